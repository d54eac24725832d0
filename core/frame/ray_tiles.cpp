#include "core/frame/ray_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/frame/ray_witness.hpp"
#include "core/frame/steep_ground.hpp"
#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double smallest_radius_m = 6'335'000.0;
constexpr double least_grip = 0.05;
constexpr double within_tile = 1.01;  ///< what is needed inside a tile against its corners
constexpr int angles_in_bin = 2;
constexpr double widest_turn_rad = 0.8;  ///< of the vertical within a tile
constexpr double neighbour_px = 0.7071;
constexpr int way_bins = 256;

/// From the largest on; the last: every pixel by itself.
constexpr std::array shapes{BlockShape{8, 8}, BlockShape{6, 6}, BlockShape{4, 4}, BlockShape{3, 3},
                            BlockShape{2, 2}, BlockShape{1, 2}, BlockShape{2, 1}, BlockShape{1, 1}};
constexpr std::size_t single = shapes.size() - 1, upright_pair = single - 2,
                      level_pair = single - 1;
constexpr double farthest_witness_px = 10.0;

class TilePlan {
 public:
  TilePlan(const Camera& camera, const RaySharing& sharing, const RayTileTables& tables,
           const TileAxis& across, const TileAxis& down)
      : camera_(camera),
        sharing_(sharing),
        tables_(tables),
        camera_from_enu_(glm::transpose(camera.enu_from_camera.columns)),
        across_(across),
        down_(down) {
    const glm::dvec3 up = camera_from_enu_ * glm::dvec3(0, 0, 1);
    left_out_ = std::abs(up.y) >= std::abs(up.x) ? level_pair : upright_pair;
    for (auto& of_shape : allowed_) {
      for (Steepest& of_other : of_shape) of_other.fill(-1.0F);
    }
  }

  /// Gives every tile but those at the border its shape: a pixel there may have no other above it.
  void choose_shapes();

 private:
  /// By the direction of the vertical, what ground may be so steep.
  using Steepest = std::array<float, way_bins>;

  /// How the picture of a tile lies; not known where the vertical itself is near.
  struct Look {
    bool known = false;
    double down_rad = -1;             ///< largest angle looked down
    double stretch = 0, skew = 0;     ///< largest, see Upright
    int first_bin = 0, last_bin = 0;  ///< of the direction of the vertical; may run over the ends
  };
  [[nodiscard]] Look look_at(const RayTile& tile) const;
  /// Made when first asked for.
  [[nodiscard]] double allowed(std::size_t shape, std::size_t other, std::size_t bin);
  [[nodiscard]] bool fits(std::size_t shape, std::size_t other, std::size_t tile, const Look& look);
  /// Makes the neighbours of a tile smaller until its pixels find their witnesses there as well.
  bool settle(int column, int row);

  const Camera& camera_;
  const RaySharing& sharing_;
  const RayTileTables& tables_;
  glm::dmat3 camera_from_enu_;
  TileAxis across_, down_;
  std::size_t largest_ = 0;  ///< first shape that the promise allows
  /// Of the two pairs the one that lies across: so every shape holds all smaller ones, and what a
  /// tile finds beside the largest of its neighbours it finds beside all.
  std::size_t left_out_ = level_pair;
  /// For blocks of one shape beside blocks of another; negative: not made yet.
  std::array<std::array<Steepest, shapes.size()>, shapes.size()> allowed_{};
};

