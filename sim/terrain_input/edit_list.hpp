#pragma once
#include <string>
#include <vector>

#include "core/terrain/height_tile.hpp"
#include "platform/file_result.hpp"
#include "sim/terrain_input/statements.hpp"

namespace ridgeline::sim {

/// A rectangle of posts whose heights are replaced from a time on.
struct TerrainEdit {
  double time_s = 0;             ///< on the clock of the frames' `time_s`
  PostGrid grid;                 ///< where the posts stand; may be one post
  std::vector<float> heights_m;  ///< rows x columns, from the south and west; above the tile
                                 ///< datum, NaN = unknown
  int line = 0;                  ///< of the file
};

inline constexpr std::size_t most_edits = 64;
inline constexpr std::size_t most_edited_posts = 65'536;  ///< of all edits together
inline constexpr double smallest_edit_step_arcsec = 0.01;
inline constexpr double largest_edit_step_arcsec = 3600;

/// The edits of a file, by time, then by line. One edit a line, `#` starts a comment:
///   SECONDS SOUTH_DEG WEST_DEG LAT_STEP_ARCSEC LON_STEP_ARCSEC ROWS COLUMNS HEIGHTS...
/// HEIGHTS is ROWS x COLUMNS heights in m, rows from the south, or `fill` and one height for all;
/// `void` stands for a height that is unknown.
/// Domain: south -90..90 and north not above 90; west -180..180, 180 meaning -180; steps 0.01..3600
///         seconds of arc; not more than 360 degrees wide; heights -12000..9000. Else, and for
///         any other line, Fault::file_malformed; more than most_edits or most_edited_posts is
///         Fault::capacity_exceeded. The message begins "FILE:LINE: ".
FileResult<std::vector<TerrainEdit>> edit_list(const std::string& path);
/// The same of a file that has been read.
FileResult<std::vector<TerrainEdit>> edit_list(const StatementFile& file);

}  // namespace ridgeline::sim
