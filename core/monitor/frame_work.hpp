#pragma once
#include <cstdint>

#include "config/limits_budget.hpp"

namespace ridgeline {

/// How much is shown of what the ground looks like; where the ground is shown never depends on it.
enum class ShadeDetail : std::uint8_t {
  full,
  no_lines,  ///< neither contours nor ground grid
  facets,    ///< and the light of each cell by itself
};
inline constexpr int shade_detail_count = 3;

/// Countable work of a frame, or of a part of it.
struct FrameWork {
  std::int64_t frames = 0;      ///< 1: what every frame costs
  std::int64_t bus_frames = 0;  ///< decoded
  std::int64_t blocks = 0;      ///< of terrain taken in
  std::int64_t plans = 0;       ///< of ray tiles, in thousandths of a picture
  std::int64_t nodes = 0;       ///< of the grid, swept
  std::int64_t rays = 0;        ///< cast
  std::int64_t shaded = 0;      ///< rays that are shaded; none without terrain
  std::int64_t pixels = 0;      ///< of the picture, filled

  friend constexpr FrameWork operator+(const FrameWork& a, const FrameWork& b) {
    return {a.frames + b.frames, a.bus_frames + b.bus_frames, a.blocks + b.blocks,
            a.plans + b.plans,   a.nodes + b.nodes,           a.rays + b.rays,
            a.shaded + b.shaded, a.pixels + b.pixels};
  }
  friend constexpr FrameWork operator-(const FrameWork& a, const FrameWork& b) {
    return {a.frames - b.frames, a.bus_frames - b.bus_frames, a.blocks - b.blocks,
            a.plans - b.plans,   a.nodes - b.nodes,           a.rays - b.rays,
            a.shaded - b.shaded, a.pixels - b.pixels};
  }
};

/// What shading costs of what it costs in full, percent.
constexpr std::int64_t shade_percent(ShadeDetail detail) {
  return detail == ShadeDetail::full ? 100 : detail == ShadeDetail::no_lines ? 75 : 50;
}

/// Time of some work on the reference machine: whole numbers, the same everywhere.
constexpr std::int64_t nominal_ns(const FrameWork& work, ShadeDetail detail) {
  return work.frames * limits::nominal_frame_ns + work.bus_frames * limits::nominal_bus_frame_ns +
         work.blocks * limits::nominal_block_ns + work.plans * limits::nominal_plan_ns / 1000 +
         work.nodes * limits::nominal_node_ns + work.rays * limits::nominal_ray_ns +
         work.shaded * limits::nominal_shaded_ns * shade_percent(detail) / 100 +
         work.pixels * limits::nominal_pixel_ns;
}

}  // namespace ridgeline
