#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "tests/oracle/terrain.hpp"
#include "tests/oracle/tile.hpp"

namespace ridgeline::oracle {

/// A rectangle of posts that replaces what tiles say, from a time on.
struct Edit {
  double time_s = 0;
  int line = 0;
  Tile patch;  ///< its posts; NaN makes a post unknown
};

/// The edits of a file, in order of time, then line. A line of it reads
/// `SECONDS SOUTH_DEG WEST_DEG LAT_STEP_ARCSEC LON_STEP_ARCSEC ROWS COLUMNS HEIGHTS...`; HEIGHTS
/// are ROWS * COLUMNS numbers (m above the tiles' datum, rows from the south, columns from the
/// west) or `void`, or `fill` and one of them. `#` starts a comment. Domain: at most 64 edits of
/// 65,536 posts in all; heights -12,000 to 9000 m. Errors: InputError naming the file and the line.
[[nodiscard]] std::vector<Edit> read_edits(const std::filesystem::path& file);
/// The same for the text of a file.
[[nodiscard]] std::vector<Edit> edits_in(const std::filesystem::path& file, std::string_view text);

/// Keeps a terrain as it is at the time of the frame in hand.
class TimedEdits {
 public:
  /// Errors: InputError naming the file and the line of an edit whose steps are those of no tile
  ///         with posts there.
  TimedEdits(const std::filesystem::path& file, std::vector<Edit> edits, Terrain& terrain);

  /// Brings the terrain to a time: the edits up to and including it have happened, no others.
  /// Cost: grows with the posts of the edits that are done or undone.
  /// Owner: changes the terrain; no tracer may be at work on it.
  void advance_to(double time_s);

 private:
  std::vector<Edit> edits_;
  Terrain& terrain_;
  std::vector<ReplacedPosts> done_;  ///< one for each edit that has happened
};

}  // namespace ridgeline::oracle
