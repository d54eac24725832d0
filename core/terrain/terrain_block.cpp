#include "core/terrain/terrain_block.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/assert.hpp"
#include "core/geo/local_frame.hpp"
#include "core/terrain/ground_part.hpp"
#include "core/terrain/polar_region.hpp"
#include "core/terrain/void_floor.hpp"

namespace ridgeline {
namespace {

constexpr int margin = region_margin;
constexpr int cells = block_posts + 2 * margin;  ///< a side of the region
constexpr int corners = cells + 1;
constexpr float nothing = -1e9F;
constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double equator_radius_m = 6'378'137.0;
constexpr double polar_radius_m = 6'335'439.0;  ///< smallest radius of curvature northwards
constexpr int coarse_geoid_stride = 8;
constexpr double widest_stride_deg = 25.0 / 3600.0;  ///< for which the slack below is enough
constexpr double geoid_slack_m = 0.05;  ///< of the coarse stride, at the kinks of the geoid grid

bool is_void(float post) {
  return post < void_threshold_m;
}

/// Up to where a post reaches: its height, or its floor.
float top_of(float post) {
  return is_void(post) ? post + void_offset_m : post;
}

/// The fine posts of a block with its margin, and what is made of them cell by cell.
class Builder {
 public:
  Builder(int level, std::span<const float> fine, bool with_voids)
      : level_(level),
        step_(1 << level),
        side_(region_side(level)),
        fine_(fine),
        with_voids_(with_voids) {
    for (int y = 0; y < corners; ++y) {
      for (int x = 0; x < corners; ++x) post(x, y) = at(x * step_, y * step_);
    }
  }

  /// Moves the posts of a coarse level to the middle of what they must stand for.
  void settle();
  void measure(BlockFacts& facts) const;
  void fill(TerrainBlock& block) const;
  /// Puts slopes and heights of finest posts `east_m` and `north_m` apart.
  void put_ground(double east_m, double north_m, BlockFacts& facts) const;

 private:
  using Corners = std::array<float, corners * corners>;

  [[nodiscard]] float at(int x, int y) const {
    return fine_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(x)];
  }
  [[nodiscard]] float& post(int x, int y) {
    return posts_[static_cast<std::size_t>(y * corners + x)];
  }
  [[nodiscard]] float post(int x, int y) const {
    return posts_[static_cast<std::size_t>(y * corners + x)];
  }
  /// Whether every fine post of a cell, borders included, is known / some fine cell is.
  [[nodiscard]] bool all_known(int cx, int cy) const;
  [[nodiscard]] bool some_cell_known(int cx, int cy) const;
  [[nodiscard]] bool drawn_known(int cx, int cy) const;
  /// Calls use(fine height minus the cell's surface, weights of its corners) over a known cell.
  template <typename Use>
  void over_cell(int cx, int cy, const Use& use) const;
  void settle_cell(int cx, int cy, Corners& low, Corners& high) const;
  void settle_post(int x, int y, float low, float high);
  [[nodiscard]] float highest_of_cell(int cx, int cy) const;
  /// Lowest true height or floor of the block's own cells, their borders included.
  [[nodiscard]] float lowest() const;

  int level_, step_, side_;
  std::span<const float> fine_;
  bool with_voids_;
  Corners posts_{};
};

bool Builder::all_known(int cx, int cy) const {
  if (!with_voids_) return true;
  for (int y = cy * step_; y <= (cy + 1) * step_; ++y) {
    for (int x = cx * step_; x <= (cx + 1) * step_; ++x) {
      if (is_void(at(x, y))) return false;
    }
  }
  return true;
}

bool Builder::some_cell_known(int cx, int cy) const {
  if (!with_voids_) return true;
  for (int y = cy * step_; y < (cy + 1) * step_; ++y) {
    for (int x = cx * step_; x < (cx + 1) * step_; ++x) {
      const float low = std::min({at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)});
      if (!is_void(low)) return true;
    }
  }
  return false;
}

bool Builder::drawn_known(int cx, int cy) const {
  return !is_void(
      std::min({post(cx, cy), post(cx + 1, cy), post(cx, cy + 1), post(cx + 1, cy + 1)}));
}

template <typename Use>
void Builder::over_cell(int cx, int cy, const Use& use) const {
  const float a = post(cx, cy), b = post(cx + 1, cy), c = post(cx, cy + 1),
              d = post(cx + 1, cy + 1);
  const float unit = 1.0F / static_cast<float>(step_);
  for (int j = 0; j <= step_; ++j) {
    const float v = static_cast<float>(j) * unit;
    for (int i = 0; i <= step_; ++i) {
      const float u = static_cast<float>(i) * unit;
      const float surface = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
      use(at(cx * step_ + i, cy * step_ + j) - surface, u, v);
    }
  }
}

