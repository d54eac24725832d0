#include "sim/synthetic/tile_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "core/base/assert.hpp"
#include "sim/output/atomic_file.hpp"

namespace ridgeline::sim {
namespace {

constexpr int void_height = -32768;

std::string padded(int value, std::size_t digits) {
  std::string text = std::to_string(std::abs(value));
  while (text.size() < digits) text.insert(text.begin(), '0');
  return text;
}

/// Degrees of a post, computed alike from either side of a shared edge.
double post_deg(int first_deg, int index, int posts) {
  const int interval = posts - 1;
  return static_cast<double>(first_deg * interval + index) / interval;
}

}  // namespace

std::string tile_name(int south_deg, int west_deg) {
  return (south_deg < 0 ? "S" : "N") + padded(south_deg, 2) + (west_deg < 0 ? "W" : "E") +
         padded(west_deg, 3) + ".hgt";
}

int stored_height_m(double height_m) {
  if (!(std::fabs(height_m) < 32767)) return void_height;
  return static_cast<int>(height_m < 0 ? height_m - 0.5 : height_m + 0.5);
}

Outcome write_tile_with(const std::string& folder, int south_deg, int west_deg, int posts,
                        const HeightFunction& height_m) {
  RL_ASSERT(posts >= 2);
  std::vector<std::byte> bytes;
  bytes.reserve(2 * static_cast<std::size_t>(posts) * static_cast<std::size_t>(posts));
  for (int row = posts - 1; row >= 0; --row) {
    const double latitude_deg = post_deg(south_deg, row, posts);
    for (int column = 0; column < posts; ++column) {
      const int stored = stored_height_m(height_m(latitude_deg, post_deg(west_deg, column, posts)));
      bytes.push_back(static_cast<std::byte>((stored >> 8) & 0xff));
      bytes.push_back(static_cast<std::byte>(stored & 0xff));
    }
  }
  return write_file(folder + "/" + tile_name(south_deg, west_deg), bytes);
}

HeightFunction cone_peak(double latitude_deg, double longitude_deg, double peak_m, double slope,
                         double foot_m) {
  constexpr double metres_per_degree = 111'195;
  constexpr double radians_per_degree = 0.017453292519943295;
  const double east_scale = std::cos(latitude_deg * radians_per_degree);
  return [=](double latitude, double longitude) {
    const double north_m = (latitude - latitude_deg) * metres_per_degree;
    const double east_m = (longitude - longitude_deg) * metres_per_degree * east_scale;
    return std::max(foot_m, peak_m - slope * std::sqrt(north_m * north_m + east_m * east_m));
  };
}

}  // namespace ridgeline::sim
