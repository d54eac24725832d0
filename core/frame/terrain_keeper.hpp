#pragma once
#include <span>

#include "core/geo/local_frame.hpp"
#include "core/terrain/terrain_port.hpp"
#include "core/terrain/terrain_window.hpp"

namespace ridgeline {

/// Keeps the terrain window round the eye: decides when it must be filled anew, and fills it.
/// Memory is the caller's, given once at boot.
class TerrainKeeper {
 public:
  /// Shape: posts.size() == columns * rows, scratch.size() >= 2 * limits::max_window_posts.
  TerrainKeeper(TerrainPort& port, const GeoidLookup& geoid, int columns, int rows,
                std::span<float> posts, std::span<float> scratch);

  /// Makes the window cover the range round the eye. True when its posts changed.
  bool follow(const GeodeticPosition& eye, double range_m);
  /// Fills the window again with its base at the eye's height; for an eye close to the ground.
  void rebase(const GeodeticPosition& eye);

  /// Display range the window covers round the eye, at most `range_m`.
  [[nodiscard]] double covered_range_m(const GeodeticPosition& eye, double range_m) const;
  /// Eye height over the known surface below it; NaN over unknown ground.
  [[nodiscard]] double height_over_terrain_m(const GeodeticPosition& eye) const;
  /// Lower bound on the distance from the eye to the known surface, at least 0.05 m.
  [[nodiscard]] double clearance_m(const GeodeticPosition& eye) const;

  [[nodiscard]] const WindowGrid& grid() const { return grid_; }
  [[nodiscard]] const WindowSummary& summary() const { return summary_; }
  [[nodiscard]] double base_height_m() const { return base_height_m_; }
  [[nodiscard]] std::span<const float> posts() const { return posts_; }
  [[nodiscard]] const GeoidLookup& geoid() const { return geoid_; }

 private:
  void fill(const GeodeticPosition& eye);

  TerrainPort& port_;
  GeoidLookup geoid_;
  int columns_, rows_;
  std::span<float> posts_, scratch_;
  double range_m_ = 0;
  bool filled_ = false;
  WindowGrid grid_;
  WindowSummary summary_;
  double base_height_m_ = 0;
};

/// Posts a window needs per side to cover the range at a latitude, some travel included.
/// Units:  posts, a multiple of limits::window_alignment_posts, at most limits::max_window_posts.
struct WindowSize {
  int columns = 0, rows = 0;
};
WindowSize window_size(double latitude_deg, double range_m, double latitude_step_deg,
                       double longitude_step_deg);

/// The finest steps among tiles; what a window over them uses. Zero without tiles.
struct PostSteps {
  double latitude_deg = 0, longitude_deg = 0;
  double phase_latitude_deg = 0, phase_longitude_deg = 0;
};
PostSteps finest_steps(std::span<const HeightTile> tiles);

}  // namespace ridgeline
