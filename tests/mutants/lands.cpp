#include "tests/mutants/lands.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

void put_big_endian(std::vector<std::byte>& out, std::uint64_t bits, int width) {
  for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}

}  // namespace

void write_coarse_cells(const std::string& folder, const CellRange& cells,
                        const sim::HeightFunction& height_m) {
  for (int south = cells.south_deg; south < cells.north_deg; ++south) {
    const DtedShape shape = dted_shape(0, south);
    for (int west = cells.west_deg; west < cells.east_deg; ++west) {
      char name[32];
      std::snprintf(name, sizeof name, "/%c%02d_%c%03d.dt0", south < 0 ? 's' : 'n', std::abs(south),
                    west < 0 ? 'w' : 'e', std::abs(west));
      write_dted(folder + name, 0, south, west, [&](int row, int column) -> std::optional<int> {
        const double h =
            height_m(south + row / (shape.rows - 1.0), west + column / (shape.columns - 1.0));
        if (std::isnan(h)) return std::nullopt;
        return sim::stored_height_m(h);
      });
    }
  }
}

void write_fine_cell(const std::string& folder, int south_deg, int west_deg,
                     const sim::HeightFunction& height_m) {
  const sim::Outcome written = sim::write_tile_with(folder, south_deg, west_deg, 1201, height_m);
  if (written.ok()) return;
  std::fprintf(stderr, "%s\n", written.message.c_str());
  std::abort();
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

double rough_m(double latitude_deg, double longitude_deg) {
  const double lon = longitude_deg < 0 ? longitude_deg + 360 : longitude_deg;
  const double chance = lottery(latitude_deg, lon);
  return 1100 + 600 * std::sin(latitude_deg * 23) * std::cos(lon * 19) +
         300 * std::sin(latitude_deg * 91 + lon * 67) + 200 * chance + (chance > 0.98 ? 1000 : 0);
}

double rough_with_voids_m(double latitude_deg, double longitude_deg) {
  const bool island = std::sin(latitude_deg * 90) * std::sin(longitude_deg * 70) > 0.9;
  const bool speck = lottery(longitude_deg, latitude_deg) > 0.995;
  return island || speck ? std::nan("") : rough_m(latitude_deg, longitude_deg);
}

double spires_m(double latitude_deg, double longitude_deg) {
  const double chance = lottery(latitude_deg, longitude_deg);
  return 300 + (chance > 1 - 1.0 / 300 ? 500 + 1500 * lottery(longitude_deg, latitude_deg) : 0.0);
}

double walls_m(double latitude_deg, double longitude_deg) {
  const auto row = std::llround(latitude_deg * 120), column = std::llround(longitude_deg * 120);
  const double north = row % 11 == 0 ? 3000 * lottery(latitude_deg, 0) : 0;
  const double east = column % 13 == 0 ? 3000 * lottery(0, longitude_deg) : 0;
  return std::max(north, east);
}

double sea_m(double /*latitude_deg*/, double /*longitude_deg*/) {
  return 0;
}

}  // namespace ridgeline::test
