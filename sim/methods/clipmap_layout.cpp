#include "sim/methods/clipmap_layout.hpp"

#include <cmath>

namespace ridgeline::sim {
namespace {

int m_of(int n) {
  return (n + 1) / 4;
}

/// Along every side: vertices 2 i, 2 i + 1, 2 i + 2. The middle one lies on the coarser level's
/// edge from the first to the last.
std::vector<std::uint32_t> perimeter_indices(int n) {
  std::vector<std::uint32_t> indices;
  const auto number = [n](int x, int y) { return static_cast<std::uint32_t>(y * n + x); };
  for (int k = 0; k + 2 < n; k += 2) {
    for (int j = k; j <= k + 2; ++j) indices.push_back(number(j, 0));
    for (int j = k; j <= k + 2; ++j) indices.push_back(number(j, n - 1));
    for (int j = k; j <= k + 2; ++j) indices.push_back(number(0, j));
    for (int j = k; j <= k + 2; ++j) indices.push_back(number(n - 1, j));
  }
  return indices;
}

/// The twelve blocks and four fix-ups round the middle of 2 m x 2 m quads.
Pieces frame_pieces(int n) {
  const int m = m_of(n);
  const std::array<int, 4> steps{0, m - 1, 2 * m, 3 * m - 1};
  Pieces pieces;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const bool inner = (row == 1 || row == 2) && (column == 1 || column == 2);
      if (!inner) pieces.push_back({Footprint::block, {steps[column], steps[row]}});
    }
  }
  for (const int side : {0, 3 * m - 1}) {
    pieces.push_back({Footprint::fix_up_column, {2 * m - 2, side}});
    pieces.push_back({Footprint::fix_up_row, {side, 2 * m - 2}});
  }
  return pieces;
}

}  // namespace

glm::ivec2 footprint_quads(Footprint footprint, int n) {
  const int m = m_of(n);
  switch (footprint) {
    case Footprint::block:
      return {m - 1, m - 1};
    case Footprint::fix_up_column:
      return {2, m - 1};
    case Footprint::fix_up_row:
      return {m - 1, 2};
    case Footprint::trim_column:
      return {1, 2 * m};
    case Footprint::trim_row:
      return {2 * m - 1, 1};
    case Footprint::inner_column:
      return {1, 2 * m - 1};
    case Footprint::inner_row:
      return {2 * m - 2, 1};
    case Footprint::perimeter:
      break;
  }
  return {n - 1, n - 1};
}

std::vector<std::uint32_t> footprint_indices(Footprint footprint, int n) {
  if (footprint == Footprint::perimeter) return perimeter_indices(n);
  const glm::ivec2 quads = footprint_quads(footprint, n);
  std::vector<std::uint32_t> indices;
  for (int y = 0; y < quads.y; ++y) {
    for (int x = 0; x < quads.x; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (quads.x + 1) + x);
      const std::uint32_t b = a + 1, c = a + static_cast<std::uint32_t>(quads.x) + 1, d = c + 1;
      indices.insert(indices.end(), {b, d, a, d, c, a});
    }
  }
  return indices;
}

Pieces ring_pieces(int n, glm::ivec2 hole) {
  const int m = m_of(n);
  Pieces pieces = frame_pieces(n);
  // The finer level is 2 m - 1 quads a side: one strip each way is left of the middle.
  const int column = hole.x == m ? m - 1 : 3 * m - 2;
  const int row = hole.y == m ? m - 1 : 3 * m - 2;
  pieces.push_back({Footprint::trim_column, {column, m - 1}});
  pieces.push_back({Footprint::trim_row, {hole.x, row}});
  return pieces;
}

Pieces full_pieces(int n) {
  const int m = m_of(n);
  Pieces pieces = ring_pieces(n, {m, m});
  pieces.push_back({Footprint::inner_column, {m, m}});
  pieces.push_back({Footprint::inner_row, {m + 1, m}});
  for (const int y : {m + 1, 2 * m}) {
    for (const int x : {m + 1, 2 * m}) pieces.push_back({Footprint::block, {x, y}});
  }
  return pieces;
}

std::int64_t level_origin(int n, int level, double eye) {
  const double at = std::ldexp(eye, -level) - 0.5 * (n - 1);
  return 2 * static_cast<std::int64_t>(std::floor(0.5 * (at + 1)));
}

}  // namespace ridgeline::sim
