#pragma once
#include "core/frame/frame_pipeline.hpp"

namespace ridgeline {

/// What of the promise is left for rays that stand for several pixels.
RaySharing sharing_of(const FrameSettings& settings, const FrameReport& report);

/// What the rays of a frame are cast from.
struct CastScene {
  const FrameSettings& settings;
  const TerrainKeeper& terrain;
  const FrameTables& tables;
  const FrameBlocks& blocks;
  Renderer& renderer;
};

/// Plans the ray tiles and casts their rays, in bands where a pace is to be kept. Where it says
/// that the frame is late, what is not cast yet is planned again with the largest bound of the
/// pace, and that is the frame's from then on.
/// Result: rays, shared_px, work and, where that happened, bound and reason in `report`; false
///         where the pace gives the frame up.
/// Source: docs/error_bound.md, section 8b.
bool cast_in_time(const CastScene& scene, FrameReport& report);

}  // namespace ridgeline
