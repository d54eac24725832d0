#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace ridgeline {

/// One usable position fix (B record with validity A) of an IGC flight recorder file.
struct IgcFix {
  double time_s = 0.0;         ///< since 00:00 UTC of the file's date; goes on past midnight
  double latitude_deg = 0.0;   ///< WGS 84, with the LAD digits
  double longitude_deg = 0.0;  ///< WGS 84, with the LOD digits
  double altitude_m = 0.0;  ///< GNSS altitude as recorded; its datum is IgcTrack::altitude_is_msl
  std::optional<double> roll_deg;     ///< AOR as recorded: its sign is the recorder's
  std::optional<double> pitch_deg;    ///< AOP as recorded: its sign is the recorder's
  std::optional<double> heading_deg;  ///< HDT, true
  bool starts_segment = false;        ///< the track jumped here: nothing joins it to the fix before
};

/// What a track file held. Every line raises exactly one of the first five.
struct IgcCounters {
  std::uint64_t lines = 0;
  std::uint64_t fixes = 0;         ///< taken into the track
  std::uint64_t other_lines = 0;   ///< records that carry no position
  std::uint64_t bad_lines = 0;     ///< B or I records that cannot be read
  std::uint64_t flat_fixes = 0;    ///< validity V: no altitude, or no fix at all
  std::uint64_t time_refused = 0;  ///< fixes not later than the one before
  std::uint64_t spikes = 0;        ///< fixes faster than any flight from the one before
};

/// The track of one flight.
struct IgcTrack {
  std::vector<IgcFix> fixes;  ///< ascending in time_s
  std::int64_t day_ns = 0;    ///< 00:00 UTC of the file's date, Unix time; 0 without a date record
  bool has_date = false;
  std::optional<bool> altitude_is_msl;  ///< from the ALG header record; nothing when it is absent
  std::vector<std::string> problems;    ///< "file:line: why" of the first bad lines
  IgcCounters counters;
};

/// Reads an IGC file: B records with the extensions its I record names (LAD, LOD, HDT, AOR, AOP),
/// date, altitude datum. A bad line is counted and named, never fatal. A time that falls back by
/// more than twelve hours is midnight; by less, the fix is refused. Domain: a readable file, else
/// file_unreadable; at least one usable fix, else track_without_fixes; a GNSS altitude
///         that is not 0 throughout, else track_without_height.
/// Source: FAI/IGC technical specification for GNSS flight recorders, appendix A (records A, B, H,
/// I).
[[nodiscard]] Result<IgcTrack> igc_track(const std::filesystem::path& path);

/// The track in the text of a file named `name`; as igc_track().
[[nodiscard]] Result<IgcTrack> igc_track_in(std::string_view text, const std::string& name);

}  // namespace ridgeline
