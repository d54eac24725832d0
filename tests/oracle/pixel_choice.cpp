#include "tests/oracle/pixel_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ridgeline::oracle {
namespace {

/// A small generator of our own, because the library's distributions differ between machines.
/// Source: Steele, Lea, Flood (2014), SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t value = state_;
    value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
    value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
    return value ^ (value >> 31U);
  }
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(next() % limit); }
  double unit() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

bool differ(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) != std::isnan(b);
  if (std::isinf(a) || std::isinf(b)) return a != b;
  return std::abs(a - b) > 0.1 * std::min(std::abs(a), std::abs(b));
}

bool is_at_jump(const Frame& frame, int u, int v) {
  const double z = frame.z(u, v);
  for (int y = std::max(0, v - 1); y <= std::min(frame.height - 1, v + 1); ++y) {
    for (int x = std::max(0, u - 1); x <= std::min(frame.width - 1, u + 1); ++x) {
      if (differ(z, frame.z(x, y))) return true;
    }
  }
  return false;
}

/// Brings `count` random elements to the front.
void draw(std::vector<int>& from, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(from[i], from[i + random.below(from.size() - i)]);
  }
}

}  // namespace

std::vector<ChosenPixel> chosen_pixels(const Frame& frame, int count, std::uint64_t seed,
                                       int sample_one_in) {
  std::uint64_t mixed = seed;
  for (const char c : frame.name) mixed = mixed * 1099511628211U + static_cast<unsigned char>(c);
  Random random(mixed);
  std::vector<int> jumps;
  std::vector<int> others;
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      (is_at_jump(frame, u, v) ? jumps : others).push_back(v * frame.width + u);
    }
  }
  const std::size_t wanted =
      std::min(static_cast<std::size_t>(std::max(count, 0)), jumps.size() + others.size());
  const std::size_t at_jumps = std::min(jumps.size(), (wanted + 1) / 2);
  draw(jumps, at_jumps, random);
  std::vector<int> chosen(jumps.begin(), jumps.begin() + static_cast<std::ptrdiff_t>(at_jumps));
  others.insert(others.end(), jumps.begin() + static_cast<std::ptrdiff_t>(at_jumps), jumps.end());
  draw(others, wanted - at_jumps, random);
  chosen.insert(chosen.end(), others.begin(),
                others.begin() + static_cast<std::ptrdiff_t>(wanted - at_jumps));
  std::vector<ChosenPixel> pixels;
  for (const int index : chosen) {
    const double x = random.unit() - 0.5;
    const double y = random.unit() - 0.5;
    // They were drawn in random order, so every n-th of them is a random sample.
    const bool is_sampled =
        sample_one_in > 0 && pixels.size() % static_cast<std::size_t>(sample_one_in) == 0;
    pixels.push_back({index % frame.width, index / frame.width, {x, y}, is_sampled});
  }
  std::sort(pixels.begin(), pixels.end(), [](const ChosenPixel& a, const ChosenPixel& b) {
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  return pixels;
}

}  // namespace ridgeline::oracle
