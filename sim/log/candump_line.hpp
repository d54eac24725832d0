#pragma once
#include <cstdint>
#include <string_view>

#include "core/bus/bus_frame.hpp"

namespace ridgeline {

/// What one line of a `candump -l` / `-L` text log is.
enum class CandumpLineKind : std::uint8_t {
  frame,      ///< a classic, remote, error or FD frame
  xl_frame,   ///< a CAN XL frame: recognised, not read
  lost,       ///< "DROPCOUNT: ...": the logger lost frames
  label,      ///< "# ridgeline: ...": provenance written by this project
  comment,    ///< blank, or starts with '#'
  malformed,  ///< none of these
};

/// One line taken apart. Views point into the line.
struct CandumpLine {
  CandumpLineKind kind = CandumpLineKind::malformed;
  BusFrame frame;                ///< for `frame`; its interface index is 0
  std::string_view interface;    ///< name, for `frame`
  bool is_sent = false;          ///< direction T: sent by the logging host
  std::uint8_t raw_dlc = 0;      ///< DLC 9..15 of a classic frame of 8 bytes (`_9`..`_F`), else 0
  std::uint64_t lost_count = 0;  ///< for `lost`; at least 1
  std::string_view text;         ///< label text for `label`, the reason for `malformed`
};

/// A line that is none of the others, and why.
[[nodiscard]] CandumpLine malformed_line(std::string_view why);

/// A comment, or a label where its text begins with "ridgeline:"; `text` without the comment's
/// mark.
[[nodiscard]] CandumpLine comment_line(std::string_view text);

/// Takes one line apart; a trailing CR and blanks at either end are ignored.
/// Grammar: `(` seconds [`.` fraction] `)` blanks interface blanks frame [blanks `R`|`T`], with
/// frame one of
///   `123#0011..` or `12345678#..`  3 or 8 hex digits; up to 8 bytes, `.` allowed between bytes,
///   `_9`..`_F` after 8 `123#R`, `123#R8`, `123#R8_F`  remote `123##1..`                     FD: a
///   flags nibble, then up to 64 bytes `20000080#0011..`              error frame: bit 0x20000000
///   of 8 digits `12345#81:00:00000000#..`      CAN XL
/// With interface `429.` port (0..15) the frame may be eight hex digits: an ARINC 429 word, given
/// as the CAN frame of the convention (docs/icd.md, section 7). Units:  the fraction is a decimal
/// fraction of any number of digits; digits beyond 1 ns are cut off. Source: the formats read by
/// can-utils; field deviations in docs/icd.md.
[[nodiscard]] CandumpLine candump_line(std::string_view line);

}  // namespace ridgeline
