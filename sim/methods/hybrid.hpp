#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `hybrid`: squares of the height field, near ones drawn as full-resolution meshes, far ones as
/// boxes whose pixels are ray cast at one of four precisions.
/// Settings: `t`, projected area over the side of a square from which on it is a mesh (70);
/// `k`, how soon precision falls (1.3); `cell`, posts a side of a square (128). No bound.
///
/// Source: Ammann, Genevaux, Dischler, Hybrid Rendering of Dynamic Heightfields using Ray-Casting
/// and Mesh Rasterization, Graphics Interface 2010: cells with minimum and maximum that overlap by
/// one post; the choice A / S > T; the level of precision L = min(d_b, d_max) / d_max - h cos
/// theta; linear, then binary steps, from 64 + 25 down to 5 + 2. Departures, and choices where we
/// know the paper only in outline:
/// - A is the area of the projected box (the hull of its corners, not cut at the picture's edge); S
///   the side of a cell in posts, which makes T = 70 a cell of 128 posts with half a pixel a post.
///   A box that reaches behind the eye is a mesh.
/// - d_b is measured to the middle of the box; d_max = range / k; h is the relief of the cell over
///   that of the window; theta the angle of the line of sight over the ground. L below 1/4, 1/2,
///   3/4 and above takes 64 + 25, 27 + 11, 12 + 5, 5 + 2 steps; the two in between are ours.
/// - On the curved Earth a box has the corners of its cell through the ground map, raised by the
///   bulge of the Earth and half a post wider; inside it, a ray's posts and height are parabolas
///   through three of its points.
/// - Far faces are drawn, one fragment a ray, and the ray is cut to the cell (a quarter of a post
///   wider) and to its maximum. A ray that is below the surface where it enters has its hit there:
///   the cell before has missed it.
/// - The surface is bilinear by four posts and our own arithmetic, as everywhere here, not by
///   the texture unit.
/// - Cells are drawn front to back, but OpenGL ES 3.1 has no early depth test for fragments that
///   write their depth, so rays behind a hit are cast as well.
/// - A mesh's fragment over an unknown cell, or in a triangle with an unknown post, is unknown.
/// - Minimum and maximum are made on the CPU when the terrain changes. Where the window has coarser
///   levels, their cells are bounded by the window's minimum and maximum.
/// - The last bit of a distance says whether a ray has found it; that is how facts() counts.
std::unique_ptr<Method> make_hybrid(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
