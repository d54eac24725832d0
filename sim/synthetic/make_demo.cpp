#include "sim/synthetic/make_demo.hpp"

#include <future>
#include <vector>

#include "sim/output/atomic_file.hpp"
#include "sim/synthetic/bus_log_writer.hpp"
#include "sim/synthetic/synthetic_terrain.hpp"
#include "sim/synthetic/tile_writer.hpp"

namespace ridgeline::sim {
namespace {

constexpr int posts_a_side = 1201;

constexpr char readme[] =
    "SYNTHETIC terrain and flight, made by `ridgeline make-demo`. Not a real place.\n"
    "\n"
    "The four .hgt tiles show an island that does not exist, in the open ocean near 48 S 123 W.\n"
    "It was made by computation alone (uplift, river erosion, noise) and holds no measured data.\n"
    "Heights are whole metres above the WGS 84 ellipsoid (use --geoid none); -32768 is unknown.\n"
    "demo.log is a scripted flight as a recorded CANaerospace bus (candump -L text), with 3 s of "
    "lost\n"
    "position and 1 s of lost attitude. Nothing here may be used for navigation.\n";

}  // namespace

Outcome make_demo(const std::string& folder) {
  if (Outcome made = make_folder(folder); !made.ok()) return made;
  if (Outcome written = write_file(folder + "/README.txt", std::string_view(readme)); !written.ok())
    return written;
  const SyntheticTerrain terrain;
  const HeightFunction height_m = [&](double latitude_deg, double longitude_deg) {
    return terrain.height_m(latitude_deg, longitude_deg);
  };
  // A tile depends on nothing but its place, so the four are made side by side.
  std::vector<std::future<Outcome>> tiles;
  for (int row = 0; row < synthetic_tiles_a_side; ++row) {
    for (int column = 0; column < synthetic_tiles_a_side; ++column) {
      tiles.push_back(std::async(std::launch::async, [&, row, column] {
        return write_tile_with(folder, synthetic_south_deg + row, synthetic_west_deg + column,
                               posts_a_side, height_m);
      }));
    }
  }
  Outcome all_tiles;
  for (std::future<Outcome>& tile : tiles) {
    Outcome written = tile.get();
    if (all_tiles.ok()) all_tiles = written;
  }
  if (!all_tiles.ok()) return all_tiles;
  return write_file(folder + "/demo.log", bus_log(scripted_flight(height_m), demo_gaps));
}

}  // namespace ridgeline::sim
