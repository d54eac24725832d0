// The tables of docs/icd.md for ARINC 429 and CAN-FIX are those the code obeys.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <string>

#include "config/arinc429_icd.hpp"
#include "config/canfix_icd.hpp"

namespace ridgeline {
namespace {

/// The lines of the table that follows a heading line, without the line of dashes.
std::multiset<std::string> table_under(const std::string& heading) {
  std::ifstream file(RL_SOURCE_DIR "/docs/icd.md");
  std::multiset<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line == heading) {
      inside = true;
    } else if (inside && line.rfind("| ", 0) != 0) {
      break;
    } else if (inside && line.rfind("| -", 0) != 0) {
      rows.insert(line);
    }
  }
  return rows;
}

std::string name_of(BusParameter parameter) {
  return std::string(icd_row(parameter).name);
}

TEST(IcdTables, arinc429_rows_are_documented) {
  constexpr const char* forms[] = {"BNR",          "BNR 20",   "BNR fine", "BCD",
                                   "BCD position", "discrete", "UTC",      "date"};
  std::multiset<std::string> expected;
  for (const Arinc429Row& row : arinc429_icd) {
    char text[128], range[32] = "-";
    if (row.range != 0.0) std::snprintf(range, sizeof range, "%g", row.range);
    std::snprintf(text, sizeof text, "| %s | %03o | %s | %s | %d |", name_of(row.parameter).c_str(),
                  row.label, forms[static_cast<std::size_t>(row.form)], range,
                  row.significant_bits);
    std::string line = text;
    for (const std::uint16_t equipment : row.equipment) {
      if (equipment == 0) break;
      std::snprintf(text, sizeof text, "%s%03X", line.back() == '|' ? " " : ", ", equipment);
      line += text;
    }
    expected.insert(line + " |");
  }
  EXPECT_EQ(table_under("| gives | label | form | range | significant bits | equipment |"),
            expected);
}

TEST(IcdTables, canfix_rows_are_documented) {
  constexpr double mps_per_kt = 1852.0 / 3600.0;
  const auto step = [](const CanfixRow& row) -> std::string {
    const BusUnit unit = icd_row(row.parameter).quantity.unit;
    char text[32];
    const bool is_rate = unit == BusUnit::deg_per_s;
    switch (unit) {
      case BusUnit::deg:
      case BusUnit::deg_per_s:
        std::snprintf(text, sizeof text, is_rate ? "%g deg/s" : "%g deg", row.unit_per_step);
        break;
      case BusUnit::m:
        std::snprintf(text, sizeof text, "%g ft", row.unit_per_step / 0.3048);
        break;
      case BusUnit::m_per_s:
        if (row.parameter == BusParameter::altitude_rate) {
          std::snprintf(text, sizeof text, "%g ft/min", row.unit_per_step * 60.0 / 0.3048);
        } else {
          std::snprintf(text, sizeof text, "%g kt", row.unit_per_step / mps_per_kt);
        }
        break;
      default:
        std::snprintf(text, sizeof text, "%g s", row.unit_per_step);
    }
    return text;
  };
  constexpr const char* types[] = {"INT", "UINT", "DINT", "FLOAT", "h, m, s, ms"};
  std::multiset<std::string> expected;
  for (const CanfixRow& row : canfix_icd) {
    expected.insert("| " + name_of(row.parameter) + " | " + std::to_string(row.id) + " | " +
                    types[static_cast<std::size_t>(row.type)] + " | " + step(row) + " |");
  }
  EXPECT_EQ(table_under("| gives | id | type | unit of a step |"), expected);
}

}  // namespace
}  // namespace ridgeline
