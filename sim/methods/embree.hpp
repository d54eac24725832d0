#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `embree`: every pixel's ray through Embree 3 on the CPU, the speed bar of machines without a
/// GPU. Optional at build time: without the library make_method says `absent`.
/// Settings: `threads` (all processors), `robust` (on), `coherent` (on: the hint for packets).
///
/// Source: Wald et al., Embree, ACM TOG 33(4) 2014; used here as a library.
/// - Grid geometry in blocks of 64 x 64 cells over one vertex buffer; each cell is two triangles
///   with the diagonal from north-west to south-east, which is not the bilinear surface (mesh.hpp).
/// - Vertices are ECEF minus the place of the eye at build time, double until there, float after:
///   at 100 km one rounding step is 8 mm. The eye's own offset from there is rounded as well.
/// - Packets of 8 rays, 4 pixels wide and 2 high; strips of 2 rows are shared out among threads.
/// - Distances are uploaded into the renderer's range picture; the upload is part of the frame.
/// - Only the finest level of the window is held: what a window of several levels shows beyond it
///   is sky here, and params() says so.
/// - A cell with an unknown post is unknown; it slopes from the floors of its unknown posts to the
///   heights of its known ones, where ours is flat.
std::unique_ptr<Method> make_embree(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
