// Logs of every protocol and format through the program; wrong bus options end with status 2.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/unit/bus/other_frames.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;
constexpr double latitude_deg = -45.5, longitude_deg = -72.5, height_m = 700.0;

std::string stamp(int step) {
  char text[32];
  std::snprintf(text, sizeof text, "(17000000%02d.%d00000) ", step / 10, step % 10);
  return text;
}

/// Two seconds of level flight at 10 Hz as ARINC 429 words: port 0 inertial, port 1 GNSS.
std::string words_log() {
  std::string text = "# ridgeline: RECORDED by a test\n";
  const auto lat = testing::position_words(0110, 0120, latitude_deg);
  const auto lon = testing::position_words(0111, 0121, longitude_deg);
  for (int step = 0; step <= 20; ++step) {
    const auto word = [&](int port, std::uint32_t bits) {
      char line[32];
      std::snprintf(line, sizeof line, "429.%d %08X\n", port, bits);
      text += stamp(step) + line;
    };
    for (const std::uint32_t bits : {lat.coarse, lon.coarse, lat.fine, lon.fine}) word(1, bits);
    word(1, testing::bnr20_word(0370, height_m / 0.3048, 131072.0));
    word(0, testing::bnr_word(0324, 2.0, 180.0));
    word(0, testing::bnr_word(0325, 0.0, 180.0));
    word(0, testing::bnr_word(0314, 90.0, 180.0));
  }
  return text;
}

/// The same flight as CAN-FIX frames; the heading is magnetic, 80 degrees.
std::string canfix_log() {
  std::string text;
  const auto line = [&](int step, const BusFrame& frame) {
    char part[16];
    std::snprintf(part, sizeof part, "can0 %03X#", frame.id);
    text += stamp(step) + part;
    for (int byte = 0; byte < frame.length; ++byte) {
      std::snprintf(part, sizeof part, "%02X", frame.data[byte]);
      text += part;
    }
    text += "\n";
  };
  const auto degrees = [](std::uint32_t id, double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return testing::canfix_frame(id,
                                 {bits & 0xff, bits >> 8 & 0xff, bits >> 16 & 0xff, bits >> 24});
  };
  for (int step = 0; step <= 20; ++step) {
    line(step, degrees(451, latitude_deg));
    line(step, degrees(452, longitude_deg));
    line(step, testing::canfix_steps(*canfix_row(1034), std::lround(height_m / 0.3048)));
    line(step, testing::canfix_steps(*canfix_row(384), 200));
    line(step, testing::canfix_steps(*canfix_row(385), 0));
    line(step, testing::canfix_steps(*canfix_row(389), 800));
  }
  return text;
}

/// The same flight in ASC: the candump log of the scene, rewritten.
std::string asc_log(const FlatScene& scene) {
  std::string text = "date Tue Nov 14 22:13:20.000 2023\nbase hex timestamps absolute\n";
  std::istringstream lines(text_of(scene.log()));
  for (std::string line; std::getline(lines, line);) {
    long long micros = 0;
    unsigned id = 0;
    char data[40] = {};
    if (std::sscanf(line.c_str(), "(17000000%lld", &micros) != 1) continue;
    const std::size_t hash = line.find('#');
    const double seconds = std::stod(line.substr(1)) - 1.7e9;
    if (std::sscanf(line.substr(hash - 3).c_str(), "%x#%39s", &id, data) != 2) continue;
    char head[64];
    std::snprintf(head, sizeof head, "%.6f 1 %X Rx d 8", seconds, id);
    text += head;
    for (std::size_t at = 0; data[at] != 0; at += 2)
      text += std::string(" ") + data[at] + data[at + 1];
    text += "\n";
  }
  return text;
}

Json report(const FlatScene& scene, const std::string& log, const std::vector<std::string>& more) {
  const std::string file = scene.file("report.json");
  std::vector<std::string> arguments = {"replay", log,       "--terrain", scene.tiles(), "--size",
                                        "64x48",  "--range", "6000",      "--rate",      "5",
                                        "--from", "1",       "--report",  file};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = ridgeline(arguments);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return Json::parse(text_of(file));
}

