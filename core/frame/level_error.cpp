#include "core/frame/level_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double view_margin_rad = 0.09;      ///< the disc of the largest bound
constexpr double down_margin_rad = 2e-3;      ///< the turn itself, and the length of a block's part
constexpr double widest_off_axis_rad = 1.45;  ///< farther off, a block counts for the whole picture
constexpr double smallest_radius_m = 6'335'000.0;
constexpr double chord_share = 0.99;  ///< of a distance in latitude and longitude, at 200 km
constexpr double neighbour_px = 0.7071;
constexpr double all_neighbours_px = 4.0;  ///< so far every pixel is tried
constexpr double between_corners = 0.995;  ///< a part's inside against its corners
constexpr double slant_slack = 0.97e-4;    ///< of the contract's 1e-4 along the ray
constexpr double near_vertical = 0.2;      ///< sine of the angle to straight up or down
constexpr double least_grip = 0.05;        ///< below it a turn of the ray wins no height
constexpr double steep_grip = 0.3;
constexpr double no_bound_rad = 1e3;

/// The shortest a degree between columns gets up to a latitude, over one of the smallest radius. In
/// a polar chart, where one is a degree of a circle round the pole, it is longer than that.
double narrowest(const PostLattice& lattice, double latitude_deg) {
  return lattice.polar() ? 1.0 : std::cos(std::min(latitude_deg, 90.0) * rad_per_deg);
}

/// Lower bound on the distance from the eye to everything outside a rectangle of posts.
double distance_out_m(const TerrainView& view, const PostRect& rect, double latitude_deg) {
  if (rect.empty()) return 0.0;
  const double rows = std::min(view.eye_row - rect.south, rect.north - view.eye_row);
  const double columns = std::min(view.eye_column - rect.west, rect.east - view.eye_column);
  if (rows <= 0 || columns <= 0) return 0.0;
  // Sideways the way out may lead north first, where posts are narrower: by no more than `rows`.
  const double narrow =
      narrowest(view.lattice, std::abs(latitude_deg) + rows * view.lattice.latitude_step_deg);
  const double north_m = rows * view.lattice.latitude_step_deg;
  const double east_m = columns * view.lattice.longitude_step_deg * narrow;
  return chord_share * smallest_radius_m * rad_per_deg * std::min(north_m, east_m);
}

/// A rectangle of posts, and how far it is from the eye.
struct Place {
  PostRect rect;
  [[nodiscard]] bool inside(const PostRect& other) const {
    return rect.west >= other.west && rect.south >= other.south && rect.east <= other.east &&
           rect.north <= other.north;
  }
  [[nodiscard]] double from_eye_m(const TerrainView& view, double latitude_deg) const {
    const double rows = std::max({0.0, rect.south - view.eye_row, view.eye_row - rect.north});
    const double columns =
        std::max({0.0, rect.west - view.eye_column, view.eye_column - rect.east});
    // A block to the north or south is as narrow as its far edge.
    const double reach =
        std::max(std::abs(rect.south - view.eye_row), std::abs(rect.north - view.eye_row));
    const double farthest_deg = std::abs(latitude_deg) + reach * view.lattice.latitude_step_deg;
    const double north_deg = rows * view.lattice.latitude_step_deg;
    const double east_deg =
        columns * view.lattice.longitude_step_deg * narrowest(view.lattice, farthest_deg);
    return chord_share * smallest_radius_m * rad_per_deg * std::hypot(north_deg, east_deg);
  }
};

Place place_of(const BlockId& id, int part) {
  const std::int32_t span = block_posts << id.level, side = span / residual_parts;
  const std::int32_t west = id.column * span + part % residual_parts * side;
  const std::int32_t south = id.row * span + part / residual_parts * side;
  return {{west, south, west + side, south + side}};
}

/// Where a block lies in the picture: a square round its middle, in tangents of the two axes.
struct Sight {
  bool seen = false;
  double x = 0, y = 0, reach = 0;
};

Sight sight_of(const BlockFacts& facts, const LocalFrame& local, const Camera& camera,
               double half_diagonal_rad) {
  const Vec3<Enu> way = local.ecef_from_enu.inverse() * (facts.centre - local.eye_ecef);
  const double far = glm::length(way.xyz);
  const glm::dvec3 in_camera = glm::transpose(camera.enu_from_camera.columns) * way.xyz;
  const double spread = far > facts.radius_m ? std::asin(facts.radius_m / far) : std::numbers::pi;
  const double off_axis = std::acos(std::clamp(in_camera.z / std::max(far, 1.0), -1.0, 1.0));
  Sight sight;
  sight.seen = off_axis - spread <= half_diagonal_rad + view_margin_rad;
  if (off_axis + spread >= widest_off_axis_rad) {
    sight.reach = 1e9;
    return sight;
  }
  sight.x = in_camera.x / in_camera.z;
  sight.y = in_camera.y / in_camera.z;
  sight.reach = std::tan(off_axis + spread) - std::tan(off_axis) + view_margin_rad;
  return sight;
}