double TilePlan::allowed(std::size_t shape, std::size_t other, std::size_t bin) {
  float& kept = allowed_[shape][other][bin];
  if (kept >= 0) return static_cast<double>(kept);
  const double reach_px = std::min(sharing_.bound_px + neighbour_px, farthest_witness_px);
  double steepest = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= angles_in_bin; ++k) {
    const double angle = std::numbers::pi *
                         (static_cast<double>(bin) + static_cast<double>(k) / angles_in_bin) /
                         way_bins;
    steepest = std::min(
        steepest,
        steepest_for_block(shapes[shape], shapes[other], {std::cos(angle), std::sin(angle)},
                           reach_px, sharing_.geometry_px,
                           shape == other && ray_tile_px % shapes[shape].width == 0 &&
                               ray_tile_px % shapes[shape].height == 0));
  }
  steepest =
      std::tan(std::atan(steepest) - 1.25 * 0.5 * std::numbers::pi / way_bins / angles_in_bin);
  kept = static_cast<float>(steepest);
  return steepest;
}

TilePlan::Look TilePlan::look_at(const RayTile& tile) const {
  const glm::dvec3 up = camera_from_enu_ * glm::dvec3(0, 0, 1);
  // The corners, and the point nearest to where the vertical meets the picture.
  const double east = tile.x() + tile.width(), south = tile.y() + tile.height();
  std::array<glm::dvec2, 5> points{glm::dvec2(tile.x(), tile.y()), glm::dvec2(east, tile.y()),
                                   glm::dvec2(tile.x(), south), glm::dvec2(east, south),
                                   glm::dvec2(tile.x(), tile.y())};
  if (std::abs(up.z) > 1e-6) {
    const glm::dvec2 foot(camera_.cx + camera_.fx * up.x / up.z,
                          camera_.cy + camera_.fy * up.y / up.z);
    const double grown_px = sharing_.bound_px + 2.0;
    if (foot.x > tile.x() - grown_px && foot.x < east + grown_px && foot.y > tile.y() - grown_px &&
        foot.y < south + grown_px) {
      return {};
    }
    points[4] = {std::clamp(foot.x, 1.0 * tile.x(), east),
                 std::clamp(foot.y, 1.0 * tile.y(), south)};
  }
  Look look;
  double first = 0, least = 0, most = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = (points[k].x - camera_.cx) / camera_.fx;
    const double y = (points[k].y - camera_.cy) / camera_.fy;
    const Upright upright = upright_at(camera_, x, y);
    if (!(upright.px_per_rad > 0)) return {};
    const glm::dvec3 ray = glm::normalize(glm::dvec3(x, y, 1.0));
    look.down_rad = std::max(look.down_rad, std::asin(std::clamp(-glm::dot(ray, up), -1.0, 1.0)));
    look.stretch = std::max(look.stretch, upright.px_per_rad / upright.beside_px_per_rad);
    look.skew = std::max(look.skew, std::abs(upright.skew));
    const double angle = std::atan2(upright.way.y, upright.way.x);
    if (k == 0) first = angle;
    const double turned = std::remainder(angle - first, std::numbers::pi);
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
  if (most - least > widest_turn_rad) return {};
  look.known = true;
  look.down_rad += sharing_.range_m / smallest_radius_m;
  const auto bin = [](double angle) {
    return static_cast<int>(std::floor(angle / std::numbers::pi * way_bins));
  };
  look.first_bin = bin(first + least);
  look.last_bin = bin(first + most);
  return look;
}

bool TilePlan::fits(std::size_t shape, std::size_t other, std::size_t index, const Look& look) {
  if (shape == single) return true;
  if (shape == left_out_ || tables_.steepness[index] == any_steepness) return false;
  if (!look.known) return false;
  const auto steepness = static_cast<double>(std::max(tables_.steepness[index], gentle_steepness));
  const double grip =
      look.down_rad > 0 ? std::cos(look.down_rad) - steepness * std::sin(look.down_rad) : 1.0;
  if (grip < least_grip) return false;
  const double sine = std::sin(std::max(look.down_rad, 0.0)), sine2 = sine * sine;
  const double needed =
      within_tile *
      (steepness / std::sqrt(1.0 - sine2 * (1.0 + steepness * steepness)) * look.stretch +
       look.skew);
  for (int bin = look.first_bin; bin <= look.last_bin; ++bin) {
    const int wrapped_bin = (bin % way_bins + way_bins) % way_bins;
    if (!(needed <= allowed(shape, other, static_cast<std::size_t>(wrapped_bin)))) return false;
  }
  return true;
}

