// Cells so long that a ray's ground track bends inside one, seen through a narrow lens.
#include <gtest/gtest.h>

#include <random>

#include "tests/gl/scene.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

/// Steep ground without any order, the same every time.
int post_m(int row, int column) {
  std::uint64_t bits = static_cast<std::uint64_t>(row) * 7919U +
                       static_cast<std::uint64_t>(column) * 104'729U + 12'345U;
  bits ^= bits >> 33U;
  bits *= 0xff51afd7ed558ccdULL;
  bits ^= bits >> 33U;
  bits *= 0xc4ceb9fe1a85ec53ULL;
  return static_cast<int>(3000 * (static_cast<double>(bits >> 11U) * 0x1p-53));
}

TEST(LongCells, of_30_arc_seconds_are_sound_at_10_degrees_and_4096_pixels) {
  // 2026-11-23: the track counted as straight all through a cell, and the ground of the first one
  // was sheared by 7e-5 rad: 0.57 px here, at a bound of 0.32 px.
  TemporaryFolder folder;
  for (int south = 44; south <= 46; ++south) {
    for (int west = 7; west <= 9; ++west) {
      char name[32];
      std::snprintf(name, sizeof name, "n%02d_e%03d.dt0", south, west);
      write_dted(folder.file(name), 0, south, west, [&](int row, int column) {
        return std::optional<int>(post_m(120 * south + row, 120 * west + column));
      });
    }
  }
  Scene scene(folder.path(), {4096, 64, 10}, 0.3, 20'000, {45.5, 8.5, 3100});
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) * 0x1p-32);
  };
  std::vector<Pose> poses;
  for (int k = 0; k < 10; ++k) {
    const double latitude_deg = between(45.4, 45.6), longitude_deg = between(8.4, 8.6);
    const double height_m = between(3010, 3600), pitch_deg = between(-35, -8);
    poses.push_back({{latitude_deg, longitude_deg, height_m}, {0, pitch_deg, between(60, 120)}});
  }
  expect_sound(scene, poses, 10'000);
}

}  // namespace
}  // namespace ridgeline::test
