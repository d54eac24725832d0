#pragma once
#include <memory>
#include <span>

#include "sim/methods/loffler_footprint.hpp"
#include "sim/methods/loffler_grid.hpp"
#include "sim/methods/method.hpp"
#include "sim/methods/raster_target.hpp"
#include "sim/methods/relief_pyramid.hpp"
#include "sim/methods/step_counter.hpp"

namespace ridgeline::sim {

/// What was chosen for `loffler`.
struct LofflerSettings {
  int columns = 1024, rows = 512;  ///< vertices of the full grid
  bool warp = true;                ///< off: the uniform projected grid
  bool rays = true;                ///< off: the grid's surface alone
  bool lift = true;                ///< vertices above the threshold move to the highest post;
                                   ///< where a spec is silent, with rays only
  double gamma_px = 1;             ///< threshold, and what the paper claims the picture keeps
  bool from_eye = false;           ///< rays begin at the eye instead of at the grid's surface
  bool flat = false;               ///< vertices on a flat Earth, as in the paper
};

/// `loffler`: a projected grid, warped so that its cells on the ground are nearly square, with an
/// error for every vertex and rays for the pixels whose interpolated error passes a threshold.
/// Settings: grid=1024x512, warp=1, rays=1, lift=1, gamma=1, from=surface|eye, earth=curved|flat.
///
/// Source: Löffler, Rybacki, Schumann: Error-bounded GPU-supported terrain visualisation, WSCG
///         2009, Communication Papers, 47-54; "grid distribution on the view-plane" (coarse grid
///         and warp), "error-bounded rendering" (pyramids, metric, error buffer, ray casting).
///
/// As published, holes included (docs/evidence/published_holes.md has their pictures):
/// - Coarse grid on the CPU, importance from the aspect of projected cells, rows then columns
///   (loffler_grid.hpp); refined on the GPU (loffler_refine.comp).
/// - Average, minimum, maximum in one pyramid; level = log2 of the distance to the neighbour,
///   rounded to nearest (L3); delta = max(hmax - havg, havg - hmin) of the one aligned texel (L3),
///   havg no middle (L10); rho = lambda delta / distance with lambda = width / field of view (L5).
/// - Vertices stand at havg, those with rho > gamma at hmax, delta kept (L4). Error 1 - gamma/rho,
///   0 below, interpolated over triangles whatever happens inside them (L2, L6).
/// - Pixels with an error above 0 are ray cast, all others stay, those where the grid drew nothing
///   too (L1). Nothing is checked afterwards (L9). float32 and the rasteriser's sub-pixels are
///   not accounted for (L11).
///
/// Departures:
/// - The grid is laid on the tangent plane under the lowest terrain, as published, but its points
///   only name ground points of the frame's ground map and stand on the curved Earth; earth=flat
///   keeps them on the plane (L12; its rays still meet the curved one).
/// - The projector is the camera without its roll: rows then run along the horizon, and none is
///   lost to the sky. Its rectangle shows what loffler_footprint.hpp finds: the paper increases the
///   field of view and does not say by how much (L7).
/// - The coarse grid has 32 x 32 cells; the row pass is repeated (loffler_grid.hpp).
/// - havg is filtered in the shader between four texels of 32-bit floats, for unknown posts would
///   spoil what the texture unit filters; closer than one post to a neighbour a vertex takes the
///   posts' own bilinear surface, delta 0.
/// - The error is 0..1 by clamping: 1 - gamma/rho is unbounded below.
/// - The caster is unspecified (L8): ours descends a pyramid of maxima to the bilinear cells. It
///   begins at the lifted surface; from=eye, slower, needs no shell and is exact.
/// - Ground that is unknown is told pixel by pixel, from the cell under the surface.
/// - Where the terrain window has several levels, ground beyond the finest is drawn from the
///   coarser posts with delta 0.
/// - Shading is deferred, as there; the shading itself is the module's.
class Loffler final : public Method {
 public:
  explicit Loffler(const LofflerSettings& settings) : settings_(settings) {}
  [[nodiscard]] std::string_view name() const override { return "loffler"; }
  [[nodiscard]] std::string params() const override;
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  [[nodiscard]] RaySteps ray_steps() const override {
    return settings_.rays ? RaySteps::counted : RaySteps::no_rays;
  }
  Outcome use_counting(bool counting) override;
  [[nodiscard]] MethodFacts facts() override;

  /// The error buffer of the last frame drawn with rays: 0 where nothing is to be cast, and where
  /// the grid drew nothing. Row 0 is the top of the picture. Waits for the GPU.
  /// Shape: width x height.
  void read_errors(std::span<float> errors);

 private:
  Outcome make_objects(const RenderSizes& sizes);
  Outcome make_surface(const RenderSizes& sizes);
  Outcome make_vertices();
  Outcome make_relief(const RenderSizes& sizes);
  void upload_relief();
  void upload_frame(const RangeScene& scene);
  void refine();
  void begin_surface(const Renderer& renderer);
  void cast(const Renderer& renderer);
  [[nodiscard]] std::size_t vertex_count() const {
    return static_cast<std::size_t>(settings_.columns) * static_cast<std::size_t>(settings_.rows);
  }

  LofflerSettings settings_;
  Footprint footprint_;
  CoarseGrid coarse_;
  ReliefPyramid relief_;
  double lowest_m_ = 0;
  bool voids_ = false;

  Program refine_, draw_, cast_;
  CountingProgram counting_;
  Buffer block_, coarse_buffer_, vertices_, indices_;
  VertexArray arrays_, empty_;
  Texture relief_texture_, surface_, depth_;
  Framebuffer surface_target_, cast_target_;
  RasterTarget plain_target_;
  GLuint surface_range_ = 0, cast_range_ = 0;
  GLsizei index_count_ = 0;
  int width_px_ = 0, height_px_ = 0, relief_columns_ = 0, relief_rows_ = 0;
  std::size_t gpu_bytes_ = 0;
  std::vector<std::uint32_t> row_words_;  ///< of the error buffer, read back
};

std::unique_ptr<Method> make_loffler(const MethodSpec& spec, std::string& problem);

/// The settings of a spec; `problem` says which word is wrong.
LofflerSettings loffler_settings(const MethodSpec& spec, std::string& problem);

}  // namespace ridgeline::sim
