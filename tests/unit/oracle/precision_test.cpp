// By how much the oracle's own truth may be off: the same definition of the first hit, evaluated
// in long double (64 bits of mantissa on x86) without stretches, polynomials or summaries.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "tests/oracle/tracer.hpp"
#include "tests/unit/oracle/scenes.hpp"

namespace ridgeline::oracle {
namespace {

using Long = long double;

constexpr Long long_pi = 3.14159265358979323846264338327950288L;
constexpr Long long_a = 6378137.0L;
constexpr Long long_f = 1.0L / 298.257223563L;
constexpr Long long_e2 = long_f * (2 - long_f);
constexpr Long posts_per_degree = 1200;

struct LongVec {
  Long x = 0;
  Long y = 0;
  Long z = 0;
};

/// The height of a ray over the surface of one tile, straight from the contract.
class ExactRay {
 public:
  /// `steepest_m`: the largest step between neighbouring posts.
  ExactRay(const Tile& tile, const Geoid& geoid, float steepest_m, const Geodetic& eye,
           const Vec3& direction)
      : tile_(tile), geoid_(geoid), way_{direction.x, direction.y, direction.z} {
    const Long lat = static_cast<Long>(eye.lat_deg) * long_pi / 180;
    const Long lon = static_cast<Long>(eye.lon_deg) * long_pi / 180;
    const Long n = long_a / std::sqrt(1 - long_e2 * std::sin(lat) * std::sin(lat));
    const Long h = static_cast<Long>(eye.height_m);
    eye_ = {(n + h) * std::cos(lat) * std::cos(lon), (n + h) * std::cos(lat) * std::sin(lon),
            (n * (1 - long_e2) + h) * std::sin(lat)};
    const Long north_m = long_a / posts_per_degree * long_pi / 180 * 0.99L;
    const Long east_m = north_m * std::cos(lat) * 0.97L;
    change_ = 1.1L + 2 * static_cast<Long>(steepest_m) / east_m;
    twist_per_m2_ = 1 / (north_m * east_m);
  }

  struct Place {
    Long over_m = 0;  ///< height over the surface
    Long twist = 0;   ///< of the cell's surface, m
    int column = 0;   ///< of the cell
    int row = 0;
    long geoid_cell = 0;
  };

  [[nodiscard]] Place at(Long t) const {
    const LongVec p{eye_.x + t * way_.x, eye_.y + t * way_.y, eye_.z + t * way_.z};
    const Long level = std::sqrt(p.x * p.x + p.y * p.y);
    const Long b = long_a * (1 - long_f);
    Long tan_beta = p.z * long_a / (level * b);
    Long tan_lat = 0;
    for (int round = 0; round < 4; ++round) {
      const Long cos_beta = 1 / std::sqrt(1 + tan_beta * tan_beta);
      const Long sin_beta = tan_beta * cos_beta;
      tan_lat = (p.z + long_e2 / (1 - long_e2) * b * sin_beta * sin_beta * sin_beta) /
                (level - long_e2 * long_a * cos_beta * cos_beta * cos_beta);
      tan_beta = (1 - long_f) * tan_lat;
    }
    const Long cos_lat = 1 / std::sqrt(1 + tan_lat * tan_lat);
    const Long sin_lat = tan_lat * cos_lat;
    const Long height =
        level * cos_lat + p.z * sin_lat - long_a * std::sqrt(1 - long_e2 * sin_lat * sin_lat);
    const Long lat = std::atan(tan_lat) * 180 / long_pi;
    const Long lon = std::atan2(p.y, p.x) * 180 / long_pi;
    return over_surface(lat, lon, height);
  }

  /// The first t at which the ray is on or under the surface, or nothing: intervals are halved
  /// until a bound of the first or (inside one cell) of the second derivative excludes a hit.
  [[nodiscard]] std::optional<Long> first_hit(Long range_m) const {
    return first_hit(0, range_m, at(0), at(range_m));
  }

  /// How deep the ray dips under the surface behind a first hit, m.
  [[nodiscard]] Long dip_m(Long t) const {
    Long deepest = 0;
    for (Long beyond = 1e-9L; beyond < 20; beyond *= 1.1L) {
      const Long over = at(t + beyond).over_m;
      if (over > 0) break;
      deepest = std::max(deepest, -over);
    }
    return deepest;
  }

