#pragma once
#include <cstddef>
#include <span>

#include "core/base/result.hpp"
#include "core/terrain/height_tile.hpp"
#include "core/terrain/tile_location.hpp"

namespace ridgeline {

/// A view of an SRTM tile (.hgt): 1201 x 1201 (3"), 3601 x 3601 (1") or 10801 x 10801 (1/3") posts,
/// one degree square. The shuttle flew the first two; the third is the same layout at the step of
/// finer national surveys. The file has no header: its size gives the posts, its name the place.
/// Domain: shorter than 1201 x 1201 posts is Fault::tile_truncated; every other size that is not
///         one of the three is Fault::tile_size_mismatch (a cut 1" tile cannot be told from an
///         overlong 3" one); south -90..89 and west -180..179, else Fault::tile_location_mismatch.
/// Cost:   O(1); no allocation.
/// Owner:  the result views `bytes`.
/// Source: USGS, SRTM Topography (SRTM_Topo.txt), section 3: posts, order, void.
Result<HeightTile> parse_hgt(std::span<const std::byte> bytes, int south_deg, int west_deg);

/// The posts of an SRTM tile whose file has `size_bytes` bytes: parse_hgt() without the bytes.
Result<PostGrid> hgt_grid(std::size_t size_bytes, TileLocation location);

/// The cell that the name of an .hgt file names: location_from_name().
inline Result<TileLocation> hgt_location(std::string_view file_name) {
  return location_from_name(file_name);
}

}  // namespace ridgeline
