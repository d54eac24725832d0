#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace ridgeline::test {

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) * 0x1p-32);
  }
  int below(int count) { return static_cast<int>(between(0, count)); }

 private:
  std::mt19937 engine_;
};

/// The largest of many errors, as a share of what is derived for it.
class Row {
 public:
  Row(const char* name, double derived) : name_(name), derived_(derived) {}
  void add(double error, double allowed_besides = 0) {
    largest_ = std::max(largest_, std::abs(error) - allowed_besides);
    if (std::isnan(error)) largest_ = error;
    ++count_;
  }
  [[nodiscard]] double largest() const { return largest_; }
  void expect_within(const char* unit) const {
    std::printf("[ row ] %-34s %9.3g of %9.3g %s (%.2f) in %zu\n", name_, largest_, derived_, unit,
                largest_ / derived_, count_);
    EXPECT_LE(largest_, derived_) << name_;
    EXPECT_GT(count_, 5'000U) << name_;
  }

 private:
  const char* name_;
  double derived_, largest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace ridgeline::test
