#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/oracle/dump.hpp"
#include "tests/oracle/terrain.hpp"
#include "tests/oracle/tile.hpp"

/// Scenes made in code for the oracle's own tests: tiles, folders, and dumps drawn pixel by pixel
/// with the oracle's exact rays.
namespace ridgeline::oracle::scenes {

/// A height at a post, m; NaN for a void.
using Surface = std::function<double(double lat_deg, double lon_deg)>;

/// A tile of a given number of cells per degree and side.
[[nodiscard]] Tile tile(double south_deg, double west_deg, int cells_per_degree, int cells,
                        const Surface& surface);

/// A 1201 x 1201 `.hgt` file of one degree, named after its corner.
void write_hgt(const std::filesystem::path& folder, int south_deg, int west_deg,
               const Surface& surface);

/// Steep random bilinear terrain with a given largest height, the same for the same seed.
[[nodiscard]] Surface rugged(double highest_m, unsigned seed);

/// A pose to be drawn.
struct Shot {
  Geodetic eye;
  double roll_deg = 0;
  double pitch_deg = 0;
  double heading_deg = 0;
  int width = 64;
  int height = 48;
  double focal_px = 60;
  double range_m = 40000;
  double bound_px = 0.5;
};

/// The exact frame of a pose: every pixel shows its centre ray, or unknown where that ray *must*.
[[nodiscard]] Frame drawn(const Terrain& terrain, const Shot& shot);

/// Writes a frame as the contract asks. The colour image is grey, with its true CRC.
void write_frame(const std::filesystem::path& folder, const Frame& frame);

/// A fresh folder that vanishes with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ridgeline::oracle::scenes
