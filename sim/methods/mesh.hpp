#pragma once
#include <memory>

#include "sim/methods/method.hpp"

namespace ridgeline::sim {

/// `mesh`: every post of the window a vertex, two triangles a cell; no settings. Drawn without any
/// simplification, so it is exact as far as triangles, float32 and the rasteriser's grid of
/// sub-pixels are. What it is not: a cell's bilinear surface lies up to a quarter of the height
/// d of its second corner difference (NE - NW - SE + SW) from the two triangles.
///
/// Source: no paper; the full mesh that all four papers compare with. Choices made here:
/// - The diagonal runs from south-west to north-east.
/// - Blocks of 64 x 64 cells are drawn as instances of one index buffer; blocks outside the
/// camera's
///   cone or beyond the range are left out, by a ball round each (CPU, every frame).
/// - Where the window has several levels, the coarse one is cut off at the border of the finer one
///   pixel by pixel; the two may differ in height there (no stitching).
/// - A triangle with an unknown post is unknown; it slopes from floors of unknown posts to heights
///   of known ones, and the other triangle of its cell may be known. Ours makes the cell flat.
std::unique_ptr<Method> make_mesh(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