double tangent(double index, int count, double size_px, double centre_px, double focal_px) {
  return (size_px * index / count - centre_px) / focal_px;
}

void mark(const Camera& camera, const Sight& sight, double angle_rad, double steepness,
          LevelError& error) {
  const auto first = [](double low, double size_px, double centre, double focal, int count) {
    const double at = (low * focal + centre) / size_px * count;
    return static_cast<int>(std::clamp(std::floor(at), 0.0, count - 1.0));
  };
  const int x0 = first(sight.x - sight.reach, camera.width_px, camera.cx, camera.fx, error.columns);
  const int x1 = first(sight.x + sight.reach, camera.width_px, camera.cx, camera.fx, error.columns);
  const int y0 = first(sight.y - sight.reach, camera.height_px, camera.cy, camera.fy, error.rows);
  const int y1 = first(sight.y + sight.reach, camera.height_px, camera.cy, camera.fy, error.rows);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      LevelError::Part& part = error.parts[static_cast<std::size_t>(y * error.columns + x)];
      part.angle_rad = std::max(part.angle_rad, angle_rad);
      part.steepness = std::max(part.steepness, steepness);
    }
  }
}

/// Upper bound on the angle below the level at which the picture, grown by the disc of the largest
/// bound, looks down anywhere.
double steepest_look_rad(const Camera& camera) {
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  const double between_rad = 0.5 * std::max(camera.width_px / camera.fx / LevelError::columns,
                                            camera.height_px / camera.fy / LevelError::rows);
  double deepest = -0.5 * std::numbers::pi;
  for (int j = 0; j <= LevelError::rows; ++j) {
    for (int i = 0; i <= LevelError::columns; ++i) {
      const double x = tangent(i, LevelError::columns, camera.width_px, camera.cx, camera.fx);
      const double y = tangent(j, LevelError::rows, camera.height_px, camera.cy, camera.fy);
      const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
      deepest = std::max(deepest, std::asin(std::clamp(-glm::dot(ray, up), -1.0, 1.0)));
    }
  }
  const double diagonal = std::numbers::sqrt2 * between_rad;
  return std::min(deepest + diagonal + view_margin_rad, 0.5 * std::numbers::pi);
}

/// By what angle a ray must turn to make up for a surface that is off by `residual_m` at a
/// distance. A ray that looks down gains less height along its way by a turn, the more so as the
/// ground rises towards it: at 90 degrees none, and distances to level ground cannot be bounded at
/// all.
///
/// Both rays end over the same ground, but the higher one is shorter by turn * tan(down_rad): that
/// much of the distance the contract lets go.
/// `strict`: no bound where the ground is too steep for a turn to win height; else the turn is
/// taken for ground that leaves it `steep_grip` (docs/error_bound.md, section 11, says what that
/// leaves open).
double turn_rad(double residual_m, double away_m, double down_rad, double steepness, bool strict) {
  if (residual_m <= 0) return 0.0;
  const double level_rad = residual_m / away_m;
  if (level_rad * std::sin(down_rad) <= slant_slack * std::cos(down_rad)) return level_rad;
  const double grip = std::cos(down_rad) - steepness * std::sin(std::max(down_rad, 0.0));
  if (!strict) return residual_m / (away_m * std::max(grip, steep_grip));
  return grip > least_grip ? residual_m / (away_m * grip) : no_bound_rad;
}

/// How the picture moves at an image point when a ray turns within its vertical plane.
struct Upright {
  glm::dvec2 way{0.0};    ///< direction in the picture, of length 1
  double px_per_rad = 0;  ///< 0 where planes converge
};

Upright upright_at(const Camera& camera, double x, double y) {
  const glm::dvec3 up = glm::transpose(camera.enu_from_camera.columns) * glm::dvec3(0, 0, 1);
  const glm::dvec2 along(camera.fx * (up.x - x * up.z), camera.fy * (up.y - y * up.z));
  const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
  const double sine = glm::length(up - glm::dot(up, ray) * ray);
  const double px = glm::length(along);
  if (sine < near_vertical || px < 1e-6) return {};
  return {along / px, px * std::sqrt(1.0 + x * x + y * y) / sine};
}

/// Calls use(part, upright) for the four corners of every part that shows a coarse block.
template <typename Use>
void over_corners(const Camera& camera, const LevelError& error, const Use& use) {
  for (int k = 0; k < error.columns * error.rows; ++k) {
    const LevelError::Part& part = error.parts[static_cast<std::size_t>(k)];
    if (part.angle_rad <= 0) continue;
    for (int corner = 0; corner < 4; ++corner) {
      const double x = tangent(k % error.columns + corner % 2, error.columns, camera.width_px,
                               camera.cx, camera.fx);
      const double y = tangent(k / error.columns + corner / 2, error.rows, camera.height_px,
                               camera.cy, camera.fy);
      use(part, upright_at(camera, x, y));
    }
  }
}

}  // namespace

