#include "sim/import_igc/import_igc.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/monitor/availability.hpp"
#include "core/state/ownship_update.hpp"
#include "sim/log/candump_reader.hpp"
#include "tests/unit/igc/igc_text.hpp"
#include "tests/unit/log/temporary_folder.hpp"

namespace ridgeline {
namespace {

using ::testing::Contains;
using testing::fix_text;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr double centre_lat_deg = 46.5;
constexpr double centre_lon_deg = 8.2;
constexpr double metres_per_deg = 111170.0;  // of latitude at 46.5 N
constexpr double speed_mps = 25.0;
constexpr double radius_m = 150.0;
constexpr double omega = speed_mps / radius_m;
constexpr double climb_mps = 2.0;

/// Right-hand circles, climbing, one fix a second; `keep` chooses the seconds that are recorded.
template <typename Keep, typename Extension>
std::string circling(int seconds, Keep keep, Extension extension, int start_s = 36000) {
  std::string text = "AXXX\r\nHFDTE010120\r\n";
  text += "I043636LAD3737LOD3841AOR4244AOP\r\n";
  for (int t = 0; t < seconds; ++t) {
    if (!keep(t)) continue;
    const double lat = centre_lat_deg + radius_m * std::cos(omega * t) / metres_per_deg;
    const double lon = centre_lon_deg + radius_m * std::sin(omega * t) /
                                            (metres_per_deg * std::cos(centre_lat_deg * 0.0174533));
    text += fix_text(start_s + t, lat, lon, 2000 + climb_mps * t, "00" + extension(t));
  }
  return text;
}

std::string no_angles(int) {
  return "       ";
}
bool always(int) {
  return true;
}

struct Imported {
  IgcImportReport report;
  CandumpLog log;
};

Imported imported(const TemporaryFolder& folder, const std::string& text,
                  const IgcImportOptions& options = {}) {
  const auto input = folder.file("track.igc", text);
  const auto output = folder.path() / "out.log";
  Result<IgcImportReport> report = import_igc(input, output, options);
  EXPECT_TRUE(report.ok()) << fault_text(report.fault());
  Result<CandumpLog> log = candump_log(output);
  EXPECT_TRUE(log.ok());
  EXPECT_EQ(log.value().notes.labels, report.value().labels);
  EXPECT_EQ(log.value().statistics.bad_lines, 0U);
  return {report.value(), log.value()};
}

OwnshipPose pose_at(const CandumpLog& log, double time_s, UpdateCounters* counters = nullptr) {
  const std::int64_t now_ns = log.frames.front().time_ns + std::llround(time_s * 1e9);
  OwnshipState state;
  for (const BusFrame& frame : log.frames) {
    if (frame.time_ns <= now_ns) state = update_ownship(state, {&frame, 1}, frame.time_ns, {});
  }
  if (counters != nullptr) *counters = state.counters;
  return ownship_pose(state, now_ns, {});
}

TEST(ImportIgc, circling_flight_has_the_roll_track_and_climb_it_was_made_with) {
  const TemporaryFolder folder;
  const Imported flight = imported(folder, circling(120, always, no_angles));
  UpdateCounters counters;
  const OwnshipPose pose = pose_at(flight.log, 60.0, &counters);
  const double track_deg = std::fmod(omega * 60.0 * 180.0 / std::numbers::pi + 90.0, 360.0);
  EXPECT_NEAR(pose.heading_deg.value, track_deg, 4.0);
  const double roll_deg = std::atan(speed_mps * omega / 9.80665) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(pose.roll_deg.value, roll_deg, 3.0);
  EXPECT_NEAR(pose.pitch_deg.value,
              std::atan(climb_mps / speed_mps) * 180.0 / std::numbers::pi + 2.0, 1.5);
  EXPECT_NEAR(pose.height_m.value, 2120.0, 1.5);
  const double lat = centre_lat_deg + radius_m * std::cos(omega * 60.0) / metres_per_deg;
  EXPECT_NEAR((pose.latitude_deg.value - lat) * metres_per_deg, 0.0, 3.0);
  EXPECT_EQ(counters.implausible, 0U);
  EXPECT_EQ(counters.decoded, counters.frames);
}

TEST(ImportIgc, everything_derived_is_labelled) {
  const TemporaryFolder folder;
  const Imported flight = imported(folder, circling(60, always, no_angles));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("DERIVED roll")));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("DERIVED pitch")));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("DERIVED heading")));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("DERIVED position")));
}

