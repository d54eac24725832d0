#include "core/frame/level_error.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "config/limits.hpp"
#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double view_margin_rad = 0.09;      ///< the disc of the largest bound
constexpr double down_margin_rad = 2e-3;      ///< the length of a block's part
constexpr double widest_off_axis_rad = 1.45;  ///< farther off, a block counts for the whole picture
constexpr double smallest_radius_m = 6'335'000.0;
constexpr double chord_share = 0.99;  ///< of a distance in latitude and longitude, at 200 km
constexpr double neighbour_px = 0.7071;
constexpr double all_neighbours_px = 4.0;  ///< so far every pixel is tried
constexpr double between_corners = 0.995;  ///< a part's inside against its corners
constexpr double slant_slack = 0.97e-4;    ///< of the contract's 1e-4 along the ray
constexpr double least_grip = 0.05;        ///< below it a turn of the ray wins no height
constexpr TurnRads turn_px{1.05 * (1.0 + neighbour_px), 7.0, 64.0};
constexpr int most_cuts = 4;

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

/// Upper bound on the distance over ground from the eye to the farthest corner of a place.
double far_over_ground_m(const TerrainView& view, const Place& place, double latitude_deg) {
  constexpr double largest_radius_m = 6'400'000.0, chord = 1.01;
  const PostRect& r = place.rect;
  const double north_deg =
      std::max(r.north - view.eye_row, view.eye_row - r.south) * view.lattice.latitude_step_deg;
  const double widest =
      view.lattice.polar()
          ? 1.01
          : std::cos(std::max(0.0, std::abs(latitude_deg) - north_deg) * rad_per_deg);
  const double east_deg = std::max(r.east - view.eye_column, view.eye_column - r.west) *
                          view.lattice.longitude_step_deg * widest;
  return chord * largest_radius_m * rad_per_deg * std::hypot(north_deg, east_deg);
}

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

/// Calls use(part) for the parts of the picture that a block may stand behind.
template <typename Use>
void over_parts(const Camera& camera, const Sight& sight, LevelError& error, const Use& use) {
  const auto first = [](double low, double size_px, double centre, double focal, int count) {
    const double at = (low * focal + centre) / size_px * count;
    return static_cast<int>(std::clamp(std::floor(at), 0.0, count - 1.0));
  };
  const int x0 = first(sight.x - sight.reach, camera.width_px, camera.cx, camera.fx, error.columns);
  const int x1 = first(sight.x + sight.reach, camera.width_px, camera.cx, camera.fx, error.columns);
  const int y0 = first(sight.y - sight.reach, camera.height_px, camera.cy, camera.fy, error.rows);
  const int y1 = first(sight.y + sight.reach, camera.height_px, camera.cy, camera.fy, error.rows);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x)
      use(error.parts[static_cast<std::size_t>(y * error.columns + x)]);
  }
}

void mark(const SlantedTurn& turn, double residual_m, double steepness, LevelError::Part& part) {
  part.residual = part.residual || residual_m > 0;
  part.steepness = std::max(part.steepness, steepness);
  for (std::size_t k = 0; k < turn_sizes; ++k) {
    part.angle_rad[k] = std::max(part.angle_rad[k], turn.angle_rad[k]);
    part.grip[k] = std::min(part.grip[k], turn.grip[k]);
  }
}

/// Upper bound on the angle below the level at which the picture looks down anywhere.
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
  return std::min(deepest + diagonal, 0.5 * std::numbers::pi);
}

/// Calls use(part, upright) for the four corners of every part that shows a coarse block.
template <typename Use>
void over_corners(const Camera& camera, const LevelError& error, const Use& use) {
  for (int k = 0; k < error.columns * error.rows; ++k) {
    const LevelError::Part& part = error.parts[static_cast<std::size_t>(k)];
    if (!part.residual) continue;
    for (int corner = 0; corner < 4; ++corner) {
      const double x = tangent(k % error.columns + corner % 2, error.columns, camera.width_px,
                               camera.cx, camera.fx);
      const double y = tangent(k / error.columns + corner / 2, error.rows, camera.height_px,
                               camera.cy, camera.fy);
      use(part, upright_at(camera, x, y));
    }
  }
}

