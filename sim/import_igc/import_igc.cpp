#include "sim/import_igc/import_igc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "sim/log/canaerospace_writer.hpp"

namespace ridgeline {
namespace {

constexpr std::size_t fewest_fixes = 4;
constexpr double least_gap_limit_s = 5.0;
constexpr double median_intervals_per_gap = 3.0;
constexpr std::int64_t second_ns = 1'000'000'000;
/// Frames of one instant follow each other as on a bus of 1 Mbit/s that has other things to do.
constexpr std::int64_t frame_spacing_ns = 200'000;
constexpr std::uint8_t attitude_node = 1;
constexpr std::uint8_t position_node = 2;
constexpr std::string_view interface_name = "can0";

/// An unbroken piece of the track: fixes first..last-1.
struct Piece {
  std::size_t first = 0;
  std::size_t last = 0;
};

double median_interval_s(const IgcTrack& track) {
  std::vector<double> intervals_s;
  for (std::size_t index = 1; index < track.fixes.size(); ++index) {
    intervals_s.push_back(track.fixes[index].time_s - track.fixes[index - 1].time_s);
  }
  if (intervals_s.empty()) return 0.0;
  const auto middle = intervals_s.begin() + static_cast<std::ptrdiff_t>(intervals_s.size() / 2);
  std::nth_element(intervals_s.begin(), middle, intervals_s.end());
  return *middle;
}

std::vector<Piece> pieces_of(const IgcTrack& track, double gap_limit_s) {
  std::vector<Piece> pieces;
  for (std::size_t index = 0; index < track.fixes.size(); ++index) {
    const bool broken = index == 0 || track.fixes[index].starts_segment ||
                        track.fixes[index].time_s - track.fixes[index - 1].time_s > gap_limit_s;
    if (broken) pieces.push_back({index, index});
    pieces.back().last = index + 1;
  }
  return pieces;
}

/// Height above the ellipsoid of every fix, and what to say about it.
struct Heights {
  std::vector<double> heights_m;
  std::string label;
};

Heights heights_of(const IgcTrack& track, const IgcImportOptions& options) {
  const bool by_header = options.altitude == IgcAltitude::header;
  const bool is_msl =
      by_header ? track.altitude_is_msl.value_or(false) : options.altitude == IgcAltitude::msl;
  Heights heights;
  std::size_t unknown = 0;
  for (const IgcFix& fix : track.fixes) {
    double height_m = fix.altitude_m;
    if (is_msl && options.geoid) {
      const std::optional<double> n_m = options.geoid(fix.latitude_deg, fix.longitude_deg);
      if (n_m) height_m += *n_m;
      if (!n_m) ++unknown;
    }
    heights.heights_m.push_back(height_m);
  }
  const bool told = by_header && track.altitude_is_msl.has_value();
  heights.label = std::string("HEIGHT GNSS altitude ") +
                  (is_msl ? "above mean sea level" : "above the ellipsoid") +
                  (told        ? " by the file's header"
                   : by_header ? " by the FAI rule"
                               : " as told");
  if (is_msl && !options.geoid) heights.label += ", NOT CONVERTED: off by the geoid undulation";
  if (is_msl && options.geoid) heights.label += ", geoid undulation added";
  if (unknown > 0) heights.label += ", except at " + std::to_string(unknown) + " fixes";
  return heights;
}

class LogWriter {
 public:
  explicit LogWriter(std::ostream& out) : out_(out) {}
  void label(const std::string& text) { out_ << "# ridgeline: " << text << '\n'; }
  void write(const BusFrame& frame) {
    out_ << candump_text(frame, interface_name) << '\n';
    ++frame_count_;
  }
  /// Header of the next frame of a parameter: message codes count up per identifier.
  [[nodiscard]] CanasHeader header(BusParameter parameter, std::uint8_t node) {
    return {node, 0, codes_[static_cast<std::size_t>(parameter)]++};
  }
  [[nodiscard]] std::uint64_t frame_count() const { return frame_count_; }

 private:
  std::ostream& out_;
  std::uint64_t frame_count_ = 0;
  std::array<std::uint8_t, bus_parameter_count> codes_{};
};

/// Writes one piece; its times are those of the fixes, `day_ns` makes them Unix times.
class PieceWriter {
 public:
  PieceWriter(LogWriter& log, const DerivedFlight& flight, std::span<const IgcFix> fixes,
              const RecordedSigns& signs, const HeadingFollower& follower)
      : log_(log), flight_(flight), fixes_(fixes), signs_(signs), follower_(follower) {}