TEST(ImportIgc, rates_are_as_documented) {
  const TemporaryFolder folder;
  const Imported flight = imported(folder, circling(61, always, no_angles));
  std::array<int, bus_parameter_count> counts{};
  for (const BusFrame& frame : flight.log.frames) {
    ++counts[static_cast<std::size_t>(icd_row_of(frame)->parameter)];
  }
  const auto count = [&](BusParameter p) { return counts[static_cast<std::size_t>(p)]; };
  EXPECT_EQ(count(BusParameter::roll), 60 * 25 + 1);
  EXPECT_EQ(count(BusParameter::true_heading), 60 * 25 + 1);
  EXPECT_EQ(count(BusParameter::gps_latitude), 60 * 10 + 1);
  EXPECT_EQ(count(BusParameter::utc), 61);
  EXPECT_EQ(flight.report.frames_written, flight.log.frames.size());
}

TEST(ImportIgc, a_gap_of_the_track_is_a_gap_of_the_log_and_removes_the_picture) {
  const TemporaryFolder folder;
  const auto keep = [](int t) { return t < 40 || t >= 70; };
  const Imported flight = imported(folder, circling(120, keep, no_angles));
  EXPECT_EQ(flight.report.segments, 2U);
  EXPECT_NEAR(flight.report.gap_s, 31.0, 1e-6);
  const std::int64_t start_ns = flight.log.frames.front().time_ns;
  for (const BusFrame& frame : flight.log.frames) {
    const double time_s = static_cast<double>(frame.time_ns - start_ns) * 1e-9;
    ASSERT_TRUE(time_s < 39.01 || time_s >= 70.0) << time_s;
  }
  EXPECT_EQ(availability(pose_at(flight.log, 38.0)).mode, Mode::svs);
  EXPECT_EQ(availability(pose_at(flight.log, 55.0)).mode, Mode::removed);
  EXPECT_EQ(availability(pose_at(flight.log, 71.0)).mode, Mode::svs);
}

TEST(ImportIgc, recorded_angles_are_used_with_the_sign_they_prove) {
  const TemporaryFolder folder;
  // Roll left positive and alternating, pitch unrelated to the flight path.
  const auto angles = [](int t) {
    char text[16];
    std::snprintf(text, sizeof text, "%+04d%03d", -23 - (t % 3), t % 2);
    return std::string(text);
  };
  const auto s_turns = [](int seconds, auto extension) {
    std::string text = "HFDTE010120\r\nI023639AOR4042AOP\r\n";
    for (int t = 0; t < seconds; ++t) {
      const double north_m = 20.0 * t;
      const double east_m = 100.0 * std::sin(0.25 * t);
      text += fix_text(36000 + t, 46.5 + north_m / 111170.0, 8.2 + east_m / 76600.0, 2000,
                       extension(t));
    }
    return text;
  };
  const auto left_positive = [](int t) {
    char text[16];
    const double across = -100.0 * 0.0625 * std::sin(0.25 * t);
    const int roll = static_cast<int>(std::lround(-std::atan(across / 9.8) * 57.3));
    std::snprintf(text, sizeof text, "%+04d%03d", roll, t % 2);
    return std::string(text);
  };
  const Imported flight = imported(folder, s_turns(200, left_positive));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("RECORDED roll from AOR")));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("sign -1")));
  EXPECT_THAT(flight.report.labels, Contains(HasSubstr("DERIVED pitch")));
  // At the crest of the turn, sin = 1: the path bends to the left, so the roll must be negative.
  EXPECT_LT(pose_at(flight.log, 6.2832).roll_deg.value, -20.0);
  // Angles that follow nothing are not used at all.
  const Imported noise = imported(folder, s_turns(200, angles));
  EXPECT_THAT(noise.report.labels, Contains(HasSubstr("DERIVED roll")));
}

