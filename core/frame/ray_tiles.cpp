#include "core/frame/ray_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/frame/ray_witness.hpp"
#include "core/frame/upright.hpp"

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double smallest_radius_m = 6'335'000.0, largest_radius_m = 6'400'000.0;
constexpr float every_pixel = std::numeric_limits<float>::infinity();  ///< steepness: no sharing
constexpr float gentle = 0.05F;         ///< ground up to here counts as so steep everywhere
constexpr double least_depth_m = 0.01;  ///< before the camera: nearer ground is none
constexpr double least_grip = 0.05;
constexpr double beside_rad = 0.1;    ///< beside the picture: more than any margin
constexpr double within_tile = 1.05;  ///< what is needed inside a tile against its corners
constexpr double within_bin = 0.97;   ///< what is allowed between the angles asked
constexpr int angles_in_bin = 8;
constexpr double widest_turn_rad = 0.8;  ///< of the vertical within a tile
constexpr double neighbour_px = 0.7071;
constexpr int way_bins = 64;

/// From the largest on; the last: every pixel by itself.
constexpr std::array shapes{BlockShape{8, 8}, BlockShape{6, 6}, BlockShape{4, 4}, BlockShape{3, 3},
                            BlockShape{2, 2}, BlockShape{1, 2}, BlockShape{2, 1}, BlockShape{1, 1}};
constexpr std::size_t single = shapes.size() - 1, upright_pair = single - 2,
                      level_pair = single - 1;
constexpr double farthest_witness_px = 10.0;

/// A box round some ground in the camera's axes: its middle and three half edges.
struct GroundBox {
  glm::dvec3 middle{0.0};
  std::array<glm::dvec3, 3> half{};
};

/// Where ground shows in the picture, in tiles, both included; empty when x0 > x1.
struct TileRect {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

class TilePlan {
 public:
  TilePlan(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
           const RaySharing& sharing, const RayTileTables& tables, const TileAxis& across,
           const TileAxis& down)
      : terrain_(terrain),
        view_(terrain.view()),
        local_(local),
        camera_(camera),
        sharing_(sharing),
        tables_(tables),
        enu_from_ecef_(local.ecef_from_enu.inverse()),
        camera_from_enu_(glm::transpose(camera.enu_from_camera.columns)),
        across_(across),
        down_(down),
        half_diagonal_rad_(camera.half_diagonal_rad(0.0)) {
    const glm::dvec3 up = camera_from_enu_ * glm::dvec3(0, 0, 1);
    left_out_ = std::abs(up.y) >= std::abs(up.x) ? level_pair : upright_pair;
    for (auto& of_shape : allowed_) {
      for (Steepest& of_other : of_shape) of_other.fill(-1.0);
    }
  }

  /// How steep the ground behind every tile may be.
  void mark_ground();
  /// Gives every tile but those at the border its shape: a pixel there may have no other above it.
  void choose_shapes();

 private:
  /// By the direction of the vertical, what ground may be so steep.
  using Steepest = std::array<double, way_bins>;

  struct HeightRange {
    double low_m, high_m;
  };
  /// Where a block is, in the camera's axes but for `way`.
  struct BlockPlace {
    Vec3<Enu> way;
    double slip_m = 0;  ///< by which its axes may be off
    glm::dvec3 middle{0.0}, east{0.0}, north{0.0};
    glm::dvec3 half_east{0.0}, half_north{0.0}, half_up{0.0};  ///< of a part
  };

  void mark_block(const HeldBlock& block);
  [[nodiscard]] BlockPlace place_of(const HeldBlock& block, bool unknown) const;
  void add_neighbours(const BlockId& id, HeightRange& range) const;
  [[nodiscard]] static GroundBox box_of(const BlockPlace& place, int part);
  [[nodiscard]] TileRect tiles_of(const GroundBox& box, double margin_px) const;
  void mark(const TileRect& rect, float steepness);
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

