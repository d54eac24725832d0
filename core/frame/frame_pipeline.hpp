#pragma once
#include <span>

#include "core/frame/frame_report.hpp"
#include "core/frame/ray_tiles.hpp"
#include "core/frame/terrain_keeper.hpp"
#include "core/monitor/frame_pace.hpp"
#include "core/render/renderer.hpp"

namespace ridgeline {

/// What an alternative to the module's own passes draws the range picture of one frame from.
struct RangeScene {
  const FrameReport& report;  ///< camera, local frame, range
  const GroundMap& map;
  const TerrainView& view;
  const FrameBlocks& blocks;  ///< its grid is not used
  Renderer& renderer;         ///< between begin_range() and end_range()
};

/// Draws a range picture instead of the module's own passes: how the benchmark measures other
/// methods on the same objects (sim/methods). Such a frame promises no bound and says so.
struct RangePass {
  void (*draw)(void* context, const RangeScene& scene) = nullptr;
  void* context = nullptr;
};

/// What stays the same from frame to frame.
struct FrameSettings {
  ImageGeometry image;
  double error_px = limits::default_error_px;
  double range_m = limits::default_range_m;
  GeoidLookup geoid;  ///< for the words and lines of the picture; posts have it in them already
  GridSpacing node_spacing{3.0, 1.5};  ///< docs/performance.md has the sweep over both
  /// Every pixel by the ray cast pass, no projected grid: the plain max-pyramid ray caster that the
  /// benchmark compares with.
  bool cast_every_pixel = false;
  RangePass instead;          ///< of the module's own passes; none in the product
  FramePace* pace = nullptr;  ///< keeps frames in time; null: every frame as configured
};

/// What one frame is drawn from.
struct FrameInput {
  std::int64_t time_ns = 0;
  GeodeticPosition eye;
  Attitude attitude;
  Availability availability;  ///< from the ownship data; removed means eye or attitude are no good
  bool attitude_valid = true;
  int bus_frames = 0;  ///< decoded for this frame
  DisplayState display;
};

/// Tables the pipeline fills anew each frame; static storage, sizes from config/limits.hpp.
struct FrameTables {
  std::span<PlaneRecord> planes;  ///< >= RenderSizes::planes
  std::span<float> slopes;        ///< >= RenderSizes::rows
  std::span<std::uint8_t> text;   ///< width x height
  RayTileTables tiles;
};

/// Draws one frame. With a pace it is begun here and asked on the way: a frame that is late is
/// finished with a larger bound; end_pace() is the caller's once the picture is finished.
/// Steps: availability, local frame and camera, terrain window, error budget, projected
/// grid, error buffer, ray cast, shading. Reads top to bottom; branches only on faults.
/// Result: the report; the picture is in the renderer's targets. A frame whose terrain cannot be
///         drawn with a bound is `removed`, and says why.
FrameReport draw_frame(const FrameSettings& settings, const FrameInput& input,
                       TerrainKeeper& terrain, int refused_tiles, const FrameTables& tables,
                       Renderer& renderer);

/// Counters and times of the frame just drawn. Waits for the GPU. A march that met its step limit
/// makes the frame void: the report is turned into a removed one and the picture drawn again.
FrameCounts finish_frame(Renderer& renderer, FrameReport& report, const FrameTables& tables);

/// Tells the pace, if there is one, that the frame is finished, the GPU's part too.
void end_pace(const FrameSettings& settings, const FrameReport& report);

}  // namespace ridgeline
