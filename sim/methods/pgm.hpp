#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `pgm`: a fixed grid of vertices on the screen, laid on the base plane anew for every frame and
/// lifted to the mean height of the ground round each vertex. Constant cost, no bound.
///
/// Source: Livny, Sokolovsky, Grinshpoun, El-Sana: A GPU persistent grid mapping for terrain
/// rendering. The Visual Computer 24 (2008), 139-153. Followed: the persistent grid and its fast
/// ray shooting at the base plane; the auxiliary camera, which looks so far down that each of its
/// rays meets the plane, where the camera of the picture does not; the pyramid of averages, its
/// level chosen by the distance from a vertex to its farthest neighbour; blending with the parent
/// level by the fraction of the level; one draw call over a fixed index buffer.
/// Known to us by its abstract and by what later papers tell of it, so no sections are named.
///
/// Settings: `grid=512x256` vertices (columns x rows, 16..2048 each; the paper's own are 150x600 to
/// 400x1600).
///
/// Departures:
/// - The base plane is the sea-level ellipsoid (at the lowest post where that is below it), by the
///   frame's ground map: where a ray meets a plane at ground distance g the vertex stands at ground
///   distance g on the curved Earth.
/// - The grid covers, of the sampling camera's image, the rectangle that ground in the picture can
///   need (sim/methods/sampling_camera.hpp), not the whole image: denser above, and the foreground
///   below the picture's edge is there. An auxiliary camera has no roll.
/// - The pyramid ends 6 levels above the coarsest of the terrain window (nodes of 64 of its posts a
///   side); it is built whole, on the GPU, when the window moves: the paper updates it in L and F
///   shapes during the flight. Of several window levels the finest that holds the nodes is read.
/// - Heights of a level are interpolated bilinearly by our own arithmetic, eight fetches a vertex;
///   the paper has two. With the nearest node alone the foreground is all steps: 5 px of mean error
///   in the place of 0.04 over a valley of the Sierra Nevada.
/// - No colour map: the product's shading draws all methods alike.
/// - A node with an unknown post is unknown, so is a vertex between nodes of which one is, and a
///   triangle with such a vertex; they stand at the highest floor among them.
std::unique_ptr<Method> make_pgm(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
