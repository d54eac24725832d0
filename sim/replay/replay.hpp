#pragma once
#include <optional>
#include <string>

#include "core/bus/bus_profile.hpp"
#include "sim/replay/replay_pacing.hpp"
#include "sim/session/session.hpp"

namespace ridgeline::sim {

/// A recorded flight and what to make of it.
struct ReplayOptions {
  SceneOptions scene;
  std::string log_file;
  BusProfile bus;
  bool heading_assumed = true;  ///< id 321 is taken as true although nobody said so
  double rate_hz = 10.0;
  double from_s = 0.0;
  std::optional<double> to_s;
  std::string frames_folder, dump_folder, report_file;  ///< empty: not written
  int dump_every = 1;                                   ///< frames
  PaceOptions pace;
  DisplayState display;                       ///< of every frame
  AirGround air_ground = AirGround::unknown;  ///< what the switch says, all the time
};

/// Renders a log. The clock is the log's own time: frame k shows the moment
/// start + from_s + k / rate_hz, with the bus frames received until then and no others.
/// Outcome: the message names the file and what is wrong with it.
Outcome replay(const ReplayOptions& options);

}  // namespace ridgeline::sim
