#include "tests/oracle/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/oracle/ray_walk.hpp"

namespace ridgeline::oracle {
namespace {

/// Ray minus bilinear surface over one piece, as a function of s.
class Gap {
 public:
  Gap(const float corner[4], int row, int column, const Piece& piece)
      : piece_(piece), row_(row), column_(column), c0_(static_cast<double>(corner[0])) {
    cx_ = static_cast<double>(corner[1]) - c0_;
    cy_ = static_cast<double>(corner[2]) - c0_;
    cxy_ = static_cast<double>(corner[3]) - static_cast<double>(corner[1]) -
           static_cast<double>(corner[2]) + c0_;
  }

  [[nodiscard]] double at(double s) const {
    const double x = piece_.x->at(s) - column_;
    const double y = piece_.y->at(s) - row_;
    return piece_.height_m->at(s) - (c0_ + cx_ * x + (cy_ + cxy_ * x) * y);
  }

  /// Largest distance of the gap from the quadratic through its ends and middle. Were x and y
  /// linear the gap would be that quadratic, but for the height's own third order.
  [[nodiscard]] double not_quadratic() const {
    const double width = piece_.to - piece_.from;
    const double bend_x = piece_.x->bend() * width * width / 8;
    const double bend_y = piece_.y->bend() * width * width / 8;
    const double wiggle = (std::abs(piece_.height_m->c[3]) + 4 * std::abs(piece_.height_m->c[4])) *
                          width * width * width;
    return 3 * ((std::abs(cx_) + std::abs(cxy_)) * bend_x +
                (std::abs(cy_) + std::abs(cxy_)) * bend_y + wiggle) +
           1e-9;
  }

 private:
  const Piece& piece_;
  int row_;
  int column_;
  double c0_;
  double cx_;
  double cy_;
  double cxy_;
};

/// The s at which a gap that is positive at `above` and not at `below` comes to zero.
double zero_between(const Gap& gap, double above, double below) {
  double at_above = gap.at(above);
  double at_below = gap.at(below);
  // Illinois false position: bracketed throughout, and superlinear on a near-quadratic.
  int last_side = 0;
  for (int round = 0; round < 100 && std::abs(below - above) > 1e-15; ++round) {
    double s = above + (below - above) * at_above / (at_above - at_below);
    if (round > 30) s = 0.5 * (above + below);
    const double value = gap.at(s);
    if (value == 0) return s;
    const int side = value > 0 ? 1 : -1;
    if (value > 0) {
      above = s;
      at_above = value;
      if (last_side == side) at_below *= 0.5;
    } else {
      below = s;
      at_below = value;
      if (last_side == side) at_above *= 0.5;
    }
    last_side = side;
  }
  return below;
}

/// The lowest point of a gap inside a piece, by golden section.
double lowest_point(const Gap& gap, double from, double to) {
  constexpr double golden = 0.6180339887498949;
  double a = to - golden * (to - from);
  double b = from + golden * (to - from);
  double at_a = gap.at(a);
  double at_b = gap.at(b);
  for (int round = 0; round < 60; ++round) {
    if (at_a < at_b) {
      to = b;
      b = a;
      at_b = at_a;
      a = to - golden * (to - from);
      at_a = gap.at(a);
    } else {
      from = a;
      a = b;
      at_a = at_b;
      b = from + golden * (to - from);
      at_b = gap.at(b);
    }
  }
  return 0.5 * (from + to);
}

/// Where in [0, 1] the quadratic through three values turns upwards, if it does.
std::optional<double> valley(double at_0, double at_half, double at_1) {
  const double curvature = 2 * (at_0 - 2 * at_half + at_1);
  const double slope = at_1 - at_0 - curvature;
  if (!(curvature > 0)) return std::nullopt;
  const double place = -slope / (2 * curvature);
  if (!(place > 0) || !(place < 1)) return std::nullopt;
  return place;
}

/// The first s at which the ray is on or below the surface of one cell.
std::optional<double> first_touch(const Gap& gap, const Piece& piece) {
  const double at_from = gap.at(piece.from);
  if (at_from <= 0) return piece.from;
  const double at_to = gap.at(piece.to);
  if (at_to <= 0) return zero_between(gap, piece.from, piece.to);
  const double width = piece.to - piece.from;
  const double at_middle = gap.at(piece.from + 0.5 * width);
  if (at_middle <= 0) return zero_between(gap, piece.from, piece.from + 0.5 * width);
  const std::optional<double> place = valley(at_from, at_middle, at_to);
  if (!place) return std::nullopt;
  const double curvature = 2 * (at_from - 2 * at_middle + at_to);
  const double lowest = at_from - curvature * *place * *place;
  if (lowest > gap.not_quadratic()) return std::nullopt;
  const double bottom = lowest_point(gap, piece.from, piece.to);
  if (gap.at(bottom) > 0) return std::nullopt;
  return zero_between(gap, piece.from, bottom);
}

/// Finds the first hit, and on the way what unknown ground is passed.
struct HitVisitor {
  FirstHit hit;

