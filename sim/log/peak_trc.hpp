#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/log/candump_line.hpp"

namespace ridgeline {

/// Takes the lines of a PEAK TRC log, versions 1.0 to 2.1, apart, one after the other: what a line
/// means depends on the header before it.
/// Grammar: `;$FILEVERSION=1.1` (none: 1.0), `;$STARTTIME=` days since 1899-12-30, `;$COLUMNS=` the
///   order of a 2.x row; where there is no $STARTTIME, the comment `Start time: D.M.Y H:M:S.f`
///   gives the start. Both are read as UTC: the file says no zone. Rows are 1.0 `N) T ID LENGTH
///   BYTES..`; 1.1 with `Rx|Tx` before ID; 1.2 with a bus number before that; 1.3 with `-` after
///   ID; `RTR` in place of bytes; 2.x `N T TYPE [BUS] ID Rx|Tx [-] LENGTH BYTES..` with TYPE DT,
///   FD, FB, FE, BI or RR. T is in milliseconds. An ID of more than four digits is a 29-bit one.
///   Warnings, errors and states of the bus (Warng, Error, ER, EC, ST, id FFFFFFFF) are error
///   frames; EV is a comment, as are lines of `;` and `Start of measurement`. `; ridgeline: ..` is
///   a label. Everything else is malformed. Bus n is interface can(n-1), no bus is can0.
/// Source: facts of python-can's reader; deviations in docs/icd.md.
class PeakTrcParser {
 public:
  /// The next line; views hold until the next call.
  [[nodiscard]] CandumpLine line(std::string_view text);

 private:
  /// What a row holds, in whatever order its version writes it; empty where it has none.
  struct Row {
    std::string_view time, type, bus, id, direction, length, data;
    bool length_is_code = true;  ///< DLC, not a number of bytes
  };
  CandumpLine comment(std::string_view text);
  CandumpLine frame_of(const Row& row);
  const char* read_columns(std::string_view rest, Row& row) const;
  const char* set_bus(std::string_view bus, CandumpLine& line);

  std::string version_ = "1.0";
  std::string columns_;
  bool has_start_ = false;
  std::int64_t start_ns_ = 0;
  std::string interface_;
};

}  // namespace ridgeline
