#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/geo/camera.hpp"

namespace ridgeline::sim {

/// A rectangle of a view plane.
struct ViewRect {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// The view that the projected grid lies in: a pinhole at the eye over a flat base plane.
///
/// Frame: east, north and up at the eye. Point (x, y) of the view plane is the ray
///        ahead + x right + y upward; where it meets the base plane it names a ground point (E, N)
///        of the frame's ground map (core/geo/ground_map.hpp). The plane only names ground points:
///        the caller sets them on the curved Earth.
struct Projector {
  glm::dvec3 right{1, 0, 0}, ahead{0, 1, 0}, upward{0, 0, 1};
  double base_m = 1;   ///< height of the eye over the base plane
  double range_m = 1;  ///< rays that meet the plane farther out, or never, count as meeting it here
  ViewRect rect;

  /// The ground point of a point of the view plane.
  [[nodiscard]] glm::dvec2 ground_m(glm::dvec2 view) const;
};

/// Aims a projector at a set of ground points and takes the smallest rectangle that shows them.
/// It is the camera without its roll, tilted further only where a point would else lie more than
/// 75 degrees off its axis. `footprint`: ground points (E, N), at least one.
Projector projector_over(const Attitude& attitude, double base_m, double range_m,
                         std::span<const glm::dvec2> footprint);

/// The coarse grid of the method: view-plane points that are warped on the CPU, and between which
/// the GPU lays the vertices of the full grid by bilinear interpolation.
class CoarseGrid {
 public:
  static constexpr int cells = 32;  ///< a side
  static constexpr int points = (cells + 1) * (cells + 1);

  /// Equal cells over the projector's rectangle: the uniform projected grid.
  void spread(const Projector& projector);
  /// The two passes of the warp: rows, then columns. Importance of a row is the mean aspect (length
  /// along the view over width across it) of its cells on the ground; the new rows hold equal
  /// shares of its sum. Then the same in each row of points for the inverse aspect of the cells
  /// round it. The row pass is repeated, for the aspect inside a cell of the first grid varies as
  /// much as between cells.
  void warp(const Projector& projector);

  /// Row-major from the bottom left; the GPU reads them as they are.
  [[nodiscard]] std::span<const glm::vec2> vertices() const { return vertices_; }
  /// View-plane point of a place on the grid, both 0..1.
  [[nodiscard]] glm::dvec2 view_at(double across, double along) const;

 private:
  /// Ground length of a cell along the view, and its width across.
  struct Extent {
    double length_m = 0, width_m = 0;
  };
  [[nodiscard]] Extent extent(const Projector& projector, int column, int row) const;
  void warp_rows(const Projector& projector);
  void warp_columns(const Projector& projector);
  [[nodiscard]] glm::vec2& vertex(int column, int row) {
    return vertices_[static_cast<std::size_t>(row) * (cells + 1) + column];
  }
  [[nodiscard]] const glm::vec2& vertex(int column, int row) const {
    return vertices_[static_cast<std::size_t>(row) * (cells + 1) + column];
  }

  std::array<glm::vec2, points> vertices_{};
};

}  // namespace ridgeline::sim
