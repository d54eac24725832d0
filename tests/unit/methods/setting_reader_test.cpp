// Settings of methods: every kind takes what it should and names what it should not.
#include "sim/methods/setting_reader.hpp"

#include <gtest/gtest.h>

namespace ridgeline::sim {
namespace {

struct Values {
  double number = 1.5;
  int whole = 3, columns = 8, rows = 9;
  bool flag = false;
  std::string word = "first";
};

std::string read(const std::vector<std::pair<std::string, std::string>>& settings, Values& values) {
  const MethodSpec spec{"some", settings};
  SettingReader reader(spec);
  reader.number("number", values.number, -1.0, 2.0);
  reader.whole("whole", values.whole, 1, 10);
  reader.flag("flag", values.flag);
  reader.grid("grid", values.columns, values.rows, 2, 4096);
  reader.word("word", values.word, {"first", "second"});
  return reader.problem();
}

TEST(SettingReader, what_is_not_given_stays) {
  Values values;
  EXPECT_EQ(read({}, values), "");
  EXPECT_EQ(values.number, 1.5);
  EXPECT_EQ(values.whole, 3);
  EXPECT_EQ(values.columns, 8);
  EXPECT_EQ(values.word, "first");
}

TEST(SettingReader, every_kind_is_read) {
  Values values;
  EXPECT_EQ(read({{"grid", "512x256"},
                  {"flag", "on"},
                  {"number", "-0.25"},
                  {"word", "second"},
                  {"whole", "10"}},
                 values),
            "");
  EXPECT_EQ(values.number, -0.25);
  EXPECT_EQ(values.whole, 10);
  EXPECT_TRUE(values.flag);
  EXPECT_EQ(values.columns, 512);
  EXPECT_EQ(values.rows, 256);
  EXPECT_EQ(values.word, "second");
}

TEST(SettingReader, a_wrong_value_is_named_with_what_would_be_right) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"number", "2.5"}, {"number", "nan"}, {"number", "1 "}, {"whole", "0"},    {"whole", "1.5"},
      {"whole", "x"},    {"flag", "yes"},   {"grid", "512"},  {"grid", "512x1"}, {"grid", "x256"},
      {"grid", "8x8x8"}, {"word", "third"}, {"other", "1"}};
  for (const auto& setting : wrong) {
    Values values;
    const std::string problem = read({setting}, values);
    EXPECT_NE(problem.find(setting.first), std::string::npos) << problem;
    EXPECT_NE(problem.find("some"), std::string::npos) << problem;
    EXPECT_EQ(values.whole, 3);
    EXPECT_EQ(values.columns, 8);
    EXPECT_EQ(values.number, 1.5);
  }
}

}  // namespace
}  // namespace ridgeline::sim
