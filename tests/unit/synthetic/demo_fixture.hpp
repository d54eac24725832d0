#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sim/synthetic/make_demo.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline::test {

/// The demo as it lies on the disk, made once for all tests of the program and read by code of our
/// own.
class Demo {
 public:
  static constexpr int posts = 1201;
  static constexpr std::array<const char*, 4> tiles = {"S49W124.hgt", "S49W123.hgt", "S48W124.hgt",
                                                       "S48W123.hgt"};

  static const Demo& instance() {
    static const Demo demo;
    return demo;
  }

  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] const std::vector<unsigned char>& tile_bytes(std::size_t tile) const {
    return bytes_[tile];
  }
  [[nodiscard]] std::string log() const {
    const std::vector<unsigned char> bytes = bytes_of(file("demo.log"));
    return {bytes.begin(), bytes.end()};
  }

  /// The stored post, row from the south and column from the west, 0..2400 over the four tiles.
  [[nodiscard]] int post(int row, int column) const {
    const int tile_row = row >= posts - 1 ? 1 : 0;
    const int tile_column = column >= posts - 1 ? 1 : 0;
    return tile_post(static_cast<std::size_t>(2 * tile_row + tile_column),
                     row - tile_row * (posts - 1), column - tile_column * (posts - 1));
  }

  /// The stored post of one tile, row from the south.
  [[nodiscard]] int tile_post(std::size_t tile, int row, int column) const {
    const std::size_t at = 2 * static_cast<std::size_t>((posts - 1 - row) * posts + column);
    const int value = bytes_[tile][at] << 8 | bytes_[tile][at + 1];
    return value < 0x8000 ? value : value - 0x10000;
  }

  /// Bilinear height of the posts; NaN where one of the four is unknown.
  [[nodiscard]] double ground_m(double latitude_deg, double longitude_deg) const {
    const double y = (latitude_deg + 49) * 1200;
    const double x = (longitude_deg + 124) * 1200;
    const int row = static_cast<int>(y);
    const int column = static_cast<int>(x);
    const std::array<int, 4> around = {post(row, column), post(row, column + 1),
                                       post(row + 1, column), post(row + 1, column + 1)};
    for (const int height_m : around) {
      if (height_m == -32768) return std::numeric_limits<double>::quiet_NaN();
    }
    const double u = x - column;
    const double v = y - row;
    return (around[0] * (1 - u) + around[1] * u) * (1 - v) +
           (around[2] * (1 - u) + around[3] * u) * v;
  }

 private:
  Demo() : folder_("demo") {
    const sim::Outcome outcome = sim::make_demo(folder_.path());
    EXPECT_TRUE(outcome.ok()) << outcome.message;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      bytes_[tile] = bytes_of(folder_.file(tiles[tile]));
      // A short file is reported here once and padded, so that the other tests can still index it.
      EXPECT_EQ(bytes_[tile].size(), 2U * posts * posts) << tiles[tile];
      bytes_[tile].resize(2U * posts * posts);
    }
  }

  ScratchFolder folder_;
  std::array<std::vector<unsigned char>, 4> bytes_;
};

}  // namespace ridgeline::test