TEST(ImportIgc, altitude_datum_is_an_option_and_is_said) {
  const TemporaryFolder folder;
  const std::string text = circling(60, always, no_angles);
  const double as_recorded = pose_at(imported(folder, text).log, 20.0).height_m.value;
  IgcImportOptions options;
  options.geoid = [](double, double) { return std::optional<double>(51.0); };
  EXPECT_NEAR(pose_at(imported(folder, text, options).log, 20.0).height_m.value, as_recorded, 1e-3);
  options.altitude = IgcAltitude::msl;
  const Imported msl = imported(folder, text, options);
  EXPECT_NEAR(pose_at(msl.log, 20.0).height_m.value, as_recorded + 51.0, 1e-2);
  EXPECT_THAT(msl.report.labels, Contains(HasSubstr("geoid undulation added")));
  options.geoid = nullptr;
  EXPECT_THAT(imported(folder, text, options).report.labels, Contains(HasSubstr("NOT CONVERTED")));
  options.altitude = IgcAltitude::header;
  const Imported geo = imported(folder, "HFALG:GEO\r\n" + text, options);
  EXPECT_THAT(geo.report.labels, Contains(HasSubstr("above mean sea level by the file's header")));
}

TEST(ImportIgc, midnight_is_crossed_without_a_break) {
  const TemporaryFolder folder;
  const Imported flight = imported(folder, circling(60, always, no_angles, 86370));
  EXPECT_EQ(flight.report.segments, 1U);
  const auto& frames = flight.log.frames;
  EXPECT_NEAR(static_cast<double>(frames.back().time_ns - frames.front().time_ns) * 1e-9, 59.0,
              0.01);
}

TEST(ImportIgc, a_standing_start_has_the_heading_of_the_first_move) {
  const TemporaryFolder folder;
  std::string text = "HFDTE010120\r\n";
  for (int t = 0; t < 60; ++t) {
    const double east_m = t < 20 ? 0.0 : 15.0 * (t - 20);
    text += fix_text(36000 + t, 46.5, 8.2 + east_m / 76600.0, 500);
  }
  const Imported flight = imported(folder, text);
  EXPECT_NEAR(pose_at(flight.log, 5.0).heading_deg.value, 90.0, 3.0);
  EXPECT_NEAR(pose_at(flight.log, 5.0).roll_deg.value, 0.0, 0.5);
}

TEST(ImportIgc, a_part_of_the_track_can_be_chosen) {
  const TemporaryFolder folder;
  IgcImportOptions options;
  options.from_s = 10.0;
  options.to_s = 20.0;
  const Imported flight = imported(folder, circling(60, always, no_angles), options);
  EXPECT_NEAR(flight.report.duration_s, 10.0, 1e-9);
  EXPECT_EQ(flight.log.frames.front().time_ns % 86'400'000'000'000, 36010'000'000'000);
}

TEST(ImportIgc, faults_leave_nothing_behind) {
  const TemporaryFolder folder;
  const auto output = folder.path() / "out.log";
  EXPECT_EQ(import_igc(folder.path() / "none.igc", output).fault(), Fault::file_unreadable);
  const auto three = folder.file("three.igc", circling(3, always, no_angles));
  EXPECT_EQ(import_igc(three, output).fault(), Fault::track_without_fixes);
  const auto good = folder.file("good.igc", circling(30, always, no_angles));
  EXPECT_EQ(import_igc(good, folder.path() / "no" / "such.log").fault(), Fault::file_unwritable);
  EXPECT_EQ(import_igc(good, good).fault(), Fault::file_unwritable);
  EXPECT_EQ(testing::text_of(good), circling(30, always, no_angles));
  IgcImportOptions outside;
  outside.from_s = 1000.0;
  EXPECT_EQ(import_igc(good, output, outside).fault(), Fault::track_without_fixes);
  EXPECT_FALSE(std::filesystem::exists(output));
  EXPECT_FALSE(std::filesystem::exists(output.string() + ".partial"));
}

}  // namespace
}  // namespace ridgeline
