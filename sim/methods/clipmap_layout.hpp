#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/fixed_vector.hpp"

namespace ridgeline::sim {

/// The footprints that the rings of a geometry clipmap are made of, all rectangles of quads, and
/// the outer edge. With m = (n + 1) / 4 of a level of n x n vertices.
enum class Footprint : std::uint8_t {
  block,          ///< m - 1 x m - 1 quads: sixteen a full level, twelve a ring
  fix_up_column,  ///< 2 x m - 1: between the blocks of the south and north sides
  fix_up_row,     ///< m - 1 x 2
  trim_column,    ///< 1 x 2 m: with trim_row the L round a finer level, which stands off the middle
  trim_row,       ///< 2 m - 1 x 1
  inner_column,   ///< 1 x 2 m - 1: with inner_row the second L, inside the finest level
  inner_row,      ///< 2 m - 2 x 1
  perimeter,      ///< triangles without area along the outer edge, over the T-junctions there
};
inline constexpr int footprint_count = 8;

/// Quads of a rectangular footprint; of the perimeter, of the whole level.
glm::ivec2 footprint_quads(Footprint footprint, int n);
/// Vertex numbers of its triangles: row-major from the south-west, footprint_quads().x + 1 a row.
/// Both triangles of a quad end with its south-west vertex.
std::vector<std::uint32_t> footprint_indices(Footprint footprint, int n);

/// One footprint of a level: its south-west vertex, counted from the level's.
struct Piece {
  Footprint footprint = Footprint::block;
  glm::ivec2 at{};
};
using Pieces = FixedVector<Piece, 24>;

/// The ring of a level round the next finer one, whose south-west vertex is the level's vertex
/// `hole`. Domain: hole.x, hole.y in {m - 1, m}.
Pieces ring_pieces(int n, glm::ivec2 hole);
/// The whole of the finest level.
Pieces full_pieces(int n);

/// South-west vertex of a level, in vertices of the level along one axis: even, so that it is one
/// of the next coarser level, and such that that level's hole is in the domain of ring_pieces().
/// `eye`: in lattice posts.
std::int64_t level_origin(int n, int level, double eye);

}  // namespace ridgeline::sim
