#include "core/terrain/terrain_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "config/limits.hpp"
#include "core/frame/terrain_keeper.hpp"

namespace ridgeline {
namespace {

const float unknown = std::nanf("");
using Height = std::function<float(int row, int column)>;

/// A decoded tile that owns its posts.
struct Tile {
  std::vector<float> posts;
  HeightTile view;

  Tile(const PostGrid& grid, const Height& height_m)
      : posts(static_cast<std::size_t>(grid.rows) * grid.columns) {
    for (int r = 0; r < grid.rows; ++r) {
      for (int c = 0; c < grid.columns; ++c) {
        posts[static_cast<std::size_t>(r) * grid.columns + c] = height_m(r, c);
      }
    }
    view = {grid, TileLayout::float32_rows, std::as_bytes(std::span(posts))};
  }
};

constexpr double step = 1.0 / 1200;

PostGrid grid_of(double south_deg, double west_deg, int posts, int ratio = 1) {
  return {south_deg, west_deg, ratio * step, ratio * step, posts, posts};
}

/// A window of 512 x 512 posts filled from tiles.
struct Window {
  WindowGrid grid;
  WindowSummary summary;
  std::vector<float> posts = std::vector<float>(512 * 512);
  double base_m = 1000;

  Window(double latitude_deg, double longitude_deg, const std::vector<HeightTile>& tiles) {
    grid = window_grid_at(latitude_deg, longitude_deg, step, step, tiles[0].grid.south_deg,
                          tiles[0].grid.west_deg, 512, 512);
    std::vector<float> scratch(2 * static_cast<std::size_t>(limits::max_window_posts));
    summary = fill_window(grid, tiles, {}, base_m, posts, scratch);
  }
  [[nodiscard]] float stored(int row, int column) const {
    return posts[static_cast<std::size_t>(row) * 512 + column];
  }
  [[nodiscard]] double height_m(double latitude_deg, double longitude_deg) const {
    return window_height_m(grid, posts, latitude_deg, longitude_deg) + base_m;
  }
  /// Highest known post of the smallest aligned block of 8 to 64 posts that holds one, HAE.
  [[nodiscard]] double highest_around(int row, int column) const {
    double highest = -1e9;
    for (int size = 8; size <= 64 && highest < -1e8; size *= 2) {
      for (int r = row / size * size; r < (row / size + 1) * size; ++r) {
        for (int c = column / size * size; c < (column / size + 1) * size; ++c) {
          if (stored(r, c) < void_threshold_m) continue;
          highest = std::max(highest, static_cast<double>(stored(r, c)) + base_m);
        }
      }
    }
    return highest;
  }
  /// The floor stored at a void post, HAE.
  [[nodiscard]] double floor_m(int row, int column) const {
    EXPECT_LT(stored(row, column), void_threshold_m);
    return static_cast<double>(stored(row, column)) + static_cast<double>(void_offset_m) + base_m;
  }
};

TEST(TerrainWindow, a_seam_takes_the_taller_post) {
  const Tile west(grid_of(46, 8, 1201), [](int, int) { return 500.0F; });
  const Tile east(grid_of(46, 9, 1201), [](int row, int column) {
    return column == 0 ? (row % 2 == 0 ? 674.0F : 326.0F) : 500.0F;
  });
  for (const auto& tiles : {std::vector{west.view, east.view}, std::vector{east.view, west.view}}) {
    const Window window(46.5, 9.0, tiles);
    EXPECT_NEAR(window.height_m(46 + 600 * step, 9.0), 674, 0.01);
    EXPECT_NEAR(window.height_m(46 + 601 * step, 9.0), 500, 0.01);
    EXPECT_EQ(window.summary.tiles_used, 2);
  }
}

TEST(TerrainWindow, a_known_post_wins_over_a_void_one) {
  const Tile west(grid_of(46, 8, 1201), [](int, int) { return -3.0F; });
  const Tile east(grid_of(46, 9, 1201),
                  [](int, int column) { return column == 0 ? unknown : 500.0F; });
  for (const auto& tiles : {std::vector{west.view, east.view}, std::vector{east.view, west.view}}) {
    const Window window(46.5, 9.0, tiles);
    EXPECT_NEAR(window.height_m(46.5, 9.0), -3, 0.01);
  }
}

TEST(TerrainWindow, a_coarser_tile_keeps_its_surface) {
  const auto bumpy = [](int row, int column) {
    return 900.0F + 40.0F * static_cast<float>((row * 7 + column * 13) % 11);
  };
  const Tile fine(grid_of(46, 8, 1201), [](int, int) { return 500.0F; });
  const Tile coarse(grid_of(46, 9, 401, 3), bumpy);
  const Window window(46.5, 9.1, {fine.view, coarse.view});
  for (int k = 0; k < 300; ++k) {
    const double y = 150 + 0.29 * k, x = 1 + 0.23 * k;  // in coarse posts
    const int r = static_cast<int>(y), c = static_cast<int>(x);
    const double fy = y - r, fx = x - c;
    const auto at = [&](int dr, int dc) { return static_cast<double>(bumpy(r + dr, c + dc)); };
    const double exact = (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(0, 1)) +
                         fy * ((1 - fx) * at(1, 0) + fx * at(1, 1));
    EXPECT_NEAR(window.height_m(46 + 3 * step * y, 9 + 3 * step * x), exact, 0.01) << k;
  }
}

TEST(TerrainWindow, void_posts_carry_the_floor_of_their_block) {
  // Window posts = tile posts - 344 in both directions: the eye is on post 600, the middle on 256.
  const Tile tile(grid_of(46, 8, 1201), [](int row, int column) {
    const bool hole = row > 560 && row < 800 && column > 560 && column < 640;
    return hole ? unknown : 700.0F + static_cast<float>(row % 50);
  });
  const Window window(46.5, 8.5, {tile.view});
  int held = 0, bare = 0;
  for (int by = 0; by < 8; ++by) {
    for (int bx = 0; bx < 8; ++bx) {
      double lowest = 1e9;
      int void_row = -1, void_column = -1;
      for (int r = 64 * by; r < 64 * by + 64; ++r) {
        for (int c = 64 * bx; c < 64 * bx + 64; ++c) {
          const auto stored = static_cast<double>(window.stored(r, c));
          if (window.stored(r, c) < void_threshold_m) {
            void_row = r, void_column = c;
          } else {
            lowest = std::min(lowest, stored + window.base_m);
          }
        }
      }
      if (void_row < 0) continue;
      const double floor_m = window.floor_m(void_row, void_column);
      if (lowest < 1e9) {
        EXPECT_NEAR(floor_m, window.highest_around(void_row, void_column), 0.02) << bx << ' ' << by;
        ++held;
      } else {
        EXPECT_NEAR(floor_m, 749, 0.02) << bx << ' ' << by;  // highest known of the 5 x 5 blocks
        ++bare;
      }
    }
  }
  EXPECT_GT(held, 2);
  EXPECT_GT(bare, 0);
  EXPECT_TRUE(std::isnan(window.height_m(46 + 600 * step, 8 + 600 * step)));
}

TEST(TerrainWindow, blocks_far_from_all_posts_float_100_m_over_the_lowest) {
  const Tile tile(grid_of(46, 8, 61), [](int, int) { return 250.0F; });
  const Window window(46.0, 8.0, {tile.view});
  EXPECT_NEAR(window.floor_m(0, 0), 350, 0.02);
  EXPECT_EQ(window.summary.known_posts, 61 * 61);
  EXPECT_EQ(window.summary.void_posts, 512 * 512 - 61 * 61);
  EXPECT_GE(window.summary.highest_m, 350);  // the floor counts as the highest thing drawn
}

TEST(TerrainWindow, runs_over_the_antimeridian) {
  const Tile west(grid_of(-17, 179, 1201),
                  [](int, int column) { return static_cast<float>(column); });
  const Tile east(grid_of(-17, -180, 1201),
                  [](int, int column) { return 1200.0F + static_cast<float>(column); });
  for (const double eye_deg : {179.95, -179.95, 180.0}) {
    const Window window(-16.5, eye_deg, {west.view, east.view});
    EXPECT_EQ(window.summary.tiles_used, 2) << eye_deg;
    EXPECT_NEAR(window.height_m(-16.5, 179.95), 1140, 0.01) << eye_deg;
    EXPECT_NEAR(window.height_m(-16.5, -179.95), 1260, 0.01) << eye_deg;
    EXPECT_NEAR(window.height_m(-16.5, 180), 1200, 0.01) << eye_deg;
    EXPECT_NEAR(window.height_m(-16.5, -180), 1200, 0.01) << eye_deg;
  }
}

TEST(TerrainWindow, a_tile_off_the_grid_is_left_out_and_counted) {
  const Tile good(grid_of(46, 8, 1201), [](int, int) { return 500.0F; });
  const Tile shifted(grid_of(46 + 0.4 * step, 9, 1201), [](int, int) { return 800.0F; });
  const Window window(46.5, 9.0, {good.view, shifted.view});
  EXPECT_EQ(window.summary.tiles_used, 1);
  EXPECT_EQ(window.summary.tiles_mismatched, 1);
  EXPECT_TRUE(std::isnan(window.height_m(46.5, 9.1)));
}

class OneTile final : public TerrainPort {
 public:
  explicit OneTile(const HeightTile& tile) : tile_(tile) {}
  std::span<const HeightTile> select(const GeoBox&) override { return {&tile_, 1}; }
  [[nodiscard]] int refused_count() const override { return 0; }

