#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "config/limits.hpp"
#include "config/limits_display.hpp"
#include "core/bus/bus_profile.hpp"
#include "core/frame/frame_pipeline.hpp"
#include "core/monitor/discretes.hpp"
#include "core/state/ownship_pose.hpp"
#include "platform/file_result.hpp"
#include "platform/gpio_lines.hpp"
#include "platform/screen.hpp"

namespace ridgeline {

/// One installation of the display, as its configuration file says it. Every member is one key of
/// that file (config_keys.cpp: section, name, type, range); a path is relative to the file's
/// folder.
struct DisplayConfig {
  struct Picture {
    int width_px = 1024;
    int height_px = 800;
    double horizontal_field_of_view_deg = 60.0;
    double rate_hz = 30.0;
    double error_px = limits::default_error_px;
    double range_km = limits::default_range_m * 1e-3;
    double night_luminance = limits::default_night_luminance;
  } picture;

  struct Monitor {
    bool on = true;
    double deadline_ms = 0;  ///< 0: the period
    double most_px = limits::budget_most_px;
  } monitor;

  struct Screen {
    ScreenKind kind = ScreenKind::surfaceless;
    std::string card = "/dev/dri/card0";
    std::string connector;
    double refresh_hz = 0;
    WindowSystem window_system = WindowSystem::x11;
    std::string x_display;
    std::string wayland_display;
  } screen;

  struct Terrain {
    std::string folder;
    std::string geoid = "none";
    double gpu_budget_mib = limits::terrain_gpu_bytes / (1024.0 * 1024.0);
    double home_latitude_deg = 0;
    double home_longitude_deg = 0;
  } terrain;

  struct Bus {
    std::vector<std::string> interfaces;
    BusProtocol protocol = BusProtocol::canaerospace;
    HeaderRule header_rule = HeaderRule::strict;
    HeadingReference heading_reference = HeadingReference::unknown;
    bool variation_east_positive = true;
    int channel = 0;
    int channel_count = 1;
    int node_id = 0;
    std::vector<std::string> arinc429_ports;
    FineRule arinc429_fine_rule = FineRule::always_add;
    bool canfix_height_is_ellipsoidal = false;
    int stall_ms = static_cast<int>(limits::can_stall_ns / limits::ms_ns);
  } bus;

  struct Timeouts {
    int attitude_ms = static_cast<int>(limits::attitude_timeout_ns / limits::ms_ns);
    int heading_ms = static_cast<int>(limits::heading_timeout_ns / limits::ms_ns);
    int position_ms = static_cast<int>(limits::position_timeout_ns / limits::ms_ns);
    int height_ms = static_cast<int>(limits::height_timeout_ns / limits::ms_ns);
    int picture_ms = 500;
    int heartbeat_input_ms = 100;
  } timeouts;

  struct Line {
    std::string name;
    bool active_low = false;
  };
  struct Lines {
    std::array<Line, discrete_output_count> outputs;  ///< by DiscreteOutput
    std::array<Line, discrete_input_count> inputs;    ///< by DiscreteInput
    int hold_ms = static_cast<int>(limits::discrete_hold_ns / limits::ms_ns);
    bool can_hover = false;  ///< AirGroundFacts::can_hover
  } lines;

  struct RealTime {
    bool lock_memory = true;
    int bus_priority = 60;
    int supervisor_priority = 50;
    int render_priority = 40;
  } real_time;

  struct Report {
    std::string status_file;
    double status_interval_s = 10.0;
    std::string last_frame_folder;
  } report;
};

/// Reads and checks a configuration file: every key has a known name, its type and its range, the
/// required ones are there, and together they make sense. The message is `FILE:LINE: SECTION.KEY:
/// what is wrong`, of the first problem in the file. Allocates: boot time only.
[[nodiscard]] FileResult<DisplayConfig> load_config(const std::string& path);
/// The same for the text of a file named `path`.
[[nodiscard]] FileResult<DisplayConfig> config_in(const std::string& path, const std::string& text);

/// What the parts are told. Owner: texts view `config`.
[[nodiscard]] FrameSettings frame_settings(const DisplayConfig& config);
/// Domain: `deadline_ms` was checked by load_config().
[[nodiscard]] BudgetSettings budget_settings(const DisplayConfig& config);
[[nodiscard]] ScreenSettings screen_settings(const DisplayConfig& config);
[[nodiscard]] GpioSettings gpio_settings(const DisplayConfig& config);
[[nodiscard]] StateLimits pose_limits(const DisplayConfig& config);
/// Domain: `arinc429_ports` were checked by load_config().
[[nodiscard]] BusProfile bus_profile(const DisplayConfig& config);

}  // namespace ridgeline