 private:
  [[nodiscard]] Place over_surface(Long lat, Long lon, Long height) const {
    const Long x = (lon - static_cast<Long>(tile_.west_deg)) * posts_per_degree;
    const Long y = (lat - static_cast<Long>(tile_.south_deg)) * posts_per_degree;
    Place place;
    place.column = static_cast<int>(std::floor(x));
    place.row = static_cast<int>(std::floor(y));
    const Long u = x - place.column;
    const Long v = y - place.row;
    const auto post = [&](int r, int c) {
      return static_cast<Long>(tile_.at(place.row + r, place.column + c));
    };
    place.twist = post(1, 1) - post(1, 0) - post(0, 1) + post(0, 0);
    const Long ground = (post(0, 0) * (1 - u) + post(0, 1) * u) * (1 - v) +
                        (post(1, 0) * (1 - u) + post(1, 1) * u) * v;
    const auto near_lat = static_cast<double>(lat);
    const auto near_lon = static_cast<double>(lon);
    const GeoidPatch patch = geoid_.patch(near_lat, near_lon);
    place.geoid_cell =
        std::lround(patch.south_deg * 1e4) * 10'000'000 + std::lround(patch.west_deg * 1e4);
    const Long undulation = geoid_.is_none() ? 0 : static_cast<Long>(patch.at(near_lat, near_lon));
    place.over_m = height - undulation - ground;
    return place;
  }

  [[nodiscard]] std::optional<Long> first_hit(Long from, Long to, const Place& at_from,
                                              const Place& at_to) const {
    if (at_from.over_m <= 0) return from;
    const Long width = to - from;
    // From either end the height cannot change faster than `change_`.
    if (at_from.over_m + at_to.over_m > change_ * width) return std::nullopt;
    const bool is_one_cell = at_from.column == at_to.column && at_from.row == at_to.row &&
                             at_from.geoid_cell == at_to.geoid_cell;
    const Long bend = 2.5L * std::abs(at_from.twist) * twist_per_m2_ + 1e-4L;
    if (is_one_cell && std::min(at_from.over_m, at_to.over_m) > bend * width * width / 8) {
      return std::nullopt;
    }
    if (width < 1e-10L) return at_to.over_m <= 0 ? std::optional<Long>(to) : std::nullopt;
    const Long middle = 0.5L * (from + to);
    const Place at_middle = at(middle);
    if (const auto hit = first_hit(from, middle, at_from, at_middle)) return hit;
    return first_hit(middle, to, at_middle, at_to);
  }

  const Tile& tile_;
  const Geoid& geoid_;
  LongVec eye_;
  LongVec way_;
  Long change_ = 0;        ///< of the height over the surface, per m of the ray, at most
  Long twist_per_m2_ = 0;  ///< what a twist of 1 m bends a ray's height over the surface
};

Vec3 ray_at(const Geodetic& eye, double heading, double pitch) {
  return camera_axes(level_frame(eye.lat_deg, eye.lon_deg), 0, pitch, heading).forward;
}

/// The worst that was seen.
struct Worst {
  double along_m = 0;  ///< distance of two hits, of rays that meet the ground at 3 degrees or more
  double vertical_m = 0;  ///< height by which a hit, or the lack of one, is wrong
  double angle_rad = 0;   ///< the same over the distance: the turn that would make it right
  int hits = 0;
  int skies = 0;
  int other_side = 0;  ///< rays whose two hits lie on different hills

  void wrong_by(Long height_m, Long at_m) {
    vertical_m = std::max(vertical_m, static_cast<double>(std::abs(height_m)));
    angle_rad = std::max(angle_rad, static_cast<double>(std::abs(height_m) / at_m));
  }
};

class Comparison {
 public:
  Comparison(const Tile& tile, const Geoid& geoid)
      : tile_(tile), geoid_(geoid), terrain_({tile}, geoid) {
    for (int row = 0; row + 1 < tile.rows; ++row) {
      for (int column = 0; column + 1 < tile.columns; ++column) {
        const float post = tile.at(row, column);
        steepest_m_ = std::max({steepest_m_, std::abs(tile.at(row, column + 1) - post),
                                std::abs(tile.at(row + 1, column) - post)});
      }
    }
  }

  [[nodiscard]] const Terrain& terrain() const { return terrain_; }
  [[nodiscard]] const Worst& worst() const { return worst_; }