 private:
  HeightTile tile_;
};

TEST(TerrainKeeper, clearance_is_a_lower_bound_on_the_distance_to_the_ground) {
  const auto rough = [](int row, int column) {
    return 800.0F + static_cast<float>((row * 7919 + column * 104'729) % 211);
  };
  const Tile tile(grid_of(46, 8, 1201), rough);
  OneTile port(tile.view);
  std::vector<float> posts(512 * 512);
  std::vector<float> scratch(2 * static_cast<std::size_t>(limits::max_window_posts));
  TerrainKeeper keeper(port, {}, 512, 512, posts, scratch);
  for (int k = 0; k < 60; ++k) {
    GeodeticPosition eye{46.5 + 0.00037 * k, 8.5 + 0.00053 * k, 2000};
    static_cast<void>(keeper.follow(eye, 8'000));
    eye.height_m -= keeper.height_over_terrain_m(eye) - std::pow(10.0, 0.05 * k);
    const double claimed_m = keeper.clearance_m(eye);
    const LocalFrame frame = local_frame(eye).value();
    double nearest_m = 1e9;
    for (int dy = -80; dy <= 80; ++dy) {  // 1/20 post apart, four posts each way
      for (int dx = -80; dx <= 80; ++dx) {
        GeodeticPosition ground{eye.latitude_deg + dy * step / 20,
                                eye.longitude_deg + dx * step / 20, 0};
        ground.height_m =
            window_height_m(keeper.grid(), posts, ground.latitude_deg, ground.longitude_deg) +
            keeper.base_height_m();
        nearest_m =
            std::min(nearest_m, glm::length((ecef_from_geodetic(ground) - frame.eye_ecef).xyz));
      }
    }
    EXPECT_LE(claimed_m, nearest_m * 1.0001 + 1e-3) << k;
    EXPECT_GT(claimed_m, 0.0);
  }
}

TEST(TerrainKeeper, fills_the_window_only_when_the_range_would_leave_it) {
  const Tile tile(grid_of(46, 8, 1201), [](int, int) { return 300.0F; });
  OneTile port(tile.view);
  std::vector<float> posts(512 * 512);
  std::vector<float> scratch(2 * static_cast<std::size_t>(limits::max_window_posts));
  TerrainKeeper keeper(port, {}, 512, 512, posts, scratch);
  EXPECT_TRUE(keeper.follow({46.5, 8.5, 900}, 8'000));
  EXPECT_FALSE(keeper.follow({46.5, 8.5, 950}, 8'000));
  EXPECT_FALSE(keeper.follow({46.51, 8.51, 950}, 8'000));
  EXPECT_EQ(keeper.covered_range_m({46.51, 8.51, 950}, 8'000), 8'000);
  EXPECT_TRUE(keeper.follow({46.7, 8.5, 950}, 8'000));
  EXPECT_NEAR(keeper.height_over_terrain_m({46.7, 8.5, 950}), 650, 0.01);
}

/// One tile, handed out only for boxes that meet it.
class DistantTile final : public TerrainPort {
 public:
  explicit DistantTile(const HeightTile& tile) : tile_(tile) {}
  std::span<const HeightTile> select(const GeoBox& box) override {
    return overlaps(box, tile_.grid) ? std::span<const HeightTile>(&tile_, 1)
                                     : std::span<const HeightTile>();
  }
  [[nodiscard]] int refused_count() const override { return 0; }

 private:
  HeightTile tile_;
};

// 2026-11-22: steps came from tiles within 1 km, so a coarse tile 30 km away was never chosen.
TEST(TerrainKeeper, finds_a_coarse_tile_at_the_far_side_of_its_range) {
  const Tile tile(grid_of(5, 0, 121, 10), [](int, int) { return 70.0F; });
  DistantTile port(tile.view);
  std::vector<float> posts(512 * 512);
  std::vector<float> scratch(2 * static_cast<std::size_t>(limits::max_window_posts));
  TerrainKeeper keeper(port, {}, 512, 512, posts, scratch);
  EXPECT_TRUE(keeper.follow({5.6, -0.3, 900}, 60'000));
  EXPECT_GT(keeper.summary().known_posts, 0);
  EXPECT_EQ(keeper.covered_range_m({5.6, -0.3, 900}, 60'000), 60'000);
}

}  // namespace
}  // namespace ridgeline
