#include "sim/attack/random_case.hpp"

#include <algorithm>
#include <cmath>

#include "config/limits.hpp"
#include "core/frame/terrain_keeper.hpp"

namespace ridgeline::sim {
namespace {

constexpr double metres_per_degree = 111'195;

/// Here the disc of completeness holds one pixel centre only (docs/adr/0014).
constexpr double least_error_px = 0.25;

/// A stream of its own draws the cases of shared rays: the others stay what their seeds made them.
constexpr std::uint64_t of_shared = 0x7368'6172'6564;

/// Rough posts of longitude a degree that make cells about square.
int across(int lat_per_deg, double latitude_deg) {
  const double of_quarter = latitude_deg / 90;
  const double square = lat_per_deg * (1 - of_quarter * of_quarter);
  int divide = 1;
  while (divide < 6 && lat_per_deg % (divide + 1) == 0 && lat_per_deg / (divide + 1) >= square) {
    ++divide;
  }
  return lat_per_deg / divide;
}

TilePlan patch(TileFormat format, double south_deg, double west_deg, int lat_per_deg,
               int lon_per_deg, int rows, int columns) {
  TilePlan tile{format, south_deg, west_deg, lat_per_deg, lon_per_deg, rows, columns};
  const PostGrid grid = grid_of(tile);
  tile.south_deg = grid.south_deg;
  tile.west_deg = grid.west_deg;
  if (tile.west_deg < -180) tile.west_deg += 360;
  if (tile.west_deg >= 180) tile.west_deg -= 360;
  return tile;
}

TileFormat random_tiff(Random& r) {
  return r.chance(0.5) ? TileFormat::tif16 : TileFormat::tif32;
}

/// One patch of posts round the place, or four of the same steps that meet there.
void choose_patches(Random& r, bool four, AttackCase& c) {
  const int per_deg = static_cast<int>(r.one_of({120, 240, 360, 600, 1'200, 1'200, 3'600}));
  int lon_per_deg = r.chance(0.7) ? across(per_deg, c.at_latitude_deg) : per_deg;
  if (r.chance(0.1)) lon_per_deg = std::max(1, per_deg / 2);
  const int rows = r.whole(60, 200), columns = r.whole(60, 200);
  const double step = 1.0 / per_deg, lon_step = 1.0 / lon_per_deg;
  const TileFormat format = random_tiff(r);
  if (!four) {
    c.tiles.push_back(patch(format, c.at_latitude_deg - (rows / 2) * step,
                            c.at_longitude_deg - (columns / 2) * lon_step, per_deg, lon_per_deg,
                            rows, columns));
    return;
  }
  const int missing = r.whole(0, 7);
  for (int k = 0; k < 4; ++k) {
    if (k == missing) continue;
    const double south = c.at_latitude_deg - (k < 2 ? (rows - 1) * step : 0.0);
    const double west = c.at_longitude_deg - (k % 2 == 0 ? (columns - 1) * lon_step : 0.0);
    c.tiles.push_back(patch(format, south, west, per_deg, lon_per_deg, rows, columns));
  }
}

/// Two patches of different steps with a common edge through the place.
void choose_two_steps(Random& r, AttackCase& c) {
  const int per_deg = static_cast<int>(r.one_of({120, 300, 600, 1'200}));
  const int lon = across(per_deg, c.at_latitude_deg);
  const double ratio = lon % 2 == 0 ? r.one_of({2, 3, 3, 1.5}) : r.one_of({2, 3});
  const int finer = static_cast<int>(ratio * per_deg);
  const int rows = r.whole(50, 90), columns = r.whole(50, 120);
  const int fine_rows = static_cast<int>(ratio * (rows - 1)) + 1;
  const int fine_columns = static_cast<int>(ratio * (columns - 1)) + 1;
  const int lon_finer = static_cast<int>(ratio * lon);
  const TileFormat format = random_tiff(r);
  const bool above = r.chance(0.5);  // the finer patch is north of the other, not east of it
  const double south = c.at_latitude_deg - (above ? rows - 1.0 : rows / 2) / per_deg;
  const double west = c.at_longitude_deg - (above ? columns / 2 : columns - 1.0) / lon;
  const TilePlan coarse = patch(format, south, west, per_deg, lon, rows, columns);
  const PostGrid grid = grid_of(coarse);
  c.tiles.push_back(coarse);
  c.tiles.push_back(patch(format, above ? grid.north_deg() : grid.south_deg,
                          above ? grid.west_deg : grid.east_deg(), finer, lon_finer, fine_rows,
                          fine_columns));
}

/// Whole degrees round the place: 1, 2 or 4 cells, some stated to be sea.
void choose_cells(Random& r, TileFormat format, AttackCase& c) {
  const bool coarse = format == TileFormat::dt0;
  c.at_latitude_deg = std::clamp(std::round(c.at_latitude_deg), -89.0, 89.0);
  c.at_longitude_deg = std::round(c.at_longitude_deg);
  const int missing = r.whole(0, coarse ? 9 : 3), others = r.whole(0, 2);
  const bool sea = r.chance(0.4);
  for (int k = 0; k < 4; ++k) {
    const int south = static_cast<int>(c.at_latitude_deg) - (k < 2 ? 1 : 0);
    int west = static_cast<int>(c.at_longitude_deg) - (k % 2 == 0 ? 1 : 0);
    if (west < -180) west += 360;
    if (west >= 180) west -= 360;
    const bool has_tile = k != missing && (coarse || k == (missing + 1) % 4 ||
                                           (others == 1 && k == (missing + 2) % 4));
    if (has_tile) {
      const bool second = k % 2 == 1 && others == 1 && !coarse;
      c.tiles.push_back({second ? TileFormat::dt1 : format, static_cast<double>(south),
                         static_cast<double>(west), 0, 0, 0, 0});
    } else if (sea) {
      c.sea.push_back({south, west});
    }
  }
}

/// A cap round a pole in one file that goes once round the Earth.
void choose_cap(Random& r, AttackCase& c) {
  const bool north = c.at_latitude_deg > 0;
  const int per_deg = 120, lon_per_deg = static_cast<int>(r.one_of({1, 2, 3}));
  const int rows = r.whole(80, 150);
  const double south = north ? 90.0 - (rows - 1.0) / per_deg : -90.0;
  c.tiles.push_back(
      patch(random_tiff(r), south, -180, per_deg, lon_per_deg, rows, 360 * lon_per_deg + 1));
}

void choose_tiles(Random& r, bool polar, AttackCase& c) {
  const int kind = r.whole(0, 19);
  if (polar) {
    choose_cap(r, c);
  } else if (kind < 9) {
    choose_patches(r, false, c);
  } else if (kind < 12) {
    choose_patches(r, true, c);
  } else if (kind < 14) {
    choose_two_steps(r, c);
  } else if (kind < 19) {
    choose_cells(r, TileFormat::dt0, c);
  } else {
    choose_cells(r, r.chance(0.7) ? TileFormat::hgt : TileFormat::dt1, c);
  }
}

/// Whether the case lies at a pole.
bool choose_place(Random& r, AttackCase& c) {
  struct Site {
    double latitude_deg, longitude_deg;
  };
  constexpr Site sites[] = {{46.5, 8.5}, {46, 9},    {37.25, -3.3},   {-45.5, -72.5}, {-33, 151},
                            {0, 0},      {0, 0},     {12, 180},       {-17, -180},    {51.5, 0},
                            {62.5, 20},  {70, 20},   {75, -40},       {66.6, -180},   {80, 25},
                            {-70, -65},  {0.5, 100}, {-54.25, -36.5}, {31.5, 35.5},   {50, 5}};
  const bool polar = r.chance(0.06);
  const Site& site = sites[static_cast<std::size_t>(r.whole(0, std::size(sites) - 1))];
  c.at_latitude_deg = polar ? r.one_of({89.7, 89.9, 90, -89.8, -90}) : site.latitude_deg;
  c.at_longitude_deg = site.longitude_deg;
  return polar;
}

void choose_picture(Random& r, AttackCase& c) {
  c.image.width_px = static_cast<int>(r.spread(32, r.chance(0.1) ? 400 : 160));
  c.image.height_px = static_cast<int>(r.spread(32, c.image.width_px > 200 ? 60 : 160));
  if (r.chance(0.05)) std::swap(c.image.width_px, c.image.height_px);
  c.image.horizontal_field_of_view_deg = r.chance(0.8) ? r.one_of({10, 20, 40, 60, 60, 60, 90, 120})
                                                       : with_decimals(r.between(10, 120), 1);
  c.error_px = r.chance(0.9) ? r.one_of({least_error_px, 0.5, 1, 1, 1, 2, 4, 8})
                             : r.one_of({least_error_px, limits::max_error_px, 0.7, 3});
}

/// The range: about what the tiles reach, and no more posts than a case has time for.
void choose_range(Random& r, bool polar, int most_posts, AttackCase& c) {
  const PostGrid grid = grid_of(c.tiles.front());
  double extent_m = (grid.rows - 1) * grid.latitude_step_deg * metres_per_degree;
  double finest_m = extent_m;
  for (std::size_t tile = 0; tile < c.tiles.size(); ++tile) {
    finest_m = std::min(finest_m, grid_of(c.tiles[tile]).latitude_step_deg * metres_per_degree);
  }
  if (c.tiles.size() > 1) extent_m *= 1.5;
  const double most = polar ? 30'000 : std::min({1.5 * extent_m, most_posts * finest_m, 100'000.0});
  c.range_m = std::round(r.spread(2'000, std::max(most, 3'000.0)));
}

/// A window so small that it takes several levels to reach the range; any of the numbers of levels
/// that some window has there, 1 where there is no such window.
void choose_coarse_window(Random& r, AttackCase& c) {
  std::vector<PostGrid> grids;
  for (const TilePlan& tile : c.tiles) grids.push_back(grid_of(tile));
  const PostLattice lattice = lattice_of(grids, {c.at_latitude_deg, c.at_longitude_deg, 0});
  std::vector<double> smallest_mib(max_levels + 1, 0.0);
  for (double mib = 64; mib > 0.2; mib = with_decimals(mib / 1.15, 3)) {
    const LevelSizes sizes =
        window_sizes(lattice, c.at_latitude_deg, c.range_m, mib * 1024 * 1024, false);
    smallest_mib[static_cast<std::size_t>(sizes.levels)] = mib;
  }
  smallest_mib[0] = smallest_mib[1] = 0;
  // The last one also stands for windows that do not reach the range.
  if (r.chance(0.4)) smallest_mib[max_levels] = 0;
  std::erase(smallest_mib, 0.0);
  if (smallest_mib.empty()) return;
  const int last = static_cast<int>(smallest_mib.size()) - 1;
  c.window_mib = smallest_mib[static_cast<std::size_t>(r.whole(0, last))];
}

void choose_edits(Random& r, AttackCase& c) {
  const PostGrid grid = grid_of(c.tiles.front());
  const int lat_per_deg = static_cast<int>(std::round(1 / grid.latitude_step_deg));
  const int lon_per_deg = static_cast<int>(std::round(1 / grid.longitude_step_deg));
  const int count = r.whole(1, 3);
  for (int k = 0; k < count; ++k) {
    EditPlan e;
    e.time_s = r.whole(0, static_cast<int>(c.poses.size()) - 1);
    e.rows = r.whole(1, 8);
    e.columns = r.whole(1, 8);
    e.south_deg = grid.south_deg + r.whole(0, grid.rows - e.rows) * grid.latitude_step_deg;
    e.west_deg = grid.west_deg + r.whole(0, grid.columns - e.columns) * grid.longitude_step_deg;
    if (e.west_deg > 180) e.west_deg -= 360;
    e.lat_per_deg = lat_per_deg;
    e.lon_per_deg = lon_per_deg;
    e.height_m = r.chance(0.3) ? std::nan("") : with_decimals(r.spread(1, 9'000), 1);
    c.edits.push_back(e);
  }
}

/// A picture so large, and a bound so wide, that rays may stand for several pixels.
AttackCase shared_case(Random& r) {
  AttackCase c;
  choose_place(r, c);
  c.at_latitude_deg = std::clamp(c.at_latitude_deg, -75.0, 75.0);
  choose_patches(r, r.chance(0.25), c);
  c.image.width_px = static_cast<int>(r.between(100, 300));
  c.image.height_px = static_cast<int>(r.between(100, 240));
  c.image.horizontal_field_of_view_deg = r.one_of({10, 20, 40, 60, 60, 90, 120, 120});
  c.error_px = r.one_of({0.8, 1, 1, 1.5, 2, 2, 3, 4, 5.5, 8});
  choose_range(r, false, 250, c);
  if (r.chance(0.15)) choose_coarse_window(r, c);
  choose_shared_land(r, c);
  choose_poses(r, CaseLand(c), c);
  return c;
}

}  // namespace

AttackCase random_case(std::uint64_t seed, std::uint64_t number) {
  Random shared(seed ^ of_shared, number);
  if (shared.chance(0.4)) return shared_case(shared);
  using Arrival = SceneOptions::Arrival;
  Random r(seed, number);
  AttackCase c;
  const bool polar = choose_place(r, c);
  choose_tiles(r, polar, c);
  choose_picture(r, c);
  if (polar || c.error_px > 10) {  // the oracle takes long at poles and over large discs
    c.image.width_px = std::min(c.image.width_px, 64);
    c.image.height_px = std::min(c.image.height_px, 48);
  }
  const bool gentle = polar || r.chance(0.4);
  const bool coarse = !polar && r.chance(gentle ? 0.9 : 0.25);
  choose_range(r, polar, 250, c);
  if (coarse) {
    if (r.chance(0.5)) choose_range(r, polar, 500, c);
    choose_coarse_window(r, c);
  }
  if (r.chance(0.25)) c.arrival = r.chance(0.7) ? Arrival::in_step : Arrival::as_ready;
  choose_land(r, gentle ? Roughness::gentle : Roughness::any, c);
  if (r.chance(0.08)) c.geoid = {r.one_of({5, 20, 80}), r.one_of({10, 5, 2, 1}), r.seed()};
  choose_poses(r, CaseLand(c), c);
  if (!polar && r.chance(0.1)) choose_edits(r, c);
  return c;
}

}  // namespace ridgeline::sim
