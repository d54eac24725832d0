// Random flights with one fault each: flagged by its own word within its own time, and never
// before.
#include <gtest/gtest.h>

#include "tests/unit/state/simulated_flight.hpp"

namespace ridgeline {
namespace {

using testing::Equipment;
using testing::Falsifier;
using testing::Ownship;
using testing::SimulatedFlight;
using testing::Truth;

constexpr int seeds = 20;

struct FaultCase {
  const char* name;
  const char* word;
  double within_s;  ///< as docs/icd.md, section 10, says
  Equipment equipment;
  int node;
  Falsifier (*at)(const Truth& start);
};

void PrintTo(const FaultCase& fault, std::ostream* out) {
  *out << fault.name;
}

double since(const Truth& now, const Truth& start) {
  return now.time_s - start.time_s;
}

constexpr Equipment sole{};
constexpr Equipment two_attitudes{.attitude_nodes = 2};
constexpr Equipment two_receivers{.gps_nodes = 2};
constexpr Equipment with_ins{.ins = true, .barometer = true};
constexpr Equipment with_barometer{.barometer = true};
constexpr Equipment with_magnetic{.magnetic = true};

const FaultCase cases[] = {
    {"roll_of_one_of_two_runs_away", "attitude_disagrees", 2.0, two_attitudes, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.roll_deg += 5.0 * since(t, s); };
     }},
    {"pitch_of_the_second_runs_away", "attitude_disagrees", 2.0, two_attitudes, 2,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.pitch_deg -= 5.0 * since(t, s); };
     }},
    {"heading_of_one_of_two_runs_away", "heading_disagrees", 3.0, two_attitudes, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.heading_deg += 5.0 * since(t, s); };
     }},
    {"true_heading_leaves_the_magnetic_one", "heading_disagrees", 6.0, with_magnetic, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.heading_deg += 5.0 * since(t, s); };
     }},
    {"roll_stands_still", "attitude_frozen", 20.0, sole, 1,
     [](const Truth& s) -> Falsifier { return [s](Truth& t) { t.roll_deg = s.roll_deg; }; }},
    {"pitch_stands_still", "attitude_frozen", 20.0, sole, 1,
     [](const Truth& s) -> Falsifier { return [s](Truth& t) { t.pitch_deg = s.pitch_deg; }; }},
    {"heading_stands_still", "heading_frozen", 20.0, sole, 1,
     [](const Truth& s) -> Falsifier { return [s](Truth& t) { t.heading_deg = s.heading_deg; }; }},
    {"fix_stands_still", "position_frozen", 2.5, sole, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) {
         t.latitude_deg = s.latitude_deg;
         t.longitude_deg = s.longitude_deg;
       };
     }},
    {"fix_leaves_its_own_speed", "position_disagrees", 6.0, sole, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.latitude_deg += 20.0 * since(t, s) / 111195.0; };
     }},
    {"speed_leaves_the_fixes", "position_disagrees", 6.0, sole, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.speed_mps += std::min(10.0 * since(t, s), 60.0); };
     }},
    {"receiver_is_led_astray_with_its_speed", "position_disagrees", 24.0, with_ins, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) {
         t.latitude_deg += 10.0 * since(t, s) / 111195.0;
         const double rad = std::numbers::pi / 180.0;
         const double north = t.speed_mps * std::cos(t.track_deg * rad) + 10.0;
         const double east = t.speed_mps * std::sin(t.track_deg * rad);
         t.speed_mps = std::hypot(north, east);
         t.track_deg = std::atan2(east, north) / rad;
       };
     }},
    {"one_of_two_receivers_is_led_astray", "position_disagrees", 8.0, two_receivers, 2,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.longitude_deg += 15.0 * since(t, s) / 76500.0; };
     }},
    {"height_leaves_the_altitude_rate", "height_disagrees", 4.0, sole, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.height_m -= 15.0 * since(t, s); };
     }},
    {"height_and_rate_leave_the_barometer", "height_disagrees", 10.0, with_barometer, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) {
         t.height_m -= 10.0 * since(t, s);
         t.climb_mps -= 10.0;
       };
     }},
    {"barometer_runs_away", "height_disagrees", 10.0, with_barometer, 8,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.height_m += 10.0 * since(t, s); };
     }},
    {"altitude_rate_runs_away", "height_disagrees", 9.0, sole, 1,
     [](const Truth& s) -> Falsifier {
       return [s](Truth& t) { t.climb_mps += 3.0 * since(t, s); };
     }},
    {"height_jumps", "height_implausible", 0.12, sole, 1,
     [](const Truth&) -> Falsifier { return [](Truth& t) { t.height_m += 300.0; }; }},
    {"roll_jumps", "attitude_implausible", 0.02, sole, 1,
     [](const Truth&) -> Falsifier { return [](Truth& t) { t.roll_deg -= 80.0; }; }},
    {"fix_jumps", "position_implausible", 0.12, sole, 1,
     [](const Truth&) -> Falsifier { return [](Truth& t) { t.latitude_deg += 0.01; }; }},
};

