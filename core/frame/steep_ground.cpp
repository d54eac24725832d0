#include "core/frame/steep_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double smallest_radius_m = 6'335'000.0, largest_radius_m = 6'400'000.0;
constexpr double least_depth_m = 0.01;  ///< before the camera: nearer ground is none
constexpr double beside_rad = 0.1;      ///< beside the picture: more than any margin
constexpr double slip_m = 20.0;         ///< of a box, on top of the bend of the Earth

/// A box round some ground in the camera's axes: its middle and three half edges.
struct GroundBox {
  glm::dvec3 middle{0.0};
  std::array<glm::dvec3, 3> half{};
};

/// Where ground shows in the picture, in tiles, both included; empty when x0 > x1.
struct TileRect {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

struct HeightRange {
  double low_m, high_m;
};

/// Where a block is, in the camera's axes.
struct BlockPlace {
  double slip_m = 0;  ///< by which its axes may be off, without its height
  double bend = 0;    ///< the same, a metre of height
  double middle_m = 0;
  glm::dvec3 middle{0.0}, east{0.0}, north{0.0};  ///< at middle_m; the edges
};

/// Grows a rectangle of image points by where a point of space shows.
struct ImageRect {
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;

  void add(const Camera& camera, const glm::dvec3& p) {
    const double u = camera.cx + camera.fx * p.x / p.z, v = camera.cy + camera.fy * p.y / p.z;
    x0 = std::min(x0, u), x1 = std::max(x1, u);
    y0 = std::min(y0, v), y1 = std::max(y1, v);
  }
};

HeightRange heights_of(const BlockFacts& facts) {
  const auto highest_m = static_cast<double>(facts.highest_m);
  return {std::min(static_cast<double>(facts.lowest_m), highest_m), highest_m};
}

class Marking {
 public:
  Marking(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
          const SteepGroundLimits& limits, const TileSteepness& tiles)
      : terrain_(terrain),
        view_(terrain.view()),
        local_(local),
        camera_(camera),
        limits_(limits),
        tiles_(tiles),
        enu_from_ecef_(local.ecef_from_enu.inverse()),
        camera_from_enu_(glm::transpose(camera.enu_from_camera.columns)),
        half_diagonal_rad_(camera.half_diagonal_rad(0.0)) {}

  void mark_all();

 private:
  void mark_block(const HeldBlock& block);
  /// Parts that are drawn with a residual or beside unknown ground.
  void mark_uncertain(const HeldBlock& block, const BlockPlace& place, bool unknown);
  /// Known ground, in parts whose picture is about as large as a tile.
  void mark_slopes(const BlockFacts& facts, const BlockPlace& place, double near_m);
  [[nodiscard]] BlockPlace place_of(const HeldBlock& block, const glm::dvec3& way) const;
  [[nodiscard]] HeightRange with_neighbours(const BlockId& id, HeightRange range) const;
  /// Radius of a ball about the block's centre that holds all that mark_uncertain() marks.
  [[nodiscard]] double ball_of_floors_m(const HeldBlock& block) const;
  /// Part `column`, `row` of so many a side, grown by a share of the block.
  [[nodiscard]] GroundBox box_of(const BlockPlace& place, int column, int row, int parts,
                                 double more, const HeightRange& heights) const;
  [[nodiscard]] TileRect tiles_of(const GroundBox& box) const;
  void mark(const TileRect& rect, float steepness);

