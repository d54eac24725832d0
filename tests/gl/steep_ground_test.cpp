// What is said of the ground behind each tile of the picture, against points of the ground put into
// the picture one by one; and the plan made of it.
#include "core/frame/steep_ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include "config/limits.hpp"
#include "core/frame/ray_tiles.hpp"
#include "platform/egl_context.hpp"
#include "tests/unit/window/ground.hpp"

namespace ridgeline::test {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;

class PromptPort final : public BlockPort {
 public:
  explicit PromptPort(const Ground& ground) : ground_(ground) {}

  [[nodiscard]] int room() override {
    return limits::blocks_in_flight - static_cast<int>(orders_.size());
  }
  void order(const BlockOrder& order) override { orders_.push_back(order); }
  const TerrainBlock* take() override {
    if (orders_.empty()) return nullptr;
    const BlockOrder order = orders_.front();
    orders_.pop_front();
    return build(order);
  }
  void focus(const GeoBox& box) override { static_cast<void>(box); }
  const TerrainBlock* build(const BlockOrder& order) override {
    block_ = block_of(ground_.source(order.edits), order.id);
    return &block_;
  }
  [[nodiscard]] int refused_count() const override { return 0; }

 private:
  const Ground& ground_;
  std::deque<BlockOrder> orders_;
  TerrainBlock block_;
};

/// A window of `levels` levels, 6 x 6 blocks each, settled round an eye.
class Window {
 public:
  Window(const Ground& ground, int levels)
      : port_(ground),
        sizes_{levels, 6, 6},
        held_(static_cast<std::size_t>(levels * 36)),
        posts_(std::size_t{36} * 64 * 64),
        rests_(posts_.size()),
        keeper(port_, ground.lattice(), sizes_, held_, {posts_, rests_}) {
    auto surface = EglContext::make();
    EXPECT_TRUE(surface);
    surface_ = std::move(surface).value();
    auto made = Renderer::make({16, 16, sizes_, 64, 64}, surface_->timer_functions(),
                               [](std::string_view, std::string_view) {});
    EXPECT_TRUE(made);
    renderer_ = std::move(made).value();
  }
  void settle(const GeodeticPosition& eye) { keeper.settle(eye, *renderer_); }

 private:
  PromptPort port_;
  LevelSizes sizes_;
  std::vector<HeldBlock> held_;
  std::vector<float> posts_;
  std::vector<std::int8_t> rests_;
  std::optional<EglContext> surface_;
  std::optional<Renderer> renderer_;

 public:
  TerrainKeeper keeper;
};

constexpr int patch_posts = 24;
constexpr int half_side = 800;  ///< posts of the land to every side of its origin

/// Nearly level land with a few patches of steep teeth, so few that a tile rarely shows two; some
/// of them high up.
struct Patches {
  int seed = 0;
  float rise_m = 0;

