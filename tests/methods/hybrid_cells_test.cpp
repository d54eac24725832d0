// How `hybrid` divides the height field and chooses how each cell is drawn; no GL.
#include "sim/methods/hybrid_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeline::test {
namespace {

constexpr int side = 32;
constexpr double range_m = 30'000;

/// A window of 256 x 256 posts of 3" round 46 N 8 E, all of it drawable.
class Field {
 public:
  explicit Field(float height_m) {
    terrain_.view.lattice.latitude_step_deg = 1.0 / 1200;
    terrain_.view.lattice.longitude_step_deg = 1.0 / 1200;
    terrain_.view.lattice.origin_latitude_deg = 46;
    terrain_.view.lattice.origin_longitude_deg = 8;
    terrain_.view.sizes = {1, 4, 4};
    terrain_.view.drawable[0] = {0, 0, 255, 255};
    posts_.assign(256U * 256U, height_m);
    terrain_.lowest_m = terrain_.highest_m = static_cast<double>(height_m);
    terrain_.range_m = range_m;
  }
  void put(int column, int row, float height_m) {
    posts_[static_cast<std::size_t>(row) * 256 + column] = height_m;
    terrain_.highest_m = std::max(terrain_.highest_m, static_cast<double>(height_m));
  }
  std::vector<sim::HybridCell> cells() {
    terrain_.posts = posts_;
    return sim::hybrid_cells(terrain_, side);
  }

 private:
  sim::MethodTerrain terrain_;
  std::vector<float> posts_;
};

const sim::HybridCell& cell_at(const std::vector<sim::HybridCell>& cells, int column, int row) {
  return *std::find_if(cells.begin(), cells.end(), [&](const sim::HybridCell& cell) {
    return cell.column == column && cell.row == row;
  });
}

struct Sight {
  LocalFrame local;
  Camera view_camera;

