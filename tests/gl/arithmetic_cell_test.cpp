// The rows of section 4 of docs/error_bound.md that belong to a cell: heights over the eye, the gap
// between ray and surface, its root, the four posts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>

#include "config/limits.hpp"
#include "tests/gl/arithmetic_rows.hpp"
#include "tests/gl/exact_ray.hpp"
#include "tests/gl/shader_probe.hpp"

namespace ridgeline::test {
namespace {

constexpr double u = rounding_unit;
constexpr int side = 128;  ///< of the window: two blocks

ProbeFrame level_frame(double eye_height_m, double range_m = 10'000) {
  const Camera level = camera({}, {64, 64, 60}).value();
  return probe_frame({0.0105, 0.0105, eye_height_m}, level, range_m, 1.0 / 1200);
}

TEST(Arithmetic, height_over_the_eye_keeps_the_low_part) {
  // Fails where a compiler sums the two parts of the eye's height first.
  ShaderProbe probe("out_a.x = over_eye(in_a.x);");
  Row near("height over the eye, within 1 m", 1.5 * u), far("height over the eye, relative", 2 * u);
  Random random(11);
  for (int k = 0; k < 20; ++k) {
    const double eye_m = random.between(-600, limits::max_eye_height_m);
    const ProbeFrame frame = level_frame(eye_m);
    probe.set_blocks(frame.blocks);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 1'000; ++i) {
      const double post_m =
          i % 2 == 0 ? eye_m + random.between(-1, 1)
                     : random.between(limits::min_terrain_height_m, limits::max_terrain_height_m);
      calls.push_back({{static_cast<float>(post_m), 0, 0, 0}, {}});
    }
    const auto results = probe.run(calls);
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const double exact = static_cast<double>(calls[i].a.x) - eye_m;
      const double error = static_cast<double>(results[i].a.x) - exact;
      // The two parts of the eye's height hold u² of it.
      if (std::abs(exact) < 1) near.add(error, 2 * u * u * std::abs(eye_m));
      far.add(error / std::max(std::abs(exact), 1.0));
    }
  }
  near.expect_within("m");
  far.expect_within("");
}

/// Four posts of one cell, south-west first, and what they mean in double.
struct Corners {
  std::array<float, 4> height_m{};

  [[nodiscard]] double at(double fx, double fy) const {
    const auto h = [&](std::size_t k) { return static_cast<double>(height_m[k]); };
    return (h(0) * (1 - fx) + h(1) * fx) * (1 - fy) + (h(2) * (1 - fx) + h(3) * fx) * fy;
  }
  [[nodiscard]] double relief_m() const {
    const auto [low, high] = std::minmax_element(height_m.begin(), height_m.end());
    return static_cast<double>(*high) - static_cast<double>(*low);
  }
  [[nodiscard]] double over_m(double eye_m) const {
    double most = 0;
    for (const float h : height_m) most = std::max(most, std::abs(static_cast<double>(h) - eye_m));
    return most;
  }
};

