#pragma once
#include <cstddef>
#include <span>

#include "core/base/result.hpp"
#include "core/terrain/height_tile.hpp"

namespace ridgeline {

/// User header (80), data set identification (648) and accuracy (2700) in front of the records.
inline constexpr std::size_t dted_header_bytes = 80 + 648 + 2700;
/// In front of the posts of a record: sentinel, block, longitude and latitude count.
inline constexpr std::size_t dted_record_head_bytes = 8;

/// The bytes of one record (one column of posts), its 4-byte checksum included.
[[nodiscard]] constexpr std::size_t dted_record_bytes(int rows) {
  return dted_record_head_bytes + 2 * static_cast<std::size_t>(rows) + 4;
}

/// Where the posts of a DTED file of level 0, 1 or 2 stand, from its header alone.
/// Shape:  one degree square; towards the poles fewer columns than rows (1/2, 1/3, 1/4 or 1/6 as
///         many intervals), as the header says.
/// Domain: `size_bytes` is the size of the whole file, `header` at least its first
///         dted_header_bytes. A file shorter than its header says is Fault::tile_truncated, a
///         longer one Fault::tile_size_mismatch. Fields that are not numbers, or on which the user
///         header and the data set identification disagree: Fault::tile_header_corrupt. A grid
///         that is not one whole cell (a partial cell, or a corner off the whole degree) and a
///         file with tape labels (VOL, HDR) in front: Fault::tile_unsupported.
/// Cost:   O(1); no allocation.
/// Source: MIL-PRF-89020B (2000), sections 3.9 to 3.13 and tables I to VI.
Result<PostGrid> dted_grid(std::span<const std::byte> header, std::size_t size_bytes);

/// A view of a DTED file of level 0, 1 or 2, every record verified.
/// Domain: as dted_grid(); besides, a record whose sentinel or counts are not what its place asks
///         for is Fault::tile_record_corrupt, one whose bytes do not add up to its checksum
///         Fault::tile_checksum_mismatch. One bad record refuses the whole file.
/// Cost:   O(bytes): reads the file once; no allocation.
/// Owner:  the result views `bytes`.
/// Source: as dted_grid().
Result<HeightTile> parse_dted(std::span<const std::byte> bytes);

}  // namespace ridgeline