  Sight(const GeodeticPosition& eye, const Attitude& attitude)
      : local(local_frame(eye).value()), view_camera(camera(attitude, {1024, 800, 60}).value()) {}
  [[nodiscard]] sim::CellView view(double t, double k, double relief_m = 1000) const {
    return {view_camera, local, range_m, relief_m, side, t, k};
  }
};

TEST(HybridCells, cover_the_window_once) {
  const auto cells = Field(100).cells();
  EXPECT_EQ(cells.size(), 64U);
  std::vector<int> covered(255U * 255U, 0);
  for (const sim::HybridCell& cell : cells) {
    for (int row = cell.row; row < std::min(cell.row + side, 255); ++row) {
      for (int column = cell.column; column < std::min(cell.column + side, 255); ++column) {
        ++covered[static_cast<std::size_t>(row) * 255 + column];
      }
    }
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 255 * 255);
}

TEST(HybridCells, minimum_and_maximum_overlap_by_one_post) {
  Field field(100);
  field.put(64, 96, 900);  // the corner of four cells: each draws a slope up to it
  const auto cells = field.cells();
  for (const auto& [column, row] : {std::pair{32, 64}, {64, 64}, {32, 96}, {64, 96}}) {
    EXPECT_EQ(cell_at(cells, column, row).high_m, 900.0f) << column << ' ' << row;
    EXPECT_EQ(cell_at(cells, column, row).low_m, 100.0f);
  }
  EXPECT_EQ(cell_at(cells, 96, 96).high_m, 100.0f);
  EXPECT_EQ(cell_at(cells, 0, 64).high_m, 100.0f);
}

TEST(HybridCells, unknown_posts_count_at_their_floor) {
  Field field(100);
  field.put(40, 40, 700.0f - 100000.0f);
  EXPECT_EQ(cell_at(field.cells(), 32, 32).high_m, 700.0f);
  EXPECT_EQ(cell_at(field.cells(), 32, 32).low_m, 100.0f);
}

TEST(HybridCells, area_is_that_of_the_projected_box) {
  // Straight down from high up a flat cell is a rectangle of known size.
  const auto cells = Field(100).cells();
  const sim::HybridCell& cell = cell_at(cells, 96, 96);
  const double metres = 32 * 1852.0 / 20 * 1.0007;  // 32 posts of 3" of latitude at 46 N
  const double across_m = metres * std::cos(46.09 * 0.0174532925) * 1.0025;
  const Sight sight({46.0 + 112.0 / 1200, 8.0 + 112.0 / 1200, 10'100}, {0, -90, 0});
  const double focal = sight.view_camera.fx;
  const double expected = metres * across_m * focal * focal / 1e8;
  EXPECT_NEAR(sim::box_area_px(cell, sight.view(70, 1.3)) / expected, 1.0, 0.01);
}

TEST(HybridCells, classed_by_t) {
  const auto cells = Field(100).cells();
  const Sight sight({46.01, 8.1, 1500}, {0, -12, 0});
  std::size_t last_meshes = cells.size() + 1;
  for (const double t : {0.0, 20.0, 70.0, 300.0, 1e9}) {
    const sim::CellView view = sight.view(t, 1.3);
    std::size_t meshes = 0, casts = 0;
    for (const sim::HybridCell& cell : cells) {
      const sim::CellChoice choice = sim::choice_of(cell, view);
      if (choice.kind == sim::CellChoice::Kind::hidden) continue;
      const bool mesh = choice.kind == sim::CellChoice::Kind::mesh;
      EXPECT_EQ(mesh, sim::box_area_px(cell, view) / side > t);
      (mesh ? meshes : casts) += 1;
    }
    EXPECT_LE(meshes, last_meshes);
    EXPECT_TRUE(t > 0.0 || casts == 0) << casts;
    EXPECT_TRUE(t != 70.0 || std::min(meshes, casts) > 0) << meshes << ' ' << casts;
    last_meshes = meshes;
  }
}

TEST(HybridCells, a_box_that_reaches_behind_the_eye_is_a_mesh) {
  const auto cells = Field(100).cells();
  const Sight sight({46.0 + 112.0 / 1200, 8.0 + 112.0 / 1200, 150}, {0, 0, 0});
  const sim::CellChoice choice = sim::choice_of(cell_at(cells, 96, 96), sight.view(1e9, 1.3));
  EXPECT_EQ(choice.kind, sim::CellChoice::Kind::mesh);
  EXPECT_EQ(sim::box_area_px(cell_at(cells, 96, 96), sight.view(1e9, 1.3)),
            std::numeric_limits<double>::infinity());
}

TEST(HybridCells, precision_is_the_level_of_the_formula) {
  Field field(100);
  field.put(112, 208, 900);  // relief 800 in the cell at 96, 192
  const auto cells = field.cells();
  const Sight sight({46.01, 8.0 + 112.0 / 1200, 2000}, {0, -8, 0});
  const sim::HybridCell& flat = cell_at(cells, 96, 128);
  const sim::HybridCell& rough = cell_at(cells, 96, 192);
  for (const double k : {0.5, 1.3, 3.0, 10.0}) {
    const sim::CellView view = sight.view(1e9, k, 800);
    const sim::CellChoice choice = sim::choice_of(flat, view);
    ASSERT_EQ(choice.kind, sim::CellChoice::Kind::cast);
    const double l = std::min(choice.distance_m * k / range_m, 1.0);
    EXPECT_EQ(choice.precision, std::clamp(static_cast<int>(4 * l), 0, 3)) << k;
    // h = 1 and a flat line of sight leave nothing of any distance.
    EXPECT_EQ(sim::choice_of(rough, view).precision, 0) << k;
  }
}

TEST(HybridCells, what_is_behind_or_beyond_the_range_is_hidden) {
  const auto cells = Field(100).cells();
  const GeodeticPosition eye{46.0 + 112.0 / 1200, 8.1, 1500};
  const Sight north(eye, {0, -5, 0});
  EXPECT_EQ(sim::choice_of(cell_at(cells, 96, 0), north.view(70, 1)).kind,
            sim::CellChoice::Kind::hidden);
  EXPECT_NE(sim::choice_of(cell_at(cells, 96, 192), north.view(70, 1)).kind,
            sim::CellChoice::Kind::hidden);
  sim::CellView near = north.view(70, 1);
  near.range_m = 1000;
  EXPECT_EQ(sim::choice_of(cell_at(cells, 96, 192), near).kind, sim::CellChoice::Kind::hidden);
}

}  // namespace
}  // namespace ridgeline::test
