#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/synthetic/bus_log_writer.hpp"
#include "sim/synthetic/synthetic_terrain.hpp"
#include "tests/unit/synthetic/demo_fixture.hpp"

namespace ridgeline::test {
namespace {

/// One line of the log as this test reads it.
struct Frame {
  double time_s = 0;
  int id = 0;
  int node = 0;
  int type = 0;
  int service = 0;
  int code = 0;
  std::uint32_t data = 0;
};

/// Reads "(1700000000.000000) can0 137#0102002A40F00000"; false for any other form.
bool parse(const std::string& line, Frame& frame) {
  const std::string form = "(dddddddddd.dddddd) can0 hhh#hhhhhhhhhhhhhhhh";
  if (line.size() != form.size()) return false;
  for (std::size_t k = 0; k < form.size(); ++k) {
    const char c = line[k];
    const bool digit = c >= '0' && c <= '9';
    const bool hex = digit || (c >= 'A' && c <= 'F');
    if (k == 20 ? c != form[k] : form[k] == 'd' ? !digit : form[k] == 'h' ? !hex : c != form[k])
      return false;
  }
  const auto number = [&](std::size_t at, std::size_t count) {
    return static_cast<std::uint32_t>(std::stoul(line.substr(at, count), nullptr, 16));
  };
  frame.time_s = std::stod(line.substr(1, 17)) - 1.7e9;
  const std::size_t hash = line.find('#');
  frame.id = static_cast<int>(number(hash - 3, 3));
  frame.node = static_cast<int>(number(hash + 1, 2));
  frame.type = static_cast<int>(number(hash + 3, 2));
  frame.service = static_cast<int>(number(hash + 5, 2));
  frame.code = static_cast<int>(number(hash + 7, 2));
  frame.data = number(hash + 9, 8);
  return true;
}

std::vector<Frame> parsed(const std::string& text) {
  std::vector<Frame> frames;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind('#', 0) == 0) continue;
    Frame frame;
    EXPECT_TRUE(parse(line, frame)) << line;
    frames.push_back(frame);
  }
  return frames;
}

const std::vector<Frame>& demo_frames() {
  static const std::vector<Frame> frames = parsed(Demo::instance().log());
  return frames;
}

std::vector<Frame> with_id(int id) {
  std::vector<Frame> frames;
  for (const Frame& frame : demo_frames()) {
    if (frame.id == id) frames.push_back(frame);
  }
  return frames;
}

double longest_pause_s(const std::vector<Frame>& frames) {
  double longest_s = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    longest_s = std::max(longest_s, frames[k].time_s - frames[k - 1].time_s);
  }
  return longest_s;
}

TEST(DemoLog, comments_come_first_and_frames_in_order_of_time) {
  const std::string log = Demo::instance().log();
  EXPECT_EQ(log.front(), '#');
  EXPECT_EQ(log.back(), '\n');
  EXPECT_EQ(log.find("\n#", log.find("\n(")), std::string::npos);
  ASSERT_FALSE(demo_frames().empty());
  EXPECT_EQ(demo_frames().front().time_s, 0);
  for (std::size_t k = 1; k < demo_frames().size(); ++k) {
    ASSERT_GE(demo_frames()[k].time_s - demo_frames()[k - 1].time_s, 1.2e-4)
        << "a bus carries one frame at a time";
  }
}

TEST(DemoLog, every_frame_has_its_type_and_the_next_message_code) {
  const std::map<int, std::vector<int>> types = {
      {311, {2}},       {312, {2}},  {1133, {2}}, {314, {2}},  {1036, {30, 31}},
      {1037, {30, 31}}, {1038, {2}}, {1039, {2}}, {1040, {2}}, {1200, {15}}};
  std::map<int, int> seen;
  for (const Frame& frame : demo_frames()) {
    ASSERT_TRUE(types.contains(frame.id)) << frame.id;
    const int count = seen[frame.id]++;
    const std::vector<int>& expected = types.at(frame.id);
    ASSERT_EQ(frame.type, expected[static_cast<std::size_t>(count) % expected.size()]);
    ASSERT_EQ(frame.code, count % 256);
    ASSERT_EQ(frame.node, 1);
    ASSERT_EQ(frame.service, 0);
  }
  EXPECT_EQ(seen.size(), types.size());
}

