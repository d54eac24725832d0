#include "sim/methods/relief_pyramid.hpp"

#include <algorithm>

namespace ridgeline::sim {
namespace {

/// Adds up texels or posts that become one.
struct Sum {
  double known = 0, average = 0, floor = 0;
  float lowest_m = 1e9F, highest_m = -1e9F;
  int floors = 0;

  void add(const Relief& part) {
    if (part.known_posts > 0) {
      const double posts = static_cast<double>(part.known_posts);
      known += posts;
      average += posts * static_cast<double>(part.average_m);
      lowest_m = std::min(lowest_m, part.lowest_m);
      highest_m = std::max(highest_m, part.highest_m);
    } else {
      floor += static_cast<double>(part.average_m);
      ++floors;
    }
  }
  [[nodiscard]] Relief relief() const {
    if (known > 0) {
      return {static_cast<float>(average / known), lowest_m, highest_m, static_cast<float>(known)};
    }
    const auto mean_m = static_cast<float>(floor / std::max(floors, 1));
    return {mean_m, mean_m, mean_m, 0};
  }
};

Relief relief_of_post(float stored) {
  if (stored < void_threshold_m) {
    const float floor_m = stored + void_offset_m;
    return {floor_m, floor_m, floor_m, 0};
  }
  return {stored, stored, stored, 1};
}

/// Where the parts of texel `index` of `count` begin and end among `below` parts.
struct Parts {
  int first, end;
};
Parts parts_of(int index, int count, int below) {
  return {2 * index, index + 1 == count ? below : 2 * index + 2};
}

/// Fills a level from `below(column, row)`, which has `columns` x `rows` entries.
template <typename Below>
void fill(ReliefPyramid::Level& level, int columns, int rows, const Below& below) {
  level.columns = std::max(columns / 2, 1);
  level.rows = std::max(rows / 2, 1);
  level.texels.resize(static_cast<std::size_t>(level.columns) * level.rows);
  std::size_t out = 0;
  for (int row = 0; row < level.rows; ++row) {
    const Parts y = parts_of(row, level.rows, rows);
    for (int column = 0; column < level.columns; ++column) {
      const Parts x = parts_of(column, level.columns, columns);
      Sum sum;
      for (int r = y.first; r < y.end; ++r) {
        for (int c = x.first; c < x.end; ++c) sum.add(below(c, r));
      }
      level.texels[out++] = sum.relief();
    }
  }
}

}  // namespace

const Relief& ReliefPyramid::at(int level, std::int32_t column, std::int32_t row) const {
  const Level& l = levels[static_cast<std::size_t>(level - 1)];
  const int x = std::clamp((column - west) >> level, 0, l.columns - 1);
  const int y = std::clamp((row - south) >> level, 0, l.rows - 1);
  return l.texels[static_cast<std::size_t>(y) * l.columns + x];
}

std::size_t ReliefPyramid::bytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels) bytes += level.texels.capacity() * sizeof(Relief);
  return bytes;
}

void build_relief(const MethodTerrain& terrain, ReliefPyramid& pyramid) {
  const PostRect& rect = terrain.view.drawable[0];
  pyramid.west = rect.west;
  pyramid.south = rect.south;
  pyramid.void_posts = 0;
  const int window_columns = terrain.view.sizes.columns(), window_rows = terrain.view.sizes.rows();
  int columns = std::max(rect.east - rect.west, 0), rows = std::max(rect.north - rect.south, 0);
  std::size_t count = 0;
  for (int side = std::max(columns, rows); side > 1; side /= 2) ++count;
  pyramid.levels.resize(count);
  if (count == 0) return;
  fill(pyramid.levels[0], columns, rows, [&](int column, int row) {
    const auto x = static_cast<std::size_t>(wrapped(rect.west + column, window_columns));
    const auto y = static_cast<std::size_t>(wrapped(rect.south + row, window_rows));
    const Relief post =
        relief_of_post(terrain.posts[y * static_cast<std::size_t>(window_columns) + x]);
    pyramid.void_posts += post.known_posts > 0 ? 0 : 1;
    return post;
  });
  for (std::size_t k = 1; k < count; ++k) {
    const ReliefPyramid::Level& below = pyramid.levels[k - 1];
    fill(pyramid.levels[k], below.columns, below.rows, [&](int column, int row) {
      return below.texels[static_cast<std::size_t>(row) * below.columns + column];
    });
  }
}

}  // namespace ridgeline::sim
