#pragma once
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {

/// A stream of random numbers of its own for every case: the same on every machine.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t number) : seed_(seed), number_(number) {}

  std::uint64_t bits() {
    return lattice_hash(static_cast<std::int64_t>(number_), static_cast<std::int64_t>(count_++),
                        seed_);
  }
  /// 0 <= result < 1.
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// low..high, both included.
  int whole(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double share) { return unit() < share; }
  double one_of(std::initializer_list<double> values) {
    return values.begin()[bits() % values.size()];
  }
  /// Small values as often as large ones: one of some powers of two, then anything up to the next.
  double spread(double low, double high) {
    int doublings = 0;
    for (double value = low; 2 * value <= high; value *= 2) ++doublings;
    const double value = std::ldexp(low, whole(0, doublings)) * between(1, 2);
    return value < high ? value : high;
  }
  double seed() { return whole(0, 999'999); }

 private:
  std::uint64_t seed_, number_, count_ = 0;
};

/// `value` with so many decimals: the text of a case stays short, and exact places are hit.
inline double with_decimals(double value, int decimals) {
  double scale = 1;
  for (int k = 0; k < decimals; ++k) scale *= 10;
  return std::round(value * scale) / scale;
}

}  // namespace ridgeline::sim
