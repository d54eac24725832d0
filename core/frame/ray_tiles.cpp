#include "core/frame/ray_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/frame/ray_witness.hpp"
#include "core/frame/steep_ground.hpp"

namespace ridgeline {
namespace {

constexpr int angles_in_bin = 2;
constexpr double neighbour_px = 0.7071;

/// From the largest on; the last: every pixel by itself.
constexpr std::array shapes{BlockShape{8, 8}, BlockShape{6, 6}, BlockShape{4, 4}, BlockShape{3, 3},
                            BlockShape{2, 2}, BlockShape{1, 2}, BlockShape{2, 1}, BlockShape{1, 1}};
constexpr std::size_t single = shapes.size() - 1, upright_pair = single - 2,
                      level_pair = single - 1;
constexpr double farthest_witness_px = 10.0;
constexpr double loss_step_px = 1.0 / 256;
static_assert(shapes.size() == block_shapes);

/// How far off a pixel's witnesses are looked for.
double reach_px_of(const RaySharing& sharing) {
  return std::min(sharing.bound_px + neighbour_px, farthest_witness_px);
}

/// Width of the border in which every pixel has its own ray: no witness is looked for farther off.
/// Rasterisers that compute shade squares of 4 x 4 pixels, so tiles begin on their edges, unless
/// the picture is so small that the wider border is a good part of it.
int ring_of(double reach_px, const Camera& camera) {
  constexpr int square_px = 4, smallest_part = 32;
  const int needed = static_cast<int>(reach_px) + 1;
  const int whole = (needed + square_px - 1) / square_px * square_px;
  return smallest_part * whole <= std::min(camera.width_px, camera.height_px) ? whole : needed;
}

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
    // A block bears no less with what is a little more.
    BlockBearing& bearing = *tables_.bearing;
    const double reach_px = reach_px_of(sharing);
    const double loss_px = std::ceil(sharing.geometry_px / loss_step_px) * loss_step_px;
    if (bearing.reach_px == reach_px && bearing.loss_px == loss_px) return;
    bearing.reach_px = reach_px;
    bearing.loss_px = loss_px;
    bearing.steepest.fill(-1.0F);
  }

  /// Gives every tile but those at the border its shape: a pixel there may have no other above it.
  void choose_shapes();

 private:
  /// Made when first asked for.
  [[nodiscard]] double allowed(std::size_t shape, std::size_t other, int bin);
  [[nodiscard]] bool fits(std::size_t shape, std::size_t other, std::size_t tile);
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
};

double TilePlan::allowed(std::size_t shape, std::size_t other, int bin) {
  const auto wrapped = static_cast<std::size_t>((bin % way_bins + way_bins) % way_bins);
  BlockBearing& bearing = *tables_.bearing;
  float& kept = bearing.steepest[(shape * block_shapes + other) * way_bins + wrapped];
  if (kept >= 0) return static_cast<double>(kept);
  const BlockShape& block = shapes[shape];
  const bool square = block.width == block.height;  // turned by a right angle the same
  const bool one_lattice = shape == other && square && ray_tile_px % block.width == 0;
  double steepest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < angles_in_bin; ++k) {
    const double angle = way_bin_rad * (static_cast<double>(wrapped) + (k + 0.5) / angles_in_bin);
    const glm::dvec2 way(std::cos(angle), std::sin(angle));
    const WitnessLimits limits{bearing.reach_px, bearing.loss_px,
                               0.5 * way_bin_rad / angles_in_bin};
    steepest =
        std::min(steepest, steepest_for_block({block, shapes[other], one_lattice}, way, limits));
  }
  constexpr double rounded = 0.9999;
  kept = static_cast<float>(steepest * rounded);
  return static_cast<double>(kept);
}

