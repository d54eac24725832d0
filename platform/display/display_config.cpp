#include "platform/display/display_config.hpp"

#include <cmath>

#include "platform/display/config_keys.hpp"

namespace ridgeline {

FrameSettings frame_settings(const DisplayConfig& config) {
  const DisplayConfig::Picture& picture = config.picture;
  FrameSettings settings;
  settings.image = {picture.width_px, picture.height_px, picture.horizontal_field_of_view_deg};
  settings.error_px = picture.error_px;
  settings.range_m = picture.range_km * 1e3;
  return settings;
}

BudgetSettings budget_settings(const DisplayConfig& config) {
  const double wanted_ms = config.monitor.deadline_ms;
  const double deadline_ns = wanted_ms > 0 ? wanted_ms * 1e6 : 1e9 / config.picture.rate_hz;
  return {std::llround(deadline_ns), config.picture.error_px, config.monitor.most_px};
}

ScreenSettings screen_settings(const DisplayConfig& config) {
  ScreenSettings settings;
  settings.kind = config.screen.kind;
  settings.width_px = config.picture.width_px;
  settings.height_px = config.picture.height_px;
  settings.refresh_hz = config.screen.refresh_hz;
  settings.card = config.screen.card.c_str();
  settings.connector = config.screen.connector.c_str();
  settings.window_system = config.screen.window_system;
  settings.x_display = config.screen.x_display.c_str();
  settings.wayland_display = config.screen.wayland_display.c_str();
  settings.gpu_timeout_ns = config.timeouts.picture_ms * limits::ms_ns;
  settings.flip_timeout_ns = config.timeouts.picture_ms * limits::ms_ns;
  return settings;
}

GpioSettings gpio_settings(const DisplayConfig& config) {
  GpioSettings settings;
  for (std::size_t i = 0; i < discrete_output_count; ++i) {
    const DisplayConfig::Line& line = config.lines.outputs[i];
    settings.outputs[i] = {line.name.c_str(), line.active_low};
  }
  for (std::size_t i = 0; i < discrete_input_count; ++i) {
    const DisplayConfig::Line& line = config.lines.inputs[i];
    settings.inputs[i] = {line.name.c_str(), line.active_low};
  }
  settings.hold_ns = config.lines.hold_ms * limits::ms_ns;
  return settings;
}

StateLimits pose_limits(const DisplayConfig& config) {
  StateLimits made = state_limits(bus_profile(config));
  made.attitude_timeout_ns = config.timeouts.attitude_ms * limits::ms_ns;
  made.heading_timeout_ns = config.timeouts.heading_ms * limits::ms_ns;
  made.position_timeout_ns = config.timeouts.position_ms * limits::ms_ns;
  made.height_timeout_ns = config.timeouts.height_ms * limits::ms_ns;
  return made;
}

BusProfile bus_profile(const DisplayConfig& config) {
  BusProfile profile;
  profile.protocol = config.bus.protocol;
  profile.header_rule = config.bus.header_rule;
  profile.heading_reference = config.bus.heading_reference;
  profile.variation_east_positive = config.bus.variation_east_positive;
  profile.channel = static_cast<std::uint16_t>(config.bus.channel);
  profile.channel_count = static_cast<std::uint16_t>(config.bus.channel_count);
  profile.arinc429.fine_rule = config.bus.arinc429_fine_rule;
  for (const std::string& port : config.bus.arinc429_ports) {
    const std::string wrong = set_arinc429_port(port, profile.arinc429);
    RL_ASSERT(wrong.empty());
  }
  profile.canfix_height_is_ellipsoidal = config.bus.canfix_height_is_ellipsoidal;
  return profile;
}

}  // namespace ridgeline
