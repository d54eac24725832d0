// Blocks in a polar chart against a plain reading of the same tiles at many places.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/terrain/terrain_block.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr int rows_to_pole = 120, circle = 7200, tile_columns = 200;  // 30" by 3' posts

/// The lattice of the tiles, from one degree off the pole, its rows running north.
PostLattice lattice_at(Chart chart) {
  return {chart == Chart::north_polar ? 89.0 : -90.0, -180.0, 1.0 / 120, 1.0 / 20};
}

/// A cap of tiles ten degrees wide, each with heights of its own: neighbours disagree. One of them
/// may be missing.
Ground cap_of(Chart chart, const std::function<Ground::Height(int seed)>& heights,
              int missing = -1) {
  Ground ground(lattice_at(chart));
  for (int k = 0; k < circle / tile_columns; ++k) {
    if (k == missing) continue;
    ground.add({k * tile_columns, 0, 1, 1, tile_columns + 1, rows_to_pole + 1}, heights(k));
  }
  return ground;
}

/// Hills that are smooth over the pole, raised by a seed of the tile.
Ground::Height hills(Chart chart, int seed) {
  return [=](int column, int row) {
    const double p = chart == Chart::north_polar ? rows_to_pole - row : row;
    const double angle = column * 2 * 3.14159265358979 / circle;
    const double x = p * std::sin(angle), y = p * std::cos(angle);
    return static_cast<float>(900 + 200 * std::sin(x / 4) * std::cos(y / 5) + seed % 3);
  };
}

struct Built {
  TerrainBlock block;
  std::vector<float> posts, rows, low, high;

  explicit Built(const Ground& ground, Chart chart, const BlockId& id) {
    TerrainSource source = ground.source();
    source.lattice = lattice_in(chart, ground.lattice());
    posts.resize(static_cast<std::size_t>(region_side(id.level)) *
                 static_cast<std::size_t>(region_side(id.level)));
    rows.resize(static_cast<std::size_t>(row_scratch(id.level)));
    low.resize(polar_cells(id.level));
    high.resize(polar_cells(id.level));
    build_block(source, id, 100.0, {posts, rows, {}, low, high}, block);
  }
};

/// What the block draws at a place of its own, in posts of its level; NaN where a corner is void.
double drawn_m(const TerrainBlock& block, double x, double y) {
  const int c = static_cast<int>(x), r = static_cast<int>(y);
  const auto post = [&](int i, int j) {
    return static_cast<double>(block.posts[static_cast<std::size_t>(j * block_posts + i)]);
  };
  const double sw = post(c, r), se = post(c + 1, r), nw = post(c, r + 1), ne = post(c + 1, r + 1);
  if (std::min({sw, se, nw, ne}) < static_cast<double>(void_threshold_m)) return std::nan("");
  const double u = x - c, v = y - r;
  return (sw * (1 - u) + se * u) * (1 - v) + (nw * (1 - u) + ne * u) * v;
}

struct Found {
  double largest_of_residual = 0;  ///< error over what the block says
  int wrong_class = 0, known = 0, unknown = 0;
};

/// Compares a block with the truth at many places inside it.
Found compared(const Ground& ground, Chart chart, const TerrainBlock& block, int count) {
  const PostLattice lattice = lattice_in(chart, ground.lattice());
  const double span = block_posts << block.id.level;
  Found found;
  for (int k = 0; k < count; ++k) {
    const double x = 62.999 * lottery(k, 1, 77), y = 62.999 * lottery(k, 2, 78);
    const GroundPlace place = lattice.place_of(block.id.column * span + x * (1 << block.id.level),
                                               block.id.row * span + y * (1 << block.id.level));
    const double column = (place.longitude_deg + 180.0) * 20.0;
    const double row = ground.lattice().row_of(place.latitude_deg);
    const double truth = ground.height_m(column, row), drawn = drawn_m(block, x, y);
    ++(std::isnan(truth) ? found.unknown : found.known);
    if (std::isnan(truth) != std::isnan(drawn)) ++found.wrong_class;
    if (std::isnan(truth) || std::isnan(drawn) || block.facts.mixed) continue;
    EXPECT_LE(truth, static_cast<double>(block.facts.highest_m));
    EXPECT_GE(truth, static_cast<double>(block.facts.lowest_m));
    const int part = static_cast<int>(y) / 16 * residual_parts + static_cast<int>(x) / 16;
    const auto residual =
        static_cast<double>(block.facts.part_residual_m[static_cast<std::size_t>(part)]);
    EXPECT_LE(std::abs(drawn - truth), residual)
        << place.latitude_deg << ' ' << place.longitude_deg;
    found.largest_of_residual =
        std::max(found.largest_of_residual, std::abs(drawn - truth) / residual);
  }
  return found;
}

class PolarBlock : public testing::TestWithParam<Chart> {};

