#pragma once
#include <span>

#include "core/terrain/post_region.hpp"

namespace ridgeline {

/// Reads posts of one row of a tile as the truth has them: edits applied, and on the tile's own
/// border shared with the tiles that touch it there: the taller of two heights counts, and a known
/// one wins over a void. Tiles of other steps share the posts that coincide, where they touch in an
/// edge only; where they overlap in area they share nothing.
/// Units: m above the tiles' datum; NaN = void. Domain: as read_posts().
/// Cost: O(out.size()); on a border row times the tiles that touch it.
void read_shared_posts(const TerrainSource& source, const HeightTile& tile, int row, int column,
                       std::span<float> out);

}  // namespace ridgeline
