#pragma once
// Every capacity and domain limit of the module, with its unit. docs/memory_map.md adds them up.

namespace ridgeline::limits {

// --- domain of a pose (contract: any roll, pitch, heading; field of view 10..120 degrees) ---
inline constexpr double min_field_of_view_deg = 10.0;
inline constexpr double max_field_of_view_deg = 120.0;
inline constexpr double min_eye_height_m = -600.0;    ///< HAE; the Dead Sea shore is at -430 m MSL
inline constexpr double max_eye_height_m = 20'500.0;  ///< HAE
inline constexpr double min_range_m = 1'000.0;
inline constexpr double max_range_m = 200'000.0;
inline constexpr double default_range_m = 100'000.0;
inline constexpr double max_error_px = 64.0;
inline constexpr double default_error_px = 1.0;
inline constexpr int min_image_px = 16;
inline constexpr int max_image_px = 4096;

// --- terrain ---
inline constexpr double max_terrain_height_m = 9'000.0;
inline constexpr double min_terrain_height_m = -12'000.0;
inline constexpr double largest_undulation_m = 120.0;            ///< of any geoid
inline constexpr double terrain_gpu_bytes = 96.0 * 1024 * 1024;  ///< most the window may take
inline constexpr int blocks_in_flight = 64;  ///< ordered and not yet taken; most a frame uploads
inline constexpr int max_edits = 64;
inline constexpr int max_edited_posts = 65'536;

// --- polar grid ---
inline constexpr int max_planes = 2'048;
inline constexpr int max_rows = 2'048;
inline constexpr int grid_segments = 64;  ///< pieces of the plane and row spacing

}  // namespace ridgeline::limits