  void write(std::int64_t day_ns, double from_s, double to_s, const IgcImportOptions& options) {
    const auto step_ns = [](double hz) { return std::llround(1e9 / hz); };
    const std::int64_t attitude_step_ns = step_ns(options.attitude_hz);
    const std::int64_t position_step_ns = step_ns(options.position_hz);
    const std::int64_t end_ns = std::llround(to_s * 1e9);
    std::int64_t attitude_ns = std::llround(from_s * 1e9);
    std::int64_t position_ns = attitude_ns;
    std::int64_t clock_ns = (attitude_ns + second_ns - 1) / second_ns * second_ns;
    while (true) {
      const std::int64_t time_ns = std::min({attitude_ns, position_ns, clock_ns});
      if (time_ns > end_ns) return;
      stamp_ns_ = day_ns + time_ns;
      const FlightPoint point = flight_.at(static_cast<double>(time_ns) * 1e-9);
      if (time_ns == position_ns) {
        write_position(point);
        position_ns += position_step_ns;
      }
      if (time_ns == attitude_ns) {
        write_attitude(point, static_cast<double>(time_ns) * 1e-9, 1.0 / options.attitude_hz);
        attitude_ns += attitude_step_ns;
      }
      if (time_ns == clock_ns) {
        write_clock(day_ns + time_ns);
        clock_ns += second_ns;
      }
    }
  }

 private:
  void put(BusParameter parameter, double value, std::uint8_t node) {
    log_.write(float_frame(parameter, value, next_stamp(), log_.header(parameter, node)));
  }

  std::int64_t next_stamp() {
    const std::int64_t stamp_ns = stamp_ns_;
    stamp_ns_ += frame_spacing_ns;
    return stamp_ns;
  }

  void write_position(const FlightPoint& point) {
    const auto put_angle = [&](BusParameter parameter, double angle_deg) {
      log_.write(position_frame(parameter, angle_deg, next_stamp(),
                                log_.header(parameter, position_node)));
    };
    put_angle(BusParameter::gps_latitude, point.latitude_deg);
    put_angle(BusParameter::gps_longitude, point.longitude_deg);
    put(BusParameter::gps_height, point.height_m, position_node);
    put(BusParameter::gps_ground_speed, point.ground_speed_mps, position_node);
    put(BusParameter::gps_true_track, point.track_deg, position_node);
    put(BusParameter::altitude_rate, point.climb_mps, position_node);
  }

  void write_attitude(const FlightPoint& point, double time_s, double step_s) {
    double roll_deg = point.roll_deg;
    double pitch_deg = point.pitch_deg;
    double heading_deg = follower_.next(point, step_s);
    if (signs_.roll != 0) {
      roll_deg =
          recorded_angle(fixes_, &IgcFix::roll_deg, time_s).value_or(roll_deg * signs_.roll) *
          signs_.roll;
    }
    if (signs_.pitch != 0) {
      pitch_deg =
          recorded_angle(fixes_, &IgcFix::pitch_deg, time_s).value_or(pitch_deg * signs_.pitch) *
          signs_.pitch;
    }
    if (signs_.heading) {
      heading_deg = recorded_angle(fixes_, &IgcFix::heading_deg, time_s).value_or(heading_deg);
    }
    put(BusParameter::pitch, pitch_deg, attitude_node);
    put(BusParameter::roll, roll_deg, attitude_node);
    put(BusParameter::true_heading, heading_deg, attitude_node);
  }

  void write_clock(std::int64_t time_ns) {
    BusFrame utc = utc_frame(time_ns, log_.header(BusParameter::utc, position_node));
    BusFrame date = date_frame(time_ns, log_.header(BusParameter::date, position_node));
    utc.time_ns = next_stamp();
    date.time_ns = next_stamp();
    log_.write(utc);
    log_.write(date);
  }

  LogWriter& log_;
  const DerivedFlight& flight_;
  std::span<const IgcFix> fixes_;
  RecordedSigns signs_;
  HeadingFollower follower_;
  std::int64_t stamp_ns_ = 0;
};

std::string formatted(const char* format, double a, double b) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, a, b);
  return text.data();
}

std::vector<std::string> labels_of(const std::string& name, const IgcTrack& track,
                                   const RecordedSigns& signs, const std::string& height_label,
                                   const IgcImportOptions& options) {
  const DerivationRules& rules = options.rules;
  std::vector<std::string> labels;
  labels.push_back("SOURCE IGC track " + name + ", " + std::to_string(track.fixes.size()) +
                   " fixes");
  if (!track.has_date) labels.emplace_back("SOURCE has no date: times are seconds of the day");
  labels.push_back(
      formatted("DERIVED position height ground_speed track altitude_rate from GNSS "
                "fixes every %.3g s, smoothing spline of %.3g s^3",
                median_interval_s(track), rules.smoothing_s3));
  labels.push_back(height_label);
  const auto recorded = [&](const char* what, int sign, double correlation) {
    labels.push_back(std::string("RECORDED ") + what +
                     formatted(", linear between fixes, sign %+.0f by correlation %.2f with the "
                               "derived one",
                               sign, correlation));
  };
  if (signs.roll != 0) recorded("roll from AOR", signs.roll, signs.roll_correlation);
  if (signs.roll == 0) {
    labels.push_back(formatted("DERIVED roll from speed and track rate, at most %.0f deg",
                               rules.roll_limit_deg, 0.0));
  }
  if (signs.pitch != 0) recorded("pitch from AOP", signs.pitch, signs.pitch_correlation);
  if (signs.pitch == 0) {
    labels.push_back(
        formatted("DERIVED pitch from flight path angle plus %.1f deg, at most %.0f "
                  "deg",
                  rules.angle_of_attack_deg, rules.pitch_limit_deg));
  }
  if (signs.heading) labels.emplace_back("RECORDED heading from HDT, linear between fixes");
  if (!signs.heading) labels.emplace_back("DERIVED heading from track, without wind");
  return labels;
}

