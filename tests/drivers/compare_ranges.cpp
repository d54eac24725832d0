// Compares the range pictures of two dumps bit by bit.
// Usage: ridgeline-compare-ranges DUMP_A DUMP_B
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "tests/oracle/dump.hpp"
#include "tests/oracle/input_error.hpp"

namespace {

namespace oracle = ridgeline::oracle;

struct Difference {
  std::size_t pixels = 0, bits = 0, classes = 0;
  std::int64_t ulp = 0;
  double share = 0;  ///< of the distance
};

char class_of(float range_m) {
  return std::isnan(range_m) ? 'u' : std::isinf(range_m) ? 's' : 't';
}

/// Adds one frame to the sum. Throws where the frames are not of one size.
void add(const oracle::Frame& a, const oracle::Frame& b, Difference& sum) {
  if (a.width != b.width || a.height != b.height || a.range.size() != b.range.size()) {
    throw oracle::InputError(b.name + ": not the size of the frame it is compared with");
  }
  for (std::size_t i = 0; i < a.range.size(); ++i) {
    ++sum.pixels;
    const float x = a.range[i], y = b.range[i];
    if (class_of(x) != class_of(y)) {
      ++sum.classes;
      ++sum.bits;
    } else if (class_of(x) == 't' && x != y) {
      ++sum.bits;
      const auto p = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(x));
      const auto q = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(y));
      sum.ulp = std::max(sum.ulp, std::abs(p - q));
      sum.share = std::max(sum.share, std::abs(static_cast<double>(x) - static_cast<double>(y)) /
                                          static_cast<double>(x));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: ridgeline-compare-ranges DUMP_A DUMP_B\n");
    return 2;
  }
  try {
    Difference sum;
    const std::filesystem::path other(argv[2]);
    for (const auto& file : oracle::frame_files(argv[1])) {
      add(oracle::read_frame(file), oracle::read_frame(other / file.filename()), sum);
    }
    const double pixels = std::max(1.0, static_cast<double>(sum.pixels));
    std::printf(
        "%zu pixels, %.4f %% differ in a bit, %zu in class; at most %lld ulp, %.2g of the "
        "distance\n",
        sum.pixels, 100.0 * static_cast<double>(sum.bits) / pixels, sum.classes,
        static_cast<long long>(sum.ulp), sum.share);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ridgeline-compare-ranges: %s\n", error.what());
    return 3;
  }
  return 0;
}
