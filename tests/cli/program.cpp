#include "tests/cli/program.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/synthetic/bus_log_writer.hpp"
#include "tests/support/tile_writer.hpp"

namespace ridgeline::test {
namespace {

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

using Words = std::vector<std::string>;

/// Arguments, then the defaults that `more` does not name, then `more`.
Words joined(Words all, const std::vector<std::pair<std::string, std::string>>& defaults,
             const Words& more) {
  for (const auto& [option, value] : defaults) {
    if (std::find(more.begin(), more.end(), option) == more.end()) {
      all.insert(all.end(), {option, value});
    }
  }
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

int Ended::error_lines() const {
  return static_cast<int>(std::count(err.begin(), err.end(), '\n'));
}

Ended ridgeline(const std::vector<std::string>& arguments, const std::string& environment) {
  const TemporaryFolder folder;
  std::string command = environment + ' ' + quoted(RIDGELINE_PROGRAM);
  for (const std::string& argument : arguments) command += ' ' + quoted(argument);
  command += " >" + quoted(folder.file("out")) + " 2>" + quoted(folder.file("err")) + " </dev/null";
  const int result = std::system(command.c_str());  // NOLINT(cert-env33-c): a test's own command
  Ended ended;
  if (WIFEXITED(result)) ended.status = WEXITSTATUS(result);
  ended.out = text_of(folder.file("out"));
  ended.err = text_of(folder.file("err"));
  return ended;
}

void expect_one_line(const Ended& ended, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(ended.status, status) << ended.out << ended.err;
  EXPECT_EQ(ended.error_lines(), 1) << ended.err;
  for (const std::string& word : words) {
    EXPECT_TRUE(ended.says(word)) << "no \"" << word << "\" in: " << ended.err;
  }
}

void write_text(const std::string& path, const std::string& text) {
  write_bytes(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::string text_of(const std::string& path) {
  std::string text;
  for (const std::byte b : read_bytes(path)) text += static_cast<char>(b);
  return text;
}

std::string level_flight(double latitude_deg, double longitude_deg, double heading_deg) {
  constexpr double degree_rad = 3.14159265358979 / 180;
  constexpr double metres_a_degree = 111'300;
  const double north = std::cos(heading_deg * degree_rad);
  const double east = std::sin(heading_deg * degree_rad) / std::cos(latitude_deg * degree_rad);
  std::vector<sim::FlightSample> flight;
  for (int k = 0; k < 2 * sim::flight_ticks_per_second; ++k) {
    sim::FlightSample sample;
    sample.time_s = static_cast<double>(k) / sim::flight_ticks_per_second;
    sample.latitude_deg = latitude_deg + 60 * sample.time_s * north / metres_a_degree;
    sample.longitude_deg = longitude_deg + 60 * sample.time_s * east / metres_a_degree;
    sample.height_m = 700;
    sample.heading_deg = sample.track_deg = heading_deg;
    sample.ground_speed_mps = 60;
    flight.push_back(sample);
  }
  return sim::bus_log(flight, {});
}

FlatScene::FlatScene() {
  write_hgt(folder_.file("tiles/S46W073.hgt"), 1201, [](int, int) { return 100; });
  write_text(log(), level_flight(-45.5, -72.5, 90));
}

std::vector<std::string> FlatScene::pose(const std::vector<std::string>& more) const {
  return joined({"pose", "-45.5", "-72.5", "700", "-3", "-5", "-90", "--terrain", tiles()},
                {{"--size", "64x48"}, {"--range", "6000"}}, more);
}

std::vector<std::string> FlatScene::replay(const std::vector<std::string>& more) const {
  return joined({"replay", log(), "--terrain", tiles()},
                {{"--size", "64x48"}, {"--range", "6000"}, {"--rate", "5"}}, more);
}

}  // namespace ridgeline::test
