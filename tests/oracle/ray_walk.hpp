#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/oracle/ray_path.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::oracle {

/// A part of a ray over one cell, or over a few cells of unknown ground.
/// Units: s of the stretch; x, y in cells of the tile from its south-west post; m over the datum.
struct Piece {
  const Stretch* stretch = nullptr;
  const Quartic* height_m = nullptr;
  const Quartic* x = nullptr;
  const Quartic* y = nullptr;
  double from = 0;
  double to = 0;

  /// A lower bound of the ray's height over the piece.
  [[nodiscard]] double lowest_m() const {
    const double width = to - from;
    return std::min(height_m->at(from), height_m->at(to)) - height_m->bend() * width * width / 8;
  }

  /// The lowest height that the ray takes over the piece; it turns from falling to rising at most
  /// once.
  [[nodiscard]] double attained_low_m() const {
    double falling = from;
    double rising = to;
    if (height_m->slope(falling) < 0 && height_m->slope(rising) > 0) {
      for (int round = 0; round < 40; ++round) {
        const double middle = 0.5 * (falling + rising);
        (height_m->slope(middle) < 0 ? falling : rising) = middle;
      }
    }
    return std::min({height_m->at(from), height_m->at(falling), height_m->at(to)});
  }
};

/// Range of a polynomial over [from, to], a bend's slack included.
struct Range {
  double low;
  double high;
};
[[nodiscard]] inline Range range_of(const Quartic& polynomial, double from, double to) {
  const double slack = polynomial.bend() * (to - from) * (to - from) / 8;
  const double a = polynomial.at(from);
  const double b = polynomial.at(to);
  return {std::min(a, b) - slack, std::max(a, b) + slack};
}

/// Walks one ray and shows a visitor what it passes, in order. A visitor has
///   bool skips(const Block& all, const Piece&)    true where nothing under the piece matters
///   bool known(corners, Piece)                    a known cell; true ends the walk
///   void unknown(must_below_m, may_below_m, Piece)  an unknown cell
///   bool wants_unknown()                          false once unknown ground no longer matters
template <class Visitor>
class RayWalk {
 public:
  RayWalk(const Tracer& tracer, const Vec3& direction, double to_m, Visitor& visitor)
      : tracer_(tracer), direction_(direction), to_m_(to_m), visitor_(visitor) {}

  void run() {
    const AxisPassage axis(tracer_.eye(), direction_);
    double lon_deg = tracer_.eye_lon_deg();
    double from_m = axis.past_axis_m(0);
    while (from_m < to_m_) {
      const double end_m = std::min(to_m_, from_m + axis.stretch_length_m(from_m));
      stretch_ = stretch(tracer_.eye(), direction_, from_m, end_m, lon_deg);
      lon_deg = stretch_.lon_deg.at(1);
      // A straight line's height over the ellipsoid is convex: once it rises it goes on rising.
      constexpr double margin_m = 250;  // more than any undulation of the geoid
      const double ceiling =
          std::max(tracer_.terrain().highest_post_m(), may_be_unknown_below_m) + margin_m;
      if (stretch_.height_m.slope(-1) >= 0 && stretch_.height_m.at(-1) > ceiling) return;
      if (walk_stretch()) return;
      from_m = axis.past_axis_m(end_m);
    }
  }

 private:
  using Cuts = std::vector<double>;

  /// A tile with its edges on the turn of the ray.
  struct Placed {
    const Tracer::View* view;
    double west_deg;
    double east_deg;
  };

  static void sort_cuts(Cuts& cuts, double from, double to) {
    cuts.push_back(from);
    cuts.push_back(to);
    std::sort(cuts.begin(), cuts.end());
  }

