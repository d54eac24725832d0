// Steps of rays: what is counted, that counting changes no picture, and that what flies does not
// count.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/gl/scene.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{200, 150, 50};
constexpr double range_m = 26'000;
constexpr double pixels = 200.0 * 150.0;
const Pose along{{46.5, 8.5, 3100}, {-4, -8, 140}};

struct Counted {
  sim::Picture picture;
  std::optional<sim::StepCounts> steps;

  [[nodiscard]] double cells() const { return static_cast<double>(steps->cells); }
  [[nodiscard]] double nodes() const { return static_cast<double>(steps->nodes); }
};

FrameInput input_of(const Pose& pose) {
  FrameInput input;
  input.eye = pose.eye;
  input.attitude = pose.attitude;
  return input;
}

/// A session over a land that draws with one method after the other.
class Stand {
 public:
  explicit Stand(const Land& land) : scene_(land, image, 1.0, range_m, along.eye) {}

  /// Draws with a method from here on; false where this build lacks it.
  bool use(const char* text) {
    sim::MethodSpec spec;
    EXPECT_TRUE(sim::parse_method(text, spec).ok());
    std::string problem;
    if (sim::is_own_method(spec)) {
      scene_.session().use(nullptr);
      problem = sim::apply_own_method(spec, scene_.settings());
      EXPECT_EQ(problem, "");
      return true;
    }
    auto method = sim::make_method(spec, problem);
    if (method == nullptr) return false;
    scene_.session().use(&scene_.session().keep(std::move(method)));
    return true;
  }
  Counted count(const Pose& pose) {
    Counted result;
    result.picture = scene_.session().draw_counting(input_of(pose), true, result.steps);
    EXPECT_TRUE(result.picture.problem.ok());
    return result;
  }
  sim::Picture draw(const Pose& pose) { return scene_.draw(pose); }

 private:
  Scene scene_;
};

int ground_pixels(const sim::Picture& picture) {
  return static_cast<int>(std::count_if(picture.range_m.begin(), picture.range_m.end(),
                                        [](float z) { return !std::isinf(z); }));
}

TEST(Steps, counting_changes_no_bit_of_a_picture) {
  const RoughTile land;
  Stand stand(land);
  for (const char* method : {"ridgeline:error=1", "raycast", "loffler:grid=64x64", "hybrid"}) {
    ASSERT_TRUE(stand.use(method));
    const sim::Picture before = stand.draw(along);
    const Counted counted = stand.count(along);
    ASSERT_TRUE(counted.steps.has_value()) << method;
    EXPECT_GT(counted.cells(), 0) << method;
    EXPECT_EQ(before.rgb, counted.picture.rgb) << method;
    EXPECT_EQ(before.rgb, stand.draw(along).rgb) << method << ": after counting";
  }
}

TEST(Steps, counting_again_gives_the_same_number) {
  const RoughTile land;
  Stand stand(land);
  for (const char* method : {"ridgeline:error=1", "raycast", "loffler:grid=64x64", "hybrid"}) {
    ASSERT_TRUE(stand.use(method));
    const Counted first = stand.count(along);
    stand.draw(along);  // which counts nothing
    const Counted second = stand.count(along);
    EXPECT_EQ(first.steps->nodes, second.steps->nodes) << method;
    EXPECT_EQ(first.steps->cells, second.steps->cells) << method;
    EXPECT_EQ(first.steps->grid_nodes, second.steps->grid_nodes) << method;
  }
}

TEST(Steps, straight_down_on_a_plain_a_ray_meets_hardly_more_than_one_cell) {
  const Land land([](double, double) { return 100.0; });
  land.add_tile(46, 8);
  Stand stand(land);
  ASSERT_TRUE(stand.use("raycast"));
  const Counted counted = stand.count({{46.5, 8.5, 3100}, {0, -90, 0}});
  ASSERT_EQ(ground_pixels(counted.picture), static_cast<int>(pixels));
  EXPECT_GE(counted.cells() / pixels, 1.0);
  EXPECT_LE(counted.cells() / pixels, 1.5);
  EXPECT_LE(counted.nodes() / pixels, 20.0);
}

TEST(Steps, every_ray_that_meets_ground_has_met_a_cell) {
  const RoughTile land;
  Stand stand(land);
  ASSERT_TRUE(stand.use("raycast"));
  const Counted all = stand.count(along);
  EXPECT_GE(all.cells(), ground_pixels(all.picture));
  EXPECT_GT(all.nodes(), pixels);
  EXPECT_EQ(all.steps->grid_nodes, 0U);
}

TEST(Steps, the_grid_takes_nodes_off_the_rays) {
  const RoughTile land;
  Stand stand(land);
  ASSERT_TRUE(stand.use("raycast"));
  const Counted all = stand.count(along);
  ASSERT_TRUE(stand.use("ridgeline:error=0.25"));
  const Counted grid = stand.count(along);
  EXPECT_GT(grid.steps->grid_nodes, 0U);
  EXPECT_LT(grid.nodes(), 0.8 * all.nodes());
  EXPECT_GE(grid.cells(), ground_pixels(grid.picture));
}

TEST(Steps, a_larger_bound_takes_rays_off_where_ground_is_gentle) {
  const Land land([](double latitude_deg, double longitude_deg) {
    return 500.0 + 150.0 * std::sin(150.0 * latitude_deg) * std::sin(150.0 * longitude_deg);
  });
  land.add_tile(46, 8);
  Stand stand(land);
  ASSERT_TRUE(stand.use("ridgeline:error=0.25"));
  const Counted exact = stand.count(along);
  ASSERT_TRUE(stand.use("ridgeline:error=8"));
  const Counted coarse = stand.count(along);
  EXPECT_LT(coarse.picture.report.rays, 0.5 * exact.picture.report.rays);
  EXPECT_LT(coarse.cells(), 0.6 * exact.cells());
}

TEST(Steps, a_method_that_casts_some_pixels_counts_those_alone) {
  const RoughTile land;
  Stand stand(land);
  ASSERT_TRUE(stand.use("loffler:grid=64x64"));
  const Counted some = stand.count(along);
  const double cast = some.picture.method.ray_cast_share * pixels;
  ASSERT_GT(cast, 100);
  EXPECT_GT(some.cells(), 0.1 * cast);
  ASSERT_TRUE(stand.use("raycast"));
  EXPECT_LT(some.cells(), stand.count(along).cells());
}

TEST(Steps, methods_without_rays_take_none_and_nobody_counts_those_of_embree) {
  const RoughTile land;
  Stand stand(land);
  for (const char* method :
       {"mesh", "pgm:grid=64x64", "clipmap", "warp:grid=64", "loffler:grid=64x64,rays=0"}) {
    ASSERT_TRUE(stand.use(method));
    const Counted counted = stand.count(along);
    ASSERT_TRUE(counted.steps.has_value()) << method;
    EXPECT_EQ(counted.steps->nodes + counted.steps->cells + counted.steps->grid_nodes, 0U);
  }
  if (!stand.use("embree")) GTEST_SKIP() << "built without Embree";
  EXPECT_FALSE(stand.count(along).steps.has_value());
}

TEST(Steps, of_a_frame_without_terrain_there_are_none) {
  const RoughTile land;
  Stand stand(land);
  ASSERT_TRUE(stand.use("ridgeline"));
  Pose below = along;
  below.eye.height_m = -500;
  EXPECT_FALSE(stand.count(below).steps.has_value());
}

}  // namespace
}  // namespace ridgeline::test
