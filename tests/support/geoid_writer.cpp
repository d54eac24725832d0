#include "tests/support/geoid_writer.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {
namespace {

void put_big_endian(std::vector<std::byte>& out, std::uint64_t bits, int width) {
  for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}

}  // namespace

double lottery(double latitude_deg, double longitude_deg) {
  auto bits = static_cast<std::uint64_t>(std::llround(latitude_deg * 3600) + 400'000) * 2'000'003U +
              static_cast<std::uint64_t>(std::llround(longitude_deg * 3600) + 2'000'000);
  bits ^= bits >> 33U;
  bits *= 0xff51afd7ed558ccdULL;
  bits ^= bits >> 33U;
  bits *= 0xc4ceb9fe1a85ec53ULL;
  bits ^= bits >> 33U;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

void write_geoid(const std::string& file, const CellRange& cells, double least_m, double more_m) {
  constexpr double step_deg = 0.5;
  std::vector<std::byte> out;
  const int rows = 2 * (cells.north_deg - cells.south_deg) + 1;
  const int columns = 2 * (cells.east_deg - cells.west_deg) + 1;
  for (const double header : {1.0 * cells.south_deg, 1.0 * cells.west_deg, step_deg, step_deg}) {
    put_big_endian(out, std::bit_cast<std::uint64_t>(header), 8);
  }
  put_big_endian(out, static_cast<std::uint64_t>(rows), 4);
  put_big_endian(out, static_cast<std::uint64_t>(columns), 4);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto n = static_cast<float>(least_m + more_m * lottery(row, column));
      put_big_endian(out, std::bit_cast<std::uint32_t>(n), 4);
    }
  }
  write_bytes(file, out);
}

}  // namespace ridgeline::test
