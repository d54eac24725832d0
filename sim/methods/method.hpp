#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/frame/frame_pipeline.hpp"
#include "sim/output/outcome.hpp"

namespace ridgeline::sim {

/// The terrain a method may prepare itself from: the finest level of the terrain window.
struct MethodTerrain {
  TerrainView view;
  /// Posts of level 0, row-major, toroidal: lattice post (column, row) stands at (column mod
  /// columns, row mod rows). m over the ellipsoid; below shader void_threshold: unknown.
  std::span<const float> posts;
  double lowest_m = 0, highest_m = 0;  ///< of known posts
  double range_m = 0;
};

/// What a method says of the frame it drew last and of itself.
struct MethodFacts {
  double bound_px = 0;         ///< promised; 0: none
  double ray_cast_share = 0;   ///< pixels answered by a ray / all pixels
  std::size_t gpu_bytes = 0;   ///< GL storage of the method's own, posts not counted
  std::size_t heap_bytes = 0;  ///< heap of the method's own
};

/// Whether a method casts rays, and whether their steps can be counted.
enum class RaySteps : std::uint8_t { no_rays, counted, not_counted };

/// One published way to draw terrain, drawing the range picture of a frame into the renderer's own
/// target from the renderer's own posts, on the same curved Earth. Positions on the ground go
/// through the frame's ground map (shaders/terrain.glsl), so that what differs is the method.
/// It is made without a context; one is current whenever a member is called. GL state it may leave
/// as it likes: bound program, vertex array, framebuffer, textures of units >= 8. Of the rest, what
/// RasterTarget::begin() and end() set.
class Method {
 public:
  virtual ~Method() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Grid sizes, thresholds and what else was chosen, in one line.
  [[nodiscard]] virtual std::string params() const = 0;
  /// Builds programs, and from the posts what the method needs (pyramids, meshes). Called at boot
  /// and whenever the terrain window has moved or changed. Its time is the method's build_ms.
  virtual Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) = 0;
  /// Draws Renderer::names().range: R32UI, distance along the ray as float bits; 1e30 sky, negative
  /// unknown; every pixel is written. Row 0 of the target is the top of the picture.
  virtual void draw(const RangeScene& scene) = 0;
  /// Draws as draw() does, but runs every program the method has, needed by this scene or not: a
  /// driver compiles a program at its first use, which belongs to boot. After the first build().
  virtual void warm_up(const RangeScene& scene) { draw(scene); }
  /// Draws over the shaded colour target what a range picture cannot show; after a frame's time,
  /// and only where its picture is wanted. The blocks and textures of shade() are still bound.
  virtual void finish_picture(const Renderer& renderer) { static_cast<void>(renderer); }
  [[nodiscard]] virtual RaySteps ray_steps() const { return RaySteps::no_rays; }
  /// From the next frame on draws with variants of its programs that count the steps of rays
  /// (step_counter.hpp), or with its own again. After build(); not in a frame. Asked of methods
  /// alone whose steps are counted. Outcome: gl_shader.
  virtual Outcome use_counting(bool counting) {
    static_cast<void>(counting);
    return {};
  }
  /// Of the last frame. May wait for the GPU; not called in the timed part of a frame.
  [[nodiscard]] virtual MethodFacts facts() = 0;
};

/// `name`, or `name:setting=value,setting=value`; each method's file says which settings it has.
struct MethodSpec {
  std::string name;
  std::vector<std::pair<std::string, std::string>> settings;
};

/// Reads one spec. Outcome: the message says which word is wrong.
Outcome parse_method(std::string_view text, MethodSpec& spec);

/// Reads a list: `a,b:x=1,y=2,c`. A piece with `=` and no `:` before it goes on with the method
/// before it. Outcome: the message says which word is wrong.
Outcome parse_methods(std::string_view text, std::vector<MethodSpec>& specs);

/// The spec as parse_method reads it.
[[nodiscard]] std::string method_text(const MethodSpec& spec);

/// Makes a method; null with a message in `problem` for an unknown name, a wrong setting, and a
/// method that this build lacks (the message then holds the word `absent`).
std::unique_ptr<Method> make_method(const MethodSpec& spec, std::string& problem);

/// Whether the name is one of the module's own ways to draw, which no Method draws: `ridgeline`
/// and `raycast` (every pixel by the ray cast pass).
[[nodiscard]] bool is_own_method(const MethodSpec& spec);

/// Puts such a spec into the settings of a frame. Settings: `error` (px) of both; `planes` and
/// `rows`, the spacing of the grid (px), of ridgeline.
/// Result: empty, or which word is wrong; the settings are then as they were.
[[nodiscard]] std::string apply_own_method(const MethodSpec& spec, FrameSettings& settings);

/// What is wrong with a spec: its name or its settings; empty when a method of this or another
/// build can be made from it. Needs no context.
[[nodiscard]] std::string method_problem(const MethodSpec& spec);

/// Every name, in the order of the tables.
std::vector<std::string_view> method_names();

}  // namespace ridgeline::sim