  const TerrainKeeper& terrain_;
  TerrainView view_;
  const LocalFrame& local_;
  const Camera& camera_;
  SteepGroundLimits limits_;
  TileSteepness tiles_;
  Rotation<Enu, Ecef> enu_from_ecef_;
  glm::dmat3 camera_from_enu_;
  double half_diagonal_rad_;
};

BlockPlace Marking::place_of(const HeldBlock& block, const glm::dvec3& way) const {
  const BlockFacts& facts = block.facts;
  const int span = block_posts << block.id.level;
  const double latitude_deg = view_.lattice.latitude_deg(block.id.row * span + span / 2);
  const double narrow = std::cos(std::clamp(latitude_deg, -89.0, 89.0) * rad_per_deg);
  const double north_m = largest_radius_m * rad_per_deg * view_.lattice.latitude_step_deg * span;
  const double east_m =
      largest_radius_m * rad_per_deg * view_.lattice.longitude_step_deg * span * narrow;
  const HeightRange heights = heights_of(facts);
  // East, north and up over there are those here but for the bend of the Earth between.
  const double far = glm::length(way) / smallest_radius_m;
  const double reach_deg = std::min(std::abs(latitude_deg) + 2.0, 88.0);
  BlockPlace place;
  const double bend_of_latitude = 1.0 + std::tan(reach_deg * rad_per_deg);
  place.bend = far * bend_of_latitude;
  const double half_m = 0.5 * std::hypot(east_m, north_m);
  // A block bends over its own width as well: much, where the posts are far apart.
  const double turned = bend_of_latitude * (2.0 * far + half_m / (2.0 * smallest_radius_m));
  place.slip_m = slip_m + half_m * turned;
  place.middle_m = 0.5 * (heights.low_m + heights.high_m);
  place.middle = camera_from_enu_ * way;
  place.east = camera_from_enu_[0] * east_m;
  place.north = camera_from_enu_[1] * north_m;
  return place;
}

HeightRange Marking::with_neighbours(const BlockId& id, HeightRange range) const {
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const HeldBlock* beside =
          terrain_.levels().find({id.level, id.column + column, id.row + row});
      if (beside == nullptr || beside->facts.known_posts == 0) continue;
      range.low_m = std::min(range.low_m, static_cast<double>(beside->facts.lowest_m));
      range.high_m = std::max(range.high_m, static_cast<double>(beside->facts.highest_m));
    }
  }
  return range;
}

double Marking::ball_of_floors_m(const HeldBlock& block) const {
  const HeightRange own = heights_of(block.facts), all = with_neighbours(block.id, own);
  constexpr double cells_beside = 1.1;  // that use a post of the block
  return cells_beside * block.facts.radius_m + (own.low_m - all.low_m) + (all.high_m - own.high_m);
}

GroundBox Marking::box_of(const BlockPlace& place, int column, int row, int parts, double more,
                          const HeightRange& heights) const {
  const double east = (column + 0.5) / parts - 0.5, north = (row + 0.5) / parts - 0.5;
  const double up_m = 0.5 * (heights.low_m + heights.high_m) - place.middle_m;
  const double rise_m = heights.high_m - heights.low_m;
  // Its height leans as well, and so does the way up to it from the middle of the block.
  const double off_m = place.slip_m + place.bend * (rise_m + std::abs(up_m));
  const double half = 0.5 / parts + more;
  return {place.middle + place.east * east + place.north * north + camera_from_enu_[2] * up_m,
          {place.east * half + camera_from_enu_[0] * off_m,
           place.north * half + camera_from_enu_[1] * off_m,
           camera_from_enu_[2] * (0.5 * rise_m + off_m)}};
}

TileRect Marking::tiles_of(const GroundBox& box) const {
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
  const double more = limits_.margin_px;
  if (image.x1 < -more || image.y1 < tiles_.down.first_px - more ||
      image.x0 > camera_.width_px + more || image.y0 > camera_.height_px + more) {
    return {};
  }
  return {tiles_.across.tile_of(image.x0 - more), tiles_.down.tile_of(image.y0 - more),
          tiles_.across.tile_of(image.x1 + more), tiles_.down.tile_of(image.y1 + more)};
}

void Marking::mark(const TileRect& rect, float steepness) {
  for (int y = rect.y0; y <= rect.y1; ++y) {
    for (int x = rect.x0; x <= rect.x1; ++x) {
      float& of_tile = tiles_.steepness[static_cast<std::size_t>(y * tiles_.across.count() + x)];
      of_tile = std::max(of_tile, steepness);
    }
  }
}