TEST(Arithmetic, gap_over_a_cell_is_off_by_5_u_of_its_posts_and_13_u_of_its_relief) {
  ShaderProbe probe(
      "Cell c = cell_at(window_here(), ivec2(in_a.xy), 0);"
      "out_a.xyz = gap_along(c, in_a.zw, in_b.yz, in_b.x, 0.0, 0.0);");
  Row gap("gap over a cell, of 5 V + 13 W", u), climb("its rate, of 20 W |rate|", u);
  Row whole("gap over whole metres, of 5 V + 7 W", u);
  double of_largest = 0;
  Random random(12);
  for (int k = 0; k < 24; ++k) {
    const double eye_m = random.between(-600, 9'000);
    const ProbeFrame frame = level_frame(eye_m);
    const bool metres = k % 3 == 0;
    ProbePosts posts{side, side, std::vector<float>(side * side)};
    for (float& post : posts.heights_m) {
      const double h =
          k % 2 == 0 ? random.between(limits::min_terrain_height_m, limits::max_terrain_height_m)
                     : 9'000.0 * random.below(2) + random.between(0, 50);
      post = static_cast<float>(metres ? std::floor(h) : h);
    }
    probe.set_blocks(frame.blocks);
    probe.set_posts(posts);
    const int column = static_cast<int>(std::floor(frame.eye_column));
    const int row = static_cast<int>(std::floor(frame.eye_row));
    std::vector<ShaderProbe::Call> calls;
    std::vector<Corners> corners;
    for (int i = 0; i < 4'000; ++i) {
      const int c = random.below(side - 1), r = random.below(side - 1);
      const auto post = [&](int x, int y) {
        return posts.heights_m[static_cast<std::size_t>((r + y) * side + c + x)];
      };
      corners.push_back({{post(0, 0), post(1, 0), post(0, 1), post(1, 1)}});
      ShaderProbe::Call call{{c - column, r - row, random.between(0, 1), random.between(0, 1)},
                             {0, random.between(-1, 1), random.between(-1, 1), 0}};
      // The ray close to the surface, where the sign of the gap decides.
      const double surface_m =
          corners.back().at(static_cast<double>(call.a.z), static_cast<double>(call.a.w));
      call.b.x = static_cast<float>(surface_m - eye_m + random.between(-1, 1));
      calls.push_back(call);
    }
    const auto results = probe.run(calls);
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const glm::dvec4 a(calls[i].a), b(calls[i].b);
      const Corners& cell = corners[i];
      const double exact = b.x + eye_m - cell.at(a.z, a.w);
      const double error = static_cast<double>(results[i].a.x) - exact;
      const double over_m = cell.over_m(eye_m), relief_m = cell.relief_m();
      (metres ? whole : gap).add(error / (5 * over_m + (metres ? 7 : 13) * relief_m));
      of_largest = std::max(of_largest, std::abs(error) / (2 * u * 9'000));
      const double twist = cell.at(1, 1) - cell.at(1, 0) - cell.at(0, 1) + cell.at(0, 0);
      const double rate = (cell.at(1, 0) - cell.at(0, 0)) * b.y +
                          (cell.at(0, 1) - cell.at(0, 0)) * b.z + twist * (a.z * b.z + a.w * b.y);
      climb.add((static_cast<double>(results[i].a.y) + rate) /
                (20 * relief_m * (std::abs(b.y) + std::abs(b.z))));
    }
  }
  gap.expect_within("");
  whole.expect_within("");
  climb.expect_within("");
  std::printf("[ row ] a cliff cell needs %.2f of 2 u times 9000 m\n", of_largest);
}

TEST(Arithmetic, first_zero_of_a_gap_is_exact_for_a_gap_4_u_away) {
  // Backward error: the computed zero is one of the quadratic with x moved by 4 u of itself, up to
  // a few u of the distance; none is reported only where moving it so leaves none.
  ShaderProbe probe("out_a = vec4(first_zero(in_a.xyz), in_a.xyz);");
  Row row("first zero of the gap, of x", 5 * u), distance("first zero, relative", 8 * u);
  Random random(13);
  std::vector<ShaderProbe::Call> calls;
  for (int i = 0; i < 200'000; ++i) {
    const double x = std::pow(10.0, random.between(-7, 4));
    const double y = random.between(-3, 3) * std::pow(10.0, -random.between(0, 4));
    double z = random.between(-1, 1) * std::pow(10.0, -random.between(0, 6));
    if (i % 4 == 0) z = y * y / (4 * x) * (1 + random.between(-4, 4) * u);  // a ray that touches
    calls.push_back({{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0}, {}});
  }
  const auto zero = [](double x, double y, double z) {
    const double disc = y * y - 4 * z * x;
    if (disc < 0) return 1e30;
    const double root = std::sqrt(disc);
    if (y > 0) return z < 0 ? (y + root) / (-2 * z) : 1e30;
    return root - y > 0 ? 2 * x / (root - y) : 1e30;
  };
  for (const ShaderProbe::Call& result : probe.run(calls)) {
    const glm::dvec4 r(result.a);
    const double low = zero(r.y * (1 - 4 * u), r.z, r.w), high = zero(r.y * (1 + 4 * u), r.z, r.w);
    const double nearest = std::min(low, high), farthest = std::max(low, high);
    if (r.x >= 1e29) {
      row.add(farthest >= 1e29 ? 0 : 1);
      continue;
    }
    const double outside = std::max({0.0, nearest - r.x, r.x - farthest});
    distance.add(outside / r.x);
    row.add(nearest >= 1e29 ? 1 : 0);
  }
  row.expect_within("");
  distance.expect_within("of the way");
}

TEST(Arithmetic, cell_ahead_is_never_more_than_an_edge_early) {
  // The point lies in the cell, or before it by less than 1e-6 posts and 2.4e-7 of its place.
  ShaderProbe probe("out_a = vec4(cell_ahead(in_a.xy, in_a.zw), in_a.xy); out_b.xy = in_a.zw;");
  Row row("cell ahead, over what is derived", 1e-9);
  double largest = 0;
  Random random(15);
  std::vector<ShaderProbe::Call> calls;
  for (int i = 0; i < 100'000; ++i) {
    const double edge = std::round(random.between(-1, 1) * std::pow(10.0, random.between(0, 4.3)));
    const double off = random.between(-1, 1) * std::pow(10.0, random.between(-8, 0));
    calls.push_back({{edge + off, -edge - off, random.between(-1, 1), random.below(3) - 1}, {}});
  }
  for (const ShaderProbe::Call& result : probe.run(calls)) {
    const glm::dvec4 a(result.a), b(result.b);
    for (const auto& [cell, at, rate] : {std::array{a.x, a.z, b.x}, std::array{a.y, a.w, b.y}}) {
      const double allowed = 1e-6 + 2.4e-7 * std::abs(at) + 2 * u * std::abs(at);
      const double early = std::max(cell - at, at - (cell + 1));
      row.add(std::max(0.0, early - allowed));
      largest = std::max(largest, early / allowed);
      // On an edge the way decides: it stands on that side of the cell it leaves.
      const double left = rate > 0 ? cell + 1 - at : rate < 0 ? at - cell : 1.0;
      EXPECT_GE(left, 0.5e-6) << at << ' ' << rate;
    }
  }
  row.expect_within("posts");
  std::printf("[ row ] cell ahead: %.2f of what is derived\n", largest);
}

TEST(Arithmetic, four_posts_are_the_four_posts) {
  // Every post holds its own number; columns that are no power of two; texels before the window's
  // first and behind its last.
  ShaderProbe probe("out_a = four_posts(window_here(), ivec2(in_a.xy), 0);");
  Random random(14);
  for (const int columns : {128, 1344, 2688}) {
    const int rows = 192;
    ProbeFrame frame = level_frame(0);
    frame.blocks.frame.level_size = {static_cast<float>(columns), static_cast<float>(rows),
                                     static_cast<float>(1.0 / (columns + 1)),
                                     static_cast<float>(1.0 / (rows + 1))};
    ProbePosts posts{columns, rows, {}};
    for (int i = 0; i < columns * rows; ++i) posts.heights_m.push_back(static_cast<float>(i));
    probe.set_blocks(frame.blocks);
    probe.set_posts(posts);
    std::vector<ShaderProbe::Call> calls;
    for (int i = 0; i < 40'000; ++i) {
      calls.push_back(
          {{random.below(3 * columns) - columns, random.below(3 * rows) - rows, 0, 0}, {}});
    }
    const auto results = probe.run(calls);
    const auto number = [&](int x, int y) {
      return static_cast<float>((y + 2 * rows) % rows * columns + (x + 2 * columns) % columns);
    };
    int wrong = 0;
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const int x = static_cast<int>(calls[i].a.x), y = static_cast<int>(calls[i].a.y);
      const glm::vec4 exact(number(x, y + 1), number(x + 1, y + 1), number(x + 1, y), number(x, y));
      wrong += results[i].a == exact ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0) << columns;
  }
}

}  // namespace
}  // namespace ridgeline::test
