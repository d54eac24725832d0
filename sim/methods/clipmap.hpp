#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `clipmap`: nested regular grids of n x n vertices round the eye, each twice as coarse as the one
/// inside it. The level of detail follows from the distance alone; no bound.
///
/// Sources: Losasso, Hoppe: Geometry clipmaps: terrain rendering using nested regular grids.
/// SIGGRAPH 2004 (levels, transition regions, levels left out under a high eye); Asirvatham, Hoppe:
/// Terrain rendering using GPU-based geometry clipmaps. GPU Gems 2, chapter 2, 2005 (footprints,
/// heights fetched by the vertex, blending in the vertex, culling a block). Followed: n = 2^k - 1,
/// a level's edge on vertices of the next coarser one; twelve blocks of m x m vertices a ring, four
/// fix-ups, an L-shaped trim, for the finest level four more blocks and a second L; blending over
/// n / 10 vertices by max(|x - eye| ...) so that the outer edge is the coarser level's; triangles
/// without area over the T-junctions of that edge; view frustum culling of each footprint (CPU); a
/// level is left out while the eye is higher than 0.4 n of its steps.
///
/// Settings: `grid=255`: vertices a side; 63, 127, 255 or 511.
///
/// Departures:
/// - Level 0 is the finest of the terrain window; as many levels as cover the range. No levels of
///   synthetic detail below the data, no compression, no incremental update: the terrain window is
///   the cache, and the prefiltered pyramid (weights 1 2 1 each way, vertices of a level stand on
///   vertices of the finer one) is built whole, on the GPU, when the window moves.
/// - A level whose vertices the finest window level no longer holds is filtered from the next one.
/// - Heights are floats from those textures, not the papers' packed fine and coarse pair; the
/// vertex
///   interpolates the coarser level itself.
/// - Vertices go through the inverse of the frame's ground map onto the curved Earth; fragments
///   beyond the range are left out; vertices beyond what the window holds (and the range) have the
///   nearest height held.
/// - The papers enable a level by its whole extent in view; here every level to the coarsest is
///   active, less those left out under a high eye.
/// - A vertex whose filter meets an unknown post is unknown, a quad with such a vertex too (both
/// its
///   triangles); they stand at the highest floor.
std::unique_ptr<Method> make_clipmap(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