/// One frame's view of the window, block part by block part.
class Levels {
 public:
  Levels(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
         double clearance_m)
      : levels_(terrain.levels()),
        view_(terrain.view()),
        local_(local),
        camera_(camera),
        clearance_m_(clearance_m),
        half_diagonal_rad_(camera.half_diagonal_rad(0.0)),
        look_rad_(steepest_look_rad(camera)) {
    const double reach_deg = std::abs(local.eye.latitude_deg) + 3.0;
    const double east_deg =
        view_.lattice.longitude_step_deg * narrowest(view_.lattice, std::min(reach_deg, 89.9));
    post_m_ = smallest_radius_m * rad_per_deg * std::min(view_.lattice.latitude_step_deg, east_deg);
  }

  /// What must not be drawn, where the first residual is, and how steep the ground is.
  void survey(double range_m, LevelError& error);
  [[nodiscard]] double nearest_m() const { return nearest_m_; }
  /// Marks the parts of the picture; false where the range had to be cut and all is to be redone.
  bool mark_parts(LevelError& error) const;

 private:
  struct Reach {
    double away_m, far_m, down_rad;  ///< bounds on distance and on the angle looked down
  };
  /// Calls use(level, block, part, reach) for every part, drawn in range, of the blocks that
  /// wants(block) names.
  template <typename Wants, typename Use>
  void over_drawn(double range_m, const Wants& wants, const Use& use) const;
  [[nodiscard]] Sight sight(const HeldBlock& block) const {
    return sight_of(block.facts, local_, camera_, half_diagonal_rad_);
  }
  /// Whether near exact ground can stand before ground with a residual.
  [[nodiscard]] bool stands_before(const BlockFacts& facts, double far_m) const;

  const TerrainLevels& levels_;
  TerrainView view_;
  const LocalFrame& local_;
  const Camera& camera_;
  double clearance_m_, half_diagonal_rad_, look_rad_;
  double post_m_ = 0;  ///< smallest distance of two finest posts
  double nearest_m_ = std::numeric_limits<double>::infinity();  ///< to a residual
  double lowest_m_ = std::numeric_limits<double>::infinity();   ///< ground from there on
};

template <typename Wants, typename Use>
void Levels::over_drawn(double range_m, const Wants& wants, const Use& use) const {
  const double latitude_deg = local_.eye.latitude_deg;
  for (int level = 0; level < view_.sizes.levels; ++level) {
    const PostRect finer =
        level > 0 ? view_.drawable[static_cast<std::size_t>(level - 1)] : PostRect{};
    const double inner_m = distance_out_m(view_, finer, latitude_deg);
    levels_.over_valid(level, [&](const HeldBlock& block) {
      if (!wants(block)) return;
      const BlockFacts& facts = block.facts;
      const double above_m = local_.eye.height_m - static_cast<double>(facts.highest_m);
      const double deep_m = local_.eye.height_m - static_cast<double>(facts.lowest_m);
      const double sight_m = look_rad_ > 0 ? above_m / std::sin(look_rad_) : above_m;
      const double least_m = std::max({sight_m, inner_m, clearance_m_, 0.05});
      for (int part = 0; part < residual_parts * residual_parts; ++part) {
        const Place place = place_of(block.id, part);
        if (level > 0 && place.inside(finer)) continue;
        const double over_ground_m = place.from_eye_m(view_, latitude_deg);
        const double away_m = std::max(over_ground_m, least_m);
        if (away_m > range_m) continue;
        const double far_m = far_over_ground_m(view_, place, latitude_deg);
        const double down_rad =
            std::atan2(deep_m, over_ground_m) + over_ground_m / smallest_radius_m + down_margin_rad;
        use(level, block, static_cast<std::size_t>(part),
            Reach{away_m, std::hypot(far_m, deep_m), std::min(down_rad, look_rad_)});
      }
    });
  }
}

