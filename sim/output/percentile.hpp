#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace ridgeline::sim {

/// The value below which `share` (0..1) of the values lie, by nearest rank; 0 of nothing.
[[nodiscard]] inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace ridgeline::sim
