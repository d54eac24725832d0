#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <string>

#include "config/bus_icd.hpp"

namespace ridgeline {
namespace {

std::string unit_text(BusUnit unit) {
  switch (unit) {
    case BusUnit::deg:
      return "deg";
    case BusUnit::deg_per_s:
      return "deg/s";
    case BusUnit::m:
      return "m";
    case BusUnit::m_per_s:
      return "m/s";
    case BusUnit::s_of_day:
      return "s of day";
    case BusUnit::days_since_1970:
      return "days since 1970";
  }
  return "";
}

std::string types_text(std::uint32_t types) {
  const std::pair<CanasType, const char*> names[] = {{CanasType::float32, "FLOAT"},
                                                     {CanasType::short2, "SHORT2"},
                                                     {CanasType::int32, "LONG"},
                                                     {CanasType::char4, "CHAR4"},
                                                     {CanasType::double_high, "DOUBLEH/L"}};
  std::string text;
  for (const auto& [type, name] : names) {
    if ((types & type_bit(type)) != 0) text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

std::string table_line(const BusIcdRow& row) {
  char text[256];
  const BusQuantity& q = row.quantity;
  std::snprintf(text, sizeof text, "| %u | %03X | %s | %s | %s | %g..%g%s | %s | %g |", row.id,
                row.id, std::string(row.name).c_str(), unit_text(q.unit).c_str(),
                types_text(q.types).c_str(), q.minimum, q.maximum, q.wraps ? ", wrapped" : "",
                row.rate_hz > 0.0 ? std::to_string(static_cast<int>(row.rate_hz)).c_str() : "-",
                static_cast<double>(row.timeout_ns) * 1e-9);
  return text;
}

TEST(IcdDocument, its_table_is_the_one_the_code_obeys) {
  std::ifstream file(RL_SOURCE_DIR "/docs/icd.md");
  ASSERT_TRUE(file.good());
  std::set<std::string> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.size() > 2 && line[0] == '|' && line[2] >= '0' && line[2] <= '9') rows.insert(line);
  }
  for (const BusIcdRow& row : bus_icd) {
    EXPECT_EQ(rows.count(table_line(row)), 1U) << table_line(row);
  }
  EXPECT_EQ(rows.size(), bus_icd.size());
}

}  // namespace
}  // namespace ridgeline
