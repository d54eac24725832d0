// VH-OWA: one input runs away, in range and smoothly. What is drawn must not move without a flag.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/log/canaerospace_writer.hpp"
#include "tests/cli/program.hpp"

namespace ridgeline::test {
namespace {

using Json = nlohmann::json;
using P = BusParameter;

constexpr double length_s = 14.0;
constexpr double fault_at_s = 4.0;
constexpr double true_height_m = 700.0;
constexpr double ground_m = 100.0;

/// What the bus says at a moment of a level flight; a fault changes it.
struct Said {
  double height_m = true_height_m;
  double climb_mps = 0.0;
  double pressure_m = true_height_m - 35.0;
  double radio_m = true_height_m - ground_m;
};
using Change = std::function<void(Said&, double since_s)>;

class LogText {
 public:
  explicit LogText(const Change& fault) {
    for (int tick = 0; tick < static_cast<int>(50.0 * length_s); ++tick) {
      const double t = tick * 0.02;
      Said said;
      if (t >= fault_at_s) fault(said, t - fault_at_s);
      add(P::roll, 0.01 * std::sin(7.0 * t), tick);
      add(P::pitch, 2.0 + 0.01 * std::sin(9.0 * t), tick);
      add(P::true_heading, 90.0 + 0.01 * std::sin(8.0 * t), tick);
      if (tick % 5 != 0) continue;
      place(P::gps_latitude, -45.5, tick);
      place(P::gps_longitude, -72.5 + 60.0 * t / (111'195.0 * std::cos(0.7941)), tick);
      add(P::gps_height, said.height_m, tick);
      add(P::gps_ground_speed, 60.0, tick);
      add(P::gps_true_track, 90.0, tick);
      add(P::altitude_rate, said.climb_mps, tick);
      add(P::standard_altitude, said.pressure_m, tick);
      add(P::radio_height, said.radio_m, tick);
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] static std::int64_t time_ns(int tick) {
    return 1'700'000'000'000'000'000 + tick * std::int64_t{20'000'000};
  }
  CanasHeader header(P parameter) { return {1, 0, codes_[static_cast<std::size_t>(parameter)]++}; }
  void add(P parameter, double value, int tick) {
    text_ += candump_text(float_frame(parameter, value, time_ns(tick), header(parameter)), "can0");
    text_ += '\n';
  }
  void place(P parameter, double angle_deg, int tick) {
    text_ += candump_text(position_frame(parameter, angle_deg, time_ns(tick), header(parameter)),
                          "can0");
    text_ += '\n';
  }

  std::string text_;
  std::array<std::uint8_t, bus_parameter_count> codes_{};
};

/// How a replay of a log with a fault went.
struct Flown {
  double largest_unflagged_m =
      0.0;                       ///< of the eye from where it truly is, in frames without a word
  double largest_drawn_m = 0.0;  ///< the same in every frame that shows terrain
  double flagged_after_s = -1.0;
  int removed = 0, frames = 0;
  std::set<std::string> words;
  Json report;
};

Flown flown(const FlatScene& scene, const Change& fault) {
  const std::string log = scene.file("faulty.log");
  const std::string dump = scene.file("dump");
  const std::string report = scene.file("report.json");
  write_text(log, LogText(fault).text());
  const Ended ended =
      ridgeline({"replay", log, "--terrain", scene.tiles(), "--size", "48x36", "--range", "6000",
                 "--rate", "10", "--dump", dump, "--report", report});
  EXPECT_EQ(ended.status, 0) << ended.err;
  Flown result;
  result.report = Json::parse(text_of(report));
  for (const Json& frame : result.report["frames"]) {
    const double t = frame["time_s"].get<double>() - 1'700'000'000.0;
    if (t < 0.5) continue;  // while the first values arrive
    ++result.frames;
    const bool flagged = !frame["reasons"].empty();
    for (const auto& word : frame["reasons"]) result.words.insert(word.get<std::string>());
    EXPECT_FALSE(flagged && t < fault_at_s) << frame["reasons"] << " at " << t;
    if (flagged && result.flagged_after_s < 0.0) result.flagged_after_s = t - fault_at_s;
    const bool removed = frame["mode"] == "removed";
    result.removed += removed ? 1 : 0;
    char name[32];
    std::snprintf(name, sizeof name, "/%06d.json", frame["index"].get<int>());
    const Json said = Json::parse(text_of(dump + name));
    const double off_m = std::abs(said["eye"]["height_m"].get<double>() - true_height_m);
    if (!flagged) result.largest_unflagged_m = std::max(result.largest_unflagged_m, off_m);
    if (!removed) result.largest_drawn_m = std::max(result.largest_drawn_m, off_m);
  }
  return result;
}

TEST(VhOwa, a_flight_without_a_fault_has_no_word) {
  const FlatScene scene;
  const Flown flight = flown(scene, [](Said&, double) {});
  EXPECT_TRUE(flight.words.empty()) << *flight.words.begin();
  EXPECT_LT(flight.largest_drawn_m, 0.01);
  for (const auto& [name, count] : flight.report["integrity"].items()) EXPECT_EQ(count, 0) << name;
}

TEST(VhOwa, a_radio_height_that_runs_to_zero_moves_nothing_and_is_told) {
  const FlatScene scene;
  const Flown flight = flown(scene, [](Said& said, double since_s) {
    said.radio_m = std::max(0.0, said.radio_m - 200.0 * since_s);
  });
  EXPECT_LT(flight.largest_drawn_m, 0.01) << "the ground stands where it is";
  EXPECT_EQ(flight.removed, 0);
  EXPECT_EQ(flight.words, std::set<std::string>{"radio_height_disagrees"});
  EXPECT_LE(flight.flagged_after_s, 3.2);
  EXPECT_EQ(flight.report["integrity"]["radio_height_disagreements"], 1);
}

TEST(VhOwa, a_height_that_runs_away_is_removed_before_the_ground_has_moved_far) {
  const FlatScene scene;
  const Flown flight =
      flown(scene, [](Said& said, double since_s) { said.height_m -= 15.0 * since_s; });
  EXPECT_EQ(flight.words.count("height_disagrees"), 1U);
  EXPECT_LE(flight.flagged_after_s, 3.0);
  EXPECT_LT(flight.largest_unflagged_m, 45.0);
  EXPECT_LT(flight.largest_drawn_m, 45.0);
  EXPECT_GT(flight.removed, 60) << "it stays away";
}

TEST(VhOwa, a_height_and_its_rate_that_run_away_together_are_caught_by_the_barometer) {
  const FlatScene scene;
  const Flown flight = flown(scene, [](Said& said, double since_s) {
    said.height_m -= 20.0 * since_s;
    said.climb_mps = -20.0;
  });
  EXPECT_EQ(flight.words.count("height_disagrees"), 1U);
  EXPECT_LT(flight.largest_unflagged_m, 90.0);
  EXPECT_LE(flight.flagged_after_s, 4.5);
}

TEST(VhOwa, an_altitude_rate_that_runs_away_carries_nothing_on) {
  const FlatScene scene;
  const Flown flight =
      flown(scene, [](Said& said, double since_s) { said.climb_mps = -4.0 * since_s; });
  EXPECT_EQ(flight.words, std::set<std::string>{"velocity_doubted"}) << "height is confirmed";
  EXPECT_LT(flight.largest_drawn_m, 3.0);
  EXPECT_EQ(flight.removed, 0);
}

TEST(VhOwa, a_barometer_that_runs_away_moves_nothing_and_is_told) {
  const FlatScene scene;
  const Flown flight =
      flown(scene, [](Said& said, double since_s) { said.pressure_m += 20.0 * since_s; });
  EXPECT_LT(flight.largest_drawn_m, 0.01);
  EXPECT_EQ(flight.words.count("height_disagrees"), 1U);
  EXPECT_LE(flight.flagged_after_s, 4.5);
}

TEST(VhOwa, a_height_that_jumps_is_told_at_once) {
  const FlatScene scene;
  const Flown flight = flown(scene, [](Said& said, double) { said.height_m -= 300.0; });
  EXPECT_EQ(flight.words.count("height_implausible"), 1U);
  EXPECT_LT(flight.largest_unflagged_m, 0.01);
  EXPECT_LE(flight.flagged_after_s, 0.11);
}

}  // namespace
}  // namespace ridgeline::test
