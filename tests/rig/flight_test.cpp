#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "config/limits_bus.hpp"
#include "core/bus/can_filters.hpp"
#include "core/state/ownship_update.hpp"
#include "platform/can_socket.hpp"
#include "sim/log/candump_reader.hpp"
#include "sim/synthetic/bus_log_writer.hpp"
#include "tests/rig/link.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

constexpr int flight_samples = 8 * sim::flight_ticks_per_second;
constexpr std::int64_t most_delay_ns = limits::double_pair_limit_ns - 2 * limits::ms_ns;

std::string write_log(const test::ScratchFolder& folder) {
  std::vector<sim::FlightSample> flight =
      sim::scripted_flight([](double, double) { return 500.0; });
  flight.resize(flight_samples);
  sim::BusGaps gaps{};
  gaps.attitude_from_s = 4.0;  // longer than an attitude may age
  gaps.attitude_to_s = 5.0;
  std::ofstream(folder.file("flight.log")) << sim::bus_log(flight, gaps);
  return folder.file("flight.log");
}

/// How much later a frame came after the one before it than the log says; the worst of all.
std::int64_t worst_delay_ns(const std::vector<BusFrame>& logged,
                            const std::vector<ReceivedFrame>& live) {
  std::int64_t worst_ns = 0;
  for (std::size_t i = 1; i < live.size() && i < logged.size(); ++i) {
    const std::int64_t said_ns = logged[i].time_ns - logged[i - 1].time_ns;
    worst_ns = std::max(worst_ns, live[i].monotonic_ns - live[i - 1].monotonic_ns - said_ns);
  }
  return worst_ns;
}

/// Everything that is received while canplayer plays a log in its own time.
std::vector<ReceivedFrame> flown(CanSocket& can, const std::string& log, std::size_t count) {
  bool played = false;
  std::thread player([&] { played = rig::shell("canplayer -I " + log); });
  std::vector<ReceivedFrame> frames;
  const std::int64_t end_ns = monotonic_now_ns() + 60 * limits::second_ns;
  while (frames.size() < count && monotonic_now_ns() < end_ns) {
    pollfd waiting = {can.descriptor(), POLLIN, 0};
    ::poll(&waiting, 1, 20);
    EXPECT_TRUE(can.receive().ok());
    frames.insert(frames.end(), can.frames().begin(), can.frames().end());
  }
  player.join();
  EXPECT_TRUE(played);
  return frames;
}

void expect_same_state(const OwnshipState& log, const OwnshipState& live, std::size_t frame) {
  for (std::size_t i = 0; i < bus_parameter_count; ++i) {
    const Sample &a = log.samples[i], &b = live.samples[i];
    ASSERT_EQ(a.value, b.value) << "parameter " << i << " after frame " << frame;
    ASSERT_EQ(a.validity, b.validity) << "parameter " << i << " after frame " << frame;
    ASSERT_TRUE(a.source == b.source) << "parameter " << i << " after frame " << frame;
  }
}

// The log's own times and the times of reception differ by an offset and by jitter; what the states
// hold must not.
TEST(RigFlight, a_log_played_onto_the_bus_gives_the_states_of_its_replay) {
  const test::ScratchFolder folder("rig_flight");
  const std::string log = write_log(folder);
  const Result<CandumpLog> replayed = candump_log(log);
  ASSERT_TRUE(replayed.ok());
  ASSERT_EQ(replayed.value().notes.interfaces.size(), 1u);
  const rig::VirtualCan bus(replayed.value().notes.interfaces[0]);
  const BusProfile profile;
  CanSettings settings;
  settings.interface = bus.name();
  settings.filters = can_filters(profile).value();
  Result<CanSocket> can = CanSocket::open(settings);
  ASSERT_TRUE(can.ok()) << fault_text(can.fault());

  const std::vector<BusFrame>& logged = replayed.value().frames;
  // Halves of a value that a busy machine played further apart than they may be are none, live.
  std::vector<ReceivedFrame> live = flown(can.value(), log, logged.size());
  for (int again = 0; again < 4 && worst_delay_ns(logged, live) > most_delay_ns; ++again) {
    live = flown(can.value(), log, logged.size());
  }
  ASSERT_LE(worst_delay_ns(logged, live), most_delay_ns) << "this machine plays no log in its time";
  ASSERT_EQ(live.size(), logged.size());
  ASSERT_EQ(can.value().received().dropped, 0u);
  OwnshipState from_log, from_bus;
  for (std::size_t i = 0; i < logged.size(); ++i) {
    BusFrame frame = live[i].frame;
    frame.time_ns = live[i].monotonic_ns;
    from_log = update_ownship(from_log, {&logged[i], 1}, logged[i].time_ns, profile);
    from_bus = update_ownship(from_bus, {&frame, 1}, frame.time_ns, profile);
    expect_same_state(from_log, from_bus, i);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(from_log.counters.decoded, from_bus.counters.decoded);
  EXPECT_EQ(from_log[BusParameter::gps_latitude].validity, Validity::valid);
  EXPECT_GT(from_log.counters.decoded, 1000u);
}

}  // namespace
}  // namespace ridgeline