LevelError level_error(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       double range_m, double clearance_m) {
  const TerrainView view = terrain.view();
  const double latitude_deg = local.eye.latitude_deg;
  const double half_diagonal_rad = camera.half_diagonal_rad(0.0);
  const double look_rad = steepest_look_rad(camera);
  const bool strict = view.lattice.polar();
  LevelError error;
  error.clear_range_m = range_m;
  for (int level = 0; level < view.sizes.levels; ++level) {
    const PostRect finer =
        level > 0 ? view.drawable[static_cast<std::size_t>(level - 1)] : PostRect{};
    const double inner_m = distance_out_m(view, finer, latitude_deg);
    terrain.levels().over_valid(level, [&](const HeldBlock& block) {
      const BlockFacts& facts = block.facts;
      if (!(facts.residual_m > 0) && !facts.mixed) return;
      const double above_m = local.eye.height_m - static_cast<double>(facts.highest_m);
      const double sight_m = look_rad > 0 ? above_m / std::sin(look_rad) : above_m;
      const double least_m = std::max({sight_m, inner_m, clearance_m, 0.05});
      double angle_rad = 0;
      for (int part = 0; part < residual_parts * residual_parts; ++part) {
        const Place place = place_of(block.id, part);
        if (level > 0 && place.inside(finer)) continue;
        const double over_ground_m = place.from_eye_m(view, latitude_deg);
        const double away_m = std::max(over_ground_m, least_m);
        if (away_m > range_m) continue;
        if (facts.mixed) error.clear_range_m = std::min(error.clear_range_m, chord_share * away_m);
        const auto residual_m =
            static_cast<double>(facts.part_residual_m[static_cast<std::size_t>(part)]);
        const double deep_m = local.eye.height_m - static_cast<double>(facts.lowest_m);
        const double down_rad =
            std::atan2(deep_m, over_ground_m) + over_ground_m / smallest_radius_m + down_margin_rad;
        angle_rad = std::max(angle_rad, turn_rad(residual_m, away_m, std::min(down_rad, look_rad),
                                                 static_cast<double>(facts.steepness), strict));
      }
      if (facts.mixed || angle_rad <= 0) return;
      const Sight sight = sight_of(facts, local, camera, half_diagonal_rad);
      if (!sight.seen) return;
      mark(camera, sight, angle_rad, static_cast<double>(facts.steepness), error);
    });
  }
  const double edge = std::cos(half_diagonal_rad);
  const double largest_px_per_rad = std::max(camera.fx, camera.fy) / (edge * edge);
  over_corners(camera, error, [&](const LevelError::Part& part, const Upright& upright) {
    const double px_per_rad =
        upright.px_per_rad > 0 ? upright.px_per_rad / between_corners : largest_px_per_rad;
    error.angle_px = std::max(error.angle_px, part.angle_rad * px_per_rad);
  });
  return error;
}

bool stays_complete(const Camera& camera, double epsilon_px, const LevelError& error,
                    double geometry_rad) {
  const double reach = epsilon_px + neighbour_px;
  const double beside_px_per_rad = std::min(camera.fx, camera.fy);
  const double half_diagonal_rad = camera.half_diagonal_rad(0.0);
  bool complete = true;
  over_corners(camera, error, [&](const LevelError::Part& part, const Upright& upright) {
    if (upright.px_per_rad <= 0 || !complete) return;
    double best = 0;
    const auto try_neighbour = [&](double i, double j, double share) {
      if (std::hypot(i, j) > reach) return;
      const double above = i * upright.way.x + j * upright.way.y;
      const double beside = std::abs(i * upright.way.y - j * upright.way.x);
      best = std::max(
          best, share * above / upright.px_per_rad - part.steepness * beside / beside_px_per_rad);
    };
    const int near = static_cast<int>(std::min(reach, all_neighbours_px));
    for (int j = -near; j <= near; ++j) {
      for (int i = -near; i <= near; ++i) try_neighbour(i, j, between_corners);
    }
    // Farther off, those next to the image of the vertical; away from the axis of the picture a
    // pixel is a smaller angle.
    for (int k = near + 1; k <= static_cast<int>(reach); ++k) {
      const double bent = 2.0 * std::tan(half_diagonal_rad) * k / beside_px_per_rad;
      try_neighbour(std::round(k * upright.way.x), std::round(k * upright.way.y),
                    between_corners - bent);
    }
    complete = best >= part.angle_rad + geometry_rad;
  });
  return complete;
}

}  // namespace ridgeline