void Builder::settle_cell(int cx, int cy, Corners& low, Corners& high) const {
  std::array<std::size_t, 4> corner{};
  for (int k = 0; k < 4; ++k) {
    corner[static_cast<std::size_t>(k)] =
        static_cast<std::size_t>((cy + k / 2) * corners + cx + k % 2);
  }
  over_cell(cx, cy, [&](float gap, float u, float v) {
    const std::array<float, 4> weight{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    for (std::size_t k = 0; k < 4; ++k) {
      const float share = gap * std::min(1.0F, 2 * weight[k]);
      low[corner[k]] = std::min(low[corner[k]], share);
      high[corner[k]] = std::max(high[corner[k]], share);
    }
  });
}

void Builder::settle_post(int x, int y, float low, float high) {
  float lowest = at(x * step_, y * step_), highest = lowest;
  float floor = nothing;
  for (int j = (y - 1) * step_; j <= (y + 1) * step_; ++j) {
    for (int i = (x - 1) * step_; i <= (x + 1) * step_; ++i) {
      const float h = at(i, j);
      if (is_void(h)) {
        floor = std::max(floor, h);
      } else {
        lowest = std::min(lowest, h);
        highest = std::max(highest, h);
      }
    }
  }
  if (is_void(post(x, y))) {
    post(x, y) = floor;  // as high as any unknown ground it stands for
  } else if (!(floor > nothing)) {
    post(x, y) = std::clamp(post(x, y) + 0.5F * (low + high), lowest, highest);
  }
}

void Builder::settle() {
  if (level_ == 0) return;
  Corners low{}, high{};
  for (int cy = 0; cy < cells; ++cy) {
    for (int cx = 0; cx < cells; ++cx) {
      if (all_known(cx, cy)) settle_cell(cx, cy, low, high);
    }
  }
  for (int y = 1; y + 1 < corners; ++y) {
    for (int x = 1; x + 1 < corners; ++x) {
      const auto k = static_cast<std::size_t>(y * corners + x);
      settle_post(x, y, low[k], high[k]);
    }
  }
}

float Builder::lowest() const {
  float lowest = -nothing;
  for (int y = margin * step_; y <= (margin + block_posts) * step_; ++y) {
    for (int x = margin * step_; x <= (margin + block_posts) * step_; ++x) {
      lowest = std::min(lowest, top_of(at(x, y)));  // floors as well: their walls begin there
    }
  }
  return lowest;  // settled posts lie between true ones
}

void Builder::measure(BlockFacts& facts) const {
  facts.lowest_m = lowest();
  for (int cy = margin; cy < margin + block_posts; ++cy) {
    for (int cx = margin; cx < margin + block_posts; ++cx) {
      const float own = post(cx, cy);
      ++(is_void(own) ? facts.void_posts : facts.known_posts);
      if (level_ == 0) continue;
      const bool known = all_known(cx, cy), drawn = drawn_known(cx, cy);
      if (known != drawn || (!known && some_cell_known(cx, cy))) facts.mixed = true;
      if (!known) continue;
      constexpr int side = block_posts / residual_parts;
      const int part = (cy - margin) / side * residual_parts + (cx - margin) / side;
      float& residual = facts.part_residual_m[static_cast<std::size_t>(part)];
      over_cell(cx, cy,
                [&](float gap, float, float) { residual = std::max(residual, std::abs(gap)); });
    }
  }
}

/// Adds what the residual of every part has on top, and rounds up: the shader computes the surface
/// once more, in float.
void finish_residual(double more_m, BlockFacts& facts) {
  for (float& residual : facts.part_residual_m) {
    residual += static_cast<float>(more_m);
    if (residual > 0) residual = residual * 1.0001F + 2e-3F;
    facts.residual_m = std::max(facts.residual_m, residual);
  }
}

float Builder::highest_of_cell(int cx, int cy) const {
  float highest = nothing;
  for (int y = cy * step_; y <= (cy + 1) * step_; ++y) {
    for (int x = cx * step_; x <= (cx + 1) * step_; ++x) {
      highest = std::max(highest, top_of(at(x, y)));
    }
  }
  return highest;
}

void Builder::fill(TerrainBlock& block) const {
  for (int y = 0; y < block_posts; ++y) {
    for (int x = 0; x < block_posts; ++x) {
      block.posts[static_cast<std::size_t>(y * block_posts + x)] = post(x + margin, y + margin);
    }
  }
  std::array<float, cells * cells> of_cell{};
  if (level_ > 0) {
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells; ++x) {
        of_cell[static_cast<std::size_t>(y * cells + x)] = highest_of_cell(x, y);
      }
    }
  }
  constexpr int half = block_posts / 2;
  for (int j = 0; j < half; ++j) {
    for (int i = 0; i < half; ++i) {
      const int x0 = margin + 2 * i, y0 = margin + 2 * j;
      float highest = nothing;
      for (int y = y0 - 1; y <= y0 + 3; ++y) {
        for (int x = x0 - 1; x <= x0 + 3; ++x) highest = std::max(highest, top_of(post(x, y)));
      }
      // Finer levels inside the node may lean on true posts two cells of this level away.
      for (int y = y0 - 2; level_ > 0 && y < y0 + 4; ++y) {
        for (int x = x0 - 2; x < x0 + 4; ++x) {
          highest = std::max(highest, of_cell[static_cast<std::size_t>(y * cells + x)]);
        }
      }
      block.highest[static_cast<std::size_t>(j * half + i)] = highest;
    }
  }
  std::size_t below = 0;
  for (int side = half / 2; side >= 1; side /= 2) {
    const std::size_t here = below + static_cast<std::size_t>(4 * side * side);
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const auto node = [&](int x, int y) {
          return block.highest[below + static_cast<std::size_t>(y * 2 * side + x)];
        };
        block.highest[here + static_cast<std::size_t>(j * side + i)] =
            std::max({node(2 * i, 2 * j), node(2 * i + 1, 2 * j), node(2 * i, 2 * j + 1),
                      node(2 * i + 1, 2 * j + 1)});
      }
    }
    below = here;
  }
  block.facts.highest_m = block.highest.back();
}

