#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "core/frame/display_state.hpp"
#include "core/frame/terrain_keeper.hpp"
#include "core/geo/camera.hpp"
#include "core/geo/local_frame.hpp"
#include "core/monitor/availability.hpp"
#include "core/monitor/frame_work.hpp"
#include "core/render/frame_blocks.hpp"
#include "core/render/renderer.hpp"

namespace ridgeline {

/// Everything one frame says about itself. Plain data.
struct FrameReport {
  std::int64_t time_ns = 0;
  Availability availability;
  LocalFrame local;  ///< meaningful unless no position was given
  Camera camera;
  double range_m = 0;   ///< display range of this frame
  double bound_px = 0;  ///< 0 where there is none: removed frames, methods without a proof
  ErrorBudget budget;
  int planes = 0, rows = 0;  ///< of the projected grid; 0 when every pixel was ray cast
  std::int64_t nodes = 0;
  int rays = 0;          ///< of the picture: one a block of pixels
  double shared_px = 0;  ///< largest distance of a pixel from its ray
  WindowSummary window;
  /// Of the eye over the known ground straight below; NaN where that is unknown or none was drawn.
  double over_ground_m = std::numeric_limits<double>::quiet_NaN();
  FrameWork work;                          ///< done for it
  ShadeDetail detail = ShadeDetail::full;  ///< as planned by the frame-budget monitor
  DisplayState display;                    ///< as the pilot wants it
  bool finished_coarser = false;           ///< late: finished with a larger bound than planned
};

/// What the GPU counted and how long it took; read where the frame is waited for anyway.
struct FrameCounts {
  RenderCounters counters;
  std::array<double, pass_count> pass_ms{};
  double ray_cast_share = 0;  ///< pixels answered by the ray cast pass / all pixels
};

}  // namespace ridgeline