TEST(BusProtocol, arinc429_words_in_text_are_drawn) {
  const FlatScene scene;
  write_text(scene.file("words.log"), words_log());
  const Json json =
      report(scene, scene.file("words.log"),
             {"--bus-protocol", "arinc429", "--a429-port", "0=004", "--a429-port", "1=00B"});
  EXPECT_EQ(json["removed_frames"], 0) << json["reason_counts"];
  EXPECT_EQ(json["bus"]["ignored"], 0);
  EXPECT_EQ(json["bad_lines"], 0);
  // With the ports the other way round nothing of the position is known.
  const Json wrong = report(scene, scene.file("words.log"),
                            {"--bus-protocol", "arinc429", "--a429-port", "0=006"});
  EXPECT_EQ(wrong["removed_frames"], wrong["frame_count"]);
}

TEST(BusProtocol, canfix_frames_are_drawn_once_datum_and_variation_are_known) {
  const FlatScene scene;
  write_text(scene.file("canfix.log"), canfix_log());
  const auto flown = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options{"--bus-protocol", "canfix"};
    options.insert(options.end(), more.begin(), more.end());
    return report(scene, scene.file("canfix.log"), options);
  };
  const Json known = flown({"--canfix-height", "ellipsoidal", "--variation", "10"});
  EXPECT_EQ(known["removed_frames"], 0) << known["reason_counts"];
  const Json no_datum = flown({"--variation", "10"});
  EXPECT_EQ(no_datum["removed_frames"], no_datum["frame_count"]);
  EXPECT_TRUE(no_datum["reason_counts"].contains("height_missing"));
  const Json no_variation = flown({"--canfix-height", "ellipsoidal"});
  EXPECT_EQ(no_variation["removed_frames"], no_variation["frame_count"]);
  EXPECT_TRUE(no_variation["reason_counts"].contains("heading_reference_unknown"));
}

TEST(BusProtocol, a_log_in_another_format_gives_the_same_frames) {
  const FlatScene scene;
  write_text(scene.file("flight.asc"), asc_log(scene));
  const Json candump = report(scene, scene.log(), {});
  const Json asc = report(scene, scene.file("flight.asc"), {});
  EXPECT_EQ(asc["bad_lines"], 0);
  EXPECT_EQ(asc["bus"], candump["bus"]);
  EXPECT_EQ(asc["frame_count"], candump["frame_count"]);
  EXPECT_EQ(asc["removed_frames"], 0) << asc["reason_counts"];
}

TEST(BusProtocol, options_outside_their_domain_are_wrong_usage) {
  const FlatScene scene;
  const std::vector<std::vector<std::string>> wrong{
      {"--bus-protocol", "guess"},
      {"--bus-protocol", "arinc429"},
      {"--a429-port", "0=004"},
      {"--a429-port", "16=004", "--bus-protocol", "arinc429"},
      {"--a429-port", "x=004", "--bus-protocol", "arinc429"},
      {"--a429-port", "0=000", "--bus-protocol", "arinc429"},
      {"--a429-port", "0=1000", "--bus-protocol", "arinc429"},
      {"--a429-port", "0", "--bus-protocol", "arinc429"},
      {"--a429-port", "0=", "--bus-protocol", "arinc429"},
      {"--a429-port", "0=004", "--a429-port", "0=00B", "--bus-protocol", "arinc429"},
      {"--a429-fine", "maybe"},
      {"--canfix-height", "msl"},
      {"--channels", "0"},
      {"--channels", "70000"},
      {"--variation", "181"},
      {"--variation", "nan"}};
  for (const auto& options : wrong) {
    const Ended ended = ridgeline(scene.replay(options));
    EXPECT_EQ(ended.status, 2) << options[0] << ' ' << options[1] << ": " << ended.err;
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_TRUE(ended.says(options[0])) << ended.err;
  }
}

}  // namespace
}  // namespace ridgeline::test
