#pragma once
#include <span>

#include "core/terrain/height_tile.hpp"

namespace ridgeline {

/// Newer data for a rectangle of posts: a crane, a dam, a survey. The posts of every tile that
/// stand on a post of `grid` are replaced.
/// Units: m above the tile's vertical datum; NaN makes a post unknown. Row 0 = south.
/// Owner: views `heights_m`, whoever read the edit keeps them.
struct TerrainEdit {
  PostGrid grid;
  std::span<const float> heights_m;
};

/// Replaces what edits say of the posts of row `row` of a tile, read from column `column` on.
/// Later edits win. Posts count as the same when they are within 1e-3 of a step.
void apply_edits(std::span<const TerrainEdit> edits, const PostGrid& tile, int row, int column,
                 std::span<float> posts);

}  // namespace ridgeline
