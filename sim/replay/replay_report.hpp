#pragma once
#include <nlohmann/json.hpp>

#include "core/state/ownship_state.hpp"
#include "sim/log/candump_reader.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// Collects what the frames of a replay say about themselves; the JSON of contract section 4.
class ReplayReport {
 public:
  void add(int index, const Picture& picture);
  [[nodiscard]] int removed_count() const { return removed_; }
  [[nodiscard]] double median_cpu_ms() const;

  /// The finished report; `log` and `state` add what the input was like.
  [[nodiscard]] nlohmann::ordered_json finished(const CandumpLog& log, const OwnshipState& state,
                                                const Session& session,
                                                const std::string& log_file) const;

 private:
  nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
  std::vector<double> cpu_ms_, gpu_ms_;
  std::map<std::string, int> reasons_;
  double largest_bound_px_ = 0;
  int removed_ = 0, degraded_ = 0;
};

}  // namespace ridgeline::sim