void Levels::survey(double range_m, LevelError& error) {
  error.clear_range_m = range_m;
  const auto wants = [&](const HeldBlock& block) {
    if (block.facts.mixed) return true;
    const bool steeper = static_cast<double>(block.facts.steepness) > error.steepest;
    return (block.facts.residual_m > 0 || steeper) && sight(block).seen;
  };
  over_drawn(
      range_m, wants, [&](int, const HeldBlock& block, std::size_t part, const Reach& reach) {
        const BlockFacts& facts = block.facts;
        if (facts.mixed) {
          error.clear_range_m = std::min(error.clear_range_m, chord_share * reach.away_m);
          return;
        }
        error.steepest = std::max(error.steepest, static_cast<double>(facts.part_steepness[part]));
        if (!(facts.part_residual_m[part] > 0)) return;
        nearest_m_ = std::min(nearest_m_, reach.away_m);
        lowest_m_ = std::min(lowest_m_, static_cast<double>(facts.lowest_m));
      });
}

bool Levels::stands_before(const BlockFacts& facts, double far_m) const {
  const double deep_m = local_.eye.height_m - lowest_m_;
  if (deep_m <= 0) return true;
  return static_cast<double>(facts.highest_m) >=
         local_.eye.height_m - deep_m * (far_m / std::max(nearest_m_, 1.0)) - 1.0;
}

bool Levels::mark_parts(LevelError& error) const {
  if (!(nearest_m_ <= error.clear_range_m)) return true;
  const TurnRads limits = turn_limits_rad(camera_);
  Sight at;
  const auto wants = [&](const HeldBlock& block) {
    at = sight(block);
    return at.seen && !block.facts.mixed;
  };
  double cut_m = error.clear_range_m;
  over_drawn(error.clear_range_m, wants,
             [&](int level, const HeldBlock& block, std::size_t part, const Reach& reach) {
               const BlockFacts& facts = block.facts;
               const auto residual_m = static_cast<double>(facts.part_residual_m[part]);
               const auto steepness = static_cast<double>(facts.part_steepness[part]);
               // Exact ground nearer than every residual matters only for what it hides.
               const bool behind = residual_m > 0 || reach.far_m >= nearest_m_;
               if (!behind && !stands_before(facts, reach.far_m)) return;
               SlantedTurn turn;
               if (behind) {
                 turn = slanted_turn({reach.away_m, reach.far_m, reach.down_rad, steepness,
                                      post_m_ * (region_margin << level), residual_m},
                                     limits);
                 if (!turn.possible) {
                   cut_m = std::min(cut_m, chord_share * reach.away_m);
                   return;
                 }
               }
               over_parts(camera_, at, error, [&](LevelError::Part& shown) {
                 mark(turn, residual_m, steepness, shown);
               });
             });
  if (cut_m >= error.clear_range_m) return true;
  error.clear_range_m = cut_m;
  return false;
}

}  // namespace

TurnRads turn_limits_rad(const Camera& camera) {
  TurnRads limits{};
  for (std::size_t k = 0; k < turn_sizes; ++k) {
    limits[k] = turn_px[k] / std::min(camera.fx, camera.fy);
  }
  return limits;
}