/// All that is written: the flights of the pieces that are long enough.
struct Plan {
  std::vector<Piece> pieces;
  std::vector<DerivedFlight> flights;
  std::uint64_t short_segments = 0;
};

Plan plan_of(const IgcTrack& track, const Heights& heights, const IgcImportOptions& options) {
  const double chosen_limit_s =
      std::max(least_gap_limit_s, median_intervals_per_gap * median_interval_s(track));
  Plan plan;
  for (const Piece& piece :
       pieces_of(track, options.gap_limit_s > 0.0 ? options.gap_limit_s : chosen_limit_s)) {
    const std::size_t count = piece.last - piece.first;
    if (count < fewest_fixes) {
      ++plan.short_segments;
      continue;
    }
    plan.pieces.push_back(piece);
    plan.flights.emplace_back(std::span(track.fixes).subspan(piece.first, count),
                              std::span(heights.heights_m).subspan(piece.first, count),
                              options.rules);
  }
  return plan;
}

void write_pieces(LogWriter& log, const IgcTrack& track, const Plan& plan,
                  const RecordedSigns& signs, const IgcImportOptions& options,
                  IgcImportReport& report) {
  const double start_s = track.fixes.front().time_s;
  double written_to_s = start_s + options.from_s;
  for (std::size_t index = 0; index < plan.pieces.size(); ++index) {
    const DerivedFlight& flight = plan.flights[index];
    const double from_s = std::max(flight.first_time_s(), start_s + options.from_s);
    const double to_s = std::min(flight.last_time_s(),
                                 options.to_s ? start_s + *options.to_s : flight.last_time_s());
    if (from_s >= to_s) continue;
    const Piece& piece = plan.pieces[index];
    const auto fixes = std::span(track.fixes).subspan(piece.first, piece.last - piece.first);
    const HeadingFollower follower(options.rules, first_heading_deg(flight, from_s, options.rules));
    PieceWriter writer(log, flight, fixes, signs, follower);
    writer.write(track.day_ns, from_s, to_s, options);
    report.gap_s += std::max(0.0, from_s - written_to_s);
    report.duration_s += to_s - from_s;
    written_to_s = to_s;
    ++report.segments;
  }
}

}  // namespace

Result<IgcImportReport> write_igc_log(const IgcTrack& track, const std::string& name,
                                      const IgcImportOptions& options, std::ostream& out) {
  const Heights heights = heights_of(track, options);
  const Plan plan = plan_of(track, heights, options);
  if (plan.flights.empty()) return Fault::track_without_fixes;
  const RecordedSigns signs = recorded_signs(track.fixes, plan.flights);

  IgcImportReport report;
  report.counters = track.counters;
  report.problems = track.problems;
  report.short_segments = plan.short_segments;
  report.labels = labels_of(name, track, signs, heights.label, options);
  LogWriter log(out);
  for (const std::string& label : report.labels) log.label(label);
  write_pieces(log, track, plan, signs, options, report);
  report.frames_written = log.frame_count();
  if (report.frames_written == 0) return Fault::track_without_fixes;
  return report;
}

Result<IgcImportReport> import_igc(const std::filesystem::path& input,
                                   const std::filesystem::path& output,
                                   const IgcImportOptions& options) {
  const Result<IgcTrack> track = igc_track(input);
  if (!track) return track.fault();
  std::error_code error;
  if (std::filesystem::equivalent(input, output, error)) return Fault::file_unwritable;

  // Written beside its place and moved there when complete: a broken log would look like a short
  // flight.
  const std::filesystem::path partial = output.string() + ".partial";
  std::ofstream file(partial, std::ios::binary);
  Result<IgcImportReport> report =
      write_igc_log(track.value(), input.filename().string(), options, file);
  file.close();
  if (report && file.good()) {
    std::filesystem::rename(partial, output, error);
    if (!error) return report;
  }
  std::filesystem::remove(partial, error);
  return report ? Fault::file_unwritable : report.fault();
}

}  // namespace ridgeline
