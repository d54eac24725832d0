#include <algorithm>
#include <cmath>

#include "core/state/ownship_pose.hpp"
#include "core/state/ownship_update.hpp"
#include "sim/bench/bench.hpp"
#include "sim/log/candump_reader.hpp"

namespace ridgeline::sim {
namespace {

/// A known post of a tile, as near its middle as there is one.
bool middle_post(const HeightTile& tile, GeodeticPosition& place) {
  const PostGrid& grid = tile.grid;
  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  for (int step = 0; step < grid.rows; ++step) {
    const int r = grid.rows / 2 + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
    if (r < 0 || r >= grid.rows) continue;
    read_posts(tile, r, 0, row);
    for (int side = 0; side < grid.columns; ++side) {
      const int c = grid.columns / 2 + (side % 2 == 0 ? side / 2 : -(side + 1) / 2);
      if (c < 0 || c >= grid.columns || std::isnan(row[static_cast<std::size_t>(c)])) continue;
      place = {grid.south_deg + r * grid.latitude_step_deg,
               grid.west_deg + c * grid.longitude_step_deg,
               static_cast<double>(row[static_cast<std::size_t>(c)])};
      return true;
    }
  }
  return false;
}

/// The lowest known post of the middle third of a tile: a valley, or the sea.
GeodeticPosition lowest_post(const HeightTile& tile, const GeodeticPosition& otherwise) {
  const PostGrid& grid = tile.grid;
  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  GeodeticPosition lowest = otherwise;
  for (int r = grid.rows / 3; r < 2 * grid.rows / 3; ++r) {
    read_posts(tile, r, 0, row);
    for (int c = grid.columns / 3; c < 2 * grid.columns / 3; ++c) {
      const auto height_m = static_cast<double>(row[static_cast<std::size_t>(c)]);
      if (!(height_m < lowest.height_m)) continue;
      lowest = {grid.south_deg + r * grid.latitude_step_deg,
                grid.west_deg + c * grid.longitude_step_deg, height_m};
    }
  }
  return lowest;
}

}  // namespace

std::vector<BenchView> fixed_views(const std::string& terrain_folder) {
  GeotiffReader geotiff;
  auto opened = TerrainFolder::open(terrain_folder, &geotiff);
  if (!opened) return {};
  TerrainFolder folder = std::move(opened).value();
  folder.select({-90.0, -180.0, 90.0, 180.0});
  GeodeticPosition place;
  const auto tiles = folder.tiles();
  if (tiles.empty() || !middle_post(tiles[tiles.size() / 2], place)) return {};
  const GeodeticPosition valley = lowest_post(tiles[tiles.size() / 2], place);
  struct Fixed {
    const char* name;
    bool in_valley;
    double over_ground_m, roll_deg, pitch_deg, heading_deg;
  };
  constexpr Fixed fixed[] = {
      {"low", false, 100, 0, -2, 30},      {"valley", true, 200, 0, -1, 150},
      {"high", false, 3000, 0, -10, 250},  {"steep down", false, 4000, 0, -60, 10},
      {"banked", false, 1500, 40, -5, 80}, {"wide horizon", false, 9000, 0, -3, 330}};
  std::vector<BenchView> views;
  for (const Fixed& f : fixed) {
    FrameInput input;
    input.eye = f.in_valley ? valley : place;
    input.eye.height_m += f.over_ground_m;
    input.attitude = {f.roll_deg, f.pitch_deg, f.heading_deg};
    views.push_back({f.name, input});
  }
  return views;
}

std::vector<BenchView> log_views(const std::string& log_file, const BusProfile& profile,
                                 int count) {
  std::vector<BenchView> views;
  CandumpOptions log_options;
  log_options.format = LogFormat::by_content;
  const auto log = candump_log(log_file, log_options);
  if (!log) return views;
  const std::vector<BusFrame>& frames = log.value().frames;
  const std::int64_t start_ns = frames.front().time_ns;
  const std::int64_t length_ns = frames.back().time_ns - start_ns;
  OwnshipState state;
  std::size_t next = 0;
  for (int k = 0; k < count; ++k) {
    const std::int64_t now_ns = start_ns + length_ns / count * k + length_ns / (2 * count);
    std::size_t end = next;
    while (end < frames.size() && frames[end].time_ns <= now_ns) ++end;
    state = update_ownship(state, std::span(frames).subspan(next, end - next), now_ns, profile);
    next = end;
    const OwnshipPose pose = ownship_pose(state, now_ns, state_limits(profile));
    if (availability(pose).mode == Mode::removed) continue;
    FrameInput input;
    input.time_ns = now_ns;
    input.eye = {pose.latitude_deg.value, pose.longitude_deg.value, pose.height_m.value};
    input.attitude = {pose.roll_deg.value, pose.pitch_deg.value, pose.heading_deg.value};
    char name[32];
    std::snprintf(name, sizeof name, "%.0f s", static_cast<double>(now_ns - start_ns) * 1e-9);
    views.push_back({name, input});
  }
  return views;
}

}  // namespace ridgeline::sim
