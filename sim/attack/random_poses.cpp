#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/limits.hpp"
#include "sim/attack/random_case.hpp"

namespace ridgeline::sim {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double metres_per_degree = 111'195;

/// A place in posts of one tile.
struct Spot {
  std::size_t tile = 0;
  double row = 0, column = 0;
};

struct Place {
  double latitude_deg = 0, longitude_deg = 0;
};

Place place_of(const CaseLand& land, const Spot& spot) {
  const PostGrid& grid = land.grids()[spot.tile];
  return {grid.south_deg + spot.row * grid.latitude_step_deg,
          std::remainder(grid.west_deg + spot.column * grid.longitude_step_deg, 360.0)};
}

/// Where a pose is likely to be hard: on a post, an edge, a corner of a tile, or anywhere.
Spot random_spot(Random& r, const CaseLand& land) {
  Spot spot;
  spot.tile = static_cast<std::size_t>(r.whole(0, static_cast<int>(land.grids().size()) - 1));
  const PostGrid& grid = land.grids()[spot.tile];
  const int row = r.whole(grid.rows / 8, grid.rows - 2 - grid.rows / 8);
  const int column = r.whole(grid.columns / 8, grid.columns - 2 - grid.columns / 8);
  spot.row = row;
  spot.column = column;
  switch (r.whole(0, 9)) {
    case 0:
    case 1:
      break;  // on a post
    case 2:
      spot.row += r.unit();
      break;  // on an edge
    case 3:
      spot.column += r.unit();
      break;
    case 4:
      spot.row += 0.5;
      spot.column += 0.5;
      break;
    case 5:  // on or near a corner of the tile
      spot.row = r.chance(0.5) ? 0 : grid.rows - 1;
      spot.column = r.chance(0.5) ? 0 : grid.columns - 1;
      if (r.chance(0.3)) spot.row = row;
      break;
    default:
      spot.row += r.unit();
      spot.column += r.unit();
  }
  return spot;
}

double height_over_ground_m(Random& r) {
  switch (r.whole(0, 7)) {
    case 0:
      return 2;
    case 1:
      return with_decimals(r.spread(2, 30), 2);
    case 2:
      return r.one_of({50, 100, 300, 1'000, 3'000});
    case 3:
      return with_decimals(r.spread(3'000, 20'000), 0);
    default:
      return with_decimals(r.spread(30, 3'000), 1);
  }
}

/// Ground that the eye must stay above; the highest post round where there is a void.
double ground_m(const CaseLand& land, const Spot& spot, const Place& place) {
  double h = land.ground_m(place.latitude_deg, place.longitude_deg);
  if (std::isnan(h)) h = land.highest_near_m(spot.tile, spot.row, spot.column, 6);
  return std::isnan(h) ? 0.0 : h;
}

double random_roll(Random& r) {
  if (r.chance(0.45)) return 0;
  if (r.chance(0.35)) return r.one_of({90, -90, 180, -180, 45, 30, -30, 0.001, 360});
  return with_decimals(r.between(-180, 180), 2);
}

double random_heading(Random& r) {
  if (r.chance(0.3)) return r.one_of({0, 90, 180, 270, 360, -90});
  if (r.chance(0.25)) return r.one_of({45, 135, 225, 315});
  if (r.chance(0.1)) return r.one_of({1e-6, 89.999999, 90.000001, 0.001});
  return with_decimals(r.between(0, 360), 2);
}

double random_pitch(Random& r) {
  if (r.chance(0.25)) return 0;
  if (r.chance(0.08)) return r.one_of({-90, -89.999, -89.9, 89.999, 90});
  if (r.chance(0.3)) return with_decimals(r.between(-75, -10), 2);
  return with_decimals(r.between(-12, 6), 2);
}

/// Looks at another spot, from its own height now and then: a ray that grazes its top.
void look_at(Random& r, const CaseLand& land, double range_m, AttackPose& pose) {
  const Spot spot = random_spot(r, land);
  const Place there = place_of(land, spot);
  const double north_m = metres_per_degree * (there.latitude_deg - pose.latitude_deg);
  const double east_m = metres_per_degree * std::cos(pose.latitude_deg * deg) *
                        std::remainder(there.longitude_deg - pose.longitude_deg, 360.0);
  const double distance_m = std::hypot(north_m, east_m);
  if (!(distance_m > 1) || distance_m > range_m) return;
  pose.heading_deg = with_decimals(std::atan2(east_m, north_m) / deg, 3);
  const double top_m = land.highest_near_m(spot.tile, spot.row, spot.column, 0);
  if (std::isnan(top_m)) return;
  const double level_m = with_decimals(top_m + r.one_of({0, 0.01, -0.01, 1}), 3);
  const double drop_m = distance_m * distance_m / 12.742e6;
  if (r.chance(0.4) && level_m - drop_m > pose.height_m) {
    pose.height_m = with_decimals(level_m - (r.chance(0.5) ? drop_m : 0.0), 3);
    pose.pitch_deg = 0;
  } else {
    pose.pitch_deg = with_decimals(std::atan2(top_m - drop_m - pose.height_m, distance_m) / deg, 3);
  }
}

AttackPose random_pose(Random& r, const CaseLand& land, double range_m) {
  const Spot spot = random_spot(r, land);
  const Place place = place_of(land, spot);
  AttackPose pose;
  pose.latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
  pose.longitude_deg = place.longitude_deg;
  if (r.chance(0.2)) {
    pose.latitude_deg = with_decimals(pose.latitude_deg, 3);
    pose.longitude_deg = with_decimals(pose.longitude_deg, 3);
  }
  pose.roll_deg = random_roll(r);
  pose.pitch_deg = random_pitch(r);
  pose.heading_deg = random_heading(r);
  const double ground = ground_m(land, spot, {pose.latitude_deg, pose.longitude_deg});
  pose.height_m = with_decimals(ground + height_over_ground_m(r), 3);
  if (r.chance(0.35)) look_at(r, land, range_m, pose);
  pose.height_m = std::clamp(pose.height_m, limits::min_eye_height_m, limits::max_eye_height_m);
  return pose;
}

}  // namespace

void choose_poses(Random& r, const CaseLand& land, AttackCase& c) {
  const bool flight = c.arrival != SceneOptions::Arrival::settled;
  const int count = flight ? r.whole(4, 8) : r.whole(2, 5);
  for (int k = 0; k < count; ++k) {
    AttackPose pose = random_pose(r, land, c.range_m);
    if (flight && k > 0 && !r.chance(0.15)) {  // no jump: on from the last pose
      const AttackPose& last = c.poses.back();
      const double step_deg = r.spread(0.01, 0.5) * c.range_m / metres_per_degree;
      const double latitude = last.latitude_deg + step_deg * r.between(-1, 1);
      pose.latitude_deg = std::clamp(with_decimals(latitude, 5), -90.0, 90.0);
      pose.longitude_deg =
          with_decimals(std::remainder(last.longitude_deg + step_deg * r.between(-1, 1), 360.0), 5);
      const double ground = land.ground_m(pose.latitude_deg, pose.longitude_deg);
      pose.height_m = std::clamp(std::fmax(last.height_m, with_decimals(ground + 50, 1)),
                                 limits::min_eye_height_m, limits::max_eye_height_m);
    }
    pose.time_s = k;
    c.poses.push_back(pose);
  }
}

}  // namespace ridgeline::sim
