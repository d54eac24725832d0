#include "core/terrain/polar_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/assert.hpp"
#include "core/terrain/polar_patches.hpp"
#include "core/terrain/terrain_block.hpp"

namespace ridgeline {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr float no_low = 1e9F, no_high = -1e9F;
constexpr float not_all_known = -2e9F;    ///< as the low end of a range
constexpr double least_clip_cells = 8.0;  ///< from the pole; nearer, patches are taken whole
constexpr double widest_clip_rad = 0.2;   ///< half width of a patch, for the series of its angle
constexpr double widest_cell_rad = 0.3;   ///< farthest part of a cell from the patch's meridian
constexpr double slack_cells = 1e-6;      ///< rounding of places

void widen(const PolarCells& cells, std::size_t k, float low, float high) {
  cells.low[k] = std::min(cells.low[k], low);
  cells.high[k] = std::max(cells.high[k], high);
}

std::size_t cell_at(const PolarCells& cells, int x, int y) {
  return cells.index(x - 1, y - 1);
}

/// First round: the heights that touch each cell, and whether unknown ground does.
class Heights final : public PatchUser {
 public:
  explicit Heights(const PolarCells& cells) : cells_(cells) {}
  void use(const PolarPatch& patch, const Footprint& at) override {
    float low = not_all_known, high = no_high;
    if (patch.known) {
      const auto [least, most] = std::minmax_element(patch.corner_m.begin(), patch.corner_m.end());
      low = *least - patch.below_m;
      high = *most + patch.above_m;
    }
    for (int y = at.y0; y < at.y1; ++y) {
      for (int x = at.x0; x < at.x1; ++x) widen(cells_, cell_at(cells_, x, y), low, high);
    }
  }

 private:
  const PolarCells& cells_;
};

/// The plane of a cell, from its posts: height at the middle, slopes per cell, and the twist by
/// which their bilinear surface leaves it.
struct Plane {
  double height_m, east, north, twist;
};

Plane plane_of(const PolarCells& cells, std::span<const float> posts, int x, int y) {
  const auto columns = static_cast<std::size_t>(cells.box.columns);
  const std::size_t k = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
  const auto sw = static_cast<double>(posts[k]), se = static_cast<double>(posts[k + 1]);
  const auto nw = static_cast<double>(posts[k + columns]);
  const auto ne = static_cast<double>(posts[k + columns + 1]);
  return {0.25 * (sw + se + nw + ne), 0.5 * (se + ne - sw - nw), 0.5 * (nw + ne - sw - se),
          sw + ne - se - nw};
}

/// Third round: how far the truth is from the plane of each cell.
class Gaps final : public PatchUser {
 public:
  Gaps(const PostLattice& lattice, const PolarCells& cells, std::span<const float> posts)
      : lattice_(lattice), cells_(cells), posts_(posts) {}
  void use(const PolarPatch& patch, const Footprint& at) override;

 private:
  /// A patch in polar coordinates: cells from the pole, radians from its middle meridian.
  struct Sector {
    double south, north;  ///< cells from the pole at its parallels
    double least, most;   ///< the same by size
    double half_rad;
    double out_x, out_y;  ///< away from the pole along its middle meridian, columns and rows
    double way_x, way_y;  ///< and towards growing longitude there
    bool clips;
  };
  /// The part of a sector that can lie in a cell.
  struct Part {
    double near, far, low_rad, high_rad;
  };
  [[nodiscard]] Sector sector_of(const PolarPatch& patch) const;
  [[nodiscard]] static bool clip(const Sector& s, double column, double row, Part& part);
  void use_cell(const PolarPatch& patch, const Sector& s, int x, int y) const;