bool TilePlan::settle(int column, int row) {
  const auto index_of = [&](int i, int j) {
    return static_cast<std::size_t>(j * across_.count() + i);
  };
  const std::size_t own = index_of(column, row);
  if (tables_.shapes[own] == single) return false;  // needs nothing of its neighbours
  const Look look = look_at(tables_.tiles[own]);
  bool changed = false;
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      std::uint8_t& beside = tables_.shapes[index_of(i, j)];
      while (!fits(tables_.shapes[own], beside, own, look)) {
        if (beside >= tables_.shapes[own] && beside < single) {
          tables_.shapes[own] = single;  // not even beside its like: not known to happen
        } else if (beside == single) {
          tables_.shapes[own] = single;
        } else {
          ++beside;
          const Look there = look_at(tables_.tiles[index_of(i, j)]);
          while (beside < single && !fits(beside, beside, index_of(i, j), there)) ++beside;
        }
        changed = true;
      }
    }
  }
  return changed;
}

void TilePlan::choose_shapes() {
  while (largest_ < single && shapes[largest_].radius_px() > sharing_.slack_px) ++largest_;
  const int columns = across_.count(), rows = down_.count();
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::fill_n(tables_.shapes.begin(), count, static_cast<std::uint8_t>(single));
  for (int j = 1; j + 1 < rows; ++j) {
    for (int i = 1; i + 1 < columns; ++i) {
      const auto k = static_cast<std::size_t>(j * columns + i);
      std::size_t shape = largest_;
      const Look look = look_at(tables_.tiles[k]);
      while (!fits(shape, shape, k, look)) ++shape;
      tables_.shapes[k] = static_cast<std::uint8_t>(shape);
    }
  }
  // Shapes only get smaller, so this ends.
  for (bool changed = true; changed;) {
    changed = false;
    for (int j = 1; j + 1 < rows; ++j) {
      for (int i = 1; i + 1 < columns; ++i) changed = settle(i, j) || changed;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const BlockShape& shape = shapes[tables_.shapes[k]];
    tables_.tiles[k].block = RayTile::pair(shape.width, shape.height);
  }
}

}  // namespace

RayTilePlan plan_ray_tiles(const TerrainKeeper& terrain, const LocalFrame& local,
                           const Camera& camera, const RaySharing& sharing,
                           const RayTileTables& tables) {
  const int ring_px = static_cast<int>(sharing.bound_px + neighbour_px) + 1;
  const bool polar = terrain.lattice().polar();  // its blocks have no east and north
  const bool small = std::min(camera.width_px, camera.height_px) < 4 * ring_px;
  const bool shared = !polar && !small && sharing.slack_px >= BlockShape{1, 2}.radius_px();
  const TileAxis across{camera.width_px, shared ? ring_px : 0};
  const TileAxis down{camera.height_px, shared ? ring_px : 0};
  RayTilePlan result;
  result.tiles = put_tiles(across, down, tables.tiles);
  if (shared) {
    const double margin_px = sharing.bound_px + neighbour_px + sharing.slack_px + 2.0;
    mark_steep_ground(terrain, local, camera, {sharing.range_m, margin_px},
                      {across, down, tables.steepness});
    TilePlan plan(camera, sharing, tables, across, down);
    plan.choose_shapes();
  }
  for (const RayTile& tile : tables.tiles.first(static_cast<std::size_t>(result.tiles))) {
    const BlockShape shape = tile.shape();
    result.rays += ((tile.width() + shape.width - 1) / shape.width) *
                   ((tile.height() + shape.height - 1) / shape.height);
    result.shared_px = std::max(result.shared_px, shape.radius_px());
  }
  return result;
}

}  // namespace ridgeline
