#include "tests/oracle/tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/oracle/scenes.hpp"

namespace ridgeline::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distance to an ellipsoid with both semi-axes longer by `raised_m`, in closed form; +inf if
/// missed.
double ellipsoid_hit_m(const Vec3& eye, const Vec3& ray) {
  using Long = long double;
  const auto a = static_cast<Long>(semi_major_m);
  const auto b = static_cast<Long>(semi_minor_m);
  const auto product = [&](const Vec3& p, const Vec3& q) {
    const Long level = static_cast<Long>(p.x) * static_cast<Long>(q.x) +
                       static_cast<Long>(p.y) * static_cast<Long>(q.y);
    return level / (a * a) + static_cast<Long>(p.z) * static_cast<Long>(q.z) / (b * b);
  };
  const long double qa = product(ray, ray);
  const long double qb = product(eye, ray);
  const long double qc = product(eye, eye) - 1;
  const long double root = qb * qb - qa * qc;
  if (root < 0 || qb > 0) return infinity;
  return static_cast<double>(qc / (-qb + std::sqrt(root)));
}

Vec3 ray_at(const Geodetic& eye, double heading, double pitch) {
  return camera_axes(level_frame(eye.lat_deg, eye.lon_deg), 0, pitch, heading).forward;
}

TEST(Tracer, flat_sea_is_the_ellipsoid) {
  std::vector<Tile> tiles;
  for (int lat = 44; lat < 48; ++lat) {
    for (int lon = 6; lon < 10; ++lon) {
      tiles.push_back(scenes::tile(lat, lon, 1200, 1200, [](double, double) { return 0.0; }));
    }
  }
  const Terrain terrain(std::move(tiles), Geoid());
  const Geodetic eye{46.03, 8.01, 500};
  const Tracer tracer(terrain, eye, 90000);
  int seas = 0;
  int skies = 0;
  for (double heading = 0; heading < 360; heading += 17.3) {
    for (double pitch = -90; pitch < 1; pitch += pitch < -2 ? 4.7 : 0.013) {
      const Vec3 ray = ray_at(eye, heading, pitch);
      const double exact = ellipsoid_hit_m(tracer.eye(), ray);
      const FirstHit hit = tracer.first_hit(ray);
      ASSERT_FALSE(hit.may_be_unknown);
      if (exact > 90000) {
        ++skies;
        ASSERT_TRUE(hit.is_sky()) << heading << ' ' << pitch;
        continue;
      }
      ++seas;
      // Near the horizon the distance is the height's error over a vanishing slope.
      const double slope =
          std::abs(dot(ray, level_frame(eye.lat_deg, eye.lon_deg).down)) - exact / semi_major_m;
      ASSERT_NEAR(hit.distance_m, exact, 1e-6 + 1e-8 / std::max(1e-6, std::abs(slope)))
          << heading << ' ' << pitch;
    }
  }
  EXPECT_GT(seas, 100);
  EXPECT_GT(skies, 100);
  EXPECT_NEAR(tracer.first_hit(ray_at(eye, 0, -90)).distance_m, 500, 1e-6);
}

TEST(Tracer, horizon_lies_at_the_root_of_twice_radius_times_height) {
  std::vector<Tile> tiles;
  tiles.push_back(scenes::tile(0, 0, 1200, 1200, [](double, double) { return 0.0; }));
  tiles.push_back(scenes::tile(0, 1, 1200, 1200, [](double, double) { return 0.0; }));
  const Terrain terrain(std::move(tiles), Geoid());
  const Geodetic eye{0.5, 0.5, 100};
  const Tracer tracer(terrain, eye, 80000);
  double below = -5;
  double above = 0;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (below + above);
    (tracer.first_hit(ray_at(eye, 90, middle)).is_sky() ? above : below) = middle;
  }
  const double horizon = tracer.first_hit(ray_at(eye, 90, below)).distance_m;
  EXPECT_NEAR(horizon, std::sqrt(2 * semi_major_m * 100), 10);
}

