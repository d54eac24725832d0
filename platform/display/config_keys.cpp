#include "platform/display/config_keys.hpp"

#include <charconv>

#include "config/limits.hpp"
#include "config/limits_budget.hpp"

namespace ridgeline {
namespace {

using C = DisplayConfig;

constexpr std::string_view screen_words[] = {"surfaceless", "window", "kms"};
constexpr std::string_view window_words[] = {"x11", "wayland"};
constexpr std::string_view protocol_words[] = {"canaerospace", "arinc429", "canfix"};
constexpr std::string_view header_words[] = {"strict", "field"};
constexpr std::string_view heading_words[] = {"unknown", "true", "magnetic"};
constexpr std::string_view fine_words[] = {"add", "by-sign", "none"};

constexpr std::size_t longest_interface = 15;  // bytes, as the kernel has it
constexpr std::size_t longest_line = 31;
constexpr std::size_t longest_socket = 107;
constexpr std::size_t longest_path = 1'000;
constexpr int longest_timeout_ms = 10'000;
constexpr int highest_priority = 99;  // 0: not a real-time thread

std::string wrong_interface(const std::string& text) {
  const bool plain = text.find_first_of("/ \t") == std::string::npos;
  return !text.empty() && plain ? "" : "is not the name of an interface";
}

std::string wrong_port(const std::string& text) {
  Arinc429Profile nowhere;
  return set_arinc429_port(text, nowhere);
}

/// A member of a section, as the function that finds it.
template <auto Section, auto Member>
constexpr auto at = [](C& c) -> auto& {
  return c.*Section.*Member;
};

template <DiscreteOutput Output>
constexpr auto output =
    [](C& c) -> C::Line& { return c.lines.outputs[static_cast<std::size_t>(Output)]; };
template <DiscreteInput Input>
constexpr auto input =
    [](C& c) -> C::Line& { return c.lines.inputs[static_cast<std::size_t>(Input)]; };
template <auto Line>
TextKey line_name() {
  return {longest_line, false, [](C& c) -> std::string& { return Line(c).name; }};
}
template <auto Line>
BooleanKey line_low() {
  return {[](C& c) -> bool& { return Line(c).active_low; }};
}

using Picture = C::Picture;
using Monitor = C::Monitor;
using Screen = C::Screen;
using Terrain = C::Terrain;
using Bus = C::Bus;
using Timeouts = C::Timeouts;
using RealTime = C::RealTime;
using Report = C::Report;
constexpr auto heartbeat = output<DiscreteOutput::heartbeat>;
constexpr auto svs_valid = output<DiscreteOutput::svs_valid>;
constexpr auto svs_fail = output<DiscreteOutput::svs_fail>;
constexpr auto display_on = input<DiscreteInput::display_on>;

constexpr int least_px = limits::min_image_px, most_px = limits::max_image_px;
constexpr double km = 1e-3;

const ConfigKey keys[] = {
    {"picture", "width_px", true, WholeKey{least_px, most_px, at<&C::picture, &Picture::width_px>}},
    {"picture", "height_px", true,
     WholeKey{least_px, most_px, at<&C::picture, &Picture::height_px>}},
    {"picture", "horizontal_field_of_view_deg", true,
     NumberKey{limits::min_field_of_view_deg, limits::max_field_of_view_deg,
               at<&C::picture, &Picture::horizontal_field_of_view_deg>}},
    {"picture", "rate_hz", false, NumberKey{0.1, 120.0, at<&C::picture, &Picture::rate_hz>}},
    {"picture", "error_px", false,
     NumberKey{0.0, limits::max_error_px, at<&C::picture, &Picture::error_px>}},
    {"picture", "range_km", false,
     NumberKey{limits::min_range_m * km, limits::max_range_m* km,
               at<&C::picture, &Picture::range_km>}},
    {"picture", "night_luminance", false,
     NumberKey{limits::least_night_luminance, 1.0, at<&C::picture, &Picture::night_luminance>}},

    {"monitor", "on", false, BooleanKey{at<&C::monitor, &Monitor::on>}},
    {"monitor", "deadline_ms", false,
     NumberKey{0.0, 1e-6 * limits::max_deadline_ns, at<&C::monitor, &Monitor::deadline_ms>}},
    {"monitor", "most_px", false,
     NumberKey{0.0, limits::max_error_px, at<&C::monitor, &Monitor::most_px>}},

    {"screen", "kind", true,
     ChoiceKey{screen_words,
               [](C& c, std::size_t word) { c.screen.kind = static_cast<ScreenKind>(word); }}},
    {"screen", "card", false, TextKey{longest_path, true, at<&C::screen, &Screen::card>}},
    {"screen", "connector", false,
     TextKey{longest_line, false, at<&C::screen, &Screen::connector>}},
    {"screen", "refresh_hz", false, NumberKey{0.0, 240.0, at<&C::screen, &Screen::refresh_hz>}},
    {"screen", "window_system", false,
     ChoiceKey{
         window_words,
         [](C& c, std::size_t word) { c.screen.window_system = static_cast<WindowSystem>(word); }}},
    {"screen", "x_display", false,
     TextKey{longest_line, false, at<&C::screen, &Screen::x_display>}},
    {"screen", "wayland_display", false,
     TextKey{longest_socket, false, at<&C::screen, &Screen::wayland_display>}},

    {"terrain", "folder", true, TextKey{longest_path, true, at<&C::terrain, &Terrain::folder>}},
    {"terrain", "geoid", true, TextKey{longest_path, true, at<&C::terrain, &Terrain::geoid>}},
    {"terrain", "gpu_budget_mib", false,
     NumberKey{1.0, 4096.0, at<&C::terrain, &Terrain::gpu_budget_mib>}},
    {"terrain", "home_latitude_deg", true,
     NumberKey{-90.0, 90.0, at<&C::terrain, &Terrain::home_latitude_deg>}},
    {"terrain", "home_longitude_deg", true,
     NumberKey{-180.0, 180.0, at<&C::terrain, &Terrain::home_longitude_deg>}},

    {"bus", "interfaces", true,
     TextListKey{longest_interface, 2, wrong_interface, at<&C::bus, &Bus::interfaces>}},
    {"bus", "protocol", true,
     ChoiceKey{protocol_words,
               [](C& c, std::size_t word) { c.bus.protocol = static_cast<BusProtocol>(word); }}},
    {"bus", "header_rule", false,
     ChoiceKey{header_words,
               [](C& c, std::size_t word) { c.bus.header_rule = static_cast<HeaderRule>(word); }}},
    {"bus", "heading_reference", true,
     ChoiceKey{
         heading_words,
         [](C& c,
            std::size_t word) { c.bus.heading_reference = static_cast<HeadingReference>(word); }}},
    {"bus", "variation_east_positive", false,
     BooleanKey{at<&C::bus, &Bus::variation_east_positive>}},
    {"bus", "channel", false, WholeKey{0, 8191, at<&C::bus, &Bus::channel>}},
    {"bus", "channel_count", false, WholeKey{1, 8192, at<&C::bus, &Bus::channel_count>}},
    {"bus", "node_id", false, WholeKey{0, 255, at<&C::bus, &Bus::node_id>}},
    {"bus", "arinc429_ports", false,
     TextListKey{longest_line, arinc429_port_count, wrong_port, at<&C::bus, &Bus::arinc429_ports>}},
    {"bus", "arinc429_fine_rule", false,
     ChoiceKey{
         fine_words,
         [](C& c, std::size_t word) { c.bus.arinc429_fine_rule = static_cast<FineRule>(word); }}},
    {"bus", "canfix_height_is_ellipsoidal", false,
     BooleanKey{at<&C::bus, &Bus::canfix_height_is_ellipsoidal>}},
    {"bus", "stall_ms", false, WholeKey{10, 1'000, at<&C::bus, &Bus::stall_ms>}},

    {"timeouts", "attitude_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::attitude_ms>}},
    {"timeouts", "heading_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::heading_ms>}},
    {"timeouts", "position_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::position_ms>}},
    {"timeouts", "height_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::height_ms>}},
    {"timeouts", "picture_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::picture_ms>}},
    {"timeouts", "heartbeat_input_ms", false,
     WholeKey{20, longest_timeout_ms, at<&C::timeouts, &Timeouts::heartbeat_input_ms>}},

    {"lines", "heartbeat", false, line_name<heartbeat>()},
    {"lines", "heartbeat_active_low", false, line_low<heartbeat>()},
    {"lines", "svs_valid", false, line_name<svs_valid>()},
    {"lines", "svs_valid_active_low", false, line_low<svs_valid>()},
    {"lines", "svs_fail", false, line_name<svs_fail>()},
    {"lines", "svs_fail_active_low", false, line_low<svs_fail>()},
    {"lines", "display_on", false, line_name<display_on>()},
    {"lines", "display_on_active_low", false, line_low<display_on>()},
    {"lines", "declutter", false, line_name<input<DiscreteInput::declutter>>()},
    {"lines", "declutter_active_low", false, line_low<input<DiscreteInput::declutter>>()},
    {"lines", "night", false, line_name<input<DiscreteInput::night>>()},
    {"lines", "night_active_low", false, line_low<input<DiscreteInput::night>>()},
    {"lines", "on_ground", false, line_name<input<DiscreteInput::on_ground>>()},
    {"lines", "on_ground_active_low", false, line_low<input<DiscreteInput::on_ground>>()},
    {"lines", "can_hover", false, BooleanKey{at<&C::lines, &C::Lines::can_hover>}},
    {"lines", "hold_ms", false, WholeKey{0, 1'000, at<&C::lines, &C::Lines::hold_ms>}},

    {"real_time", "lock_memory", false, BooleanKey{at<&C::real_time, &RealTime::lock_memory>}},
    {"real_time", "bus_priority", false,
     WholeKey{0, highest_priority, at<&C::real_time, &RealTime::bus_priority>}},
    {"real_time", "supervisor_priority", false,
     WholeKey{0, highest_priority, at<&C::real_time, &RealTime::supervisor_priority>}},
    {"real_time", "render_priority", false,
     WholeKey{0, highest_priority, at<&C::real_time, &RealTime::render_priority>}},

    {"report", "status_file", false,
     TextKey{longest_path, true, at<&C::report, &Report::status_file>}},
    {"report", "status_interval_s", false,
     NumberKey{0.0, 3'600.0, at<&C::report, &Report::status_interval_s>}},
    {"report", "last_frame_folder", false,
     TextKey{longest_path, true, at<&C::report, &Report::last_frame_folder>}},
};

}  // namespace

std::span<const ConfigKey> config_keys() {
  return keys;
}

std::string set_arinc429_port(const std::string& text, Arinc429Profile& profile) {
  constexpr unsigned last_equipment = 0xfff;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return "is not PORT=EQ";
  const char* const middle = text.data() + equals;
  const char* const end = text.data() + text.size();
  unsigned port = 0, equipment = 0;
  const auto [port_end, port_error] = std::from_chars(text.data(), middle, port);
  const auto [id_end, id_error] = std::from_chars(middle + 1, end, equipment, 16);
  if (port_error != std::errc{} || port_end != middle || port >= arinc429_port_count ||
      id_error != std::errc{} || id_end != end || equipment == 0 || equipment > last_equipment) {
    return "is not PORT=EQ, port 0 to 15, equipment 001 to FFF (hexadecimal)";
  }
  if (profile.ports[port].equipment != 0) return "names a port for the second time";
  profile.ports[port].equipment = static_cast<std::uint16_t>(equipment);
  return {};
}

}  // namespace ridgeline