void Builder::put_ground(double east_m, double north_m, BlockFacts& facts) const {
  constexpr int large = block_posts / residual_parts, small = block_posts / ground_parts;
  const PostSquare fine{fine_, side_, with_voids_, static_cast<float>(1.0 / east_m),
                        static_cast<float>(1.0 / north_m)};
  for (int part = 0; part < ground_parts * ground_parts; ++part) {
    const int x = part % ground_parts * small + margin, y = part / ground_parts * small + margin;
    facts.ground[static_cast<std::size_t>(part)] =
        ground_part(fine, {x * step_, y * step_, small * step_});
  }
  for (int part = 0; part < residual_parts * residual_parts; ++part) {
    const int x = part % residual_parts * large, y = part / residual_parts * large;
    const float slope = steepest_slope(fine, {x * step_, y * step_, (large + 2 * margin) * step_});
    facts.part_steepness[static_cast<std::size_t>(part)] = slope;
    facts.steepness = std::max(facts.steepness, slope);
  }
}

/// A ball round the ground of a block, from the ellipsoid's centre of it.
void put_ball(const PostLattice& lattice, const BlockId& id, BlockFacts& facts) {
  const int span = block_posts << id.level;
  const auto place = [&](double x, double y, double height_m) {
    const GroundPlace at = lattice.place_of(id.column * span + x * span, id.row * span + y * span);
    return ecef_from_geodetic(
        {std::clamp(at.latitude_deg, -90.0, 90.0), at.longitude_deg, height_m});
  };
  const double low =
      std::min(static_cast<double>(facts.lowest_m), static_cast<double>(facts.highest_m));
  const double high = static_cast<double>(facts.highest_m);
  facts.centre = place(0.5, 0.5, 0.5 * (low + high));
  double radius = 0;
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      for (const double h : {low, high}) {
        radius = std::max(radius, glm::length((place(x, y, h) - facts.centre).xyz));
      }
    }
  }
  constexpr double between_samples = 1.02;  // edges are arcs, bulging by L²/8R between the samples
  facts.radius_m = between_samples * radius + 20.0;
}

/// Keeps what rounding took from the block's own posts.
void put_rests(std::span<const float> region, TerrainBlock& block) {
  for (int y = 0; y < block_posts; ++y) {
    for (int x = 0; x < block_posts; ++x) {
      const float rest = region[static_cast<std::size_t>((y + margin) * corners + x + margin)];
      const float units =
          std::isnan(rest) ? 0.0F : std::round(rest * static_cast<float>(1.0 / rest_unit_m));
      block.rests[static_cast<std::size_t>(y * block_posts + x)] =
          static_cast<std::int8_t>(std::clamp(units, -128.0F, 127.0F));
    }
  }
}