SlantedTurn slanted_turn(const SlantedGround& ground, const TurnRads& limits) {
  SlantedTurn turn;
  const double level_rad = ground.residual_m / ground.away_m;
  turn.angle_rad.fill(level_rad);
  if (ground.down_rad <= 0) return turn;
  bool fits = false;
  for (std::size_t k = 0; k < turn_sizes; ++k) {
    const double down = ground.down_rad + limits[k];
    const double sine = std::sin(down), cosine = std::cos(down);
    const double grip = cosine - ground.steepness * sine;
    const double slip = limits[k] * sine / std::max(cosine, 1e-9) - slant_slack;
    if (slip <= 0 && cosine > 0) {  // the contract lets go what the turn takes of the distance
      turn.grip[k] = 1;
    } else if (grip >= least_grip && slip * ground.far_m * cosine <= ground.ring_m) {
      turn.grip[k] = grip;
      const double let_go = slant_slack * (ground.steepness * cosine + sine);
      if (level_rad > 0) turn.angle_rad[k] = std::max(level_rad, (level_rad - let_go) / grip);
    } else {
      turn.grip[k] = 0;
    }
    fits = fits || (turn.grip[k] > 0 && turn.angle_rad[k] <= limits[k]);
  }
  turn.possible = fits && turn.grip[0] > 0;
  return turn;
}

double LevelError::Part::turn_rad(const TurnRads& limits, double geometry_rad) const {
  for (std::size_t k = 0; k < turn_sizes; ++k) {
    const double needed_rad = angle_rad[k] + geometry_rad;
    if (grip[k] > 0 && needed_rad <= limits[k]) return needed_rad;
  }
  return std::numeric_limits<double>::infinity();
}

LevelError level_error(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       double range_m, double clearance_m) {
  LevelError error;
  Levels levels(terrain, local, camera, clearance_m);
  levels.survey(range_m, error);
  error.known_range_m = error.clear_range_m;
  error.exact_range_m = std::min(error.clear_range_m, chord_share * levels.nearest_m());
  for (int cut = 0; !levels.mark_parts(error); ++cut) {
    error.parts = {};
    if (cut == most_cuts) error.clear_range_m = 0;
    if (error.clear_range_m < limits::min_range_m) return error;
  }
  const double edge = std::cos(camera.half_diagonal_rad(0.0));
  const double largest_px_per_rad = std::max(camera.fx, camera.fy) / (edge * edge);
  const TurnRads limits = turn_limits_rad(camera);
  over_corners(camera, error, [&](const LevelError::Part& part, const Upright& upright) {
    const double px_per_rad =
        upright.px_per_rad > 0 ? upright.px_per_rad / between_corners : largest_px_per_rad;
    error.angle_px = std::max(error.angle_px, part.turn_rad(limits, 0.0) * px_per_rad);
  });
  return error;
}

bool stays_complete(const Camera& camera, double epsilon_px, const LevelError& error,
                    double geometry_rad) {
  const double reach = epsilon_px + neighbour_px;
  const double beside_px_per_rad = std::min(camera.fx, camera.fy);
  const double half_diagonal_rad = camera.half_diagonal_rad(0.0);
  const TurnRads limits = turn_limits_rad(camera);
  bool complete = true;
  over_corners(camera, error, [&](const LevelError::Part& part, const Upright& upright) {
    if (!complete) return;
    if (upright.px_per_rad <= 0) {  // looking straight down, no pixel is above or below another
      complete = false;
      return;
    }
    double best = -1;
    const auto try_neighbour = [&](double i, double j, double share) {
      const double above = i * upright.way.x + j * upright.way.y;
      if (above <= 0 || std::hypot(i, j) > reach) return;
      const double turn_rad = above / upright.px_per_rad;
      std::size_t k = 0;
      while (k < turn_sizes && turn_rad / share > limits[k]) ++k;
      if (k == turn_sizes || part.grip[k] <= 0) return;
      const double beside = std::abs(i * upright.way.y - j * upright.way.x) / beside_px_per_rad;
      best = std::max(best, share * turn_rad - part.steepness * beside / part.grip[k] -
                                part.angle_rad[k] - geometry_rad);
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
    complete = best >= 0 && part.turn_rad(limits, geometry_rad) <= limits.back();
  });
  return complete;
}

}  // namespace ridgeline