  const PostLattice& lattice_;
  const PolarCells& cells_;
  std::span<const float> posts_;
};

Gaps::Sector Gaps::sector_of(const PolarPatch& patch) const {
  const double sign = lattice_.chart == Chart::north_polar ? -1.0 : 1.0;
  const double middle = 0.5 * (patch.west_deg + patch.east_deg) * rad_per_deg;
  Sector s{};
  s.south = (90.0 + sign * patch.south_deg) / lattice_.latitude_step_deg;
  s.north = (90.0 + sign * patch.north_deg) / lattice_.latitude_step_deg;
  s.least = std::min(s.south, s.north);
  s.most = std::max(s.south, s.north);
  s.half_rad = 0.5 * (patch.east_deg - patch.west_deg) * rad_per_deg;
  s.out_x = std::sin(middle);
  s.out_y = sign * std::cos(middle);
  s.way_x = std::cos(middle);
  s.way_y = -sign * std::sin(middle);
  s.clips = s.least >= least_clip_cells && s.half_rad <= widest_clip_rad;
  return s;
}

/// False where the sector misses the cell with this middle.
bool Gaps::clip(const Sector& s, double column, double row, Part& part) {
  part = {s.least, s.most, -s.half_rad, s.half_rad};
  if (!s.clips) return true;
  const double half = 0.5 * (std::abs(s.out_x) + std::abs(s.out_y)) + slack_cells;
  const double out = column * s.out_x + row * s.out_y, way = column * s.way_x + row * s.way_y;
  const double near = out - half, far = out + half, low = way - half, high = way + half;
  const double widest = std::max(std::abs(low), std::abs(high));
  if (!(near > 0) || widest > widest_cell_rad * near) return true;
  part.near = std::max(part.near, near);
  part.far = std::min(part.far, far + 0.5 * widest * widest / near);
  // The angle is the arc tangent of way over out, within a third of the cube of that.
  const double tan_low = low / (low > 0 ? far : near), tan_high = high / (high > 0 ? near : far);
  const auto cube = [](double a) { return std::abs(a * a * a) / 3.0; };
  part.low_rad = std::max(part.low_rad, tan_low - cube(tan_low));
  part.high_rad = std::min(part.high_rad, tan_high + cube(tan_high));
  return part.near <= part.far && part.low_rad <= part.high_rad;
}

void Gaps::use_cell(const PolarPatch& patch, const Sector& s, int x, int y) const {
  const double column = cells_.box.column + x + 0.5, row = cells_.box.row + y + 0.5;
  Part part{};
  if (!clip(s, column, row, part)) return;
  const Plane plane = plane_of(cells_, posts_, x, y);
  const double out = plane.east * s.out_x + plane.north * s.out_y;
  const double way = plane.east * s.way_x + plane.north * s.way_y;
  const double at_pole = plane.height_m - plane.east * column - plane.north * row;
  const std::array<double, 4> c{
      static_cast<double>(patch.corner_m[0]), static_cast<double>(patch.corner_m[1]),
      static_cast<double>(patch.corner_m[2]), static_cast<double>(patch.corner_m[3])};
  double low = 1e9, high = -1e9;
  for (const double angle : {part.low_rad, part.high_rad}) {
    const double e = s.half_rad > 0 ? 0.5 + 0.5 * angle / s.half_rad : 0.5;
    const double slope = out * std::cos(angle) + way * std::sin(angle);
    const double south = c[0] + (c[1] - c[0]) * e, north = c[2] + (c[3] - c[2]) * e;
    for (const double p : {part.near, part.far}) {
      const double n = (p - s.south) / (s.north - s.south);
      const double gap = south + (north - south) * n - (at_pole + p * slope);
      low = std::min(low, gap);
      high = std::max(high, gap);
    }
  }
  // Along a meridian the gap is linear; along a parallel the plane is a cosine of the angle.
  const double arc = part.high_rad - part.low_rad;
  const double bend = part.far * std::hypot(plane.east, plane.north) * arc * arc / 8.0;
  widen(cells_, cells_.index(x, y), static_cast<float>(low - bend) - patch.below_m,
        static_cast<float>(high + bend) + patch.above_m);
}

void Gaps::use(const PolarPatch& patch, const Footprint& at) {
  if (!patch.known) return;
  const Sector s = sector_of(patch);
  for (int y = at.y0 - 1; y < at.y1 - 1; ++y) {
    for (int x = at.x0 - 1; x < at.x1 - 1; ++x) {
      if (cells_.low[cells_.index(x, y)] > not_all_known) use_cell(patch, s, x, y);
    }
  }
}

/// Columns from the west of a tile, or a negative number outside it.
double column_in(const PostGrid& grid, const GroundPlace& place) {
  if (place.latitude_deg < grid.south_deg || place.latitude_deg > grid.north_deg()) return -1.0;
  double east = place.longitude_deg - grid.west_deg;
  if (east < 0.0) east += 360.0;
  return east > grid.east_deg() - grid.west_deg ? -1.0 : east / grid.longitude_step_deg;
}

/// The truth at a place by the first tile that holds it, the same whoever asks; NaN where unknown.
float height_at(const TerrainSource& source, const GroundPlace& place) {
  const HeightTile* found = nullptr;
  double x = -1.0;
  for (auto tile = source.tiles.begin(); x < 0.0 && tile != source.tiles.end(); ++tile) {
    found = &*tile;
    x = column_in(tile->grid, place);
  }
  if (x < 0.0) return std::numeric_limits<float>::quiet_NaN();
  const PostGrid& grid = found->grid;
  const double y = (place.latitude_deg - grid.south_deg) / grid.latitude_step_deg;
  const int column = std::clamp(static_cast<int>(x), 0, grid.columns - 2);
  const int row = std::clamp(static_cast<int>(y), 0, grid.rows - 2);
  std::array<float, 4> posts{};
  for (int k = 0; k < 2; ++k) {
    const std::span<float> two = std::span(posts).subspan(static_cast<std::size_t>(2 * k), 2);
    read_posts(*found, row + k, column, two);
    if (!source.edits.empty()) apply_edits(source.edits, grid, row + k, column, two);
  }
  const auto e = static_cast<float>(x - column), n = static_cast<float>(y - row);
  const float south = posts[0] + (posts[1] - posts[0]) * e;
  const float height = south + (posts[2] + (posts[3] - posts[2]) * e - south) * n;
  const GeoidLookup& geoid = source.geoid;
  if (geoid.undulation_m == nullptr) return height;
  return height +
         static_cast<float>(geoid.undulation_m(
             geoid.context, std::clamp(place.latitude_deg, -90.0, 90.0), place.longitude_deg));
}

/// Second round: the posts.
bool put_posts(const TerrainSource& source, const PolarCells& cells, std::span<float> posts) {
  const PostBox& box = cells.box;
  bool with_voids = false;
  for (int y = 0; y < box.rows; ++y) {
    for (int x = 0; x < box.columns; ++x) {
      float low = no_low, high = no_high, part_high = no_high;
      for (const std::size_t k : {cells.index(x - 1, y - 1), cells.index(x, y - 1),
                                  cells.index(x - 1, y), cells.index(x, y)}) {
        part_high = std::max(part_high, cells.high[k]);
        if (cells.kind(k) != PolarCells::Kind::known) continue;
        low = std::min(low, cells.low[k]);
        high = std::max(high, cells.high[k]);
      }
      float& post = posts[static_cast<std::size_t>(y) * static_cast<std::size_t>(box.columns) +
                          static_cast<std::size_t>(x)];
      if (high > no_high) {
        post = height_at(source, source.lattice.place_of(box.column + x, box.row + y));
        if (!(post >= low && post <= high)) post = 0.5F * (low + high);
      } else if (part_high > no_high) {
        post = part_high;
      } else {
        post = polar_floor_m - void_offset_m;
        with_voids = true;
      }
    }
  }
  return with_voids;
}

/// Forgets the heights of cells and keeps what kind they are, as their posts draw them.
void keep_kinds(const PolarCells& cells, std::span<const float> posts) {
  const auto columns = static_cast<std::size_t>(cells.box.columns);
  for (int y = -1; y < cells.box.rows; ++y) {
    for (int x = -1; x < cells.box.columns; ++x) {
      const std::size_t k = cells.index(x, y);
      const bool inside = x >= 0 && y >= 0 && x + 1 < cells.box.columns && y + 1 < cells.box.rows;
      PolarCells::Kind kind = inside ? cells.kind(k) : PolarCells::Kind::unknown;
      if (inside) {
        const std::size_t p = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
        const float least =
            std::min({posts[p], posts[p + 1], posts[p + columns], posts[p + columns + 1]});
        if ((kind == PolarCells::Kind::known) != (least > void_threshold_m)) {
          kind = PolarCells::Kind::mixed;
        }
      }
      cells.low[k] = kind == PolarCells::Kind::known ? no_low : not_all_known;
      cells.high[k] = kind == PolarCells::Kind::mixed ? 0.0F : no_high;
    }
  }
}

}  // namespace

