#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/egl_context.hpp"
#include "platform/scene.hpp"
#include "sim/geotiff/geotiff_reader.hpp"
#include "sim/methods/method.hpp"
#include "sim/methods/step_counter.hpp"
#include "sim/output/outcome.hpp"
#include "sim/terrain_input/edit_list.hpp"

namespace ridgeline::sim {

/// What `pose`, `replay` and `bench` have in common.
struct SceneOptions {
  std::string terrain_folder;
  std::string geoid = "none";  ///< a PGM or GTX file, or `none`
  std::string coverage_file;   ///< which missing tiles are sea; empty: none
  std::string edit_file;       ///< terrain that changes during the run; empty: none
  FrameSettings settings;
  MethodSpec method;  ///< what draws; no name: the module's own passes, as `settings` has them
  /// When terrain counts as there: `settled` before every picture (single views), `in_step` so many
  /// blocks a frame (repeatable runs; the first drawn frame starts settled), `as_ready` whenever
  /// the disk is done.
  /// `as_recorded`: as expect_blocks() says, frame by frame.
  enum class Arrival : std::uint8_t { settled, in_step, as_ready, as_recorded };
  Arrival arrival = Arrival::settled;
  double terrain_gpu_bytes = limits::terrain_gpu_bytes;  ///< most the terrain window may take
  int read_delay_us = 0;  ///< before every block; shows that slow disks change no bit
};

/// One drawn frame, read back.
struct Picture {
  FrameReport report;
  FrameCounts counts;
  Outcome problem;            ///< a method could not be built: nothing was drawn
  MethodFacts method;         ///< of the method that drew it; nothing for the module's own passes
  double cpu_ms = 0;          ///< wall time of draw_frame and of waiting for it
  double core_ms = 0;         ///< CPU time of all threads of the program over that
  double since_start_ms = 0;  ///< from the start of the program to the end of this frame
  BlockWorker::TakeTimes take;
  FramePlan plan;               ///< where a frame budget is kept
  std::int64_t elapsed_ns = 0;  ///< on its clock; 0: none is kept
  double wanted_px = 0;         ///< the configured error bound and range
  double wanted_range_m = 0;
  std::vector<float> range_m;  ///< empty in a removed frame
  std::vector<std::uint8_t> rgb;
};

/// The module joined together for the desktop: tiles, geoid, context, renderer, buffers.
/// Everything is allocated by open(); drawing allocates only what it hands back.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  /// Opens the inputs and sizes the terrain window for an eye near `first`.
  /// Outcome: the message names the file and what is wrong with it.
  Outcome open(const SceneOptions& options, const GeodeticPosition& first);

  /// Takes a method in; it stays until the session ends. Draw with it after use().
  Method& keep(std::unique_ptr<Method> method);
  /// Draws with a kept method from now on; null: with the module's own passes again.
  /// `bearing`: what those keep from frame to frame, where settings take turns; null: the
  /// session's.
  void use(Method* method, BlockBearing* bearing = nullptr) {
    method_ = method;
    scene_.use_bearing(bearing);
  }
  /// Applies edits, settles the terrain window round the eye and builds the method in use from it,
  /// where the window is not the one it was built from. Nothing to do for the module's own passes.
  /// draw() calls it; call it before where its time must not be part of a measurement.
  Outcome prepare(const FrameInput& input);
  /// Time of the last build of the method in use, ms; the settling of the window not counted.
  [[nodiscard]] double build_ms() const;

  /// Draws one frame and waits for it. A method's frame contains all it does for the frame, with
  /// the module's own shading; its window is always settled.
  /// `want_pixels`: read range and colour back (not part of cpu_ms).
  Picture draw(const FrameInput& input, bool want_pixels);

  /// The same in variants of the programs in use that count the steps of rays and planes. The
  /// picture is the same; not so the time.
  /// `steps`: nothing where they cannot be counted, and where nothing was drawn.
  Picture draw_counting(const FrameInput& input, bool want_pixels,
                        std::optional<StepCounts>& steps);

  /// Messages about refused tiles that were not reported yet.
  std::vector<std::string> new_problems() { return scene_.worker().new_problems(); }
  [[nodiscard]] const FrameSettings& settings() const { return scene_.settings(); }
  [[nodiscard]] FrameSettings& settings() { return scene_.settings(); }
  [[nodiscard]] const std::string& geoid_name() const { return scene_.geoid_name(); }
  [[nodiscard]] double geoid_undulation_m(double latitude_deg, double longitude_deg) const {
    return scene_.geoid_undulation_m(latitude_deg, longitude_deg);
  }
  [[nodiscard]] std::size_t mapped_bytes() const { return scene_.worker().mapped_bytes(); }
  [[nodiscard]] std::uint64_t blocks_loaded() const { return scene_.worker().blocks_taken(); }
  [[nodiscard]] std::size_t loader_bytes() const { return scene_.worker().buffer_bytes(); }
  /// Blocks of terrain that came in since the last call, by rounds of taking; and how many the next
  /// frame is to wait for.
  BlockWorker::Rounds blocks_in_rounds() { return scene_.worker().taken_in_rounds(); }
  void expect_blocks(const BlockWorker::Rounds& rounds) { scene_.worker().expect(rounds); }
  [[nodiscard]] const LevelSizes& window() const { return scene_.window(); }
  [[nodiscard]] const PostLattice& lattice() const { return scene_.lattice(); }
  [[nodiscard]] int sea_cells() const { return scene_.folder().sea_count(); }
  [[nodiscard]] int idle_sea_cells() const { return scene_.folder().idle_sea_count(); }
  [[nodiscard]] const char* driver() const { return context_->description(); }
  [[nodiscard]] TerrainKeeper& terrain() { return scene_.terrain(); }

 private:
  Outcome open_edits();
  void apply_edits(double time_s);
  void settle_if_due(const FrameInput& input);
  Outcome open_renderer();
  [[nodiscard]] MethodTerrain method_terrain();
  Outcome use_counting(bool counting);
  void warm_up(const FrameInput& input);

  /// The state of the terrain window that a method was built from.
  struct WindowState {
    std::uint64_t blocks = 0;
    std::size_t edits = 0;
    Chart chart = Chart::geographic;
    std::array<PostRect, max_levels> drawable{};
    friend bool operator==(const WindowState&, const WindowState&) = default;
  };
  [[nodiscard]] WindowState window_state() const;
  struct Kept {
    std::unique_ptr<Method> method;
    std::optional<WindowState> built;
    double build_ms = 0;
  };

  SceneOptions options_;
  GeotiffReader geotiff_;
  std::optional<EglContext> context_;
  std::vector<sim::TerrainEdit> edits_;
  std::vector<ridgeline::TerrainEdit> core_edits_;
  std::vector<PostGrid> edit_grids_;
  Scene scene_;  ///< its worker reads the edits until the end
  std::size_t edits_applied_ = 0;
  bool settled_ = false;
  std::vector<std::uint8_t> rgba_;
  std::vector<Kept> methods_;
  Method* method_ = nullptr;  ///< in use
  StepCounter step_counter_;
  std::vector<float> method_posts_;
  std::optional<WindowState> method_posts_of_;
};

/// Writes `N.json`, `N_range.npy` (unless removed) and `N_color.png` of contract section 3.
Outcome write_dump(const std::string& folder, int index, const Picture& picture,
                   const std::string& geoid_name);

}  // namespace ridgeline::sim