TEST(Tracer, geoid_raises_the_sea_by_the_undulation) {
  std::vector<Tile> tiles;
  tiles.push_back(scenes::tile(46, 8, 1200, 1200, [](double, double) { return 10.0; }));
  const Geoid geoid = Geoid::from_nodes(45, 7, 0.3, 0.3, 11, 11, std::vector<float>(121, 47.5F));
  const Terrain terrain(std::move(tiles), geoid);
  const Geodetic eye{46.5, 8.5, 1057.5};
  EXPECT_NEAR(Tracer(terrain, eye, 9000).first_hit(ray_at(eye, 0, -90)).distance_m, 1000, 1e-6);
}

/// Height over the known surface by the shortest way from its definition.
double height_over_m(const Tile& tile, const Geoid& geoid, const Geodetic& g) {
  const double x = (g.lon_deg - tile.west_deg) / tile.lon_step_deg;
  const double y = (g.lat_deg - tile.south_deg) / tile.lat_step_deg;
  if (x < 0 || y < 0 || x > tile.columns - 1 || y > tile.rows - 1) return infinity;
  const int c = std::min(static_cast<int>(x), tile.columns - 2);
  const int r = std::min(static_cast<int>(y), tile.rows - 2);
  const auto post = [&](int dr, int dc) { return static_cast<double>(tile.at(r + dr, c + dc)); };
  const double u = x - c;
  const double v = y - r;
  return g.height_m - geoid.at(g.lat_deg, g.lon_deg) -
         ((post(0, 0) * (1 - u) + post(0, 1) * u) * (1 - v) +
          (post(1, 0) * (1 - u) + post(1, 1) * u) * v);
}

