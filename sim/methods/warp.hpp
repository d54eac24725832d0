#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `warp`: a regular grid, warped to where the view needs its vertices, drawn as one mesh.
/// Settings: `grid`, vertices a side (512); `map`, texels of the importance map a side (256);
/// `edge`, wanted length of an edge in the picture (2 px); `posts`, most vertices a post (2);
/// `turn`, 1: the square is turned into the view, 0: it stays north up (1);
/// `detail`, 1: adds procedural relief below the posts (0). With detail the picture is no longer
/// that of the data. No bound.
///
/// Source: Dachsbacher, Stamminger, Rendering Procedural Terrain by Geometry Image Warping,
/// Eurographics Symposium on Rendering 2004: importance map, two-pass warp, procedural detail. An
/// importance map over the terrain says how many vertices each place deserves, by distance, view
/// frustum, orientation and a bound on the surface; its rows and then its columns are warped by
/// summing the importance and inverting the sum; the image of positions resampled so is the mesh.
/// Each vertex knows the octave of detail its density can carry; finer octaves are left to shading.
/// Departures, and choices where we know the paper only in outline:
/// - Its domain is a fixed terrain; ours is the square round the eye, in the frame's ground map.
///   Vertices past 1.05 of the display range move onto a rim there; nothing beyond the range shows.
/// - `turn`: with v along the view, rows come out across it and both passes reach what is asked;
///   north up, as a fixed domain is, they do only for views along an axis.
/// - Importance is two densities, along rows and along columns: the projected length of a unit step
///   over the wanted edge, root mean square over the slopes of a 16 x 16 block of posts (minimum,
///   maximum, mean and squares of the slopes are made when the terrain window changes). A block is
///   left out of sight by a ball round it, and as facing away by the cone of its slopes.
/// - Without detail nothing is gained by more than a few vertices a post: `posts` caps the density.
/// - What nobody sees keeps 2 % of the vertices of a line, so that the warp stays invertible.
/// - All passes are compute shaders, one invocation a row or column where a sum runs.
/// - Heights are point samples of the bilinear surface; no filtered levels.
/// - Beyond the finest level of the window blocks count as moderately steep, 600 m high.
/// - Detail is value noise in place of the paper's textures; its height follows the slopes around.
///   A vertex is displaced by the octaves it can carry; all that a pixel can show are lit, by a
///   pass over the shaded picture (not part of a frame's time).
/// - A fragment over an unknown cell, or in a triangle with an unknown corner, is unknown.
std::unique_ptr<Method> make_warp(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
