// Footprints of a clipmap level: no quad left out, none drawn twice, levels nested.
#include "sim/methods/clipmap_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ridgeline::test {
namespace {

using sim::Footprint;

/// How often each quad of an n x n level is drawn, row-major.
std::vector<int> quad_counts(int n, const sim::Pieces& pieces) {
  const int side = n - 1;
  std::vector<int> counts(static_cast<std::size_t>(side) * side);
  for (const sim::Piece& piece : pieces) {
    const glm::ivec2 quads = sim::footprint_quads(piece.footprint, n);
    for (int y = piece.at.y; y < piece.at.y + quads.y; ++y) {
      for (int x = piece.at.x; x < piece.at.x + quads.x; ++x) {
        EXPECT_TRUE(x >= 0 && y >= 0 && x < side && y < side);
        ++counts[static_cast<std::size_t>(y) * side + x];
      }
    }
  }
  return counts;
}

TEST(ClipmapLayout, a_ring_covers_every_quad_but_the_finer_level_once) {
  for (const int n : {15, 63, 127, 255, 511}) {
    const int m = (n + 1) / 4;
    for (const int x : {m - 1, m}) {
      for (const int y : {m - 1, m}) {
        const auto counts = quad_counts(n, sim::ring_pieces(n, {x, y}));
        int wrong = 0;
        for (int row = 0; row < n - 1; ++row) {
          for (int column = 0; column < n - 1; ++column) {
            // The finer level is (n - 1) / 2 of these quads a side.
            const bool hole =
                column >= x && column < x + (n - 1) / 2 && row >= y && row < y + (n - 1) / 2;
            wrong += counts[static_cast<std::size_t>(row) * (n - 1) + column] != (hole ? 0 : 1);
          }
        }
        EXPECT_EQ(wrong, 0) << n << ' ' << x << ' ' << y;
      }
    }
  }
}

TEST(ClipmapLayout, the_finest_level_covers_every_quad_once) {
  for (const int n : {15, 63, 127, 255, 511}) {
    for (const int count : quad_counts(n, sim::full_pieces(n))) ASSERT_EQ(count, 1) << n;
  }
}

TEST(ClipmapLayout, triangles_of_a_footprint_cover_its_quads) {
  for (int k = 0; k + 1 < sim::footprint_count; ++k) {
    const auto footprint = static_cast<Footprint>(k);
    const glm::ivec2 quads = sim::footprint_quads(footprint, 63);
    const auto indices = sim::footprint_indices(footprint, 63);
    double area = 0;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      glm::dvec2 corner[3];
      for (std::size_t j = 0; j < 3; ++j) {
        const auto number = static_cast<int>(indices[t + j]);
        corner[j] = {number % (quads.x + 1), number / (quads.x + 1)};
        EXPECT_LE(corner[j].y, quads.y);
      }
      const glm::dvec2 a = corner[1] - corner[0], b = corner[2] - corner[0];
      EXPECT_EQ(a.x * b.y - a.y * b.x, 1.0);
      EXPECT_TRUE(corner[2].x <= corner[0].x && corner[2].x <= corner[1].x &&
                  corner[2].y <= corner[0].y && corner[2].y <= corner[1].y);
      area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    EXPECT_EQ(area, quads.x * quads.y);
  }
}

TEST(ClipmapLayout, perimeter_triangles_have_no_area_and_bridge_two_edges) {
  constexpr int n = 63;
  const auto indices = sim::footprint_indices(Footprint::perimeter, n);
  EXPECT_EQ(indices.size(), 4U * 3U * (n - 1) / 2);
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    EXPECT_EQ(indices[t] + indices[t + 2], 2 * indices[t + 1]);
    for (std::size_t j = 0; j < 3; ++j) {
      const unsigned x = indices[t + j] % n, y = indices[t + j] / n;
      EXPECT_TRUE(x == 0 || y == 0 || x == n - 1 || y == n - 1);
    }
    EXPECT_EQ((indices[t] % n) % 2 + (indices[t] / n) % 2, 0U);  // on a vertex of the coarser level
  }
}

TEST(ClipmapLayout, levels_are_nested_round_the_eye_wherever_it_stands) {
  std::mt19937 random(20251125);
  std::uniform_real_distribution<double> place(-4e5, 4e5);
  for (int k = 0; k < 20000; ++k) {
    const double eye = k % 3 == 0 ? std::round(place(random)) : place(random);
    for (const int n : {63, 127, 255, 511}) {
      const int m = (n + 1) / 4;
      for (int level = 0; level < 8; ++level) {
        const auto origin = sim::level_origin(n, level, eye);
        ASSERT_EQ(origin % 2, 0);
        const double middle = static_cast<double>(origin) + 0.5 * (n - 1);
        ASSERT_LE(std::abs(middle - std::ldexp(eye, -level)), 1.0);
        const auto hole = origin / 2 - sim::level_origin(n, level + 1, eye);
        ASSERT_TRUE(hole == m - 1 || hole == m) << hole << " at " << eye;
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline::test