double marched_hit_m(const Tile& tile, const Geoid& geoid, const Vec3& eye, const Vec3& ray,
                     double range) {
  const auto over = [&](double t) {
    return height_over_m(tile, geoid, geodetic_from_ecef(eye + t * ray));
  };
  for (double t = 1; t <= range; t += 1) {
    if (over(t) > 0) continue;
    double low = t - 1;
    double high = t;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (over(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  return infinity;
}

TEST(Tracer, agrees_with_dense_marching_over_random_terrain) {
  const Tile tile = scenes::tile(46, 8, 1200, 360, scenes::rugged(2500, 7));
  // Nodes off the lines of the posts, so that cells are cut by lines of the geoid.
  std::vector<float> nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(static_cast<float>(40 + 7 * (i % 7) - i % 3));
  const Geoid geoid = Geoid::from_nodes(45.9503, 7.9307, 0.0519, 0.0619, 10, 10, nodes);
  const Terrain terrain({tile}, geoid);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int hits = 0;
  for (int i = 0; i < 250; ++i) {
    const Geodetic eye{46.05 + 0.2 * unit(random), 8.05 + 0.2 * unit(random),
                       2600 - 1200 * unit(random)};
    const Tracer tracer(terrain, eye, 9000);
    const Vec3 ray = ray_at(eye, 360 * unit(random), 4 - 18 * unit(random));
    if (height_over_m(tile, geoid, eye) <= 0) continue;
    const double marched = marched_hit_m(tile, geoid, tracer.eye(), ray, 9000);
    const double traced = tracer.first_hit(ray).distance_m;
    if (marched == infinity && traced == infinity) continue;
    ++hits;
    // Marching by 1 m may step over a ridge that the ray truly grazes, never the other way round.
    if (traced < marched - 1e-3) {
      const Geodetic g = geodetic_from_ecef(tracer.eye() + traced * ray);
      EXPECT_LT(std::abs(height_over_m(tile, geoid, g)), 1e-5);
    } else {
      EXPECT_NEAR(traced, marched, 1e-4) << i;
    }
  }
  EXPECT_GT(hits, 60);
}

TEST(Tracer, acceleration_changes_nothing) {
  const scenes::Surface hills = scenes::rugged(3000, 5);
  const auto with_voids = [&](double lat, double lon) {
    const bool is_void = std::hypot(lat - 46.4, lon - 8.5) < 0.05 ||
                         (std::fmod(lat * 100, 7) < 0.2 && std::fmod(lon * 100, 5) < 0.3);
    return is_void ? std::nan("") : hills(lat, lon);
  };
  std::vector<Tile> tiles;
  tiles.push_back(scenes::tile(46, 8, 1200, 1200, with_voids));
  tiles.push_back(scenes::tile(46, 9, 1200, 1200, with_voids));
  tiles.push_back(scenes::tile(47, 8, 600, 600, hills));
  const Terrain terrain(std::move(tiles), Geoid());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int hits = 0;
  int unknowns = 0;
  for (int i = 0; i < 400; ++i) {
    const Geodetic eye{46.1 + unit(random), 8.1 + 1.5 * unit(random), 1500 + 9000 * unit(random)};
    const Vec3 ray = ray_at(eye, 360 * unit(random), 3 - 25 * unit(random));
    const FirstHit fast = Tracer(terrain, eye, 80000).first_hit(ray);
    const FirstHit slow = Tracer(terrain, eye, 80000, Walk::every_cell).first_hit(ray);
    ASSERT_EQ(fast.is_sky(), slow.is_sky()) << i;
    if (!fast.is_sky()) {
      ASSERT_NEAR(fast.distance_m, slow.distance_m, 1e-6) << i;
    }
    ASSERT_EQ(fast.may_be_unknown, slow.may_be_unknown) << i;
    ASSERT_EQ(fast.must_be_unknown, slow.must_be_unknown) << i;
    hits += fast.is_sky() ? 0 : 1;
    unknowns += fast.may_be_unknown ? 1 : 0;
    const double a = Tracer(terrain, eye, 80000).clearance(ray, 30000, 0.05);
    const double b = Tracer(terrain, eye, 80000, Walk::every_cell).clearance(ray, 30000, 0.05);
    // Where stretches are cut moves the points at which the smallest ratio is sampled.
    ASSERT_NEAR(a, b, 1e-7 + 1e-3 * std::abs(a)) << i;
    if (!fast.is_sky() && fast.distance_m < 29999) {
      ASSERT_LE(a, 1e-9);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(unknowns, 20);
}

TEST(Tracer, a_spire_hides_what_stands_behind_it) {
  const auto spire = [](double lat, double lon) {
    return std::hypot(lat - 46.5, lon - 8.5) < 1e-6 ? 3000.0 : 100.0;
  };
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200, spire)}, Geoid());
  const Geodetic eye{46.4, 8.5, 2000};
  const Tracer tracer(terrain, eye, 30000);
  const double to_spire_m = tracer.first_hit(ray_at(eye, 0, 0)).distance_m;
  // One cell (92.6 m) of slope rises 2900 m, so its south face stands at 2000 m (and the drop of
  // the Earth, 10 m) some 61 m north of the last low post.
  EXPECT_NEAR(to_spire_m, 0.1 * 111150 - 92.6 * (1 - 1910.0 / 2900), 25);
  EXPECT_TRUE(tracer.first_hit(ray_at(eye, 1, 0)).is_sky());
}

TEST(Tracer, the_taller_of_two_posts_on_a_shared_edge_is_the_truth) {
  const Terrain terrain({scenes::tile(46, 8, 1200, 1200, [](double, double) { return 100.0; }),
                         scenes::tile(46, 9, 1200, 1200, [](double, double) { return 250.0; })},
                        Geoid());
  const Geodetic eye{46.5, 9.0 - 0.5 / 1200, 1000};
  EXPECT_NEAR(Tracer(terrain, eye, 9000).first_hit(ray_at(eye, 0, -90)).distance_m, 1000 - 175,
              1e-6);
}

TEST(Tracer, tiles_meet_across_the_antimeridian) {
  const Terrain terrain({scenes::tile(-20, 179, 1200, 1200, [](double, double) { return 0.0; }),
                         scenes::tile(-20, -180, 1200, 1200, [](double, double) { return 300.0; })},
                        Geoid());
  const Geodetic eye{-19.5, 179.9, 200};
  const FirstHit hit = Tracer(terrain, eye, 50000).first_hit(ray_at(eye, 90, 0));
  EXPECT_GT(hit.distance_m, 10000);
  EXPECT_LT(hit.distance_m, 11000);
  EXPECT_FALSE(hit.may_be_unknown);
}

}  // namespace
}  // namespace ridgeline::oracle