/// Adds what the truth can differ from the finest posts by, part by part.
void add_gaps(const PolarCells& truth, std::span<const float> fine, int level, BlockFacts& facts) {
  constexpr int part_posts = block_posts / residual_parts;
  float largest = 0;
  for (int part = 0; part < residual_parts * residual_parts; ++part) {
    const int x = (margin + part % residual_parts * part_posts) << level;
    const int y = (margin + part / residual_parts * part_posts) << level;
    const PolarGap gap = polar_gap(truth, fine, x, y, part_posts << level);
    facts.mixed = facts.mixed || gap.mixed;
    facts.part_residual_m[static_cast<std::size_t>(part)] += gap.gap_m;
    largest = std::max(largest, gap.gap_m);
  }
  facts.lowest_m -= largest;
  facts.highest_m += largest;
}

/// A block in a polar chart: as any other from its finest posts on; but those stand for ranges.
void build_polar_block(const TerrainSource& source, const BlockScratch& scratch,
                       TerrainBlock& block) {
  const BlockId& id = block.id;
  const PostBox box = block_region(id);
  const std::size_t cell_count = polar_cells(id.level);
  RL_ASSERT(scratch.low.size() >= cell_count && scratch.high.size() >= cell_count);
  const PolarCells truth{box, scratch.low.first(cell_count), scratch.high.first(cell_count)};
  const std::span<float> fine = scratch.posts.first(static_cast<std::size_t>(box.rows) *
                                                    static_cast<std::size_t>(box.columns));
  const bool with_voids = read_polar_region(source, truth, fine);
  Builder builder(id.level, fine, with_voids);
  builder.settle();
  builder.measure(block.facts);
  builder.fill(block);
  BlockFacts& facts = block.facts;
  add_gaps(truth, fine, id.level, facts);
  finish_residual(0.0, facts);
  constexpr double smallest_scale = 0.99;  // of a parallel, within 12 degrees of the pole
  const double post_m =
      smallest_scale * source.lattice.latitude_step_deg * rad_per_deg * polar_radius_m;
  builder.put_ground(post_m, post_m, facts);
  put_ball(source.lattice, id, facts);
}

}  // namespace

PostBox block_region(const BlockId& id) {
  const int step = 1 << id.level;
  return {(id.column * block_posts - margin) * step, (id.row * block_posts - margin) * step,
          region_side(id.level), region_side(id.level)};
}

PostBox block_neighbourhood(const BlockId& id) {
  constexpr int reach = 3 * block_posts;  // a square of 64 and two more of them, whole
  PostBox box = block_region(id);
  box.column -= reach;
  box.row -= reach;
  box.columns += 2 * reach;
  box.rows += 2 * reach;
  return box;
}

void build_block(const TerrainSource& source, const BlockId& id, double far_floor_m,
                 const BlockScratch& scratch, TerrainBlock& block) {
  const PostBox box = block_region(id);
  const auto count = static_cast<std::size_t>(box.rows) * static_cast<std::size_t>(box.columns);
  RL_ASSERT(scratch.posts.size() >= count);
  block.id = id;
  block.chart = source.lattice.chart;
  block.edits = static_cast<int>(source.edits.size());
  block.facts = {};
  block.rests.fill(0);
  if (source.lattice.polar()) {
    build_polar_block(source, scratch, block);
    return;
  }
  const std::span<float> fine = scratch.posts.first(count);
  const bool fine_posts =
      source.lattice.latitude_step_deg < widest_stride_deg / coarse_geoid_stride;
  const int stride = id.level == 0 || !fine_posts ? 1 : coarse_geoid_stride;
  const std::span<float> rests = id.level == 0 ? scratch.rests.first(count) : std::span<float>{};
  const RegionFacts region = read_region(source, box, stride, fine, scratch.rows, rests);
  const bool with_voids =
      std::any_of(fine.begin(), fine.end(), [](float h) { return std::isnan(h); });
  if (with_voids) put_floors(source, box, far_floor_m, fine);
  Builder builder(id.level, fine, with_voids);
  builder.settle();
  builder.measure(block.facts);
  builder.fill(block);
  if (id.level == 0) put_rests(rests, block);
  BlockFacts& facts = block.facts;
  facts.mismatched_tiles = region.mismatched_tiles;
  facts.mixed = facts.mixed || region.seam_void;
  const bool with_geoid = source.geoid.undulation_m != nullptr;
  finish_residual(region.seam_m + (id.level > 0 && with_geoid ? geoid_slack_m : 0.0), facts);
  const double reach = std::max(std::abs(source.lattice.latitude_deg(box.row)),
                                std::abs(source.lattice.latitude_deg(box.row + box.rows)));
  const double east_m = source.lattice.longitude_step_deg * rad_per_deg * equator_radius_m *
                        std::cos(std::min(reach, 89.99) * rad_per_deg);
  const double north_m = source.lattice.latitude_step_deg * rad_per_deg * polar_radius_m;
  builder.put_ground(east_m, north_m, facts);
  put_ball(source.lattice, id, facts);
}

}  // namespace ridgeline