  const TerrainKeeper& terrain_;
  TerrainView view_;
  const LocalFrame& local_;
  const Camera& camera_;
  const RaySharing& sharing_;
  const RayTileTables& tables_;
  Rotation<Enu, Ecef> enu_from_ecef_;
  glm::dmat3 camera_from_enu_;
  TileAxis across_, down_;
  double half_diagonal_rad_;
  std::size_t largest_ = 0;  ///< first shape that the promise allows
  /// Of the two pairs the one that lies across: so every shape holds all smaller ones, and what a
  /// tile finds beside the largest of its neighbours it finds beside all.
  std::size_t left_out_ = level_pair;
  /// For blocks of one shape beside blocks of another; negative: not made yet.
  std::array<std::array<Steepest, shapes.size()>, shapes.size()> allowed_{};
};

TilePlan::BlockPlace TilePlan::place_of(const HeldBlock& block, bool unknown) const {
  const BlockFacts& facts = block.facts;
  const int span = block_posts << block.id.level;
  const double latitude_deg = view_.lattice.latitude_deg(block.id.row * span + span / 2);
  const double narrow = std::cos(std::clamp(latitude_deg, -89.0, 89.0) * rad_per_deg);
  const double north_m = largest_radius_m * rad_per_deg * view_.lattice.latitude_step_deg * span;
  const double east_m =
      largest_radius_m * rad_per_deg * view_.lattice.longitude_step_deg * span * narrow;
  BlockPlace place;
  place.way = enu_from_ecef_ * (facts.centre - local_.eye_ecef);
  const auto highest_m = static_cast<double>(facts.highest_m);
  const double lowest_m = std::min(static_cast<double>(facts.lowest_m), highest_m);
  // Floors of unknown ground have walls down to the ground beside them, which may be another
  // block's.
  HeightRange range{lowest_m, highest_m};
  if (unknown) add_neighbours(block.id, range);
  // East, north and up over there are those here but for the bend of the Earth between.
  const double far = glm::length(place.way.xyz) / smallest_radius_m;
  const double reach_deg = std::min(std::abs(latitude_deg) + 2.0, 88.0);
  const double bend = far * (1.0 + std::tan(reach_deg * rad_per_deg));
  const double rise_m = range.high_m - range.low_m;
  place.slip_m = bend * (std::hypot(east_m, north_m) + rise_m) + 20.0;
  const double raised_m = 0.5 * (range.low_m + range.high_m) - 0.5 * (lowest_m + highest_m);
  place.middle = camera_from_enu_ * (place.way.xyz + glm::dvec3(0.0, 0.0, raised_m));
  place.east = camera_from_enu_[0] * east_m;
  place.north = camera_from_enu_[1] * north_m;
  place.half_up = camera_from_enu_[2] * (0.5 * rise_m + place.slip_m);
  // A cell of the next block that uses a post of this one belongs to this one, too.
  constexpr double half = 0.5 / residual_parts + 2.0 / block_posts;
  place.half_east = place.east * half + camera_from_enu_[0] * place.slip_m;
  place.half_north = place.north * half + camera_from_enu_[1] * place.slip_m;
  return place;
}

void TilePlan::add_neighbours(const BlockId& id, HeightRange& range) const {
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const HeldBlock* beside =
          terrain_.levels().find({id.level, id.column + column, id.row + row});
      if (beside == nullptr || beside->facts.known_posts == 0) continue;
      range.low_m = std::min(range.low_m, static_cast<double>(beside->facts.lowest_m));
      range.high_m = std::max(range.high_m, static_cast<double>(beside->facts.highest_m));
    }
  }
}

GroundBox TilePlan::box_of(const BlockPlace& place, int part) {
  const double parts = residual_parts;
  const double east = (part % residual_parts + 0.5) / parts - 0.5;
  const double north = static_cast<double>(part / residual_parts) / parts + 0.5 / parts - 0.5;
  return {place.middle + place.east * east + place.north * north,
          {place.half_east, place.half_north, place.half_up}};
}

/// Grows a rectangle of image points by where a point of space shows.
struct ImageRect {
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;

  void add(const Camera& camera, const glm::dvec3& p) {
    const double u = camera.cx + camera.fx * p.x / p.z, v = camera.cy + camera.fy * p.y / p.z;
    x0 = std::min(x0, u), x1 = std::max(x1, u);
    y0 = std::min(y0, v), y1 = std::max(y1, v);
  }
};

TileRect TilePlan::tiles_of(const GroundBox& box, double margin_px) const {
  std::array<glm::dvec3, 8> corners;
  bool behind = false;
  for (std::size_t k = 0; k < 8; ++k) {
    corners[k] = box.middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[k] += (k >> axis & 1U) == 1 ? box.half[axis] : -box.half[axis];
    }
    behind = behind || corners[k].z < least_depth_m;
  }
  ImageRect image;  // of what of the box is before the eye
  for (std::size_t k = 0; k < 8; ++k) {
    const glm::dvec3& p = corners[k];
    if (p.z >= least_depth_m) image.add(camera_, p);
    for (std::size_t axis = 0; behind && axis < 3; ++axis) {
      const glm::dvec3& q = corners[k ^ (std::size_t{1} << axis)];
      if (p.z >= least_depth_m || q.z < least_depth_m) continue;
      image.add(camera_, p + (q - p) * ((least_depth_m - p.z) / (q.z - p.z)));
    }
  }
  if (image.x1 < -margin_px || image.y1 < -margin_px || image.x0 > camera_.width_px + margin_px ||
      image.y0 > camera_.height_px + margin_px) {
    return {};
  }
  return {across_.tile_of(image.x0 - margin_px), down_.tile_of(image.y0 - margin_px),
          across_.tile_of(image.x1 + margin_px), down_.tile_of(image.y1 + margin_px)};
}

