// IGC tracks. An input is the text of a track.
#include "sim/import_igc/igc_track.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

void check_fixes(const IgcTrack& track) {
  double time_s = -1.0;
  for (const IgcFix& fix : track.fixes) {
    must(fix.time_s > time_s, "fixes are in order of time");
    time_s = fix.time_s;
    must(std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 180.0,
         "a fix is on the Earth");
    must(std::abs(fix.altitude_m) <= 99999.0, "an altitude has five digits");
    for (const std::optional<double>& angle : {fix.roll_deg, fix.pitch_deg, fix.heading_deg}) {
      must(!angle || std::abs(*angle) <= 360.0, "an angle is within a turn");
    }
  }
}

/// "track:LINE: why".
void check_problems(const IgcTrack& track) {
  must(track.problems.size() == std::min<std::uint64_t>(track.counters.bad_lines, 10),
       "the first bad lines are told");
  std::uint64_t line_before = 0;
  for (const std::string& problem : track.problems) {
    const std::size_t colon = problem.find(": ", 6);
    must(problem.starts_with("track:") && colon != std::string::npos && colon > 6,
         "a problem names its file and line");
    const std::uint64_t line = std::stoull(problem.substr(6, colon - 6));
    must(line > line_before && line <= track.counters.lines, "the lines of problems are in order");
    line_before = line;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::InputBytes(data, size).text();
  const Result<IgcTrack> read = igc_track_in(text, "track");
  if (!read) {
    must(read.fault() == Fault::track_without_fixes || read.fault() == Fault::track_without_height,
         "a track is refused for want of fixes or heights");
    return 0;
  }
  const IgcTrack& track = read.value();
  const IgcCounters& counters = track.counters;
  const auto ends = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
  must(counters.lines == ends + (text.back() != '\n' ? 1 : 0), "every line is read");
  must(counters.lines == counters.fixes + counters.other_lines + counters.bad_lines +
                             counters.flat_fixes + counters.time_refused + counters.spikes,
       "every line is counted once");
  must(counters.fixes == track.fixes.size() && counters.fixes > 0, "every fix counted is given");
  must(track.has_date || track.day_ns == 0, "a track without date has no day");
  check_fixes(track);
  check_problems(track);
  return 0;
}
