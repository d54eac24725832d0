#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/bus/bus_frame.hpp"
#include "sim/log/line_parser.hpp"

namespace ridgeline {

/// How a log is read.
struct CandumpOptions {
  /// Vector ASC and PEAK TRC logs are read as well, when told or when their content says so.
  LogFormat format = LogFormat::candump;
  /// Read 8-digit ids below 0x800 as 11-bit ids: one logger of the field prints them so.
  bool fold_short_ids = false;
};

/// What a log held. Every line raises exactly one of the line counters.
struct CandumpStatistics {
  std::uint64_t lines = 0;
  std::uint64_t data_frames = 0;  ///< classic data frames
  std::uint64_t fd_frames = 0;    ///< CAN FD data frames
  std::uint64_t remote_frames = 0;
  std::uint64_t error_frames = 0;
  std::uint64_t xl_frames = 0;      ///< CAN XL: skipped
  std::uint64_t comment_lines = 0;  ///< labels and blank lines as well
  std::uint64_t lost_lines = 0;     ///< DROPCOUNT
  std::uint64_t bad_lines = 0;

  std::uint64_t lost_frames = 0;     ///< what the DROPCOUNT lines add up to
  std::uint64_t sent_frames = 0;     ///< marked T
  std::uint64_t raw_dlc_frames = 0;  ///< marked _9.._F
  std::uint64_t folded_ids = 0;
  std::uint64_t time_reversals = 0;      ///< frames earlier than the one before
  std::int64_t largest_reversal_ns = 0;  ///< earlier than the latest time before, at most

  /// Data, FD, remote and error frames.
  [[nodiscard]] std::uint64_t frames() const {
    return data_frames + fd_frames + remote_frames + error_frames;
  }
  [[nodiscard]] bool operator==(const CandumpStatistics&) const = default;
};

/// What is kept of a log besides its frames.
struct CandumpNotes {
  std::vector<std::string> problems;    ///< "file:line: why" of the first bad lines
  std::vector<std::string> labels;      ///< "# ridgeline:" texts in order, without the prefix
  std::vector<std::string> interfaces;  ///< by BusFrame::interface
};

/// Streams the frames of a text log in file order: `candump -l` / `-L`, Vector ASC or PEAK TRC. A
/// bad line is counted, the first few are kept as "file:line: why"; none ends the reading. Memory
/// does not grow with the file.
class CandumpReader {
 public:
  /// Opens a log. Domain: a readable file, else Fault::file_unreadable.
  [[nodiscard]] static Result<CandumpReader> open(const std::filesystem::path& path,
                                                  const CandumpOptions& options = {});

  /// Reads a log that lies in memory, handed over in pieces of at most `piece_bytes` as a file is.
  /// Domain: piece_bytes >= 1; the first piece decides the format where it is told by content.
  /// Owner:  views `text`, which outlives the reader.
  [[nodiscard]] static CandumpReader over(std::string_view text, std::string name,
                                          const CandumpOptions& options = {},
                                          std::size_t piece_bytes = std::size_t{64} * 1024);

  /// The next frame in file order; nothing at the end, or when reading fails (see status()).
  [[nodiscard]] std::optional<BusFrame> next();

  /// file_unreadable when reading broke off; log_without_frames at the end of a log without any.
  [[nodiscard]] Status status() const;

  [[nodiscard]] const CandumpStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const CandumpNotes& notes() const { return notes_; }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  CandumpReader() = default;
  void start(std::string name, const CandumpOptions& options);
  void fill_block();
  bool read_line();
  std::optional<BusFrame> taken(const CandumpLine& line);
  std::optional<BusFrame> taken_frame(const CandumpLine& line);
  void count_time(std::int64_t time_ns);
  void note_problem(std::string_view why);
  std::optional<std::uint8_t> interface_index(std::string_view name);

  std::string name_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  CandumpOptions options_;
  LineParser parser_;
  std::vector<char> buffer_;     ///< of a file
  std::string_view memory_;      ///< what is left of a log in memory
  std::size_t piece_bytes_ = 0;  ///< most of `memory_` that is taken at once
  std::string_view block_;       ///< what is left of the block in hand
  std::string line_;
  bool line_is_too_long_ = false;
  bool read_failed_ = false;
  bool ended_ = false;
  std::int64_t previous_time_ns_ = 0;
  std::int64_t latest_time_ns_ = 0;
  CandumpStatistics statistics_;
  CandumpNotes notes_;
};

/// A whole log in memory.
struct CandumpLog {
  std::vector<BusFrame> frames;  ///< ascending in time; equal times in file order
  CandumpStatistics statistics;
  CandumpNotes notes;
};

/// Reads a whole log and puts its frames in time order. Interfaces are logged with their own
/// delays, up to a second apart; a stable sort makes the order, and with it the replay, the same
/// every time. Domain: a readable file, else Fault::file_unreadable; at least one frame, else
/// log_without_frames; at most
///         `most_frames`, else capacity_exceeded.
/// Cost:   O(n log n); about 100 bytes a frame (an hour at 150 frames/s is 54 MB).
[[nodiscard]] Result<CandumpLog> candump_log(const std::filesystem::path& path,
                                             const CandumpOptions& options = {},
                                             std::size_t most_frames = 50'000'000);

}  // namespace ridgeline
