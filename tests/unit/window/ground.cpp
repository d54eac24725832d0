#include "tests/unit/window/ground.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::test {
namespace {

float taller(float a, float b) {
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  return std::max(a, b);
}

double bilinear(const std::vector<float>& posts, int columns, int rows, double x, double y) {
  const int c = std::min(static_cast<int>(x), columns - 2);
  const int r = std::min(static_cast<int>(y), rows - 2);
  const double fx = x - c, fy = y - r;
  const auto at = [&](int dc, int dr) {
    return static_cast<double>(posts[static_cast<std::size_t>(r + dr) * columns + c + dc]);
  };
  return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
         fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

}  // namespace

PostGrid grid_of(const PostLattice& lattice, const Patch& patch) {
  const double west = lattice.longitude_deg(patch.column);
  return {lattice.latitude_deg(patch.row),
          west - 360.0 * std::floor((west + 180.0) / 360.0 + 1e-12),
          patch.row_ratio * lattice.latitude_step_deg,
          patch.column_ratio * lattice.longitude_step_deg,
          patch.rows,
          patch.columns};
}

int Ground::Sheet::index(int column, int row) const {
  const int x = column - patch.column, y = row - patch.row;
  if (x < 0 || y < 0 || x % patch.column_ratio != 0 || y % patch.row_ratio != 0) return -1;
  const int c = x / patch.column_ratio, r = y / patch.row_ratio;
  return c < patch.columns && r < patch.rows ? r * patch.columns + c : -1;
}

namespace {

std::vector<float> heights_of(const Patch& patch, const Ground::Height& height_m) {
  std::vector<float> posts;
  posts.reserve(static_cast<std::size_t>(patch.rows) * patch.columns);
  for (int r = 0; r < patch.rows; ++r) {
    for (int c = 0; c < patch.columns; ++c) {
      posts.push_back(
          height_m(patch.column + c * patch.column_ratio, patch.row + r * patch.row_ratio));
    }
  }
  return posts;
}

}  // namespace

void Ground::add(const Patch& patch, const Height& height_m) {
  sheets_.push_back({patch, heights_of(patch, height_m), {}});
}

void Ground::edit(const Patch& patch, const Height& height_m) {
  edits_.push_back({patch, heights_of(patch, height_m), {}});
}

void Ground::share(Sheet& a, Sheet& b) {
  const Patch &p = a.patch, &q = b.patch;
  const int west = std::max(p.column, q.column), south = std::max(p.row, q.row);
  const int east = std::min(p.last_column(), q.last_column());
  const int north = std::min(p.last_row(), q.last_row());
  const bool same = p.column_ratio == q.column_ratio && p.row_ratio == q.row_ratio;
  if (west > east || south > north || (!same && west < east && south < north)) return;
  for (int row = south; row <= north; ++row) {
    for (int column = west; column <= east; ++column) {
      const int i = a.index(column, row), j = b.index(column, row);
      if (i < 0 || j < 0) continue;
      float &x = a.truth[static_cast<std::size_t>(i)], &y = b.truth[static_cast<std::size_t>(j)];
      x = y = taller(x, y);
    }
  }
}

void Ground::finish() {
  tiles_.clear();
  for (Sheet& sheet : sheets_) {
    sheet.truth = sheet.raw;
    tiles_.push_back({grid_of(lattice_, sheet.patch), TileLayout::float32_rows,
                      std::as_bytes(std::span(sheet.raw))});
  }
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      for (std::size_t j = i + 1; j < sheets_.size(); ++j) share(sheets_[i], sheets_[j]);
    }
  }
  terrain_edits_.clear();
  for (const Sheet& edit : edits_) {
    terrain_edits_.push_back({grid_of(lattice_, edit.patch), edit.raw});
    for (Sheet& sheet : sheets_) {
      const Patch& p = sheet.patch;
      for (int r = 0; r < p.rows; ++r) {
        for (int c = 0; c < p.columns; ++c) {
          const int k = edit.index(p.column + c * p.column_ratio, p.row + r * p.row_ratio);
          if (k < 0) continue;
          sheet.truth[static_cast<std::size_t>(r) * p.columns + c] =
              edit.raw[static_cast<std::size_t>(k)];
        }
      }
    }
  }
}

