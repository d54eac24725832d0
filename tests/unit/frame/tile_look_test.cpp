// How a tile lies in the picture: what tile_look() says bounds every point of the tile, in banked,
// pitched and wide pictures and with pixels of any shape.
#include "core/frame/tile_look.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double earth_radius_m = 6'371'000.0;
constexpr double grown_px = 4.0;
constexpr int samples = 16;

struct TileCase {
  Camera camera;
  RayTile tile;
  double range_m = 0;
};

class Cases {
 public:
  explicit Cases(unsigned seed) : random_(seed) {}

  double unit() { return static_cast<double>(random_()) * 0x1p-32; }
  int whole(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

  TileCase next() {
    const ImageGeometry image{64 + whole(1400), 64 + whole(900), 10 + 110 * unit()};
    const bool level = whole(3) == 0;
    const Attitude attitude{level ? 0.0 : 360 * unit() - 180, 180 * unit() - 90, 360 * unit()};
    TileCase result;
    result.camera = camera(attitude, image).value();
    if (whole(2) == 0) result.camera.fy *= std::exp2(2 * unit() - 1);
    const int width = 1 + whole(ray_tile_px), height = 1 + whole(ray_tile_px);
    const bool whole_tile = whole(4) > 0;
    result.tile.size =
        whole_tile ? RayTile::pair(ray_tile_px, ray_tile_px) : RayTile::pair(width, height);
    result.tile.origin = RayTile::pair(whole(image.width_px - result.tile.width() + 1),
                                       whole(image.height_px - result.tile.height() + 1));
    result.range_m = 1000 + 150'000 * unit() * unit();
    return result;
  }

 private:
  std::mt19937 random_;
};

/// The picture at one point, and how far that looks down.
struct PointLook {
  Upright upright;
  double down_rad = 0;
};

PointLook look_at(const Camera& camera, double u_px, double v_px) {
  PointLook look;
  look.upright = upright_at(camera, (u_px - camera.cx) / camera.fx, (v_px - camera.cy) / camera.fy);
  look.down_rad = std::asin(std::clamp(-glm::normalize(camera.ray(u_px, v_px).xyz).z, -1.0, 1.0));
  return look;
}

/// But those so near to the vertical that nothing is said of them.
template <typename Use>
void over_points(const TileCase& c, const Use& use) {
  for (int j = 0; j <= samples; ++j) {
    for (int i = 0; i <= samples; ++i) {
      const PointLook point = look_at(c.camera, c.tile.x() + i * c.tile.width() / double{samples},
                                      c.tile.y() + j * c.tile.height() / double{samples});
      if (point.upright.px_per_rad > 0) use(point);
    }
  }
}

/// What a block must bear at one point, without any allowance.
double needed_at(const PointLook& point, double range_m, double steepness) {
  const double down_rad = std::max(point.down_rad + range_m / earth_radius_m, 0.0);
  const double across = std::cos(down_rad), sine = steepness * std::sin(down_rad);
  const double stretch = point.upright.px_per_rad / point.upright.beside_px_per_rad;
  return steepness / std::sqrt(across * across - sine * sine) * stretch +
         std::abs(point.upright.skew);
}

// 2026-11-25: corners alone missed up to half of what the middle of a tile needs, in pictures of so
// few and so wide pixels that a tile spans 20 degrees and more.
TEST(TileLook, bounds_what_every_point_of_the_tile_needs) {
  Cases cases(1101);
  int known = 0, skewed = 0;
  for (int k = 0; k < 20'000; ++k) {
    const TileCase c = cases.next();
    const TileLook look = tile_look(c.camera, c.tile, grown_px, c.range_m);
    if (!look.known) continue;
    ++known;
    skewed += look.skew > 0.3 ? 1 : 0;
    for (const double steepness : {0.05, 0.3, 1.0, 3.0, 10.0}) {
      const double needed = needed_steepness(look, steepness);
      if (std::isinf(needed)) continue;
      double most = 0;
      over_points(c, [&](const PointLook& point) {
        most = std::max(most, needed_at(point, c.range_m, steepness));
      });
      EXPECT_LE(most, needed) << "case " << k << ", steepness " << steepness << ", down "
                              << look.down_rad << ", turn "
                              << (look.last_bin - look.first_bin) * way_bin_rad;
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(known, 5000);
  EXPECT_GT(skewed, 300);
}

TEST(TileLook, bins_hold_the_vertical_of_every_point) {
  Cases cases(1102);
  for (int k = 0; k < 20'000 && !testing::Test::HasFailure(); ++k) {
    const TileCase c = cases.next();
    const TileLook look = tile_look(c.camera, c.tile, grown_px, c.range_m);
    if (!look.known) continue;
    const double first_rad = look.first_bin * way_bin_rad;
    const double last_rad = (look.last_bin + 1) * way_bin_rad;
    const double middle_rad = 0.5 * (first_rad + last_rad);
    over_points(c, [&](const PointLook& point) {
      const double angle = std::atan2(point.upright.way.y, point.upright.way.x);
      const double off = std::abs(std::remainder(angle - middle_rad, std::numbers::pi));
      EXPECT_LE(off, 0.5 * (last_rad - first_rad) + 1e-9)
          << "case " << k << ", from " << first_rad << " to " << last_rad;
    });
  }
}

// What `more` is for: the points looked at do not bound all that is between.
TEST(TileLook, points_alone_are_not_enough) {
  Cases cases(1103);
  int more_needed = 0;
  for (int k = 0; k < 20'000; ++k) {
    const TileCase c = cases.next();
    TileLook look = tile_look(c.camera, c.tile, grown_px, 0.0);
    if (!look.known) continue;
    look.more = 1.0;
    double most = 0;
    over_points(c,
                [&](const PointLook& point) { most = std::max(most, needed_at(point, 0.0, 0.3)); });
    more_needed += most > needed_steepness(look, 0.3) * (1 + 1e-9) ? 1 : 0;
  }
  EXPECT_GT(more_needed, 0);  // 4 of 20,000
}

TEST(TileLook, is_unknown_where_the_vertical_itself_is_near) {
  const Camera below = camera({0, -90, 0}, {320, 256, 60}).value();
  const RayTile middle{RayTile::pair(144, 112), 0, RayTile::pair(32, 32), 0};
  EXPECT_FALSE(tile_look(below, middle, grown_px, 1000).known);
  EXPECT_TRUE(std::isinf(needed_steepness(tile_look(below, middle, grown_px, 1000), 0.05)));
}

}  // namespace
}  // namespace ridgeline
