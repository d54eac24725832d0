#pragma once
#include <cstdint>
// Constants of the frame-budget monitor; docs/monitor.md says what each is for.

namespace ridgeline::limits {

inline constexpr std::int64_t default_deadline_ns = 33'333'333;  ///< 30 frames a second
inline constexpr std::int64_t min_deadline_ns = 1'000'000;
inline constexpr std::int64_t max_deadline_ns = 10'000'000'000;

// --- the ladder ---
inline constexpr double budget_most_px = 8.0;          ///< largest bound taken for the sake of time
inline constexpr double budget_rung_ratio = 1.4142;    ///< of one bound to the next, at least
inline constexpr int budget_rungs = 12;                ///< bounds above the wanted one, at most
inline constexpr int budget_steps = budget_rungs + 4;  ///< full, two of shading, bounds, none

// --- shares of the deadline ---
inline constexpr double budget_full_share = 0.92;  ///< a frame that needs more is shed for
inline constexpr double budget_aim_share = 0.85;   ///< what shedding makes for
inline constexpr double budget_calm_share = 0.78;  ///< what a better step may need
inline constexpr double budget_late_share = 0.95;  ///< within a frame: later than this is late

// --- hysteresis, frames ---
inline constexpr int budget_hold_frames = 30;        ///< calm ones before a better step
inline constexpr int budget_none_hold_frames = 60;   ///< without terrain before it is tried again
inline constexpr int budget_most_hold_frames = 480;  ///< after better steps that did not last
inline constexpr int budget_forget_holds = 4;        ///< holds a better step lasts to count as good
inline constexpr int budget_recent_frames = 8;       ///< from which the machine's speed is known

// --- inside a frame ---
inline constexpr int budget_bands = 4;      ///< draws that the rays of a frame are cast in
inline constexpr int budget_readings = 16;  ///< of the clock in one frame, at most

// --- nominal cost of a unit of work, ns: of the reference machine of docs/performance.md ---
inline constexpr std::int64_t nominal_frame_ns = 1'000'000;
inline constexpr std::int64_t nominal_bus_frame_ns = 200;
inline constexpr std::int64_t nominal_block_ns = 40'000;
inline constexpr std::int64_t nominal_plan_ns = 1'500'000;
inline constexpr std::int64_t nominal_node_ns = 8;
inline constexpr std::int64_t nominal_ray_ns = 70;
inline constexpr std::int64_t nominal_shaded_ns = 20;  ///< a ray, with everything
inline constexpr std::int64_t nominal_pixel_ns = 7;    ///< with what its tile costs

}  // namespace ridgeline::limits
