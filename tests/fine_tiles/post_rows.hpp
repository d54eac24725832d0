#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/fine_tiles/source_mosaic.hpp"

namespace ridgeline::fine {

/// Columns first..last, both included.
struct ColumnRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(last - first + 1); }
};

/// A field of posts that is made row by row, so that a large one never stands in memory.
/// Units: m, NaN = void. Row 0 is the south edge, column 0 the west one.
class PostRows {
 public:
  PostRows(int rows, int columns, ColumnRange held);
  PostRows(const PostRows&) = delete;
  PostRows& operator=(const PostRows&) = delete;
  virtual ~PostRows() = default;

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] ColumnRange held() const { return held_; }

  /// The held columns of a row. The last four consecutive rows are kept.
  /// Owner: views this object; valid until a row that is four or more away is asked for.
  /// Domain: 0 <= row < rows(), else RL_ASSERT.
  [[nodiscard]] std::span<const float> row(int row);

 protected:
  virtual void make_row(int row, std::span<float> out_m) = 0;

 private:
  struct Kept {
    int row = -1;
    std::vector<float> posts_m;
  };
  int rows_;
  int columns_;
  ColumnRange held_;
  std::array<Kept, 4> kept_;
};

/// The rows of a mosaic.
class MosaicRows final : public PostRows {
 public:
  MosaicRows(const SourceMosaic& mosaic, ColumnRange held)
      : PostRows(mosaic.rows(), mosaic.columns(), held), mosaic_(mosaic) {}

 private:
  void make_row(int row, std::span<float> out_m) override;
  const SourceMosaic& mosaic_;
};

/// New posts beyond the smooth surface: at most this share of the relief of one coarse step.
inline constexpr double detail_share = 0.15;

/// A field with three steps for every step of a coarser one. Posts that lie on a coarse one are
/// that one. The others are on a smooth surface through the coarse posts (cubic, slopes from the
/// neighbours, beyond the edges the mirror image) plus noise of at most detail_share times the
/// relief, the half range of the 3 x 3 coarse posts around, linear between them. Applied twice,
/// the noise of the second time belongs to the finer relief, so it falls as the ground smoothes.
/// A post between coarse ones of which one is void is void: nothing is filled in.
/// A post depends on its index in the field and on `seed` only, never on the columns held: two
/// tiles cut from the field agree on their common edge.
/// Error: the same bits on every machine with IEEE-754 doubles.
class RefinedRows final : public PostRows {
 public:
  /// `coarse` outlives this and holds coarse_columns(held).
  RefinedRows(PostRows& coarse, ColumnRange held, std::uint64_t seed);

  /// The coarse columns that the columns `held` of a refined field are made from.
  [[nodiscard]] static ColumnRange coarse_columns(ColumnRange held, int coarse_column_count);

 private:
  void make_row(int row, std::span<float> out_m) override;
  void blend_rows(int row);

  PostRows& coarse_;
  std::uint64_t seed_;
  std::vector<double> line_m_;    // the smooth surface at the row, at coarse columns
  std::vector<double> relief_m_;  // the relief at the row, at coarse columns
  std::vector<double> lower_m_, lower_top_m_, upper_m_, upper_top_m_;
};

}  // namespace ridgeline::fine
