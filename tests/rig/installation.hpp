#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/synthetic/scripted_flight.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline::rig {

/// Whether this machine is an emulated one, ten times as slow as others; `guest` says so.
bool is_emulated();

/// What an installation of the flight program may be told otherwise.
struct InstallationSettings {
  std::string terrain = "tiles", geoid = "none", screen = "surfaceless", card = "/dev/dri/card0";
  std::string wayland_display;  ///< of a window; empty: of no compositor
  std::vector<std::string> buses = {"rig0"};
  std::string heartbeat = "rig-beat";
  int width_px = 64, height_px = 48;
  double rate_hz = is_emulated() ? 1 : 4;
  double range_km = 8;
  int attitude_ms = is_emulated() ? 3000 : 1000;  ///< heading and input of the heartbeat likewise
  int position_ms = is_emulated() ? 6000 : 3000;  ///< height likewise
  int picture_ms = is_emulated() ? 9000 : 2000;
  double status_interval_s = 1;
  std::string status_file = "status.json", last_frame_folder = "last";
  bool monitor_on = true;
  std::string more;  ///< lines at the end
};

/// On the simulated card's monitor, in its smallest mode, as slow as it has to be in emulation.
InstallationSettings monitor_settings();

/// A line of a recorded bus without its time: false drops the frame. `data` may be changed.
using FrameEdit = std::function<bool(const std::string& id, std::string& data)>;

/// Hills under a flight that stands nearly still over them, its configuration, and what it leaves.
class Installation {
 public:
  Installation();

  void configure(const InstallationSettings& settings) const;
  /// A log of 20 s, played again and again; its end and its beginning are 2 m apart.
  [[nodiscard]] std::vector<std::string> player(const std::string& bus = "rig0",
                                                const std::string& log = "flight.log") const;
  /// Writes another log, with frames of the usual one changed.
  void write_log(const std::string& name, const FrameEdit& edit) const;
  /// Writes a log of a flight that is elsewhere.
  void write_log(const std::string& name, double latitude_deg, double height_m,
                 double roll_deg) const;

  [[nodiscard]] std::vector<std::string> program() const;
  /// The newest status report; discarded, where there is none yet.
  [[nodiscard]] nlohmann::json status() const;
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  test::ScratchFolder folder_{"rig_display"};
};

}  // namespace ridgeline::rig
