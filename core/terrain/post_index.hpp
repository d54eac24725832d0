#pragma once
#include <cmath>

namespace ridgeline {

inline constexpr double same_post_steps = 1e-3;  ///< posts this close, in steps, are one

/// The index of a coordinate among `count` posts from `first` on, or -1 where no post stands.
inline int post_index(double value, double first, double step, int count) {
  const double index = (value - first) / step;
  const double nearest = std::round(index);
  if (!(std::abs(index - nearest) <= same_post_steps)) return -1;
  return nearest >= 0 && nearest < count ? static_cast<int>(nearest) : -1;
}

}  // namespace ridgeline
