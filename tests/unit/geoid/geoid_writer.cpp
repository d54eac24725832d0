#include "tests/unit/geoid/geoid_writer.hpp"

#include <bit>
#include <cstdint>

namespace ridgeline::test {
namespace {

void append(std::vector<std::byte>& out, const std::string& text) {
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

void append_big_endian(std::vector<std::byte>& out, std::uint64_t value, int width) {
  for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((value >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}

}  // namespace

std::vector<std::byte> geoid_pgm_bytes(int columns, int rows, const std::string& offset_m,
                                       const std::string& scale_m,
                                       const std::function<unsigned(int row, int column)>& sample) {
  std::vector<std::byte> out;
  append(out, "P5\n# Geoid file in PGM format\n# Description a geoid of the tests\n");
  append(out, "# DateTime 2020-01-01 00:00:00\n# MaxBilinearError 1\n# RMSBilinearError 1\n");
  append(out, "# MaxCubicError 1\n# RMSCubicError 1\n");
  append(out, "# Offset " + offset_m + "\n# Scale " + scale_m + "\n# Origin 90N 0E\n");
  append(out, "# AREA_OR_POINT Point\n# Vertical_Datum WGS84\n");
  append(out, std::to_string(columns) + " " + std::to_string(rows) + "\n65535\n");
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      append_big_endian(out, sample(row, column), 2);
    }
  }
  return out;
}

std::vector<std::byte> geoid_gtx_bytes(const GtxPlace& place,
                                       const std::function<float(int row, int column)>& post_m) {
  std::vector<std::byte> out;
  for (const double value :
       {place.south_deg, place.west_deg, place.latitude_step_deg, place.longitude_step_deg}) {
    append_big_endian(out, std::bit_cast<std::uint64_t>(value), 8);
  }
  append_big_endian(out, static_cast<std::uint32_t>(place.rows), 4);
  append_big_endian(out, static_cast<std::uint32_t>(place.columns), 4);
  for (int row = 0; row < place.rows; ++row) {
    for (int column = 0; column < place.columns; ++column) {
      append_big_endian(out, std::bit_cast<std::uint32_t>(post_m(row, column)), 4);
    }
  }
  return out;
}

}  // namespace ridgeline::test
