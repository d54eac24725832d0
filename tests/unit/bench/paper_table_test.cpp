// The papers' rows: each can be drawn, and stands beside ours with the right ratios.
#include "sim/bench/paper_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {
namespace {

TEST(Papers, all_four_are_there_and_no_other) {
  EXPECT_EQ(papers().size(), 4U);
  for (const char* name : {"loffler", "livny", "ammann", "dachsbacher"}) {
    ASSERT_NE(find_paper(name), nullptr) << name;
    EXPECT_EQ(find_paper(name)->name, name);
  }
  EXPECT_EQ(find_paper("hoppe"), nullptr);
}

TEST(Papers, every_row_names_a_method_with_settings_it_takes) {
  for (const Paper& paper : papers()) {
    for (const PaperRow& row : paper.rows) {
      MethodSpec spec;
      ASSERT_TRUE(parse_method(row.spec, spec).ok()) << row.spec;
      EXPECT_EQ(method_text(spec), row.spec);
      const auto names = method_names();
      if (std::find(names.begin(), names.end(), spec.name) == names.end()) continue;
      EXPECT_EQ(method_problem(spec), "") << row.spec;
    }
  }
}

BenchRow row_of(const char* spec, double ms) {
  BenchRow row;
  row.spec = spec;
  row.view = "all";
  row.frame_ms = {0.75 * ms};
  row.core_ms = {ms};
  row.steps = {{0.25, 0.75, 0}};
  row.error.errors_px = {0, 3};
  row.error.worst_px = 3;
  return row;
}

std::string line_of(const std::string& table, const std::string& words) {
  const std::size_t at = table.find(words);
  if (at == std::string::npos) return {};
  const std::size_t begin = table.rfind('\n', at) + 1;
  return table.substr(begin, table.find('\n', at) - begin);
}

TEST(PaperTable, puts_ratios_to_the_first_row_side_by_side) {
  BenchResult result;
  result.rows = {row_of("pgm:grid=400x1600", 100), row_of("pgm:grid=430x430", 40)};
  result.absent.push_back({"clipmap", "gone"});
  const std::string table = paper_markdown(*find_paper("livny"), result);
  const std::string line = line_of(table, "430x430");
  EXPECT_NE(line.find("| 112 | 3.20 |"), std::string::npos) << line;
  EXPECT_NE(line.find("| 30.0 | 40.0 | 2.50 | 0.78 | 50.00 | 1.500 | 3.00 | 0 |"),
            std::string::npos)
      << line;
  EXPECT_NE(line.find("| 0.25 + 0.75 |"), std::string::npos) << line;
  EXPECT_NE(line_of(table, "geometry clipmaps").find("absent: gone"), std::string::npos);
  EXPECT_NE(line_of(table, "| mesh |").find("not drawn"), std::string::npos);
  const auto cells = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '|');
  };
  const auto head = cells(line_of(table, "| setting |"));
  for (const char* words : {"|---", "430x430", "geometry clipmaps", "| raycast |"}) {
    EXPECT_EQ(cells(line_of(table, words)), head) << words;
  }
}

}  // namespace
}  // namespace ridgeline::sim
