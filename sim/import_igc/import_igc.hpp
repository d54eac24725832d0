#pragma once
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "sim/import_igc/derived_flight.hpp"
#include "sim/import_igc/igc_track.hpp"

namespace ridgeline {

/// What the GNSS altitude of a track is counted from.
enum class IgcAltitude : std::uint8_t {
  header,  ///< as the file's ALG record says; above the ellipsoid where it says nothing (FAI rule)
  hae,     ///< above the ellipsoid
  msl,     ///< above mean sea level: many recorders, against the rule
};

/// How a track becomes a bus log.
struct IgcImportOptions {
  IgcAltitude altitude = IgcAltitude::header;
  /// Turns MSL into heights above the ellipsoid. Without it MSL heights are written unchanged and
  /// the log says so: right where the terrain is used without a geoid as well, else off by the
  /// undulation.
  GeoidUndulation geoid;
  double attitude_hz = 25.0;  ///< roll, pitch, heading; 20..100
  double position_hz = 10.0;  ///< position, height, speed, track, climb; 5..50
  /// Longest time between fixes that is flown over; 0 chooses three median intervals, at least 5 s.
  double gap_limit_s = 0.0;
  double from_s = 0.0;         ///< first second of the track that is written
  std::optional<double> to_s;  ///< last one
  DerivationRules rules;
};

/// What an import did.
struct IgcImportReport {
  IgcCounters counters;
  std::vector<std::string> problems;  ///< "file:line: why" of the first bad lines
  std::vector<std::string> labels;    ///< the log's "# ridgeline:" texts
  std::uint64_t segments = 0;         ///< unbroken pieces written
  std::uint64_t short_segments = 0;   ///< pieces of fewer than four fixes, left out
  double gap_s = 0.0;                 ///< time of the track without data in the log
  std::uint64_t frames_written = 0;
  double duration_s = 0.0;
};

/// Turns an IGC track into a `candump -L` log of CANaerospace frames: roll 312, pitch 311, true
/// heading 1133 (FLOAT) at attitude_hz; latitude 1036, longitude 1037 (LONG 1e-7 deg), height 1038,
/// ground speed 1039, track 1040, altitude rate 314 at position_hz; UTC 1200 and date 1206 at 1 Hz.
/// Every derived item is named in a comment line `# ridgeline: DERIVED ...`. A gap in the track is
/// a gap in the log: lost data, not invented flight. Domain: see igc_track(); no unbroken piece of
/// four fixes: track_without_fixes; the log cannot be written, or is
///         the track itself: file_unwritable (nothing is left behind).
[[nodiscard]] Result<IgcImportReport> import_igc(const std::filesystem::path& input,
                                                 const std::filesystem::path& output,
                                                 const IgcImportOptions& options = {});

/// The log of a track that has been read, written to `out`; `name` is the track's for the labels.
/// Domain: no unbroken piece of four fixes, or nothing to write: track_without_fixes.
[[nodiscard]] Result<IgcImportReport> write_igc_log(const IgcTrack& track, const std::string& name,
                                                    const IgcImportOptions& options,
                                                    std::ostream& out);

}  // namespace ridgeline
