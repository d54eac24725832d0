#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/methods/hole_figure.hpp"

namespace ridgeline::test {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double posts_per_deg = 1200;
constexpr double m_per_deg = 111'200;  ///< of latitude, near enough to lay out a scene

/// A number in 0..1 that depends on two integers alone.
double lottery(std::int64_t a, std::int64_t b) {
  auto bits = static_cast<std::uint64_t>(a) * 2'000'003U + static_cast<std::uint64_t>(b) * 7919U;
  bits ^= bits >> 33U;
  bits *= 0xff51afd7ed558ccdULL;
  bits ^= bits >> 33U;
  bits *= 0xc4ceb9fe1a85ec53ULL;
  bits ^= bits >> 33U;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// L1, L3: a plain with one tall post in every square of 24 posts.
Hole spires() {
  constexpr std::int64_t square = 24;
  const auto height = [](double latitude_deg, double longitude_deg) {
    const auto row = std::llround(latitude_deg * posts_per_deg);
    const auto column = std::llround(longitude_deg * posts_per_deg);
    const std::int64_t i = row / square, j = column / square;
    const auto spire_row = static_cast<std::int64_t>(lottery(i, j) * square);
    const auto spire_column = static_cast<std::int64_t>(lottery(j, i) * square);
    const bool is_spire = row % square == spire_row && column % square == spire_column;
    return is_spire ? 500.0 : 100.0;
  };
  return {"hole_spires.png",
          "L1, L3: spires of one post (400 m) between the vertices, against the sky",
          height,
          {{45, 8}},
          {{45.1, 8.5, 180}, {0, 0, 0}},
          {512, 256, 60},
          38'000,
          "grid=512x256",
          1,
          {0, 78, 512, 138, 1},
          2};
}

/// L2: walls one post thick, 400 m high, each over two degrees of azimuth, at 2.5 to 5.5 km.
Hole walls() {
  const GeodeticPosition eye{45.1, 8.5, 300};
  constexpr int walls = 28;
  const auto height = [eye](double latitude_deg, double longitude_deg) {
    const double north_m = (latitude_deg - eye.latitude_deg) * m_per_deg;
    const double east_m =
        (longitude_deg - eye.longitude_deg) * m_per_deg * std::cos(eye.latitude_deg * deg);
    const double azimuth_deg = std::atan2(east_m, north_m) / deg;
    const auto wall = static_cast<std::int64_t>(std::floor(azimuth_deg / 2.0)) + walls / 2;
    if (north_m <= 0 || wall < 0 || wall >= walls) return 100.0;
    const double wall_m = 2500 + 3000 * lottery(wall, 17);
    const auto wall_row = std::llround((eye.latitude_deg + wall_m / m_per_deg) * posts_per_deg);
    return std::llround(latitude_deg * posts_per_deg) == wall_row ? 500.0 : 100.0;
  };
  return {"hole_walls.png",
          "L2: walls one post thick (400 m) between vertices whose delta is 0",
          height,
          {{45, 8}},
          {eye, {0, 0, 0}},
          {512, 256, 60},
          20'000,
          "grid=512x256",
          1,
          {0, 68, 512, 148, 1},
          2};
}

/// L12: islands in the sea, on the published flat base plane.
Hole islands() {
  struct Island {
    double north_deg, east_deg, peak_m;
  };
  const std::array<Island, 7> islands{{{0.42, 9.82, 1500},
                                       {0.55, 10.12, 2200},
                                       {0.68, 10.55, 2600},
                                       {0.75, 10.25, 1600},
                                       {0.83, 10.68, 3200},
                                       {0.9, 10.36, 3600},
                                       {0.88, 10.86, 3000}}};
  const auto height = [islands](double latitude_deg, double longitude_deg) {
    double highest = 0;
    for (const Island& island : islands) {
      const double away_m =
          m_per_deg * std::hypot(latitude_deg - island.north_deg, longitude_deg - island.east_deg);
      const double rough =
          0.15 * island.peak_m * std::sin(latitude_deg * 700) * std::sin(longitude_deg * 600);
      highest = std::max(highest, island.peak_m - 0.35 * away_m + rough);
    }
    return highest;
  };
  return {"hole_flat_earth.png",
          "L12: the published flat base plane, islands at 40 to 100 km",
          height,
          {{0, 9}, {0, 10}, {1, 9}, {1, 10}},
          {{0.05, 10.4, 1200}, {0, 0, 0}},
          {1024, 400, 60},
          100'000,
          "grid=1024x512,earth=flat",
          1,
          {200, 160, 824, 230, 1},
          2};
}

}  // namespace

std::vector<Hole> published_holes() {
  return {spires(), walls(), islands()};
}

}  // namespace ridgeline::test
