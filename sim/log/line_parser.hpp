#pragma once
#include <string_view>
#include <variant>

#include "sim/log/candump_line.hpp"
#include "sim/log/peak_trc.hpp"
#include "sim/log/vector_asc.hpp"

namespace ridgeline {

/// How a text log is written.
enum class LogFormat : std::uint8_t {
  by_content,  ///< told from the file's first lines, then from its name
  candump,     ///< can-utils, `candump -l` or `-L`; ARINC 429 words as well
  vector_asc,
  peak_trc,
};

/// The format of a file: what its first line that says so says, else .asc or .trc at the end of the
/// name in any case, else candump. Never `by_content`.
[[nodiscard]] LogFormat log_format(std::string_view first_lines, std::string_view file_name);

/// Takes the lines of a log of one format apart, one after the other.
class LineParser {
 public:
  /// Domain: any format but `by_content`, which is read as candump.
  explicit LineParser(LogFormat format = LogFormat::candump);

  /// The next line; views hold until the next call.
  [[nodiscard]] CandumpLine line(std::string_view text);

 private:
  struct Candump {
    [[nodiscard]] static CandumpLine line(std::string_view text) { return candump_line(text); }
  };
  std::variant<Candump, VectorAscParser, PeakTrcParser> parser_;
};

}  // namespace ridgeline
