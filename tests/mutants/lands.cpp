#include "tests/mutants/lands.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
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