  void compare(const Geodetic& eye, const Vec3& ray, double range_m) {
    const ExactRay exact(tile_, geoid_, steepest_m_, eye, ray);
    const double traced = Tracer(terrain_, eye, range_m).first_hit(ray).distance_m;
    const std::optional<Long> truth = exact.first_hit(static_cast<Long>(range_m));
    if (!truth && traced > range_m) {
      ++worst_.skies;
      return;
    }
    ++worst_.hits;
    // A hit at the very end of the range may be lost by as little as rounding.
    const Long traced_m = static_cast<Long>(std::min(traced, range_m));
    const Long truth_m = truth.value_or(static_cast<Long>(range_m));
    if (std::abs(truth_m - traced_m) < 1) {
      worst_.wrong_by(exact.at(traced_m).over_m, traced_m);
      const Long falls_m = exact.at(traced_m - 1e-3L).over_m - exact.at(traced_m).over_m;
      if (falls_m > 0.05e-3L) {
        worst_.along_m =
            std::max(worst_.along_m, std::abs(static_cast<double>(truth_m - traced_m)));
      }
      return;
    }
    ++worst_.other_side;
    if (traced_m < truth_m) {
      worst_.wrong_by(exact.at(traced_m).over_m, traced_m);
    } else {
      worst_.wrong_by(exact.dip_m(truth_m), truth_m);
    }
  }

 private:
  const Tile& tile_;
  const Geoid& geoid_;
  Terrain terrain_;
  float steepest_m_ = 0;
  Worst worst_;
};

/// Rays in all directions, and rays turned by as little as rounding from where they graze a hill.
void compare_everywhere(Comparison& comparison, unsigned seed, int eyes) {
  constexpr double range_m = 25000;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < eyes; ++i) {
    const Geodetic eye{46.4 + 0.2 * unit(random), 8.4 + 0.2 * unit(random),
                       2650 + 3000 * unit(random) * unit(random)};
    const Tracer tracer(comparison.terrain(), eye, range_m);
    for (int k = 0; k < 4; ++k) {
      comparison.compare(eye, ray_at(eye, 360 * unit(random), 1 - 30 * unit(random)), range_m);
    }
    const double heading = 360 * unit(random);
    const auto distance_m = [&](double pitch) {
      return std::min(2 * range_m, tracer.first_hit(ray_at(eye, heading, pitch)).distance_m);
    };
    double low = -10;
    double high = 0.5;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      const bool jumps_above =
          distance_m(high) - distance_m(middle) > 0.5 * (distance_m(high) - distance_m(low));
      (jumps_above ? low : high) = middle;
    }
    for (const double turn_deg : {0.0, 1e-13, -1e-13, 1e-11, -1e-11, 1e-9, -1e-9}) {
      comparison.compare(eye, ray_at(eye, heading, low + turn_deg), range_m);
    }
  }
}

TEST(Precision, first_hits_are_those_of_long_double_to_a_tenth_of_a_micrometre) {
  static_assert(std::numeric_limits<Long>::digits >= 64);
  const Tile tile = scenes::tile(46, 8, 1200, 1200, scenes::rugged(2500, 31));
  std::vector<float> nodes;
  for (int i = 0; i < 400; ++i) nodes.push_back(static_cast<float>(40 + 7 * (i % 7) - i % 3));
  const Geoid geoids[] = {Geoid(),
                          Geoid::from_nodes(45.9503, 7.9307, 0.0719, 0.0819, 20, 20, nodes)};
  for (const Geoid& geoid : geoids) {
    Comparison comparison(tile, geoid);
    compare_everywhere(comparison, 17, 60);
    const Worst& worst = comparison.worst();
    std::printf(
        "[ truth ] geoid %s: %d hits, %d skies, %d on other hills; along the ray %.2g m, "
        "vertically %.2g m, as an angle %.2g rad\n",
        geoid.name().c_str(), worst.hits, worst.skies, worst.other_side, worst.along_m,
        worst.vertical_m, worst.angle_rad);
    EXPECT_GT(worst.hits, 300);
    EXPECT_LT(worst.along_m, 1e-7);
    EXPECT_LT(worst.vertical_m, 5e-8);
    EXPECT_LT(worst.angle_rad, 1e-11);
    EXPECT_GT(worst.other_side, 20);
  }
}

}  // namespace
}  // namespace ridgeline::oracle