class Injected : public ::testing::TestWithParam<FaultCase> {};

TEST_P(Injected, fault_is_flagged_in_its_time_and_nothing_before) {
  const FaultCase& fault = GetParam();
  double slowest_s = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SimulatedFlight flight(seed, fault.equipment);
    const double fault_at_s = flight.uniform(20.0, 40.0);
    while (flight.truth().time_s < fault_at_s) {
      flight.step();
      if (flight.truth().time_s < 1.0) continue;
      ASSERT_TRUE(flight.words().empty())
          << flight.words()[0] << " at " << flight.truth().time_s << " s, seed " << seed;
    }
    const Truth start = flight.truth();
    flight.falsify(fault.node, fault.at(start));
    while (!flight.says(fault.word)) {
      flight.step();
      ASSERT_LE(since(flight.truth(), start), fault.within_s + 0.001) << "seed " << seed;
    }
    slowest_s = std::max(slowest_s, since(flight.truth(), start));
  }
  RecordProperty("slowest_s", std::to_string(slowest_s));
  std::printf("  %-40s %-22s slowest %.2f s of %.2f s\n", fault.name, fault.word, slowest_s,
              fault.within_s);
}

TEST(Integrity, flights_without_a_fault_are_never_flagged) {
  constexpr Equipment everything{
      .attitude_nodes = 3, .gps_nodes = 3, .ins = true, .barometer = true, .magnetic = true};
  for (const Equipment& equipment :
       {sole, two_attitudes, two_receivers, with_ins, with_barometer, everything}) {
    for (unsigned seed = 100; seed < 106; ++seed) {
      SimulatedFlight flight(seed, equipment);
      while (flight.truth().time_s < 120.0) {
        flight.step();
        if (flight.truth().time_s < 1.0) continue;
        ASSERT_TRUE(flight.words().empty())
            << flight.words()[0] << " at " << flight.truth().time_s << " s, seed " << seed;
      }
      const UpdateCounters& c = flight.own().state.counters;
      EXPECT_EQ(c.disagreements + c.freezes + c.outvoted + c.clock_steps + c.replay_bursts, 0U);
      EXPECT_EQ(c.implausible + c.duplicated + c.replayed + c.lost_in_sequence, 0U);
    }
  }
}

TEST(Integrity, the_same_frames_give_the_same_doubts_however_they_are_handed_in) {
  SimulatedFlight flight(7, with_ins);
  Ownship one_by_one, all_at_once;
  one_by_one.profile = all_at_once.profile = flight.own().profile;
  std::vector<BusFrame> waiting;
  for (int tick = 0; tick < 3000; ++tick) {
    if (tick == 1000) flight.falsify(1, [](Truth& t) { t.height_m += t.time_s * 10.0 - 200.0; });
    for (const BusFrame& frame : flight.make_frames()) {
      one_by_one.feed(frame);
      waiting.push_back(frame);
    }
    if (tick % 50 != 49) continue;
    all_at_once.feed(waiting, flight.now_ms() + 19.0);
    one_by_one.feed({}, flight.now_ms() + 19.0);
    waiting.clear();
    for (const BusIcdRow& row : bus_icd) {
      ASSERT_EQ(one_by_one.validity(row.parameter, flight.now_ms() + 19.0),
                all_at_once.validity(row.parameter, flight.now_ms() + 19.0))
          << row.name << " at tick " << tick;
    }
  }
  EXPECT_EQ(one_by_one.state.counters.disagreements, all_at_once.state.counters.disagreements);
  EXPECT_GT(all_at_once.state.counters.disagreements, 0U);
}

INSTANTIATE_TEST_SUITE_P(Faults, Injected, ::testing::ValuesIn(cases),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace ridgeline
