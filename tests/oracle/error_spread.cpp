#include "tests/oracle/error_spread.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::oracle {
namespace {

constexpr double smallest_px = 1e-9;
constexpr double largest_px = 1e4;
constexpr int steps_per_octave = 64;

const double octaves = std::log2(largest_px / smallest_px);

std::size_t step_of(double error_px) {
  if (!(error_px > 0)) return 0;
  const double octave = std::clamp(std::log2(error_px / smallest_px), 0.0, octaves);
  return 1 + static_cast<std::size_t>(octave * steps_per_octave);
}

double upper_end_px(std::size_t step) {
  if (step == 0) return 0;
  return smallest_px * std::exp2(static_cast<double>(step) / steps_per_octave);
}

}  // namespace

ErrorSpread::ErrorSpread() : steps_(step_of(largest_px) + 1) {}

void ErrorSpread::add(double error_px, bool is_larger, double bound_px,
                      std::optional<double> proven_px) {
  ++count_;
  max_px_ = std::max(max_px_, error_px);
  sum_px_ += error_px;
  sum_of_bounds_px_ += bound_px;
  const double of_bound = error_px / bound_px;
  max_of_bound_ = std::max(max_of_bound_, of_bound);
  std::size_t bin = 0;
  while (bin < bin_ends.size() && of_bound > bin_ends[bin]) ++bin;
  if (is_larger && of_bound >= 1) bin = bin_ends.size();
  ++bins_[bin];
  ++steps_[step_of(error_px)];
  if (!proven_px) return;
  ++proven_count_;
  sum_of_proven_px_ += *proven_px;
  max_of_proven_ = std::max(max_of_proven_, error_px / *proven_px);
}

double ErrorSpread::percentile_px(double share) const {
  if (count_ == 0) return 0;
  const double rank = std::clamp(share, 0.0, 1.0) * static_cast<double>(count_ - 1);
  std::size_t below = 0;
  for (std::size_t step = 0; step < steps_.size(); ++step) {
    below += steps_[step];
    if (static_cast<double>(below) > rank) return std::min(upper_end_px(step), max_px_);
  }
  return max_px_;
}

}  // namespace ridgeline::oracle
