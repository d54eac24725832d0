#include "sim/methods/hybrid_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ridgeline::sim {
namespace {

constexpr float void_threshold = -50000.0f;  // as in shaders/terrain.glsl
constexpr float void_offset = 100000.0f;
constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double ball_share = 1.01;  ///< of the farthest corner: faces of a box on a curved Earth
constexpr double least_depth_m = 1.0;

/// Lowest and highest of the posts of a cell of the finest level; floors where unknown.
void bound_heights(const MethodTerrain& terrain, int side, HybridCell& cell) {
  const int columns = terrain.view.sizes.columns(), rows = terrain.view.sizes.rows();
  const PostRect& held = terrain.view.drawable[0];
  cell.low_m = std::numeric_limits<float>::max();
  cell.high_m = std::numeric_limits<float>::lowest();
  const std::int32_t north = std::min(cell.row + side, held.north);
  const std::int32_t east = std::min(cell.column + side, held.east);
  for (std::int32_t row = std::max(cell.row, held.south); row <= north; ++row) {
    const std::size_t from = static_cast<std::size_t>(wrapped(row, rows)) * columns;
    for (std::int32_t column = std::max(cell.column, held.west); column <= east; ++column) {
      const float stored = terrain.posts[from + wrapped(column, columns)];
      const float height = stored < void_threshold ? stored + void_offset : stored;
      cell.low_m = std::min(cell.low_m, height);
      cell.high_m = std::max(cell.high_m, height);
    }
  }
}

void place(const PostLattice& lattice, double span, HybridCell& cell) {
  const auto point = [&](double share_east, double share_north, double height_m) {
    const GroundPlace at =
        lattice.place_of(cell.column + share_east * span, cell.row + share_north * span);
    return GeodeticPosition{at.latitude_deg, at.longitude_deg, height_m};
  };
  const double low = cell.low_m, high = cell.high_m;
  const GeodeticPosition middle = point(0.5, 0.5, 0.5 * (low + high));
  cell.centre = ecef_from_geodetic(middle);
  const double lat = middle.latitude_deg * rad_per_deg, lon = middle.longitude_deg * rad_per_deg;
  cell.up = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  for (int corner = 0; corner < 8; ++corner) {
    const double east = corner % 2, north = corner / 2 % 2;
    const Vec3<Ecef> at = ecef_from_geodetic(point(east, north, corner < 4 ? low : high));
    cell.corners[static_cast<std::size_t>(corner)] = at;
    cell.radius_m =
        std::max(cell.radius_m, ball_share * glm::length(at.xyz - cell.centre.xyz) + 1.0);
  }
}

bool inside(const PostRect& outer, const HybridCell& cell, std::int32_t span) {
  return cell.column >= outer.west && cell.row >= outer.south && cell.column + span <= outer.east &&
         cell.row + span <= outer.north;
}

/// Area of the convex hull of eight points.
double hull_area(std::array<glm::dvec2, 8>& points) {
  std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  const auto turn = [](const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::array<glm::dvec2, 17> hull;
  std::size_t count = 0;
  const auto add = [&](const glm::dvec2& point, std::size_t least) {
    while (count >= least + 2 && turn(hull[count - 2], hull[count - 1], point) <= 0) --count;
    hull[count++] = point;
  };
  for (const glm::dvec2& point : points) add(point, 0);
  const std::size_t upper = count - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], upper);
  double twice = 0;
  for (std::size_t i = 1; i < count; ++i) {
    twice += hull[i - 1].x * hull[i].y - hull[i - 1].y * hull[i].x;
  }
  return 0.5 * std::abs(twice);
}

/// Whether the ball round the cell touches the cone round the picture.
bool may_be_seen(const HybridCell& cell, const CellView& view, const glm::dvec3& way) {
  const double distance_m = glm::length(way);
  if (distance_m - cell.radius_m > view.range_m) return false;
  if (distance_m <= cell.radius_m) return true;
  const glm::dvec3 ahead =
      (view.local.ecef_from_enu * view.camera.enu_from_camera * Vec3<CameraAxes>{{0, 0, 1}}).xyz;
  const double off_rad = std::acos(std::clamp(glm::dot(way, ahead) / distance_m, -1.0, 1.0));
  return off_rad <= view.camera.half_diagonal_rad(1.0) + std::asin(cell.radius_m / distance_m);
}

}  // namespace

std::vector<HybridCell> hybrid_cells(const MethodTerrain& terrain, int side) {
  std::vector<HybridCell> cells;
  for (int level = 0; level < terrain.view.sizes.levels; ++level) {
    const PostRect& rect = terrain.view.drawable[static_cast<std::size_t>(level)];
    if (rect.empty()) continue;
    const std::int32_t span = side << level;
    const auto first = [&](std::int32_t post) {
      return static_cast<std::int32_t>(std::floor(static_cast<double>(post) / span)) * span;
    };
    for (std::int32_t row = first(rect.south); row < rect.north; row += span) {
      for (std::int32_t column = first(rect.west); column < rect.east; column += span) {
        HybridCell cell{};
        cell.column = column;
        cell.row = row;
        cell.level = level;
        cell.low_m = static_cast<float>(terrain.lowest_m);
        cell.high_m = static_cast<float>(terrain.highest_m);
        if (level == 0) {
          bound_heights(terrain, side, cell);
        } else if (inside(terrain.view.drawable[static_cast<std::size_t>(level - 1)], cell, span)) {
          continue;
        }
        place(terrain.view.lattice, span, cell);
        cells.push_back(cell);
      }
    }
  }
  return cells;
}

double box_area_px(const HybridCell& cell, const CellView& view) {
  const auto axes = (view.local.ecef_from_enu * view.camera.enu_from_camera).columns;
  std::array<glm::dvec2, 8> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 way = cell.corners[i].xyz - view.local.eye_ecef.xyz;
    const double depth_m = glm::dot(way, axes[2]);
    if (depth_m < least_depth_m) return std::numeric_limits<double>::infinity();
    points[i] = {view.camera.fx * glm::dot(way, axes[0]) / depth_m,
                 view.camera.fy * glm::dot(way, axes[1]) / depth_m};
  }
  return hull_area(points);
}

CellChoice choice_of(const HybridCell& cell, const CellView& view) {
  const glm::dvec3 way = cell.centre.xyz - view.local.eye_ecef.xyz;
  CellChoice choice;
  choice.distance_m = glm::length(way);
  if (!may_be_seen(cell, view, way)) return choice;
  if (box_area_px(cell, view) / view.side > view.t) {
    choice.kind = CellChoice::Kind::mesh;
    return choice;
  }
  choice.kind = CellChoice::Kind::cast;
  const double d_max_m = view.range_m / view.k;
  const double relief =
      view.relief_m > 0 ? static_cast<double>(cell.high_m - cell.low_m) / view.relief_m : 0.0;
  const double climb = glm::dot(way, cell.up) / choice.distance_m;
  const double cosine = std::sqrt(std::max(0.0, 1.0 - climb * climb));
  const double l = std::min(choice.distance_m, d_max_m) / d_max_m - relief * cosine;
  choice.precision = std::clamp(static_cast<int>(std::floor(4.0 * l)), 0, 3);
  return choice;
}

}  // namespace ridgeline::sim
