#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `clipmap`: nested regular grids of n x n vertices round the eye, each twice as coarse as the one
/// inside it. The level of detail follows from the distance alone; no bound.
///
/// Sources: Losasso, Hoppe: Geometry clipmaps: terrain rendering using nested regular grids.
/// SIGGRAPH 2004; Asirvatham, Hoppe: Terrain rendering using GPU-based geometry clipmaps. GPU Gems
/// 2, chapter 2, 2005. Followed: a prefiltered pyramid and levels of n x n vertices, n = 2^k - 1,
/// a level's edge on vertices of the next coarser one (2.1); levels of less extent than 2.5 times
/// the height of the eye over the ground are left out, the finest one left is a full square
/// (2.3.1); twelve blocks of m x m vertices a ring, four fix-ups, an L-shaped trim, for the finest
/// level four more blocks and a second L, triangles without area over the T-junctions of the outer
/// edge (2.3.2); culling of each footprint by the view frustum (CPU); blending over n / 10 vertices
/// by the larger of the distances along x and y, so that the outer edge is the coarser level's.
/// The chapter was read in part, the paper of 2004 in its abstract and as the chapter tells it.
///
/// Settings: `grid=255`: vertices a side; 63, 127, 255 or 511.
///
/// Departures:
/// - Level 0 is the finest of the terrain window; as many levels as cover the range. No levels of
///   synthetic detail below the data, no compression, no incremental update: the terrain window is
///   the cache, and the prefiltered pyramid (weights 1 2 1 each way, vertices of a level stand on
///   vertices of the finer one) is built whole, on the GPU, when the window moves.
/// - A level whose vertices the finest window level no longer holds is filtered from the next one.
/// - Heights are floats from those textures, not the papers' packed fine and coarse pair: the
///   vertex interpolates the coarser level itself.
/// - Vertices go through the inverse of the frame's ground map onto the curved Earth; fragments
///   beyond the range are left out; vertices beyond what the window holds (and the range) have the
///   nearest height held.
/// - The ground under the eye is the mean of a square of 4 x 4 posts, taken when the window moves;
///   the chapter reads one post back.
/// - A vertex whose filter meets an unknown post is unknown, a quad with such a vertex too (both
///   triangles); they stand at the highest floor.
std::unique_ptr<Method> make_clipmap(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