void Marking::mark_uncertain(const HeldBlock& block, const BlockPlace& place, bool unknown) {
  const BlockFacts& facts = block.facts;
  HeightRange heights = heights_of(facts);
  // Floors of unknown ground have walls down to the ground beside them, which may be another
  // block's.
  if (unknown) heights = with_neighbours(block.id, heights);
  // A cell of the next block that uses a post of this one belongs to this one, too.
  const double more = 2.0 / block_posts;
  for (int part = 0; part < residual_parts * residual_parts; ++part) {
    if (!unknown && !(facts.part_residual_m[static_cast<std::size_t>(part)] > 0)) continue;
    mark(tiles_of(box_of(place, part % residual_parts, part / residual_parts, residual_parts, more,
                         heights)),
         any_steepness);
  }
}

void Marking::mark_slopes(const BlockFacts& facts, const BlockPlace& place, double near_m) {
  const double block_px = glm::length(place.north) * camera_.fx;
  const int joined = block_px > near_m * ground_parts / 2 * ray_tile_px ? 1 : 2;
  for (int row = 0; row < ground_parts; row += joined) {
    for (int column = 0; column < ground_parts; column += joined) {
      GroundPart all = facts.ground[static_cast<std::size_t>(row * ground_parts + column)];
      for (int k = 1; k < joined * joined; ++k) {
        const GroundPart& part = facts.ground[static_cast<std::size_t>(
            (row + k / joined) * ground_parts + column + k % joined)];
        all.steepness = std::max(all.steepness, part.steepness);
        all.lowest_m = std::min(all.lowest_m, part.lowest_m);
        all.highest_m = std::max(all.highest_m, part.highest_m);
      }
      if (all.highest_m < all.lowest_m) continue;
      const HeightRange heights{static_cast<double>(all.lowest_m),
                                static_cast<double>(all.highest_m)};
      mark(tiles_of(
               box_of(place, column / joined, row / joined, ground_parts / joined, 0.0, heights)),
           all.steepness <= gentle_steepness ? 0.0F : all.steepness);
    }
  }
}

void Marking::mark_block(const HeldBlock& block) {
  const BlockFacts& facts = block.facts;
  const bool unknown = facts.void_posts > 0 || facts.mixed;
  const bool uncertain = unknown || facts.residual_m > 0;
  const Vec3<Enu> way = enu_from_ecef_ * (facts.centre - local_.eye_ecef);
  const double far_m = glm::length(way.xyz);
  // Walls of floors may reach farther down than the ball, and so nearer to a low eye.
  const double ball_m = unknown ? ball_of_floors_m(block) : facts.radius_m;
  if (far_m - ball_m > limits_.range_m) return;
  if (!unknown && far_m > facts.radius_m) {  // out of sight
    const glm::dvec3 p = camera_from_enu_ * way.xyz;
    const double spread_rad = std::asin(facts.radius_m / far_m);
    const double off_axis_rad = std::acos(std::clamp(p.z / far_m, -1.0, 1.0));
    if (off_axis_rad - spread_rad > half_diagonal_rad_ + beside_rad) return;
  }
  // Under a floor every ray begins in unknown ground, whatever shows of the floor.
  const bool within = glm::length(glm::dvec2(way.xyz)) < facts.radius_m + slip_m;
  if (unknown && within && local_.eye.height_m < static_cast<double>(facts.highest_m) + slip_m) {
    mark({0, 0, tiles_.across.count() - 1, tiles_.down.count() - 1}, any_steepness);
    return;
  }
  const BlockPlace place = place_of(block, way.xyz);
  if (uncertain) mark_uncertain(block, place, unknown);
  if (unknown) return;
  if (facts.steepness > gentle_steepness) {
    mark_slopes(facts, place, far_m - facts.radius_m);
  } else {
    mark(tiles_of(box_of(place, 0, 0, 1, 0.0, heights_of(facts))), 0.0F);
  }
}

void Marking::mark_all() {
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

}  // namespace

void mark_steep_ground(const TerrainKeeper& terrain, const LocalFrame& local, const Camera& camera,
                       const SteepGroundLimits& limits, const TileSteepness& tiles) {
  const auto count =
      static_cast<std::size_t>(tiles.across.count()) * static_cast<std::size_t>(tiles.down.count());
  std::fill_n(tiles.steepness.begin(), count, no_ground);
  Marking(terrain, local, camera, limits, tiles).mark_all();
}

}  // namespace ridgeline
