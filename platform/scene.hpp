#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/frame/frame_pipeline.hpp"
#include "platform/block_worker.hpp"
#include "platform/geoid_file.hpp"
#include "platform/terrain_folder.hpp"

namespace ridgeline {

/// What the module is told about terrain and picture before it boots.
struct SceneSettings {
  std::string terrain_folder;
  std::string geoid = "none";         ///< a PGM or GTX file, or `none`
  std::vector<TileLocation> sea;      ///< cells an installer states to be sea
  TileReader* extra_tiles = nullptr;  ///< outlives the scene; null: .hgt and DTED alone
  FrameSettings frame;                ///< its geoid is set by the scene
  BlockWorker::Arrival arrival = BlockWorker::Arrival::as_ready;
  double terrain_gpu_bytes = limits::terrain_gpu_bytes;  ///< most the terrain window may take
  int read_delay_us = 0;                                 ///< before every block
};

/// The module joined together, for the flight program and the desktop alike: tiles, geoid, terrain
/// window, renderer, tables. Everything is allocated while it is opened, in this order: open_files,
/// open_renderer, open_terrain. draw() and finish() then allocate nothing.
/// Owner: a context is current on the calling thread from open_renderer() on, for every call, until
///        the scene has ended.
class Scene {
 public:
  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Opens tiles and geoid and sizes the terrain window for an eye near `first`; no context needed.
  /// The problem's fault is `none` when all is well; its message names the file.
  [[nodiscard]] FileProblem open_files(const SceneSettings& settings,
                                       const GeodeticPosition& first);
  /// Makes every GL object and runs every shader once over nothing: a driver compiles a shader at
  /// its first use, which belongs to boot.
  [[nodiscard]] Status open_renderer(const TimerFunctions& timer, ShaderLog log);
  /// Starts the thread that reads terrain. `edits` outlive the scene.
  void open_terrain(std::span<const TerrainEdit> edits = {});

  /// Draws one frame into the renderer's targets; `settings` in place of the scene's own.
  FrameReport draw(const FrameSettings& settings, const FrameInput& input) {
    return draw_frame(settings, input, *terrain_, worker_->refused_count(), tables(), *renderer_);
  }
  /// Draws with a table of a method's own of what blocks of pixels bear, which outlives its use;
  /// null: with the scene's. One table for methods in turn would be filled anew for each.
  void use_bearing(BlockBearing* bearing) { other_bearing_ = bearing; }
  /// Waits for the frame just drawn.
  FrameCounts finish(FrameReport& report) { return finish_frame(*renderer_, report, tables()); }
  /// Waits for the terrain round the eye; for boot, and for single pictures.
  void settle(const GeodeticPosition& eye) { terrain_->settle(eye, *renderer_); }
  /// Reads the picture just drawn. Shape: width x height, row 0 at the top.
  void read_range(std::span<float> range_m) { renderer_->read_range(range_m, range_words_); }
  void read_colour(std::span<std::uint8_t> rgba) { renderer_->read_colour(rgba); }

  /// As the settings had it, with the geoid.
  [[nodiscard]] const FrameSettings& settings() const { return settings_.frame; }
  [[nodiscard]] FrameSettings& settings() { return settings_.frame; }
  [[nodiscard]] std::size_t pixels() const { return text_.size(); }
  [[nodiscard]] TerrainKeeper& terrain() { return *terrain_; }
  [[nodiscard]] const TerrainKeeper& terrain() const { return *terrain_; }
  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const Renderer& renderer() const { return *renderer_; }
  [[nodiscard]] BlockWorker& worker() { return *worker_; }
  [[nodiscard]] const BlockWorker& worker() const { return *worker_; }
  [[nodiscard]] TerrainFolder& folder() { return *folder_; }
  [[nodiscard]] const TerrainFolder& folder() const { return *folder_; }
  [[nodiscard]] const LevelSizes& window() const { return window_; }
  [[nodiscard]] const PostLattice& lattice() const { return lattice_; }
  [[nodiscard]] std::span<const float> finest_posts_m() const { return finest_posts_; }
  [[nodiscard]] const std::string& geoid_name() const { return geoid_.name(); }
  /// 0 without a geoid.
  [[nodiscard]] double geoid_undulation_m(double latitude_deg, double longitude_deg) const;

 private:
  [[nodiscard]] FrameTables tables() {
    return {planes_,
            slopes_,
            text_,
            {ray_tiles_, tile_steepness_, tile_shapes_, tile_looks_,
             other_bearing_ != nullptr ? other_bearing_ : block_bearing_.get()}};
  }
  void size_window(const GeodeticPosition& first);
  void warm_up();

  SceneSettings settings_;
  std::optional<TerrainFolder> folder_;
  GeoidFile geoid_;
  GeoidGrid geoid_grid_;
  double far_floor_m_ = 0;
  bool polar_ = false;  ///< some tile lies where a polar chart is used
  PostLattice lattice_;
  LevelSizes window_;
  std::optional<Renderer> renderer_;
  std::unique_ptr<BlockWorker> worker_;
  std::vector<HeldBlock> held_;
  std::vector<float> finest_posts_;
  std::vector<std::int8_t> finest_rests_;
  std::optional<TerrainKeeper> terrain_;
  std::vector<PlaneRecord> planes_;
  std::vector<float> slopes_;
  std::vector<std::uint8_t> text_;
  std::vector<RayTile> ray_tiles_;
  std::vector<float> tile_steepness_;
  std::vector<std::uint8_t> tile_shapes_;
  std::vector<TileLook> tile_looks_;
  std::unique_ptr<BlockBearing> block_bearing_;
  BlockBearing* other_bearing_ = nullptr;
  std::vector<std::uint32_t> range_words_;
};

}  // namespace ridgeline
