#include "tests/fine_tiles/post_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/assert.hpp"
#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::fine {
namespace {

constexpr int steps = 3;  // of a refined field for one of the coarse one

/// An index beyond an edge, mirrored back into 0..last.
int mirrored(int index, int last) {
  if (index < 0) return -index;
  return index > last ? 2 * last - index : index;
}

/// The smooth curve through b (t = 0) and c (t = 1) with the neighbours a and d. A void neighbour
/// is taken on the straight line through b and c.
double curve(double a, double b, double c, double d, double t) {
  if (t == 0) return b;
  if (std::isnan(a)) a = 2 * b - c;
  if (std::isnan(d)) d = 2 * c - b;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// Even noise within -1..1.
double noise(int column, int row, std::uint64_t seed) {
  return static_cast<double>(sim::lattice_hash(column, row, seed) >> 11) * 0x1p-52 - 1;
}

double lowest(double a, double b, double c) {
  return std::fmin(std::fmin(a, b), c);  // a void one does not count
}
double highest(double a, double b, double c) {
  return std::fmax(std::fmax(a, b), c);
}

}  // namespace

PostRows::PostRows(int rows, int columns, ColumnRange held)
    : rows_(rows), columns_(columns), held_(held) {
  RL_ASSERT(held.first >= 0 && held.first <= held.last && held.last < columns);
  for (Kept& kept : kept_) kept.posts_m.resize(held.count());
}

std::span<const float> PostRows::row(int row) {
  RL_ASSERT(row >= 0 && row < rows_);
  Kept& kept = kept_[static_cast<std::size_t>(row) % kept_.size()];
  if (kept.row != row) {
    make_row(row, kept.posts_m);
    kept.row = row;
  }
  return kept.posts_m;
}

void MosaicRows::make_row(int row, std::span<float> out_m) {
  for (std::size_t k = 0; k < out_m.size(); ++k) {
    const std::int16_t post = mosaic_.post_m(row, held().first + static_cast<int>(k));
    out_m[k] = post == void_post ? std::numeric_limits<float>::quiet_NaN() : post;
  }
}

RefinedRows::RefinedRows(PostRows& coarse, ColumnRange held, std::uint64_t seed)
    : PostRows(steps * (coarse.rows() - 1) + 1, steps * (coarse.columns() - 1) + 1, held),
      coarse_(coarse),
      seed_(seed) {
  const ColumnRange needed = coarse_columns(held, coarse.columns());
  RL_ASSERT(coarse.held().first <= needed.first && coarse.held().last >= needed.last);
  RL_ASSERT(coarse.rows() >= 3 && coarse.columns() >= 3);
  const std::size_t count = coarse.held().count();
  RL_ASSERT(count >= 2);
  for (auto* row_m : {&line_m_, &relief_m_, &lower_m_, &lower_top_m_, &upper_m_, &upper_top_m_}) {
    row_m->resize(count);
  }
}

ColumnRange RefinedRows::coarse_columns(ColumnRange held, int coarse_column_count) {
  return {std::max(0, held.first / steps - 1),
          std::min(coarse_column_count - 1, held.last / steps + 2)};
}

void RefinedRows::blend_rows(int row) {
  const int base = row / steps;
  const double t = static_cast<double>(row % steps) / steps;
  const int last = coarse_.rows() - 1;
  std::array<std::span<const float>, 4> lines;
  for (int k = 0; k < 4; ++k) {
    lines[static_cast<std::size_t>(k)] = coarse_.row(mirrored(base - 1 + k, last));
  }
  const std::size_t count = line_m_.size();
  for (std::size_t c = 0; c < count; ++c) {
    const double a = lines[0][c], b = lines[1][c], up = lines[2][c], d = lines[3][c];
    line_m_[c] = curve(a, b, up, d, t);
    lower_m_[c] = lowest(a, b, up);
    lower_top_m_[c] = highest(a, b, up);
    upper_m_[c] = lowest(b, up, d);
    upper_top_m_[c] = highest(b, up, d);
  }
  for (std::size_t c = 0; c < count; ++c) {
    // A range that ends inside the field has a spare column there; at an edge of the field the
    // missing neighbour is the mirror image of the other one.
    const std::size_t west = c == 0 ? 1 : c - 1;
    const std::size_t east = c + 1 == count ? count - 2 : c + 1;
    const double here = highest(lower_top_m_[west], lower_top_m_[c], lower_top_m_[east]) -
                        lowest(lower_m_[west], lower_m_[c], lower_m_[east]);
    const double above = highest(upper_top_m_[west], upper_top_m_[c], upper_top_m_[east]) -
                         lowest(upper_m_[west], upper_m_[c], upper_m_[east]);
    relief_m_[c] = 0.5 * (here + t * (above - here));
  }
}

void RefinedRows::make_row(int row, std::span<float> out_m) {
  blend_rows(row);
  const int first = coarse_.held().first;
  const int last = coarse_.columns() - 1;
  const auto at = [&](const std::vector<double>& line, int column) {
    return line[static_cast<std::size_t>(mirrored(column, last) - first)];
  };
  for (std::size_t k = 0; k < out_m.size(); ++k) {
    const int column = held().first + static_cast<int>(k);
    const int base = column / steps;
    if (column % steps == 0 && row % steps == 0) {
      out_m[k] = static_cast<float>(at(line_m_, base));
      continue;
    }
    const double t = static_cast<double>(column % steps) / steps;
    const double smooth_m = curve(at(line_m_, base - 1), at(line_m_, base), at(line_m_, base + 1),
                                  at(line_m_, base + 2), t);
    const double west_m = at(relief_m_, base);
    const double relief_m = west_m + t * (at(relief_m_, base + 1) - west_m);
    out_m[k] = static_cast<float>(smooth_m + detail_share * relief_m * noise(column, row, seed_));
  }
}

}  // namespace ridgeline::fine