  [[nodiscard]] bool wants_unknown() const { return !hit.may_be_unknown || !hit.must_be_unknown; }

  [[nodiscard]] bool skips(const Block& all, const Piece& piece) const {
    const double lowest = piece.lowest_m();
    if (lowest <= static_cast<double>(all.highest_m)) return false;
    if (!all.has_unknown) return true;
    return (hit.may_be_unknown || lowest >= may_be_unknown_below_m + 250) &&
           (hit.must_be_unknown || lowest >= static_cast<double>(all.must_below_m));
  }

  bool known(const float corner[4], int row, int column, const Piece& piece) {
    const float highest = std::max({corner[0], corner[1], corner[2], corner[3]});
    if (piece.lowest_m() > static_cast<double>(highest)) return false;
    const Gap gap(corner, row, column, piece);
    const std::optional<double> touch = first_touch(gap, piece);
    if (!touch) return false;
    hit.distance_m = piece.stretch->distance_m(*touch);
    return true;
  }

  void unknown(double must_below_m, double may_below_m, const Piece& piece) {
    constexpr double rounding_m = 1e-3;
    const double lowest = piece.attained_low_m();
    hit.must_be_unknown = hit.must_be_unknown || lowest < must_below_m;
    hit.may_be_unknown =
        hit.may_be_unknown || hit.must_be_unknown || lowest < may_below_m + rounding_m;
  }
};

/// Finds the smallest height over the known surface per distance.
struct ClearanceVisitor {
  double smallest;

  [[nodiscard]] static bool wants_unknown() { return false; }
  static void unknown(double /*must*/, double /*may*/, const Piece& /*piece*/) {}

  [[nodiscard]] bool skips(const Block& all, const Piece& piece) const {
    const double gap = piece.lowest_m() - static_cast<double>(all.highest_m);
    const double distance = piece.stretch->distance_m(gap > 0 ? piece.to : piece.from);
    return gap > smallest * distance;
  }

  bool known(const float corner[4], int row, int column, const Piece& piece) {
    const Gap gap(corner, row, column, piece);
    const auto ratio = [&](double s) {
      return gap.at(s) / std::max(1e-3, piece.stretch->distance_m(s));
    };
    const double width = piece.to - piece.from;
    const double at_from = ratio(piece.from);
    const double at_middle = ratio(piece.from + 0.5 * width);
    const double at_to = ratio(piece.to);
    smallest = std::min({smallest, at_from, at_middle, at_to});
    const std::optional<double> place = valley(at_from, at_middle, at_to);
    if (place) smallest = std::min(smallest, ratio(piece.from + *place * width));
    return false;
  }
};

/// What counts as one place, in degrees: 1e-8 m, a few roundings of a coordinate in double.
constexpr double line_deg = 1e-13;

bool is_on_a_line(double place_deg, double first_deg, double step_deg) {
  const double line = first_deg + std::round((place_deg - first_deg) / step_deg) * step_deg;
  return std::abs(place_deg - line) <= line_deg;
}

}  // namespace

double shared_edge(double degrees) {
  return std::round(degrees * 3.6e9) / 3.6e9;
}

Tracer::Tracer(const Terrain& terrain, const Geodetic& eye, double range_m, Walk walk)
    : terrain_(&terrain),
      eye_(ecef_from_geodetic(eye)),
      eye_lon_deg_(eye.lon_deg),
      range_m_(range_m),
      walk_(walk) {
  for (const TerrainTile& entry : terrain.tiles()) {
    const Tile& tile = entry.tile;
    views_.push_back({&entry, shared_edge(tile.south_deg), shared_edge(tile.north_deg()),
                      shared_edge(tile.west_deg), shared_edge(tile.east_deg())});
    const View& view = views_.back();
    const double turned =
        eye.lon_deg + 360 * std::ceil((view.west_deg - line_deg - eye.lon_deg) / 360);
    const bool inside = eye.lat_deg >= view.south_deg - line_deg &&
                        eye.lat_deg <= view.north_deg + line_deg &&
                        turned <= view.east_deg + line_deg;
    eye_on_a_line_ = eye_on_a_line_ ||
                     (inside && (is_on_a_line(eye.lat_deg, view.south_deg, tile.lat_step_deg) ||
                                 is_on_a_line(turned, view.west_deg, tile.lon_step_deg)));
  }
}

FirstHit Tracer::first_hit(const Vec3& direction) const {
  HitVisitor visitor;
  RayWalk<HitVisitor>(*this, direction, range_m_, visitor).run();
  return visitor.hit;
}

double Tracer::clearance(const Vec3& direction, double to_m, double ceiling) const {
  ClearanceVisitor visitor{ceiling};
  RayWalk<ClearanceVisitor>(*this, direction, to_m, visitor).run();
  return visitor.smallest;
}

}  // namespace ridgeline::oracle