PolarCells::Kind PolarCells::kind(std::size_t index) const {
  if (!(high[index] > no_high)) return Kind::unknown;
  return low[index] > not_all_known ? Kind::known : Kind::mixed;
}

bool read_polar_region(const TerrainSource& source, const PolarCells& cells,
                       std::span<float> posts) {
  RL_ASSERT(source.lattice.polar());
  const auto count =
      static_cast<std::size_t>(cells.columns()) * static_cast<std::size_t>(cells.rows());
  RL_ASSERT(cells.low.size() == count && cells.high.size() == count);
  const PostBox& box = cells.box;
  const PostBox all{box.column - 1, box.row - 1, cells.columns(), cells.rows()};
  std::fill(cells.low.begin(), cells.low.end(), no_low);
  std::fill(cells.high.begin(), cells.high.end(), no_high);
  Heights heights(cells);
  walk_patches(source, all, heights);
  const bool with_voids = put_posts(source, cells, posts);
  keep_kinds(cells, posts);
  Gaps gaps(source.lattice, cells, posts);
  walk_patches(source, all, gaps);
  return with_voids;
}

PolarGap polar_gap(const PolarCells& cells, std::span<const float> posts, int x, int y, int side) {
  PolarGap gap;
  for (int j = y; j < y + side; ++j) {
    for (int i = x; i < x + side; ++i) {
      const std::size_t k = cells.index(i, j);
      const PolarCells::Kind kind = cells.kind(k);
      gap.mixed = gap.mixed || kind == PolarCells::Kind::mixed;
      if (kind != PolarCells::Kind::known) continue;
      const auto twist = static_cast<float>(0.25 * std::abs(plane_of(cells, posts, i, j).twist));
      gap.gap_m = std::max({gap.gap_m, cells.high[k] + twist, twist - cells.low[k]});
    }
  }
  return gap;
}

}  // namespace ridgeline
