// The lattice that a session cuts its window from, and where tiles lie on it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/terrain/post_lattice.hpp"

namespace ridgeline {
namespace {

constexpr double arcsec = 1.0 / 3600;

/// A one-degree tile by its steps in arc seconds.
PostGrid tile(double south_deg, double west_deg, double lat_arcsec, double lon_arcsec) {
  return {south_deg,
          west_deg,
          lat_arcsec * arcsec,
          lon_arcsec * arcsec,
          static_cast<int>(std::lround(3600 / lat_arcsec)) + 1,
          static_cast<int>(std::lround(3600 / lon_arcsec)) + 1};
}

void expect_steps(const PostLattice& lattice, double lat_arcsec, double lon_arcsec) {
  EXPECT_NEAR(lattice.latitude_step_deg / arcsec, lat_arcsec, 1e-6 * lat_arcsec);
  EXPECT_NEAR(lattice.longitude_step_deg / arcsec, lon_arcsec, 1e-6 * lon_arcsec);
}

TEST(Lattice, is_3_arc_seconds_from_the_equator_where_there_is_no_tile) {
  const PostLattice lattice = lattice_of({}, {46.5, 8.5, 0});
  expect_steps(lattice, 3, 3);
  EXPECT_EQ(lattice.origin_latitude_deg, 0);
  EXPECT_EQ(lattice.origin_longitude_deg, 0);
}

TEST(Lattice, takes_the_finer_step_of_3_and_1_arc_seconds_from_either_side) {
  const std::vector<PostGrid> tiles{tile(46, 8, 3, 3), tile(46, 9, 1, 1), tile(46, 12, 3, 3)};
  for (const double eye_deg : {8.5, 9.5, 12.5, 40.0}) {
    const PostLattice lattice = lattice_of(tiles, {46.5, eye_deg, 0});
    expect_steps(lattice, 1, 1);
    for (const PostGrid& t : tiles) {
      const int ratio = t.rows == 3601 ? 1 : 3;
      EXPECT_EQ(fit_rows(lattice, t).ratio, ratio);
      EXPECT_EQ(fit_columns(lattice, t, lattice.column_of(eye_deg)).ratio, ratio);
    }
  }
}

TEST(Lattice, carries_every_zone_of_dted_from_wherever_the_flight_starts) {
  const std::vector<PostGrid> tiles{tile(49, 8, 3, 3), tile(50, 8, 3, 6), tile(70, 8, 3, 9),
                                    tile(75, 8, 3, 12), tile(80, 8, 3, 18)};
  const int ratios[] = {1, 2, 3, 4, 6};
  for (const double eye_deg : {49.5, 50.5, 60.0, 70.5, 75.5, 80.5, 89.9}) {
    const PostLattice lattice = lattice_of(tiles, {eye_deg, 8.5, 0});
    expect_steps(lattice, 3, 3);
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const AxisFit rows = fit_rows(lattice, tiles[k]);
      const AxisFit columns = fit_columns(lattice, tiles[k], 0);
      EXPECT_EQ(rows.ratio, 1);
      EXPECT_EQ(columns.ratio, ratios[k]) << eye_deg;
      EXPECT_NEAR(lattice.latitude_deg(rows.first), tiles[k].south_deg, 1e-9);
      EXPECT_NEAR(lattice.longitude_deg(columns.first), 8, 1e-9);
    }
  }
}

TEST(Lattice, finds_a_common_step_that_no_tile_has) {
  const std::vector<PostGrid> tiles{tile(75, 8, 3, 12), tile(70, 8, 3, 9)};
  expect_steps(lattice_of(tiles, {75.5, 8.5, 0}), 3, 3);
  const std::vector<PostGrid> odd{tile(46, 8, 3, 3), tile(46, 9, 2, 2)};
  expect_steps(lattice_of(odd, {46.5, 8.5, 0}), 1, 1);
}

TEST(Lattice, takes_the_step_of_a_much_finer_tile_wherever_it_is) {
  const std::vector<PostGrid> tiles{tile(46, 8, 30, 30), tile(46, 12, 1.0 / 3, 1.0 / 3)};
  for (const double eye_deg : {8.5, 12.5}) {
    const PostLattice lattice = lattice_of(tiles, {46.5, eye_deg, 0});
    expect_steps(lattice, 1.0 / 3, 1.0 / 3);
    EXPECT_EQ(fit_rows(lattice, tiles[0]).ratio, 90);
  }
}

TEST(Lattice, leaves_out_a_tile_that_would_make_it_finer_than_a_sixth_of_both) {
  const std::vector<PostGrid> tiles{tile(46, 8, 3, 3), tile(46, 12, 3.6, 3.6)};
  const PostLattice lattice = lattice_of(tiles, {46.5, 8.5, 0});
  expect_steps(lattice, 0.6, 0.6);
  const std::vector<PostGrid> odd{tile(46, 8, 3, 3), tile(46, 12, 3.75, 3.75),
                                  tile(46, 13, 3.2, 3.2)};
  const PostLattice left = lattice_of(odd, {46.5, 8.5, 0});
  expect_steps(left, 0.75, 0.75);
  EXPECT_EQ(fit_rows(left, odd[2]).ratio, 0);
}

TEST(Lattice, leaves_out_tiles_out_of_phase_or_of_an_odd_step) {
  PostGrid shifted = tile(46, 9, 1, 1);
  shifted.south_deg += 0.4 * arcsec;
  PostGrid odd = tile(46, 10, 3, 3);
  odd.latitude_step_deg *= 1.001;
  const std::vector<PostGrid> tiles{tile(46, 8, 3, 3), shifted, odd};
  const PostLattice lattice = lattice_of(tiles, {46.5, 6.5, 0});
  expect_steps(lattice, 3, 3);
  EXPECT_GT(fit_rows(lattice, tiles[0]).ratio, 0);
  EXPECT_EQ(fit_rows(lattice, shifted).ratio, 0);
  EXPECT_EQ(fit_rows(lattice, odd).ratio, 0);
}

TEST(Lattice, its_columns_run_on_over_the_antimeridian_and_round_the_earth) {
  const PostLattice lattice{-17, 179, 3 * arcsec, 3 * arcsec};
  EXPECT_NEAR(lattice.column_near(179.5, 0), 600, 1e-6);
  EXPECT_NEAR(lattice.column_near(-179.5, 1000), 1800, 1e-6);
  EXPECT_NEAR(lattice.column_near(180, 0), 1200, 1e-6);
  EXPECT_NEAR(lattice.column_near(-180, 0), 1200, 1e-6);
  const double circle = lattice.circle_columns();
  EXPECT_NEAR(circle, 432'000, 1e-6);
  // Eastwards three times round the Earth in steps of 7 degrees: no jump.
  double column = 600;
  for (int k = 1; k < 160; ++k) {
    const double longitude = std::remainder(179.5 + 7.0 * k, 360.0);
    column = lattice.column_near(longitude, column);
    EXPECT_NEAR(column, 600 + k * 8400, 1e-3) << k;
  }
}

TEST(Lattice, tiles_on_both_sides_of_the_antimeridian_are_neighbours) {
  const PostGrid east_of_it = tile(-17, -180, 3, 3), west_of_it = tile(-17, 179, 3, 3);
  for (const PostLattice& lattice :
       {lattice_of(std::vector{west_of_it, east_of_it}, {-16.5, 179.9, 0}),
        lattice_of(std::vector{east_of_it, west_of_it}, {-16.5, -179.9, 0})}) {
    for (int turn = -2; turn <= 2; ++turn) {
      for (const double eye_deg : {179.9, -179.9}) {
        const double eye = lattice.column_near(eye_deg, turn * lattice.circle_columns());
        const AxisFit west = fit_columns(lattice, west_of_it, eye);
        const AxisFit east = fit_columns(lattice, east_of_it, eye);
        EXPECT_EQ(west.ratio, 1);
        EXPECT_EQ(east.ratio, 1);
        EXPECT_EQ(east.first, west.first + 1200) << turn;
        EXPECT_LT(std::abs(eye - east.first), 1200);
      }
    }
  }
}

TEST(Lattice, the_posts_of_a_fitted_tile_stand_where_it_says_on_the_nearest_turn) {
  std::mt19937 random(11);
  const auto pick = [&](int count) { return static_cast<int>(random() % unsigned(count)); };
  const double steps[] = {1, 3, 6, 9, 12, 18, 30};
  for (int k = 0; k < 500; ++k) {
    const double step = steps[pick(2)];
    const PostLattice lattice{pick(180) - 90.0, pick(360) - 180.0, step * arcsec, step * arcsec};
    const PostGrid t = tile(pick(180) - 90, pick(360) - 180, step * (1 + pick(3)), steps[pick(7)]);
    const double near_column = (pick(7) - 3) * lattice.circle_columns() + pick(1'000'000);
    const AxisFit columns = fit_columns(lattice, t, near_column);
    const AxisFit rows = fit_rows(lattice, t);
    ASSERT_GT(rows.ratio, 0);
    EXPECT_NEAR(lattice.latitude_deg(rows.first), t.south_deg, 1e-4 * step * arcsec);
    EXPECT_NEAR(rows.ratio * lattice.latitude_step_deg, t.latitude_step_deg, 1e-12);
    const double ratio = t.longitude_step_deg / lattice.longitude_step_deg;
    if (std::abs(ratio - std::round(ratio)) > 1e-6 || ratio < 0.9) {
      EXPECT_EQ(columns.ratio, 0);
      continue;
    }
    ASSERT_EQ(columns.ratio, static_cast<int>(std::lround(ratio)));
    const double off = lattice.longitude_deg(columns.first) - t.west_deg;
    EXPECT_NEAR(std::remainder(off, 360.0), 0, 1e-4 * step * arcsec);
    const double middle = columns.first + 0.5 * (t.columns - 1) * columns.ratio;
    EXPECT_LE(std::abs(middle - near_column), 0.5 * lattice.circle_columns() + 1);
  }
}

}  // namespace
}  // namespace ridgeline
