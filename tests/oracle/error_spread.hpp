#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace ridgeline::oracle {

/// How the actual errors of many pixels are spread, and how they compare with the bounds of their
/// frames. Adding the same errors in the same order gives the same numbers.
/// Cost:   a fixed number of counters, however many errors are added.
class ErrorSpread {
 public:
  ErrorSpread();

  /// Units: px. `is_larger`: the error is at least this, and how large is not known. `proven_px`:
  /// what the frame's terms add up to, at most the bound.
  void add(double error_px, bool is_larger, double bound_px, std::optional<double> proven_px);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double max_px() const { return max_px_; }
  [[nodiscard]] double mean_px() const { return mean(sum_px_); }
  /// The error below which `share` (0..1) of the pixels lie. Error: at most 1.1 % too large.
  [[nodiscard]] double percentile_px(double share) const;

  [[nodiscard]] double mean_bound_px() const { return mean(sum_of_bounds_px_); }
  [[nodiscard]] double max_of_bound() const { return max_of_bound_; }
  /// Mean bound over mean error: 1 would be a bound without any reserve; +inf without any error.
  [[nodiscard]] double tightness() const { return sum_of_bounds_px_ / sum_px_; }

  /// The same for what was proven, where every frame said so.
  [[nodiscard]] bool has_proven() const { return count_ > 0 && proven_count_ == count_; }
  [[nodiscard]] double mean_proven_px() const { return mean(sum_of_proven_px_); }
  [[nodiscard]] double max_of_proven() const { return max_of_proven_; }
  [[nodiscard]] double tightness_of_proven() const { return sum_of_proven_px_ / sum_px_; }

  /// Upper ends of the bins of error / bound. The first holds errors of exactly 0, the last but one
  /// ends at 1, the last holds what is above it.
  static constexpr std::array<double, 8> bin_ends{0, 0.001, 0.01, 0.05, 0.1, 0.2, 0.5, 1};
  [[nodiscard]] const std::array<std::size_t, bin_ends.size() + 1>& bins() const { return bins_; }

 private:
  [[nodiscard]] double mean(double sum) const {
    return count_ == 0 ? 0 : sum / static_cast<double>(count_);
  }

  std::size_t count_ = 0;
  std::size_t proven_count_ = 0;
  double max_px_ = 0;
  double sum_px_ = 0;
  double sum_of_bounds_px_ = 0;
  double sum_of_proven_px_ = 0;
  double max_of_bound_ = 0;
  double max_of_proven_ = 0;
  std::array<std::size_t, bin_ends.size() + 1> bins_{};
  std::vector<std::size_t> steps_;  ///< errors by their logarithm; the first counts zeros
};

}  // namespace ridgeline::oracle
