#include "tests/rig/installation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/synthetic/bus_log_writer.hpp"
#include "sim/synthetic/tile_writer.hpp"

namespace ridgeline::rig {
namespace {

constexpr int posts = 1201;  // 3"
constexpr double home_latitude_deg = 46.5, home_longitude_deg = 8.5;
constexpr double usual_height_m = 1500, usual_roll_deg = 5;

double hills(double latitude_deg, double longitude_deg) {
  return 800.0 + 300.0 * std::sin(latitude_deg * 400.0) * std::cos(longitude_deg * 300.0);
}

std::string flight_log(double latitude_deg, double height_m, double roll_deg) {
  std::vector<sim::FlightSample> samples;
  for (int tick = 0; tick < 20 * sim::flight_ticks_per_second; ++tick) {
    sim::FlightSample sample;
    sample.time_s = static_cast<double>(tick) / sim::flight_ticks_per_second;
    sample.latitude_deg = latitude_deg + sample.time_s * 1e-6;
    sample.longitude_deg = home_longitude_deg;
    sample.height_m = height_m;
    sample.roll_deg = roll_deg;
    sample.heading_deg = 30.0;
    samples.push_back(sample);
  }
  return sim::bus_log(samples, sim::BusGaps{});
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

std::string quoted(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + quoted(text);
  return "[" + all + "]";
}

}  // namespace

InstallationSettings monitor_settings() {
  InstallationSettings settings;
  settings.screen = "kms";
  settings.width_px = 640;
  settings.height_px = 480;
  settings.rate_hz = is_emulated() ? 0.1 : 1;
  settings.range_km = 4;
  settings.attitude_ms = settings.position_ms = settings.picture_ms = 10'000;
  settings.monitor_on = false;
  return settings;
}

bool is_emulated() {
  return std::getenv("RIG_EMULATED") != nullptr;
}

Installation::Installation() {
  std::filesystem::create_directories(file("tiles"));
  EXPECT_TRUE(sim::write_tile_with(file("tiles"), 46, 8, posts, hills).ok());
  write_log("flight.log", home_latitude_deg, usual_height_m, usual_roll_deg);
  configure({});
}

void Installation::configure(const InstallationSettings& s) const {
  std::ofstream out(file("rig.toml"));
  out << "[picture]\nwidth_px = " << s.width_px << "\nheight_px = " << s.height_px
      << "\nhorizontal_field_of_view_deg = 60\nrate_hz = " << s.rate_hz
      << "\nrange_km = " << s.range_km << "\n";
  out << "[screen]\nkind = " << quoted(s.screen) << "\ncard = " << quoted(s.card) << "\n";
  if (!s.wayland_display.empty()) {
    out << "window_system = \"wayland\"\nwayland_display = " << quoted(s.wayland_display) << "\n";
  }
  out << "[monitor]\non = " << (s.monitor_on ? "true" : "false") << "\ndeadline_ms = 10000\n";
  out << "[terrain]\nfolder = " << quoted(s.terrain) << "\ngeoid = " << quoted(s.geoid)
      << "\nhome_latitude_deg = " << home_latitude_deg
      << "\nhome_longitude_deg = " << home_longitude_deg << "\n";
  out << "[bus]\ninterfaces = " << quoted(s.buses)
      << "\nprotocol = \"canaerospace\"\nheading_reference = \"unknown\"\nnode_id = 12\n";
  out << "[timeouts]\nattitude_ms = " << s.attitude_ms << "\nheading_ms = " << s.attitude_ms
      << "\nheartbeat_input_ms = " << s.attitude_ms << "\nposition_ms = " << s.position_ms
      << "\nheight_ms = " << s.position_ms << "\npicture_ms = " << s.picture_ms << "\n";
  out << "[lines]\nheartbeat = " << quoted(s.heartbeat)
      << "\nsvs_valid = \"rig-valid\"\nsvs_fail = \"rig-fail\"\ndisplay_on = \"rig-on\"\n"
      << "declutter = \"rig-decl\"\nnight = \"rig-night\"\non_ground = \"rig-ground\"\n";
  out << "[report]\nstatus_file = " << quoted(s.status_file)
      << "\nstatus_interval_s = " << s.status_interval_s
      << "\nlast_frame_folder = " << quoted(s.last_frame_folder) << "\n"
      << s.more;
}

std::vector<std::string> Installation::player(const std::string& bus,
                                              const std::string& log) const {
  return {"canplayer", "-l", "i", "-I", file(log), bus + "=can0"};
}

void Installation::write_log(const std::string& name, const FrameEdit& edit) const {
  std::istringstream lines(flight_log(home_latitude_deg, usual_height_m, usual_roll_deg));
  std::ofstream out(file(name));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t mark = line.find('#', 1), start = line.rfind(' ') + 1;
    if (line.starts_with('#') || mark == std::string::npos) continue;
    std::string data = line.substr(mark + 1);
    if (edit(line.substr(start, mark - start), data)) {
      out << line.substr(0, mark + 1) << data << "\n";
    }
  }
}

void Installation::write_log(const std::string& name, double latitude_deg, double height_m,
                             double roll_deg) const {
  std::ofstream(file(name)) << flight_log(latitude_deg, height_m, roll_deg);
}

std::vector<std::string> Installation::program() const {
  return {DISPLAY_PROGRAM, file("rig.toml")};
}

nlohmann::json Installation::status() const {
  std::ifstream stream(file("status.json"));
  return nlohmann::json::parse(stream, nullptr, false);
}

}  // namespace ridgeline::rig
