// The flight that is derived from a track, written as a log and read again. An input is what is
// asked for, and fixes of seven to ten bytes: time step, moves north, east and up, angles.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "core/bus/canaerospace.hpp"
#include "sim/import_igc/import_igc.hpp"
#include "sim/log/candump_reader.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using namespace ridgeline;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

constexpr std::size_t most_fixes = 12;

std::optional<double> angle_from(InputBytes& input) {
  const int angle = static_cast<std::int8_t>(input.u8()) * 3;
  return std::abs(angle) > 360 ? std::nullopt : std::optional<double>(angle);
}

IgcTrack track_from(InputBytes& input) {
  IgcTrack track;
  const std::uint8_t form = input.u8();
  track.has_date = (form & 1U) != 0;
  track.day_ns = track.has_date ? std::int64_t{1'600'000'000} / 86400 * 86400 * 1'000'000'000 : 0;
  if ((form & 2U) != 0) track.altitude_is_msl = (form & 4U) != 0;
  IgcFix fix;
  fix.time_s = (form & 8U) != 0 ? 86395.0 : 0.0;
  fix.latitude_deg = (form & 16U) != 0 ? 89.99 : 46.5;
  fix.longitude_deg = (form & 32U) != 0 ? 180.0 : 8.5;
  fix.altitude_m = 1000.0;
  while (!input.empty() && track.fixes.size() < most_fixes) {
    fix.time_s += 1.0 + input.u8() % 8;
    fix.latitude_deg += static_cast<std::int16_t>(input.u16()) * 1e-6;
    fix.longitude_deg += static_cast<std::int16_t>(input.u16()) * 1e-6;
    fix.latitude_deg = std::clamp(fix.latitude_deg, -90.0, 90.0);
    fix.longitude_deg = std::clamp(fix.longitude_deg, -180.0, 180.0);
    fix.altitude_m += static_cast<std::int8_t>(input.u8()) * 8.0;
    const std::uint8_t more = input.u8();
    fix.starts_segment = (more & 7U) == 7U;
    fix.roll_deg = (more & 8U) != 0 ? angle_from(input) : std::nullopt;
    fix.pitch_deg = (more & 16U) != 0 ? angle_from(input) : std::nullopt;
    fix.heading_deg = (more & 32U) != 0 ? angle_from(input) : std::nullopt;
    track.fixes.push_back(fix);
  }
  return track;
}

/// Every line of the log is a frame that the display takes, or says where the log is from.
void check_log(const std::string& text, const IgcImportReport& report) {
  CandumpReader reader = CandumpReader::over(text, "log");
  BusProfile profile;
  std::uint64_t frames = 0;
  while (const std::optional<BusFrame> frame = reader.next()) {
    ++frames;
    const Result<DecodedValue> value = decode_canaerospace(*frame, profile);
    must(value.ok() || value.fault() == Fault::bus_value_out_of_range,
         "a frame that was written is read");
  }
  must(frames == report.frames_written, "every frame is written");
  must(reader.statistics().bad_lines == 0, "no line is bad");
  must(reader.notes().labels == report.labels, "the log says what was derived");
  must(reader.statistics().time_reversals == 0, "frames are in order of time");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  IgcImportOptions options;
  const std::uint8_t asked = input.u8();
  options.altitude = static_cast<IgcAltitude>(asked % 3U);
  options.attitude_hz = 20.0;
  options.position_hz = 5.0;
  options.from_s = (asked & 8U) != 0 ? input.u8() / 8.0 : 0.0;
  options.to_s = options.from_s + 0.04;  // writing a frame takes longer than deriving it
  if ((asked & 16U) != 0) {
    options.geoid = [](double, double longitude_deg) -> std::optional<double> {
      if (longitude_deg > 8.5) return std::nullopt;
      return 48.0;
    };
  }
  if ((asked & 32U) != 0) options.gap_limit_s = 3.0;
  const IgcTrack track = track_from(input);
  if (track.fixes.empty()) return 0;
  std::ostringstream out;
  const Result<IgcImportReport> report = write_igc_log(track, "track", options, out);
  if (!report) {
    must(report.fault() == Fault::track_without_fixes, "a track is refused for want of fixes");
    return 0;
  }
  must(
      report.value().duration_s > 0.0 && report.value().gap_s >= 0.0 && report.value().segments > 0,
      "what is written lasts some time");
  if (size % 4 == 0) check_log(out.str(), report.value());  // reading costs as much: not each time
  return 0;
}