  [[nodiscard]] bool steep(int column, int row) const { return lottery(column, row, seed) < 0.012; }
  static int floor_of(int post) {
    return static_cast<int>(std::floor(static_cast<double>(post) / patch_posts));
  }
  float operator()(int column, int row) const {
    const int part_column = floor_of(column), part_row = floor_of(row);
    const float base = 600.0F + 40.0F * std::sin(0.02F * static_cast<float>(column + row));
    if (!steep(part_column, part_row)) return base;
    const auto chance = static_cast<float>(lottery(column, row, seed + 1));
    return base + rise_m * (chance + (lottery(part_column, part_row, seed) < 0.004 ? 4.0F : 0.0F));
  }
};

Ground land(const PostLattice& lattice, const Patches& patches) {
  Ground ground(lattice);
  ground.add({-half_side, -half_side, 1, 1, 2 * half_side + 1, 2 * half_side + 1}, patches);
  ground.finish();
  return ground;
}

struct Found {
  int points = 0, steep_points = 0, sky_tiles = 0, gentle_tiles = 0, steep_tiles = 0;
};

/// Marks one picture and puts random points of the ground into it.
class Marked {
 public:
  Marked(const Ground& ground, Window& window, const GeodeticPosition& eye, const Camera& camera,
         double margin_px)
      : ground_(ground),
        local_(local_frame(eye).value()),
        camera_(camera),
        margin_px_(margin_px),
        range_m_(window.keeper.covered_range_m(eye, 150'000)),
        across_{camera.width_px, 3},
        down_{camera.height_px, 3},
        steepness_(static_cast<std::size_t>(across_.count() * down_.count())),
        eye_(eye) {
    mark_steep_ground(window.keeper, local_, camera_, {range_m_, margin_px_},
                      {across_, down_, steepness_});
  }

  /// A point of the known surface: at least as steep as that is there.
  void expect_ground_marked(double column, double row, Found& found) const {
    const double height_m = ground_.height_m(column, row);
    if (std::isnan(height_m)) return;
    const double slope = slope_at(column, row);
    const double least = slope <= static_cast<double>(gentle_steepness) ? 0.0 : slope;
    const int before = found.points;
    expect_point_marked(column, row, height_m, least, found);
    found.steep_points += found.points > before && slope > 0.2 ? 1 : 0;
  }
  void expect_point_marked(double column, double row, double height_m, double least,
                           Found& found) const {
    const PostLattice& lattice = ground_.lattice();
    const GeodeticPosition place{lattice.latitude_deg(row), lattice.longitude_deg(column),
                                 height_m};
    const Vec3<Enu> way =
        local_.ecef_from_enu.inverse() * (ecef_from_geodetic(place) - local_.eye_ecef);
    if (glm::length(way.xyz) > range_m_) return;
    const glm::dvec3 p = glm::transpose(camera_.enu_from_camera.columns) * way.xyz;
    if (p.z < 0.02) return;
    const double u = camera_.cx + camera_.fx * p.x / p.z, v = camera_.cy + camera_.fy * p.y / p.z;
    if (u < 0 || v < 0 || u > camera_.width_px || v > camera_.height_px) return;
    ++found.points;
    for (int y = down_.tile_of(v - margin_px_); y <= down_.tile_of(v + margin_px_); ++y) {
      for (int x = across_.tile_of(u - margin_px_); x <= across_.tile_of(u + margin_px_); ++x) {
        const float marked = steepness_[static_cast<std::size_t>(y * across_.count() + x)];
        EXPECT_GE(static_cast<double>(marked), least)
            << "post " << column << ", " << row << " at " << u << ", " << v << " px, "
            << glm::length(way.xyz) << " m away, tile " << x << ", " << y << ", eye at "
            << eye_.latitude_deg << ", " << eye_.longitude_deg << ", " << eye_.height_m;
      }
    }
  }
  void count_tiles(Found& found) const {
    for (const float steepness : steepness_) {
      found.sky_tiles += steepness == no_ground ? 1 : 0;
      found.gentle_tiles += steepness == 0 ? 1 : 0;
      found.steep_tiles += steepness > 0 && steepness < any_steepness ? 1 : 0;
    }
  }

 private:
  /// Of the surface through the posts; on a ball none smaller than the Earth, so none too large.
  [[nodiscard]] double slope_at(double column, double row) const {
    constexpr double step = 1e-3, radius_m = 6'400'000;
    const double x = std::floor(column) + std::clamp(column - std::floor(column), step, 1 - step);
    const double y = std::floor(row) + std::clamp(row - std::floor(row), step, 1 - step);
    const double north_m = radius_m * rad_per_deg * ground_.lattice().latitude_step_deg;
    const double east_m = radius_m * rad_per_deg * ground_.lattice().longitude_step_deg *
                          std::cos(ground_.lattice().latitude_deg(row) * rad_per_deg);
    const double h = ground_.height_m(x, y);
    const double half = 0.5 * step;
    const double east = ground_.height_m(x + half, y) - ground_.height_m(x - half, y);
    const double north = ground_.height_m(x, y + half) - ground_.height_m(x, y - half);
    if (std::isnan(h + east + north)) return 0;
    return 0.999 * std::hypot(east / (step * east_m), north / (step * north_m));
  }

  const Ground& ground_;
  LocalFrame local_;
  Camera camera_;
  double margin_px_, range_m_;
  TileAxis across_, down_;
  std::vector<float> steepness_;
  GeodeticPosition eye_;
};

/// Every post of a patch, moved into its cells by a little.
template <typename Use>
void over_posts(int patch_column, int patch_row, const Use& use) {
  constexpr double inside = 1e-6, last = patch_posts - inside;
  for (int j = 0; j <= patch_posts; ++j) {
    for (int i = 0; i <= patch_posts; ++i) {
      use(patch_column * patch_posts + std::clamp(1.0 * i, inside, last),
          patch_row * patch_posts + std::clamp(1.0 * j, inside, last));
    }
  }
}

/// Looks at some patch within the range, nearly.
Attitude towards_a_patch(const Patches& patches, const PostLattice& lattice,
                         const GeodeticPosition& eye, double range_m, std::mt19937& random) {
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  const LocalFrame local = local_frame(eye).value();
  constexpr int side = half_side / patch_posts;
  for (int k = 0; k < 100'000; ++k) {
    const int column = static_cast<int>(2 * side * unit()) - side;
    const int row = static_cast<int>(2 * side * unit()) - side;
    if (!patches.steep(column, row)) continue;
    const GeodeticPosition place{lattice.latitude_deg((row + 0.5) * patch_posts),
                                 lattice.longitude_deg((column + 0.5) * patch_posts), 700};
    const Vec3<Enu> way =
        local.ecef_from_enu.inverse() * (ecef_from_geodetic(place) - local.eye_ecef);
    const double away_m = glm::length(way.xyz);
    if (away_m > range_m) continue;
    return {unit() < 0.75 ? 0.0 : 360 * unit() - 180,
            std::asin(way.xyz.z / away_m) / rad_per_deg + 4 * unit() - 2,
            std::atan2(way.xyz.x, way.xyz.y) / rad_per_deg + 6 * unit() - 3};
  }
  return {};
}

/// Random cameras over a land; the eye once in three over the middle of a block.
Found marked_pictures(const PostLattice& lattice, const Patches& patches, int levels,
                      int pictures) {
  const Ground ground = land(lattice, patches);
  std::mt19937 random(static_cast<unsigned>(patches.seed));
  const auto unit = [&] { return static_cast<double>(random()) * 0x1p-32; };
  Window window(ground, levels);
  Found found;
  for (int k = 0; k < pictures && !testing::Test::HasFailure(); ++k) {
    const bool over_a_middle = k % 3 == 0;
    const double column = over_a_middle ? 32 : 60 * unit(), row = over_a_middle ? 32 : 60 * unit();
    const GeodeticPosition eye{ground.lattice().latitude_deg(row),
                               ground.lattice().longitude_deg(column),
                               200 + 5000 * unit() * unit()};
    window.settle(eye);
    const double range_m = window.keeper.covered_range_m(eye, 150'000);
    const double view_deg = k % 4 != 0 ? 10 + 4 * unit() : 30 + 90 * unit();
    const Attitude attitude = towards_a_patch(patches, ground.lattice(), eye, range_m, random);
    const Marked marked(ground, window, eye, camera(attitude, {1024, 320, view_deg}).value(),
                        k % 8 < 6 ? 0.0 : 6 * unit());
    marked.count_tiles(found);
    const auto expect_marked = [&](double x, double y) {
      if (!testing::Test::HasFailure()) marked.expect_ground_marked(x, y, found);
    };
    for (int i = 0; i < 4000; ++i) expect_marked(1600 * unit() - 800, 1600 * unit() - 800);
    constexpr int side = half_side / patch_posts;
    for (int patch = 0; patch < 4 * side * side; ++patch) {
      const int patch_column = patch % (2 * side) - side, patch_row = patch / (2 * side) - side;
      if (patches.steep(patch_column, patch_row))
        over_posts(patch_column, patch_row, expect_marked);
    }
  }
  return found;
}

void expect_all_kinds(const Found& found) {
  EXPECT_GT(found.points, 6'000);
  EXPECT_GT(found.steep_points, 300);
  EXPECT_GT(found.sky_tiles, 100);
  EXPECT_GT(found.gentle_tiles, 10);
  EXPECT_GT(found.steep_tiles, 100);
}

TEST(SteepGround, marks_every_tile_that_a_point_of_the_ground_shows_in) {
  expect_all_kinds(marked_pictures({46, 8, 1.0 / 1200, 1.0 / 1200}, {31, 60}, 1, 64));
}

// Blocks of 59 km: at 60 km, and over their own width, the Earth bends by 280 and 137 m.
TEST(SteepGround, marks_tiles_over_posts_far_apart) {
  expect_all_kinds(marked_pictures({57, 8, 1.0 / 120, 1.0 / 120}, {32, 700}, 1, 64));
}

TEST(SteepGround, marks_tiles_over_several_levels) {
  const Found found = marked_pictures({46, 8, 1.0 / 1200, 1.0 / 1200}, {33, 60}, 3, 24);
  EXPECT_GT(found.points, 6'000);
  EXPECT_GT(found.sky_tiles, 100);
}

// Floors in the first column of a block stand over the last column of the block before it, and
// their walls reach down to the ground of that one.
TEST(SteepGround, marks_the_walls_of_floors_beside_another_block) {
  Ground ground(lattice_3s());
  ground.add({-400, -400, 1, 1, 801, 801}, [](int column, int row) {
    if (column < 64) return 400.0F;
    return column == 64 && (row & 31) > 4 ? unknown : 2400.0F;
  });
  ground.finish();
  Window window(ground, 1);
  Found found;
  for (int k = 0; k < 12; ++k) {
    const GeodeticPosition eye{ground.lattice().latitude_deg(-20.0 + 2 * k),
                               ground.lattice().longitude_deg(40.0 + k), 500.0 + 40 * k};
    window.settle(eye);
    const Attitude attitude{k % 3 == 0 ? 7.0 * k : 0.0, 15.0, 10.0 + 6 * k};
    const Marked marked(ground, window, eye, camera(attitude, {1024, 800, 40}).value(), 0.0);
    for (int row = 0; row < 64; ++row) {
      if ((row & 31) <= 6) continue;
      for (double height_m = 400; height_m <= 2400; height_m += 50) {
        marked.expect_point_marked(63 + 1e-6, row - 0.5, height_m, 1e9, found);
      }
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(found.points, 5000);
}

/// The blocks of every tile, planned with tables that may have served another promise before.
class Plans {
 public:
  Plans(Window& window, const GeodeticPosition& eye, const Camera& camera)
      : window_(window), local_(local_frame(eye).value()), camera_(camera) {}

  RayTilePlan plan(double bound_px, double geometry_px, BlockBearing& bearing) {
    const RayTileTables tables{tiles_, steepness_, shapes_, looks_, &bearing};
    return plan_ray_tiles(window_.keeper, local_, camera_,
                          {20'000, 0.9 * bound_px, bound_px, geometry_px, false}, tables);
  }
  std::vector<std::int32_t> blocks(double bound_px, double geometry_px, BlockBearing& bearing) {
    const RayTilePlan plan = this->plan(bound_px, geometry_px, bearing);
    std::vector<std::int32_t> result;
    for (const RayTile& tile : std::span(tiles_).first(static_cast<std::size_t>(plan.tiles))) {
      result.push_back(tile.block);
    }
    return result;
  }

 private:
  static constexpr std::size_t most = std::size_t{most_tiles(320)} * most_tiles(256);
  Window& window_;
  LocalFrame local_;
  Camera camera_;
  std::vector<RayTile> tiles_{most};
  std::vector<float> steepness_ = std::vector<float>(most);
  std::vector<std::uint8_t> shapes_ = std::vector<std::uint8_t>(most);
  std::vector<TileLook> looks_{most};
};

// 2026-11-25: the last tile before the border, 3 x 3 pixels and one block, was coloured as sky.
TEST(RayTilePlan, ground_in_a_tile_as_small_as_its_block_is_no_sky) {
  Ground ground(lattice_3s());
  ground.add({-400, -400, 1, 1, 801, 801}, [](int, int) { return 400.0F; });
  ground.finish();
  Window window(ground, 1);
  const GeodeticPosition eye{46.02, 8.02, 700};
  window.settle(eye);
  Plans plans(window, eye, camera({0, -50, 30}, {73, 73, 60}).value());
  const auto bearing = std::make_unique<BlockBearing>();
  const RayTilePlan plan = plans.plan(1.6, 0.01, *bearing);
  EXPECT_EQ(plan.tiles, 25);
  EXPECT_EQ(plan.ground_tiles, plan.tiles);
  EXPECT_GT(plan.shared_px, 1.4);  // other tiles have blocks as large
}

TEST(RayTilePlan, what_blocks_bear_is_asked_anew_for_another_promise) {
  const Ground ground = land({46, 8, 1.0 / 1200, 1.0 / 1200}, {34, 20});
  Window window(ground, 1);
  const GeodeticPosition eye{46.02, 8.02, 1500};
  window.settle(eye);
  Plans plans(window, eye, camera({20, -12, 30}, {320, 256, 60}).value());
  const auto kept = std::make_unique<BlockBearing>();
  const struct {
    double bound_px, geometry_px;
  } promises[] = {{3.0, 0.01}, {1.0, 0.01}, {1.0, 0.2}, {3.0, 0.01}, {1.6, 0.1}};
  std::vector<std::int32_t> before;
  int changes = 0;
  for (const auto& promise : promises) {
    const auto fresh = std::make_unique<BlockBearing>();
    const auto anew = plans.blocks(promise.bound_px, promise.geometry_px, *fresh);
    EXPECT_EQ(plans.blocks(promise.bound_px, promise.geometry_px, *kept), anew)
        << promise.bound_px << " px, " << promise.geometry_px << " px";
    changes += anew != before ? 1 : 0;
    before = anew;
  }
  EXPECT_GE(changes, 4);
}

}  // namespace
}  // namespace ridgeline::test