void TilePlan::mark(const TileRect& rect, float steepness) {
  for (int y = rect.y0; y <= rect.y1; ++y) {
    for (int x = rect.x0; x <= rect.x1; ++x) {
      float& of_tile = tables_.steepness[static_cast<std::size_t>(y * across_.count() + x)];
      of_tile = std::max(of_tile, steepness);
    }
  }
}

void TilePlan::mark_block(const HeldBlock& block) {
  const BlockFacts& facts = block.facts;
  const bool unknown = facts.void_posts > 0 || facts.mixed;
  if (!unknown && !(facts.residual_m > 0) && facts.steepness <= gentle) return;
  const Vec3<Enu> way = enu_from_ecef_ * (facts.centre - local_.eye_ecef);
  const double far_m = glm::length(way.xyz);
  if (far_m - facts.radius_m > sharing_.range_m) return;
  const glm::dvec3 p = camera_from_enu_ * way.xyz;
  if (!unknown && far_m > facts.radius_m) {  // out of sight
    const double spread_rad = std::asin(facts.radius_m / far_m);
    const double off_axis_rad = std::acos(std::clamp(p.z / far_m, -1.0, 1.0));
    if (off_axis_rad - spread_rad > half_diagonal_rad_ + beside_rad) return;
  }
  const double margin_px = sharing_.bound_px + neighbour_px + sharing_.slack_px + 2.0;
  const BlockPlace place = place_of(block, unknown);
  for (int part = 0; part < residual_parts * residual_parts; ++part) {
    const auto k = static_cast<std::size_t>(part);
    const bool off = unknown || facts.part_residual_m[k] > 0;
    const float steepness = off ? every_pixel : facts.part_steepness[k];
    if (steepness > gentle) mark(tiles_of(box_of(place, part), margin_px), steepness);
  }
}

void TilePlan::mark_ground() {
  for (int level = 0; level < view_.sizes.levels; ++level) {
    const PostRect finer =
        level > 0 ? view_.drawable[static_cast<std::size_t>(level - 1)] : PostRect{};
    terrain_.levels().over_valid(level, [&](const HeldBlock& block) {
      const std::int32_t span = block_posts << level;
      const std::int32_t west = block.id.column * span, south = block.id.row * span;
      const bool hidden = level > 0 && west >= finer.west && south >= finer.south &&
                          west + span <= finer.east && south + span <= finer.north;
      if (!hidden) mark_block(block);
    });
  }
}

double TilePlan::allowed(std::size_t shape, std::size_t other, std::size_t bin) {
  double& steepest = allowed_[shape][other][bin];
  if (steepest >= 0) return steepest;
  const double reach_px = std::min(sharing_.bound_px + neighbour_px, farthest_witness_px);
  steepest = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= angles_in_bin; ++k) {
    const double angle = std::numbers::pi *
                         (static_cast<double>(bin) + static_cast<double>(k) / angles_in_bin) /
                         way_bins;
    steepest = std::min(steepest, steepest_for_block(shapes[shape], shapes[other],
                                                     {std::cos(angle), std::sin(angle)}, reach_px,
                                                     sharing_.geometry_px));
  }
  steepest *= within_bin;
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
  if (shape == left_out_ || tables_.steepness[index] == every_pixel) return false;
  if (!look.known) return false;
  const auto steepness = static_cast<double>(std::max(tables_.steepness[index], gentle));
  const double grip =
      look.down_rad > 0 ? std::cos(look.down_rad) - steepness * std::sin(look.down_rad) : 1.0;
  if (grip < least_grip) return false;
  const double needed = within_tile * (steepness / grip * look.stretch + look.skew);
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
                           const RayTileTables& tables, const TileCut& cut) {
  const double reach_px = std::min(sharing.bound_px + neighbour_px, farthest_witness_px);
  const int ring_px = std::max(static_cast<int>(reach_px) + 1, cut.from_px > 0 ? cut_ring_px : 0);
  const bool polar = terrain.lattice().polar();  // its blocks have no east and north
  const bool small = std::min(camera.width_px, camera.height_px - cut.from_px) < 4 * ring_px;
  const bool shared = !polar && !small && sharing.slack_px >= BlockShape{1, 2}.radius_px();
  const TileAxis across{camera.width_px, shared ? ring_px : 0};
  const TileAxis down{camera.height_px, shared ? ring_px : 0, cut.from_px, cut.kept_rows};
  RayTilePlan result;
  result.columns = across.count();
  result.rows = down.count();
  result.tiles = put_tiles(across, down, tables.tiles);
  if (shared) {
    std::fill_n(tables.steepness.begin(), result.tiles, 0.0F);
    TilePlan plan(terrain, local, camera, sharing, tables, across, down);
    plan.mark_ground();
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