/// At the pole, beside it, on a diagonal, and where the cap ends.
const std::vector<BlockId> blocks{{0, 0, 0},  {0, -1, -1}, {0, -1, 0}, {0, 1, 0},  {0, -2, 1},
                                  {1, 0, -1}, {1, -1, 0},  {2, 0, 0},  {2, -1, -1}};

TEST_P(PolarBlock, rough_truth_stays_within_the_residual) {
  Ground ground = cap_of(GetParam(), [](int seed) { return rough(seed); });
  ground.edit({3000, GetParam() == Chart::north_polar ? 110 : 4, 1, 1, 300, 6},
              [](int, int) { return 4000.0F; });
  ground.finish();
  for (const BlockId& id : blocks) {
    const Built built(ground, GetParam(), id);
    EXPECT_EQ(built.block.chart, GetParam());
    compared(ground, GetParam(), built.block, 20'000);
  }
}

TEST_P(PolarBlock, residual_of_smooth_ground_is_small) {
  const Chart chart = GetParam();
  Ground ground = cap_of(chart, [chart](int seed) { return hills(chart, seed); });
  ground.finish();
  for (const BlockId& id : blocks) {
    const Built built(ground, chart, id);
    const Found found = compared(ground, chart, built.block, 20'000);
    if (id.level > 0) continue;
    EXPECT_LT(built.block.facts.residual_m, 60.0F) << id.column << ' ' << id.row;
    EXPECT_FALSE(built.block.facts.mixed);
    EXPECT_GT(found.largest_of_residual, 0.1);
  }
}

TEST_P(PolarBlock, flat_ground_has_no_residual) {
  Ground ground = cap_of(GetParam(), [](int) { return [](int, int) { return 2800.0F; }; });
  ground.finish();
  for (const BlockId& id : {BlockId{0, 0, 0}, BlockId{0, -2, 1}, BlockId{1, -1, 0}}) {
    const Built built(ground, GetParam(), id);
    EXPECT_EQ(built.block.facts.residual_m, 0.0F);
    for (const float post : built.block.posts) EXPECT_EQ(post, 2800.0F);
    for (const float node : built.block.highest) EXPECT_EQ(node, 2800.0F);
  }
}

TEST_P(PolarBlock, unknown_ground_is_drawn_so_or_the_block_is_not_drawn) {
  int mixed = 0, whole = 0;
  for (const int missing : {9, 18, 31}) {
    Ground ground = cap_of(
        GetParam(), [](int seed) { return rough_with_voids(seed); }, missing);
    ground.finish();
    for (std::int32_t row = -4; row < 4; ++row) {
      for (std::int32_t column = -4; column < 4; ++column) {
        const Built built(ground, GetParam(), {0, column, row});
        const Found found = compared(ground, GetParam(), built.block, 2'000);
        ++(built.block.facts.mixed ? mixed : whole);
        const bool is_mixed = built.block.facts.mixed;
        EXPECT_TRUE(is_mixed || found.wrong_class == 0) << column << ' ' << row;
        EXPECT_TRUE(is_mixed || found.known == 0 || found.unknown == 0) << column << ' ' << row;
      }
    }
  }
  EXPECT_GT(mixed, 0);
  EXPECT_GT(whole, 0);
}

TEST_P(PolarBlock, place_and_point_of_the_lattice_are_inverse) {
  const PostLattice lattice = lattice_in(GetParam(), lattice_at(GetParam()));
  EXPECT_DOUBLE_EQ(lattice.latitude_step_deg, 1.0 / 240);
  EXPECT_DOUBLE_EQ(lattice.longitude_step_deg, 1.0 / 240);
  for (const double column : {-800.25, -1.5, 0.0, 0.5, 77.0}) {
    for (const double row : {-300.0, -0.5, 0.0, 12.75}) {
      const LatticePoint back = lattice.point_of(lattice.place_of(column, row), 1e6);
      EXPECT_NEAR(back.column, column, 1e-9);
      EXPECT_NEAR(back.row, row, 1e-9);
    }
  }
}

TEST_P(PolarBlock, box_of_posts_holds_all_its_places) {
  const PostLattice lattice = lattice_in(GetParam(), lattice_at(GetParam()));
  for (const PostBox& box : {PostBox{-10, -10, 21, 21}, PostBox{5, -40, 30, 90},
                             PostBox{-300, -200, 64, 64}, PostBox{-64, 1, 65, 40}}) {
    const GeoBox place = geo_box(lattice, box);
    for (int k = 0; k < 2'000; ++k) {
      const GroundPlace at = lattice.place_of(box.column + (box.columns - 1) * lottery(k, 1, 5),
                                              box.row + (box.rows - 1) * lottery(k, 2, 6));
      EXPECT_TRUE(overlaps(place, {at.latitude_deg, at.longitude_deg, 1e-9, 1e-9, 2, 2}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, PolarBlock, testing::Values(Chart::north_polar, Chart::south_polar),
                         [](const auto& side) {
                           return side.param == Chart::north_polar ? "north" : "south";
                         });

}  // namespace
}  // namespace ridgeline::test
