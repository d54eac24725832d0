#include "sim/log/candump_reader.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

namespace ridgeline {
namespace {

constexpr std::size_t block_bytes = 64 * 1024;
/// The longest valid line is a CAN XL frame of 2048 bytes with dots, about 6200 characters.
constexpr std::size_t longest_line = 8 * 1024;
constexpr std::size_t most_problems = 10;
constexpr std::size_t most_labels = 64;
constexpr std::size_t longest_label = 200;
constexpr std::size_t most_interfaces = 255;
constexpr std::uint32_t fold_limit = 0x800;

}  // namespace

Result<CandumpReader> CandumpReader::open(const std::filesystem::path& path,
                                          const CandumpOptions& options) {
  CandumpReader reader;
  std::error_code error;
  // A folder can be opened, but not read.
  if (std::filesystem::is_directory(path, error)) return Fault::file_unreadable;
  reader.file_.reset(std::fopen(path.c_str(), "rb"));
  if (reader.file_ == nullptr) return Fault::file_unreadable;
  reader.buffer_.resize(block_bytes);
  reader.start(path.string(), options);
  return reader;
}

CandumpReader CandumpReader::over(std::string_view text, std::string name,
                                  const CandumpOptions& options, std::size_t piece_bytes) {
  CandumpReader reader;
  reader.memory_ = text;
  reader.piece_bytes_ = piece_bytes;
  reader.start(std::move(name), options);
  return reader;
}

void CandumpReader::start(std::string name, const CandumpOptions& options) {
  name_ = std::move(name);
  options_ = options;
  LogFormat format = options.format;
  if (format == LogFormat::by_content) {
    fill_block();
    format = log_format(block_, name_);
  }
  parser_ = LineParser(format);
}

/// Takes the next block; an empty one at the end, or when reading fails.
void CandumpReader::fill_block() {
  if (file_ == nullptr) {
    block_ = memory_.substr(0, piece_bytes_);
    memory_.remove_prefix(block_.size());
    return;
  }
  const std::size_t used = std::fread(buffer_.data(), 1, buffer_.size(), file_.get());
  block_ = {buffer_.data(), used};
  read_failed_ = used == 0 && std::ferror(file_.get()) != 0;
}

/// Reads the next line into line_, without its end; false at the end of the file.
bool CandumpReader::read_line() {
  line_.clear();
  line_is_too_long_ = false;
  bool any = false;
  while (true) {
    if (block_.empty()) {
      fill_block();
      if (block_.empty()) return any;
    }
    any = true;
    const std::size_t end = block_.find('\n');
    const std::string_view part = block_.substr(0, end);
    const std::size_t room = longest_line - line_.size();
    if (part.size() > room) line_is_too_long_ = true;
    line_.append(part.substr(0, room));
    block_.remove_prefix(part.size() + (end == std::string_view::npos ? 0 : 1));
    if (end != std::string_view::npos) return true;
  }
}

void CandumpReader::note_problem(std::string_view why) {
  ++statistics_.bad_lines;
  if (notes_.problems.size() >= most_problems) return;
  std::string text = name_;
  text.append(":").append(std::to_string(statistics_.lines)).append(": ").append(why);
  notes_.problems.push_back(std::move(text));
}

std::optional<std::uint8_t> CandumpReader::interface_index(std::string_view name) {
  for (std::size_t index = 0; index < notes_.interfaces.size(); ++index) {
    if (notes_.interfaces[index] == name) return static_cast<std::uint8_t>(index);
  }
  if (notes_.interfaces.size() >= most_interfaces) return std::nullopt;
  notes_.interfaces.emplace_back(name);
  return static_cast<std::uint8_t>(notes_.interfaces.size() - 1);
}

void CandumpReader::count_time(std::int64_t time_ns) {
  if (statistics_.frames() > 0) {
    if (time_ns < previous_time_ns_) ++statistics_.time_reversals;
    statistics_.largest_reversal_ns =
        std::max(statistics_.largest_reversal_ns, latest_time_ns_ - time_ns);
    latest_time_ns_ = std::max(latest_time_ns_, time_ns);
  } else {
    latest_time_ns_ = time_ns;
  }
  previous_time_ns_ = time_ns;
}

std::optional<BusFrame> CandumpReader::taken_frame(const CandumpLine& line) {
  BusFrame frame = line.frame;
  const std::optional<std::uint8_t> index = interface_index(line.interface);
  if (!index) {
    note_problem("more than 255 interfaces");
    return std::nullopt;
  }
  frame.interface = *index;
  if (options_.fold_short_ids && frame.extended && frame.id < fold_limit) {
    frame.extended = false;
    ++statistics_.folded_ids;
  }
  count_time(frame.time_ns);
  if (line.is_sent) ++statistics_.sent_frames;
  if (line.raw_dlc != 0) ++statistics_.raw_dlc_frames;
  if (frame.error) {
    ++statistics_.error_frames;
  } else if (frame.remote) {
    ++statistics_.remote_frames;
  } else if (frame.fd) {
    ++statistics_.fd_frames;
  } else {
    ++statistics_.data_frames;
  }
  return frame;
}

/// Counts a line and gives its frame, if it holds one.
std::optional<BusFrame> CandumpReader::taken(const CandumpLine& line) {
  switch (line.kind) {
    case CandumpLineKind::frame:
      return taken_frame(line);
    case CandumpLineKind::xl_frame:
      ++statistics_.xl_frames;
      break;
    case CandumpLineKind::lost:
      ++statistics_.lost_lines;
      statistics_.lost_frames += line.lost_count;
      break;
    case CandumpLineKind::label:
      if (notes_.labels.size() < most_labels) {
        notes_.labels.emplace_back(line.text.substr(0, longest_label));
      }
      ++statistics_.comment_lines;
      break;
    case CandumpLineKind::comment:
      ++statistics_.comment_lines;
      break;
    case CandumpLineKind::malformed:
      note_problem(line.text);
      break;
  }
  return std::nullopt;
}

std::optional<BusFrame> CandumpReader::next() {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  while (!ended_) {
    if (!read_line()) {
      ended_ = true;
      break;
    }
    ++statistics_.lines;
    if (line_is_too_long_) {
      note_problem("line is longer than any frame");
      continue;
    }
    std::string_view text = line_;
    if (statistics_.lines == 1 && text.substr(0, byte_order_mark.size()) == byte_order_mark) {
      text.remove_prefix(byte_order_mark.size());
    }
    if (const std::optional<BusFrame> frame = taken(parser_.line(text))) return frame;
  }
  return std::nullopt;
}

Status CandumpReader::status() const {
  if (read_failed_) return Fault::file_unreadable;
  if (ended_ && statistics_.frames() == 0) return Fault::log_without_frames;
  return {};
}

Result<CandumpLog> candump_log(const std::filesystem::path& path, const CandumpOptions& options,
                               std::size_t most_frames) {
  Result<CandumpReader> opened = CandumpReader::open(path, options);
  if (!opened) return opened.fault();
  CandumpReader& reader = opened.value();
  CandumpLog log;
  while (const std::optional<BusFrame> frame = reader.next()) {
    if (log.frames.size() == most_frames) return Fault::capacity_exceeded;
    log.frames.push_back(*frame);
  }
  if (!reader.status()) return reader.status().fault();
  std::stable_sort(log.frames.begin(), log.frames.end(),
                   [](const BusFrame& a, const BusFrame& b) { return a.time_ns < b.time_ns; });
  log.statistics = reader.statistics();
  log.notes = reader.notes();
  return log;
}

}  // namespace ridgeline
