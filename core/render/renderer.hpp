#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/render/dimming.hpp"
#include "core/render/frame_blocks.hpp"
#include "core/render/gl_object.hpp"
#include "core/render/gpu_timer.hpp"
#include "core/render/tile_list.hpp"
#include "core/terrain/terrain_levels.hpp"

namespace ridgeline {

/// Sizes of everything the renderer owns, fixed at boot.
struct RenderSizes {
  int width_px = 0;
  int height_px = 0;
  LevelSizes window;  ///< of the terrain window
  int planes = 0;     ///< capacity of the node texture
  int rows = 0;
};

/// GPU bytes of the terrain for each post of the window: the post, and its share of the pyramid.
inline constexpr double gpu_bytes_per_post = 4.0 * (1.0 + 0.375);

/// How much the shade pass makes of the ground: everything; no lines on it; each cell lit by
/// itself; no ground at all, for frames without terrain.
enum class Shading : std::uint8_t { full, no_lines, facets, plain };
inline constexpr std::size_t shading_count = 4;

/// What the GPU counted in one frame; read back only where a caller waits for the frame anyway.
struct RenderCounters {
  std::uint32_t rays_cast = 0;   ///< pixels whose ray was followed through the terrain
  std::uint32_t unresolved = 0;  ///< marches that met their step limit: the frame is void
};

/// All GL objects of the module and the passes of one frame. OpenGL ES 3.1, no extension needed.
/// A context must be current whenever a member is called.
class Renderer {
 public:
  /// Allocates every GL object. Errors: gl_limit_too_small, gl_shader, gl_out_of_memory.
  static Result<Renderer> make(const RenderSizes& sizes, const TimerFunctions& timer,
                               ShaderLog log);

  /// Puts one block into its place in the terrain window.
  void upload_block(const TerrainBlock& block, const BlockSlot& slot);

  /// What a measured alternative to the module's own passes draws with (sim/methods).
  struct Names {
    GLuint posts = 0;    ///< array texture of posts, one layer a level
    GLuint highest = 0;  ///< array texture of the maxima, as shaders/terrain.glsl reads it
    GLuint range = 0;    ///< R32UI target: distance as float bits, as ray_cast.frag writes it
    GLuint colour = 0;   ///< RGBA8 target of shade(); row 0 is the bottom of the picture
  };
  [[nodiscard]] Names names() const {
    return {posts_.name(), highest_.name(), range_.name(), colour_.name()};
  }
  /// Begins a range picture that others draw: frame block, window and counters are bound.
  void begin_range(const FrameBlocks& blocks);
  /// Ends it: counts its pixels as after the module's own passes.
  void end_range();

  /// Draws the ranges of one frame into the renderer's own target, a ray for each block of each
  /// tile. Owner: `tiles` is looked at again when the picture is shaded or read.
  void draw_terrain(const FrameBlocks& blocks, std::span<const PlaneRecord> planes,
                    std::span<const float> slopes, const RayTiles& tiles);
  /// The same in parts: all but the rays; then rays of tiles, in any order; end_range() at the end.
  void begin_terrain(const FrameBlocks& blocks, std::span<const PlaneRecord> planes,
                     std::span<const float> slopes, const RayTiles& tiles);
  void cast_tiles(int first, int count) const;
  /// Other tiles from here on; those drawn already stand where they stood.
  void replace_tiles(const FrameBlocks& blocks, const RayTiles& tiles);
  /// From here on every pixel has its own ray: for pictures without terrain, or by others.
  void use_single_rays() { tiles_shown_ = {}; }
  /// Shades the current range picture into the colour target.
  void shade(const FrameBlocks& blocks, const shader::StyleBlock& style, Shading shading,
             const Dimming& dimming = {});
  /// Uploads the text layer: width x height bytes, 0 transparent, 255 ink. Row 0 at the top.
  void upload_text(std::span<const std::uint8_t> layer);

  /// Numbers that read_range() needs to read into.
  static constexpr std::size_t scratch_words(int width_px, int height_px) {
    return 4 * static_cast<std::size_t>(ray_target_px(width_px)) *
           static_cast<std::size_t>(ray_target_px(height_px));
  }
  /// Waits for the frame and reads the range picture, contract form (inf sky, NaN unknown).
  void read_range(std::span<float> range_m, std::span<std::uint32_t> scratch);
  /// Waits for the frame and reads 8-bit RGBA rows, top row first.
  void read_colour(std::span<std::uint8_t> rgba);
  /// Waits for the frame and reads its counters.
  [[nodiscard]] RenderCounters read_counters();

  /// Exchanges the programs of grid and ray cast for others that draw the same: how the benchmark
  /// counts their steps (sim/methods).
  void exchange_marches(Program& sweep, Program& ray_cast);
  /// What such programs are compiled with.
  [[nodiscard]] std::string_view march_defines() const;

  [[nodiscard]] GpuTimer& timer() { return timer_; }
  [[nodiscard]] const RenderSizes& sizes() const { return sizes_; }

 private:
  Renderer() = default;
  Status make_programs(ShaderLog log);
  Status make_storage();
  Status make_tiles();
  void begin_rays(const FrameBlocks& blocks);
  /// Tiles of the list in use, from `first` on.
  struct TileRange {
    int first = 0, count = 0;
  };
  /// Draws tiles with a program into a target; `kept` as in Dimming.
  void draw_tiles(const Framebuffer& target, const Program& program, const TileRange& tiles,
                  float kept = 1.0F) const;
  /// Their squares, by number.
  [[nodiscard]] TileRange squares_of(const TileRange& tiles, TileFace face) const;
  /// Draws the text layer over the colour target.
  void draw_words(float kept) const;
  [[nodiscard]] int rays_width() const { return ray_target_px(sizes_.width_px); }
  [[nodiscard]] int rays_height() const { return ray_target_px(sizes_.height_px); }
  [[nodiscard]] const TileList& tile_list() const {
    return tiles_shown_.tiles.empty() ? single_tiles_ : tiles_;
  }
  [[nodiscard]] TileRange all_tiles() const;
  [[nodiscard]] TileRange ground_tiles() const;  ///< all but those of plain sky
  void write_frame_block(const FrameBlocks& blocks);
  void bind_window() const;
  /// Where a pyramid level stands in its layer; the same rule is in shaders/terrain.glsl.
  [[nodiscard]] glm::ivec2 pyramid_corner(int level) const;

  static constexpr std::size_t counter_bytes = 8 * sizeof(std::uint32_t);

  RenderSizes sizes_;
  Program sweep_, ray_cast_, count_, present_, sky_, words_;
  std::array<Program, shading_count> shade_;
  Texture posts_, highest_, nodes_, slopes_, range_, shaded_, colour_, text_;
  Buffer frame_block_, grid_block_, style_block_, planes_, counters_;
  Sampler blended_, blocky_;  ///< how colours are taken from rays
  TileList tiles_, single_tiles_, word_tiles_;
  RayTiles tiles_shown_;  ///< the caller's; empty: single rays
  int single_count_ = 0, word_count_ = 0;
  Framebuffer range_target_, shaded_target_, colour_target_;
  GpuTimer timer_;
};

}  // namespace ridgeline
