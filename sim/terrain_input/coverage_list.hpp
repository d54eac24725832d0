#pragma once
#include <string>
#include <vector>

#include "core/terrain/tile_location.hpp"
#include "platform/file_result.hpp"
#include "sim/terrain_input/statements.hpp"

namespace ridgeline::sim {

/// The cells of a coverage list: where an installer states that a missing tile is sea.
/// One statement a line, `sea N46E008`: the south-west corner of a one-degree cell, S90..N89 and
/// W180..E179, in any case; `#` starts a comment.
/// Shape:  each cell once, by south, then west. A cell stated twice is no error.
/// Domain: a file that cannot be read is Fault::file_unreadable; any other line is
///         Fault::file_malformed, the message begins "FILE:LINE: ".
FileResult<std::vector<TileLocation>> coverage_list(const std::string& path);
/// The same of a file that has been read.
FileResult<std::vector<TileLocation>> coverage_list(const StatementFile& file);

}  // namespace ridgeline::sim
