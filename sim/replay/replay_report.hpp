#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/monitor/air_ground_check.hpp"
#include "core/monitor/ground_check.hpp"
#include "core/state/ownship_state.hpp"
#include "sim/log/candump_reader.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// What frames showed of the ground below is judged by the next one: it is known once it is drawn.
struct GroundWatch {
  GroundCheck radio;
  AirGroundCheck air_ground;

  void take(const OwnshipPose& pose, AirGround said, double over_ground_m, std::int64_t time_ns) {
    radio = ground_check(radio, pose.radio_height_m, over_ground_m, time_ns);
    const AirGroundFacts facts{said, pose.ground_speed_mps, over_ground_m, false};
    air_ground = air_ground_check(air_ground, facts, time_ns);
  }
};

/// Collects what the frames of a replay say about themselves; the JSON of contract section 4.
class ReplayReport {
 public:
  void add(int index, const Picture& picture);
  [[nodiscard]] int removed_count() const { return removed_; }
  [[nodiscard]] double median_cpu_ms() const;

  /// The finished report; `log` and `state` add what the input was like.
  [[nodiscard]] nlohmann::ordered_json finished(const CandumpLog& log, const OwnshipState& state,
                                                const GroundWatch& ground, const Session& session,
                                                const std::string& log_file) const;

 private:
  struct Recovery {
    double from_s = 0, worst_px = 0;
    int frames = 0;
  };
  void track_recovery(const Picture& picture);

  nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json recoveries_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json rss_ = nlohmann::ordered_json::array();
  std::vector<double> cpu_ms_, gpu_ms_, upload_ms_;
  std::map<std::string, int> reasons_;
  std::optional<Recovery> recovery_;
  double largest_bound_px_ = 0;
  double first_terrain_ms_ = -1, first_svs_ms_ = -1;  ///< from the start of the program
  int removed_ = 0, degraded_ = 0, bounds_held_ = 0;
};

}  // namespace ridgeline::sim