TerrainSource Ground::source(int edits) const {
  const std::span<const TerrainEdit> all(terrain_edits_);
  return {lattice_, tiles_, edits < 0 ? all : all.first(static_cast<std::size_t>(edits)), {}};
}

double Ground::height_m(double column, double row) const {
  const Sheet* finest = nullptr;
  for (const Sheet& sheet : sheets_) {
    const Patch& p = sheet.patch;
    const bool holds =
        column >= p.column && column <= p.last_column() && row >= p.row && row <= p.last_row();
    const int size = p.column_ratio * p.row_ratio;
    if (holds &&
        (finest == nullptr || size < finest->patch.column_ratio * finest->patch.row_ratio)) {
      finest = &sheet;
    }
  }
  if (finest == nullptr) return std::nan("");
  const Patch& p = finest->patch;
  return bilinear(finest->truth, p.columns, p.rows, (column - p.column) / p.column_ratio,
                  (row - p.row) / p.row_ratio);
}

bool Ground::cell_known(int column, int row) const {
  return !std::isnan(height_m(column + 0.5, row + 0.5));
}

double lottery(int a, int b, int seed) {
  auto bits = static_cast<std::uint64_t>(a + 4'000'000) * 8'000'009U +
              static_cast<std::uint64_t>(b + 4'000'000) +
              static_cast<std::uint64_t>(seed) * 77'777U;
  bits ^= bits >> 33U;
  bits *= 0xff51afd7ed558ccdULL;
  bits ^= bits >> 33U;
  bits *= 0xc4ceb9fe1a85ec53ULL;
  bits ^= bits >> 33U;
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

Ground::Height rough(int seed) {
  return [seed](int column, int row) {
    const double x = column + 13.0 * seed, y = row - 7.0 * seed;
    const double spire = lottery(column, row, seed) > 0.998 ? 700 : 0;
    const double pit = lottery(row, column, seed) > 0.999 ? -400 : 0;
    return static_cast<float>(std::floor(1000 + 500 * std::sin(x * 0.011) * std::cos(y * 0.013) +
                                         120 * std::sin(x * 0.07 + y * 0.09) +
                                         60 * lottery(column, row, seed + 1) + spire + pit));
  };
}

Ground::Height rough_with_voids(int seed) {
  const Ground::Height land = rough(seed);
  return [land, seed](int column, int row) {
    const bool island = std::sin((column + 31 * seed) * 0.023) * std::sin(row * 0.017) > 0.8;
    const bool pond = std::sin(column * 0.21) * std::sin((row - 5 * seed) * 0.19) > 0.97;
    const bool speck = lottery(column, row, seed + 2) > 0.9995;
    return island || pond || speck ? unknown : land(column, row);
  };
}

PostLattice lattice_3s() {
  return {46.0, 8.0, 1.0 / 1200, 1.0 / 1200};
}

PostLattice lattice_1s() {
  return {46.0, 8.0, 1.0 / 3600, 1.0 / 3600};
}

Region region_of(const TerrainSource& source, const PostBox& box, int geoid_stride) {
  Region region{box, {}, {}};
  region.posts.resize(static_cast<std::size_t>(box.rows) * box.columns);
  std::vector<float> scratch(4 * static_cast<std::size_t>(box.columns) + 8);
  region.facts = read_region(source, box, geoid_stride, region.posts, scratch);
  return region;
}

TerrainBlock block_of(const TerrainSource& source, const BlockId& id, double far_floor_m) {
  const auto side = static_cast<std::size_t>(region_side(id.level));
  std::vector<float> posts(side * side), rows(static_cast<std::size_t>(row_scratch(id.level)));
  TerrainBlock block;
  std::vector<float> rests(region_side(0) * region_side(0));
  build_block(source, id, far_floor_m, {posts, rows, rests}, block);
  return block;
}

}  // namespace ridgeline::test
