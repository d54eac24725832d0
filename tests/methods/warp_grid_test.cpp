// The warp itself: whether vertices stand where the importance map asks for them.
#include "sim/methods/warp_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "tests/methods/method_stand.hpp"

namespace ridgeline::test {
namespace {

constexpr ImageGeometry image{256, 200, 60};
constexpr double range_m = 30'000;
constexpr double earth_radius_m = 6.37e6;

/// Warps and draws nothing: the picture is sky.
class GridOnly final : public sim::Method {
 public:
  explicit GridOnly(const sim::WarpSettings& settings) : grid(settings) {}
  [[nodiscard]] std::string_view name() const override { return "grid_only"; }
  [[nodiscard]] std::string params() const override { return ""; }
  sim::Outcome build(const sim::MethodTerrain& terrain, const RenderSizes& sizes) override {
    sim::Outcome made = target_.make(sizes);
    return made.ok() ? grid.make(terrain) : made;
  }
  void draw(const RangeScene& scene) override {
    grid.warp(scene);
    target_.begin(scene.renderer);
    target_.end();
  }
  [[nodiscard]] sim::MethodFacts facts() override { return {}; }

  sim::WarpGrid grid;

 private:
  sim::RasterTarget target_;
};

std::vector<glm::vec4> texels(GLuint texture, int side) {
  std::vector<glm::vec4> values(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  GLuint target = 0;
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, values.data());
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  glDeleteFramebuffers(1, &target);
  return values;
}

/// How far a position is along v and to the right of it, m.
glm::dvec2 in_square(const glm::vec4& position, const glm::dvec2& ahead) {
  const glm::dvec4 p(position);
  return {p.x * ahead.y - p.y * ahead.x, p.x * ahead.x + p.y * ahead.y};
}

/// Texel of the importance map below a position.
int texel_below(const glm::vec4& p, const glm::dvec2& ahead, int map) {
  const double high = 1.0 + static_cast<double>(p.z) / earth_radius_m;
  const auto index = [&](double offset_m) {
    const double place = 0.5 * (offset_m / high / range_m + 1.0);
    return std::clamp(static_cast<int>(place * map), 0, map - 1);
  };
  const glm::dvec2 place = in_square(p, ahead);
  return index(place.y) * map + index(place.x);
}

/// Vertices obtained over vertices asked for, in each texel in sight that asks for enough.
struct Ratios {
  std::vector<double> sorted;
  double seen_share = 0;  ///< of all vertices
  [[nodiscard]] double at(double share) const {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
  [[nodiscard]] double share_between(double low, double high) const {
    const auto inside = std::count_if(sorted.begin(), sorted.end(),
                                      [&](double r) { return r >= low && r <= high; });
    return static_cast<double>(inside) / static_cast<double>(sorted.size());
  }
};

/// What is asked is a wish for all texels alike: scaled so that the wishes sum up to the vertices.
Ratios ratios_of(const GridOnly& method) {
  const int map = method.grid.settings().map;
  const auto importance = texels(method.grid.importance(), map);
  const auto positions = texels(method.grid.positions(), method.grid.settings().grid);
  std::vector<double> asked, obtained(importance.size(), 0.0);
  for (const glm::vec4& texel : importance) {
    asked.push_back(static_cast<double>(texel.x) * static_cast<double>(texel.y));
  }
  for (const glm::vec4& p : positions) {
    obtained[static_cast<std::size_t>(texel_below(p, method.grid.ahead(), map))] += 1;
  }
  const double scale =
      static_cast<double>(positions.size()) / std::accumulate(asked.begin(), asked.end(), 0.0);
  Ratios ratios;
  constexpr double enough = 8;  // vertices: fewer are a matter of rounding
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (importance[i].z < 0.5f) continue;
    ratios.seen_share += obtained[i] / static_cast<double>(positions.size());
    if (asked[i] * scale >= enough) ratios.sorted.push_back(obtained[i] / (asked[i] * scale));
  }
  std::sort(ratios.sorted.begin(), ratios.sorted.end());
  return ratios;
}

class WarpDensity : public testing::TestWithParam<bool> {};

TEST_P(WarpDensity, follows_importance) {
  Land land(rough_m);
  land.add_tile(46, 8);
  MethodStand stand(land, image, range_m, {46.4, 8.5, 2500});
  auto made = std::make_unique<GridOnly>(sim::WarpSettings{.map = 64, .turn = GetParam()});
  const GridOnly& method = *made;
  stand.use(std::move(made));
  for (const double heading : {0.0, 45.0, 100.0, 215.0}) {
    stand.draw({{46.5, 8.5, 2600}, {0, -8, heading}});
    const Ratios ratios = ratios_of(method);
    std::printf(
        "[ density ] heading %3.0f: %4.1f %% of vertices in sight; obtained / asked in %zu "
        "texels: 5 %% %.2f, median %.2f, 95 %% %.2f; within 0.5..2: %.1f %%\n",
        heading, 100 * ratios.seen_share, ratios.sorted.size(), ratios.at(0.05), ratios.at(0.5),
        ratios.at(0.95), 100 * ratios.share_between(0.5, 2));
    EXPECT_GT(ratios.sorted.size(), 50U);
    EXPECT_GT(ratios.seen_share, 0.6);  // the view covers a sixth of the square
    EXPECT_GT(ratios.share_between(0.5, 2), GetParam() ? 0.9 : 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Square, WarpDensity, testing::Values(true, false),
                         [](const auto& turn) { return turn.param ? "turned" : "north_up"; });

TEST(WarpGrid, no_vertex_is_lost_and_lines_keep_their_order) {
  Land land(rough_with_voids_m);
  land.add_tile(46, 8);
  MethodStand stand(land, image, range_m, {46.4, 8.5, 2500});
  const sim::WarpSettings settings{.grid = 128, .map = 64};
  auto made = std::make_unique<GridOnly>(settings);
  const GridOnly& method = *made;
  stand.use(std::move(made));
  for (const Attitude& attitude : {Attitude{0, -8, 30}, Attitude{40, -90, 0}, Attitude{0, 60, 0}}) {
    stand.draw({{46.5, 8.5, 2600}, attitude});
    const std::vector<glm::vec4> p = texels(method.grid.positions(), settings.grid);
    int backwards = 0;
    for (int row = 0; row < settings.grid; ++row) {
      for (int column = 0; column < settings.grid; ++column) {
        const std::size_t at = static_cast<std::size_t>(row) * 128 + column;
        ASSERT_TRUE(std::isfinite(p[at].x) && std::isfinite(p[at].y) && std::isfinite(p[at].z));
        ASSERT_LT(std::hypot(p[at].x, p[at].y), 1.06f * static_cast<float>(range_m));
        // Within the range nothing has been moved onto the rim: a line runs along v.
        const bool inside = std::hypot(p[at].x, p[at].y) < static_cast<float>(range_m);
        if (!inside || row + 1 == settings.grid) continue;
        const double here = in_square(p[at], method.grid.ahead()).y;
        backwards += in_square(p[at + 128], method.grid.ahead()).y < here ? 1 : 0;
      }
    }
    EXPECT_EQ(backwards, 0);
  }
}

}  // namespace
}  // namespace ridgeline::test
