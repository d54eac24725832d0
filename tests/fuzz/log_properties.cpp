#include "tests/fuzz/log_properties.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "sim/log/canaerospace_writer.hpp"
#include "sim/log/candump_reader.hpp"
#include "tests/fuzz/property.hpp"

namespace ridgeline::fuzz {
namespace {

constexpr std::size_t frames_written_again = 2;

struct ReadLog {
  std::vector<BusFrame> frames;
  CandumpStatistics statistics;
  CandumpNotes notes;
  bool is_good = false;
};

ReadLog read(std::string_view text, LogFormat format, std::size_t piece_bytes) {
  CandumpReader reader = CandumpReader::over(text, "log", {format, false}, piece_bytes);
  ReadLog log;
  while (const std::optional<BusFrame> frame = reader.next()) log.frames.push_back(*frame);
  must(!reader.next().has_value(), "the end stays the end");
  log.statistics = reader.statistics();
  log.notes = reader.notes();
  log.is_good = reader.status().ok();
  return log;
}

std::uint64_t line_count(std::string_view text) {
  const auto ends = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
  return ends + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

/// "log:LINE: why", the lines in order.
void check_problems(const ReadLog& log) {
  const std::vector<std::string>& problems = log.notes.problems;
  must(problems.size() == std::min<std::uint64_t>(log.statistics.bad_lines, 10),
       "the first bad lines are told");
  std::uint64_t line_before = 0;
  for (const std::string& problem : problems) {
    must(problem.starts_with("log:"), "a problem names its file");
    const std::size_t colon = problem.find(':', 4);
    must(colon != std::string::npos && colon > 4 && colon + 2 < problem.size(),
         "a problem names its line and what is wrong");
    const std::uint64_t line = std::stoull(problem.substr(4, colon - 4));
    must(line > line_before && line <= log.statistics.lines, "the lines of problems are in order");
    line_before = line;
  }
}

void check_counts(const ReadLog& log, std::string_view text) {
  const CandumpStatistics& counts = log.statistics;
  must(counts.lines == line_count(text), "every line is read");
  must(counts.lines == counts.frames() + counts.xl_frames + counts.comment_lines +
                           counts.lost_lines + counts.bad_lines,
       "every line is counted once");
  must(counts.frames() == log.frames.size(), "every frame counted is given");
  must(log.is_good == !log.frames.empty(), "a log without frames is no good log");
  must(counts.lost_frames >= counts.lost_lines, "a line of losses tells at least one");
  must(counts.sent_frames <= counts.frames() && counts.raw_dlc_frames <= counts.frames() &&
           counts.time_reversals < std::max<std::uint64_t>(counts.frames(), 1),
       "what is counted of frames is not more than the frames");
  must((counts.time_reversals == 0) == (counts.largest_reversal_ns == 0) &&
           counts.largest_reversal_ns >= 0,
       "there is a largest reversal when there is one");
}

/// A classic data frame written by candump_text() and read again.
void check_written(const BusFrame& frame, const std::string& interface) {
  const std::string text = candump_text(frame, interface);
  const CandumpLine line = candump_line(text);
  must(line.kind == CandumpLineKind::frame, "a frame that was written is one");
  must(line.interface == interface, "its interface is the same");
  BusFrame expected = frame;
  expected.interface = 0;
  expected.time_ns -= frame.time_ns % 1000;  // microseconds are written
  must(is_same(line.frame, expected), "a frame that was written is read again");
}

}  // namespace

bool is_same(const BusFrame& a, const BusFrame& b) {
  return a.time_ns == b.time_ns && a.id == b.id && a.extended == b.extended &&
         a.remote == b.remote && a.error == b.error && a.fd == b.fd && a.interface == b.interface &&
         a.length == b.length && a.data == b.data;
}

void check_frame(const BusFrame& frame) {
  constexpr std::uint32_t last_standard = 0x7ff, last_extended = 0x1fffffff;
  const bool is_wide = frame.extended || frame.error;
  must(frame.id <= (is_wide ? last_extended : last_standard), "an identifier fits its width");
  must(frame.length <= (frame.fd ? 64 : 8), "a length fits the kind of frame");
  must(!frame.error || (!frame.remote && !frame.fd && !frame.extended),
       "an error frame is nothing else");
  must(!frame.remote || !frame.fd, "CAN FD has no remote frames");
  const auto unused = frame.data.begin() + (frame.remote ? 0 : frame.length);
  must(std::all_of(unused, frame.data.end(), [](std::uint8_t byte) { return byte == 0; }),
       "unused data bytes are 0");
}

void check_log(std::string_view text, LogFormat format) {
  const ReadLog log = read(text, format, text.size() + 1);
  check_counts(log, text);
  check_problems(log);
  std::size_t written = 0;
  for (const BusFrame& frame : log.frames) {
    check_frame(frame);
    must(frame.time_ns >= 0, "no time is before 1970");
    must(frame.interface < log.notes.interfaces.size(), "a frame's interface has a name");
    const bool is_classic = !frame.error && !frame.remote && !frame.fd;
    if (is_classic && written++ < frames_written_again) {
      check_written(frame, log.notes.interfaces[frame.interface]);
    }
  }
  if (text.size() % 4 != 0) return;  // twice the work: not each time
  const ReadLog again = read(text, format, 1 + text.size() % 13);
  must(again.statistics == log.statistics, "pieces make no difference to the counts");
  must(std::equal(again.frames.begin(), again.frames.end(), log.frames.begin(), log.frames.end(),
                  is_same),
       "pieces make no difference to the frames");
}

}  // namespace ridgeline::fuzz