  bool walk_stretch() {
    const Geoid& geoid = tracer_.terrain().geoid();
    Cuts& cuts = geoid_cuts_;
    cuts.clear();
    if (!geoid.is_none()) {
      const GeoidPatch first = geoid.patch(stretch_.lat_deg.at(0), stretch_.lon_deg.at(0));
      append_lines(stretch_.lat_deg.mapped(first.south_deg, 1 / first.lat_step_deg), -1, 1, cuts);
      append_lines(stretch_.lon_deg.mapped(first.west_deg, 1 / first.lon_step_deg), -1, 1, cuts);
    }
    sort_cuts(cuts, -1, 1);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double from = cuts[i];
      const double to = cuts[i + 1];
      if (to <= from) continue;
      const double middle = 0.5 * (from + to);
      const GeoidPatch patch =
          geoid.patch(stretch_.lat_deg.at(middle), stretch_.lon_deg.at(middle));
      height_ = geoid.is_none() ? stretch_.height_m : datum_height_m(stretch_, patch);
      may_below_m_ = may_be_unknown_below_m + std::max(0.0, -patch.at(stretch_.lat_deg.at(middle),
                                                                      stretch_.lon_deg.at(middle)));
      if (walk_patch(from, to)) return true;
    }
    return false;
  }

  /// Cuts at the edges of tiles.
  bool walk_patch(double from, double to) {
    const Piece whole{&stretch_, &height_, nullptr, nullptr, from, to};
    if (tracer_.walk() == Walk::accelerated && !visitor_.wants_unknown()) {
      const auto highest = static_cast<float>(tracer_.terrain().highest_post_m());
      if (visitor_.skips(Block{0, highest, 0, false}, whole)) return false;
    }
    const Range lat = range_of(stretch_.lat_deg, from, to);
    const Range lon = range_of(stretch_.lon_deg, from, to);
    Cuts& cuts = tile_cuts_;
    cuts.clear();
    if (!is_gathered(lat, lon)) gather(lat, lon);
    for (const Placed& placed : nearby_) {
      const Tracer::View& view = *placed.view;
      if (lat.high < view.south_deg || lat.low > view.north_deg || lon.high < placed.west_deg ||
          lon.low > placed.east_deg) {
        continue;
      }
      for (const double edge : {view.south_deg, view.north_deg}) {
        if (edge >= lat.low && edge <= lat.high) {
          append_crossings(stretch_.lat_deg, edge, from, to, cuts);
        }
      }
      for (const double edge : {placed.west_deg, placed.east_deg}) {
        if (edge >= lon.low && edge <= lon.high) {
          append_crossings(stretch_.lon_deg, edge, from, to, cuts);
        }
      }
    }
    sort_cuts(cuts, from, to);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] <= cuts[i]) continue;
      const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
      const Placed* placed = placed_at(stretch_.lat_deg.at(middle), stretch_.lon_deg.at(middle));
      if (placed == nullptr) {
        walk_outside(cuts[i], cuts[i + 1]);
      } else if (walk_tile(*placed, cuts[i], cuts[i + 1])) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool is_gathered(const Range& lat, const Range& lon) const {
    return lat.low >= gathered_lat_.low && lat.high <= gathered_lat_.high &&
           lon.low >= gathered_lon_.low && lon.high <= gathered_lon_.high;
  }

  /// Collects the tiles round a place, finest first; a tile wider than a turn is placed twice.
  void gather(const Range& lat, const Range& lon) {
    constexpr double lat_margin_deg = 0.5;
    const double highest_lat = std::min(std::max(std::abs(lat.low), std::abs(lat.high)), 88.0);
    const double lon_margin_deg = lat_margin_deg / std::cos(highest_lat * degree_rad);
    gathered_lat_ = {lat.low - lat_margin_deg, lat.high + lat_margin_deg};
    gathered_lon_ = {lon.low - lon_margin_deg, lon.high + lon_margin_deg};
    nearby_.clear();
    for (const Tracer::View& view : tracer_.views()) {
      if (gathered_lat_.high < view.south_deg || gathered_lat_.low > view.north_deg) continue;
      const double last = std::floor((gathered_lon_.high - view.west_deg) / 360);
      for (double turn = std::ceil((gathered_lon_.low - view.east_deg) / 360); turn <= last;
           ++turn) {
        nearby_.push_back({&view, shared_edge(view.west_deg + 360 * turn),
                           shared_edge(view.east_deg + 360 * turn)});
      }
    }
  }

  const Placed* placed_at(double lat, double lon) const {
    const double latitude = std::clamp(lat, -90.0, 90.0);  // a polynomial may overshoot the pole
    for (const Placed& placed : nearby_) {
      if (latitude >= placed.view->south_deg && latitude <= placed.view->north_deg &&
          lon >= placed.west_deg && lon <= placed.east_deg) {
        return &placed;
      }
    }
    return nullptr;
  }

  bool walk_tile(const Placed& placed, double from, double to) {
    tile_ = &placed.view->entry->tile;
    levels_ = &placed.view->entry->levels;
    x_ = stretch_.lon_deg.mapped(placed.west_deg, 1 / tile_->lon_step_deg);
    y_ = stretch_.lat_deg.mapped(placed.view->south_deg, 1 / tile_->lat_step_deg);
    return walk_interval(from, to);
  }

  static int cell(double coordinate, int posts) {
    return static_cast<int>(std::clamp(std::floor(coordinate), 0.0, posts - 2.0));
  }

  bool walk_interval(double from, double to) {
    const Range x = range_of(x_, from, to);
    const Range y = range_of(y_, from, to);
    const int column_0 = cell(x.low, tile_->columns);
    const int column_1 = cell(x.high, tile_->columns);
    const int row_0 = cell(y.low, tile_->rows);
    const int row_1 = cell(y.high, tile_->rows);
    const int extent = std::max(column_1 - column_0, row_1 - row_0);
    const bool accelerated = tracer_.walk() == Walk::accelerated;
    if (accelerated) {
      const Piece piece{&stretch_, &height_, &x_, &y_, from, to};
      if (visitor_.skips(summary(row_0, row_1, column_0, column_1), piece)) return false;
    }
    if (extent <= (accelerated ? 6 : 40) || to - from < 1e-9) return walk_cells(from, to);
    const double middle = 0.5 * (from + to);
    return walk_interval(from, middle) || walk_interval(middle, to);
  }

  /// One block that covers a rectangle of cells.
  Block summary(int row_0, int row_1, int column_0, int column_1) const {
    std::size_t level = 0;
    int r0 = row_0 / block_cells;
    int r1 = row_1 / block_cells;
    int c0 = column_0 / block_cells;
    int c1 = column_1 / block_cells;
    while (r1 - r0 > 1 || c1 - c0 > 1) {
      ++level;
      r0 /= 2;
      r1 /= 2;
      c0 /= 2;
      c1 /= 2;
    }
    Block all = (*levels_)[level].at(r0, c0);
    for (int r = r0; r <= r1; ++r) {
      for (int c = c0; c <= c1; ++c) {
        const Block& part = (*levels_)[level].at(r, c);
        all.highest_m = std::max(all.highest_m, part.highest_m);
        all.must_below_m = std::max(all.must_below_m, part.must_below_m);
        all.has_unknown = all.has_unknown || part.has_unknown;
      }
    }
    return all;
  }

  /// Appends where a coordinate in cells takes a whole value.
  static void append_lines(const Quartic& coordinate, double from, double to, Cuts& cuts) {
    const Range range = range_of(coordinate, from, to);
    const int last = static_cast<int>(std::floor(range.high));
    for (int line = static_cast<int>(std::ceil(range.low)); line <= last; ++line) {
      append_crossings(coordinate, line, from, to, cuts);
    }
  }

  bool walk_cells(double from, double to) {
    Cuts& cuts = cell_cuts_;
    cuts.clear();
    append_lines(x_, from, to, cuts);
    append_lines(y_, from, to, cuts);
    sort_cuts(cuts, from, to);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] <= cuts[i]) continue;
      const Piece piece{&stretch_, &height_, &x_, &y_, cuts[i], cuts[i + 1]};
      const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
      const int column = cell(x_.at(middle), tile_->columns);
      const int row = cell(y_.at(middle), tile_->rows);
      const float corner[4] = {tile_->at(row, column), tile_->at(row, column + 1),
                               tile_->at(row + 1, column), tile_->at(row + 1, column + 1)};
      if (std::isnan(corner[0] + corner[1] + corner[2] + corner[3])) {
        if (!visitor_.wants_unknown() || is_left_at_once(piece)) continue;
        const Block& block = levels_->front().at(row / block_cells, column / block_cells);
        visitor_.unknown(static_cast<double>(block.must_below_m), may_below_m_, piece);
      } else if (visitor_.known(corner, row, column, piece)) {
        return true;
      }
    }
    return false;
  }

  /// A piece so short and so near the eye that it only says on which side of a line rounding put
  /// an eye that stands on it.
  [[nodiscard]] bool is_left_at_once(const Piece& piece) const {
    constexpr double rounding_m = 2e-6;  // twice what a stretch may be off by
    return tracer_.eye_on_a_line() && piece.stretch->distance_m(piece.to) < rounding_m;
  }

  /// What brings a longitude to the turn closest to a tile.
  static double turn_to(const Tracer::View& view, double lon) {
    return 360 * std::round((0.5 * (view.west_deg + view.east_deg) - lon) / 360);
  }

  /// The nearest tile of a file: stated sea has the finest steps of the folder, which may not be
  /// those of the data that is missing. Null where all is stated sea.
  const Tile* nearest_tile(double lat, double lon) const {
    const Tile* best = nullptr;
    double best_distance = std::numeric_limits<double>::infinity();
    for (const Tracer::View& view : tracer_.views()) {
      if (view.entry->tile.sea) continue;
      const double north = std::max({view.south_deg - lat, lat - view.north_deg, 0.0});
      const double turned = lon + turn_to(view, lon);
      const double east = std::max({view.west_deg - turned, turned - view.east_deg, 0.0}) *
                          std::cos(lat * degree_rad);
      const double distance = north * north + east * east;
      if (distance < best_distance) {
        best_distance = distance;
        best = &view.entry->tile;
      }
    }
    return best;
  }

  /// Ground without a tile: unknown cells with the steps of the nearest tile.
  void walk_outside(double from, double to) {
    const Piece piece{&stretch_, &height_, nullptr, nullptr, from, to};
    if (!visitor_.wants_unknown() || is_left_at_once(piece)) return;
    if (piece.lowest_m() >= std::max(may_below_m_, tracer_.terrain().highest_post_m())) return;
    const double middle = 0.5 * (from + to);
    const Tile* nearest = nearest_tile(stretch_.lat_deg.at(middle), stretch_.lon_deg.at(middle));
    if (nearest == nullptr) {
      visitor_.unknown(tracer_.terrain().lowest_post_m(), may_below_m_, piece);
      return;
    }
    const Tile& tile = *nearest;
    const Range lat = range_of(stretch_.lat_deg, from, to);
    const Range lon = range_of(stretch_.lon_deg, from, to);
    const double extent = std::max((lat.high - lat.low) / tile.lat_step_deg,
                                   (lon.high - lon.low) / tile.lon_step_deg);
    // Above the lowest post only nearby posts could raise the threshold: look closer, or be content
    // with the threshold that holds everywhere.
    if (extent > block_cells && to - from > 1e-9 && near_a_tile(lat, lon, tile)) {
      walk_outside(from, middle);
      walk_outside(middle, to);
      return;
    }
    const double must_below =
        near_a_tile(lat, lon, tile)
            ? tracer_.terrain().must_below_m({lat.low, lat.high, lon.low, lon.high},
                                             tile.lat_step_deg, tile.lon_step_deg)
            : tracer_.terrain().lowest_post_m();
    visitor_.unknown(must_below, may_below_m_, piece);
  }

  bool near_a_tile(const Range& lat, const Range& lon, const Tile& tile) const {
    const double lat_reach = 128 * tile.lat_step_deg;
    const double lon_reach = 128 * tile.lon_step_deg;
    return std::any_of(
        tracer_.views().begin(), tracer_.views().end(), [&](const Tracer::View& view) {
          const double turn = turn_to(view, 0.5 * (lon.low + lon.high));
          return lat.high > view.south_deg - lat_reach && lat.low < view.north_deg + lat_reach &&
                 lon.high + turn > view.west_deg - lon_reach &&
                 lon.low + turn < view.east_deg + lon_reach;
        });
  }

  const Tracer& tracer_;
  const Vec3 direction_;
  const double to_m_;
  Visitor& visitor_;
  Stretch stretch_;
  Quartic height_;
  Quartic x_;
  Quartic y_;
  double may_below_m_ = 0;
  const Tile* tile_ = nullptr;
  const std::vector<BlockLevel>* levels_ = nullptr;
  std::vector<Placed> nearby_;  ///< the tiles that meet the gathered box
  Range gathered_lat_{0, -1};
  Range gathered_lon_{0, -1};
  Cuts geoid_cuts_;
  Cuts tile_cuts_;
  Cuts cell_cuts_;
};

}  // namespace ridgeline::oracle