TEST(DemoLog, rates_and_gaps_are_those_of_the_script) {
  constexpr int ticks = 90 * 80 + 1;
  for (const int id : {311, 312, 1133}) {
    EXPECT_EQ(with_id(id).size(), static_cast<std::size_t>(ticks - 80)) << id;
    EXPECT_NEAR(longest_pause_s(with_id(id)), 1.0125, 0.001) << id;
  }
  for (const int id : {1038, 1039, 1040}) {
    EXPECT_EQ(with_id(id).size(), 901U - 30) << id;
    EXPECT_NEAR(longest_pause_s(with_id(id)), 3.1, 0.001) << id;
  }
  EXPECT_EQ(with_id(1036).size(), 2 * (901U - 30));
  EXPECT_EQ(with_id(1200).size(), 91U);
  EXPECT_EQ(with_id(314).size(), 901U);
}

TEST(DemoLog, carries_the_flight) {
  const std::vector<sim::FlightSample> flight = sim::scripted_flight(sim::synthetic_height_m);
  const auto sample_at = [&](double time_s) {
    return flight[static_cast<std::size_t>(time_s * 80 + 1e-3)];
  };
  const auto real = [](const Frame& frame) {
    return static_cast<double>(std::bit_cast<float>(frame.data));
  };
  for (const Frame& frame : with_id(311))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).pitch_deg, 1e-5);
  for (const Frame& frame : with_id(312))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).roll_deg, 1e-5);
  for (const Frame& frame : with_id(1133))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).heading_deg, 1e-5);
  for (const Frame& frame : with_id(1038))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).height_m, 1e-4);
  for (const Frame& frame : with_id(1040))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).track_deg, 1e-5);
  for (const Frame& frame : with_id(314))
    ASSERT_NEAR(real(frame), sample_at(frame.time_s).climb_mps, 1e-5);
  for (const int id : {1036, 1037}) {
    const std::vector<Frame> halves = with_id(id);
    for (std::size_t k = 0; k + 1 < halves.size(); k += 2) {
      const auto bits = static_cast<std::uint64_t>(halves[k].data) << 32 | halves[k + 1].data;
      const sim::FlightSample sample = sample_at(halves[k].time_s);
      ASSERT_EQ(std::bit_cast<double>(bits),
                id == 1036 ? sample.latitude_deg : sample.longitude_deg);
    }
  }
}

TEST(DemoLog, tells_the_time_of_day) {
  const std::vector<Frame> times = with_id(1200);
  ASSERT_EQ(times.size(), 91U);
  EXPECT_EQ(times[0].data, 22U << 24 | 13U << 16 | 20U << 8);  // 1700000000 s is 22:13:20 UTC
  EXPECT_EQ(times[45].data, 22U << 24 | 14U << 16 | 5U << 8);
}

TEST(BusLog, encodes_the_worked_examples_of_the_frame_layout) {
  sim::FlightSample sample;
  sample.pitch_deg = 7.5;
  sample.roll_deg = -30;
  sample.longitude_deg = 7.985432;
  const std::string log = sim::bus_log({&sample, 1}, {});
  EXPECT_NE(log.find("(1700000000.000000) can0 137#0102000040F00000\n"), std::string::npos) << log;
  EXPECT_NE(log.find(" can0 138#01020000C1F00000\n"), std::string::npos);
  EXPECT_NE(log.find(" can0 40D#011E0000401FF115\n"), std::string::npos);
  EXPECT_NE(log.find(" can0 40D#011F00011611BA3D\n"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline::test