bool TilePlan::fits(std::size_t shape, std::size_t other, std::size_t index) {
  if (shape == single) return true;
  const float steepness = tables_.steepness[index];
  if (shape == left_out_ || steepness == any_steepness) return false;
  const TileLook& look = tables_.looks[index];
  const double needed =
      needed_steepness(look, static_cast<double>(std::max(steepness, gentle_steepness)));
  for (int bin = look.first_bin; bin <= look.last_bin; ++bin) {
    if (!(needed <= allowed(shape, other, bin))) return false;
    if (sharing_.may_be_cut && !(needed <= allowed(shape, single, bin))) return false;
  }
  return true;
}

bool TilePlan::settle(int column, int row) {
  const auto index_of = [&](int i, int j) {
    return static_cast<std::size_t>(j * across_.count() + i);
  };
  const std::size_t own = index_of(column, row);
  if (tables_.shapes[own] == single) return false;  // needs nothing of its neighbours
  bool changed = false;
  for (int j = row - 1; j <= row + 1; ++j) {
    for (int i = column - 1; i <= column + 1; ++i) {
      std::uint8_t& beside = tables_.shapes[index_of(i, j)];
      while (!fits(tables_.shapes[own], beside, own)) {
        if (beside >= tables_.shapes[own] && beside < single) {
          tables_.shapes[own] = single;  // not even beside its like: not known to happen
        } else if (beside == single) {
          tables_.shapes[own] = single;
        } else {
          ++beside;
          while (beside < single && !fits(beside, beside, index_of(i, j))) ++beside;
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
      if (tables_.steepness[k] == no_ground) continue;
      tables_.looks[k] =
          tile_look(camera_, tables_.tiles[k], sharing_.bound_px + 2.0, sharing_.range_m);
      std::size_t shape = largest_;
      while (!fits(shape, shape, k)) ++shape;
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

/// Gives tiles of plain sky one ray and puts them behind the others; how many others there are.
int part_sky(std::span<RayTile> tiles, std::span<float> steepness) {
  std::size_t ground = 0;
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    if (steepness[k] == no_ground) {
      tiles[k].block = tiles[k].size;
      continue;
    }
    std::swap(tiles[ground], tiles[k]);
    std::swap(steepness[ground], steepness[k]);
    ++ground;
  }
  return static_cast<int>(ground);
}

}  // namespace

RayTilePlan plan_ray_tiles(const TerrainKeeper& terrain, const LocalFrame& local,
                           const Camera& camera, const RaySharing& sharing,
                           const RayTileTables& tables, const TileCut& cut) {
  const double reach_px = reach_px_of(sharing);
  const int ring_px = std::max(ring_of(reach_px, camera), cut.from_px > 0 ? cut_ring_px : 0);
  const bool polar = terrain.lattice().polar();  // its blocks have no east and north
  const bool small = std::min(camera.width_px, camera.height_px - cut.from_px) < 4 * ring_px;
  const bool surveyed = !polar && !sharing.every_pixel;
  const bool shared = surveyed && !small && sharing.slack_px >= BlockShape{1, 2}.radius_px();
  const TileAxis across{camera.width_px, shared ? ring_px : 0};
  const TileAxis down{camera.height_px, shared ? ring_px : 0, cut.from_px, cut.kept_rows};
  RayTilePlan result;
  result.tiles = put_tiles(across, down, tables.tiles);
  result.ground_tiles = result.tiles;
  const auto tiles = tables.tiles.first(static_cast<std::size_t>(result.tiles));
  if (surveyed) {
    const double margin_px =
        sharing.bound_px + neighbour_px + std::max(sharing.slack_px, 0.0) + 2.0;
    mark_steep_ground(terrain, local, camera, {sharing.range_m, margin_px},
                      {across, down, tables.steepness});
    if (shared) TilePlan(camera, sharing, tables, across, down).choose_shapes();
    result.ground_tiles = part_sky(tiles, tables.steepness);
  }
  for (const RayTile& tile : tiles) result.rays += tile.ray_count();
  for (const RayTile& tile : tiles.first(static_cast<std::size_t>(result.ground_tiles))) {
    result.shared_px = std::max(result.shared_px, tile.shape().radius_px());
  }
  return result;
}

}  // namespace ridgeline
