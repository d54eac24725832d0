#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ridgeline::oracle {

/// The undulation N over one cell of the geoid grid: bilinear, N = c0 + cx x + cy y + cxy x y with
/// x, y in cells from its south-west node. It may be evaluated a little outside its cell.
struct GeoidPatch {
  double west_deg = 0;
  double south_deg = 0;
  double lon_step_deg = 1;
  double lat_step_deg = 1;
  double c0 = 0;
  double cx = 0;
  double cy = 0;
  double cxy = 0;

  /// Units: degrees; m. `lon_deg` must be on the same turn as `west_deg`.
  [[nodiscard]] double at(double lat_deg, double lon_deg) const {
    const double x = (lon_deg - west_deg) / lon_step_deg;
    const double y = (lat_deg - south_deg) / lat_step_deg;
    return c0 + cx * x + (cy + cxy * x) * y;
  }
};

/// A geoid grid, or N = 0 everywhere when default-made (`none`).
class Geoid {
 public:
  Geoid() = default;

  /// Reads GeographicLib's PGM or a PROJ GTX grid, which the first bytes tell apart.
  /// Errors: InputError naming the file.
  [[nodiscard]] static Geoid read(const std::filesystem::path& file);

  /// The same for the bytes of a file.
  [[nodiscard]] static Geoid in(const std::filesystem::path& file, const std::string& bytes);

  /// A grid of given nodes, for tests. Shape: rows x columns, row 0 the south row.
  [[nodiscard]] static Geoid from_nodes(double south_deg, double west_deg, double lat_step_deg,
                                        double lon_step_deg, int rows, int columns,
                                        std::vector<float> nodes_m);

  /// `none`, or the name of the file without its folder.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_none() const { return nodes_.empty(); }

  /// The patch that holds a position, on the turn of `lon_deg`.
  /// Domain: any longitude; outside a regional grid N = 0 (a frame there cannot be judged anyway).
  [[nodiscard]] GeoidPatch patch(double lat_deg, double lon_deg) const;

  /// The undulation at a position.
  [[nodiscard]] double at(double lat_deg, double lon_deg) const {
    return patch(lat_deg, lon_deg).at(lat_deg, lon_deg);
  }

 private:
  [[nodiscard]] double node(int row, int column) const;

  std::string name_ = "none";
  double south_deg_ = 0;
  double west_deg_ = 0;
  double lat_step_deg_ = 1;
  double lon_step_deg_ = 1;
  int rows_ = 0;
  int columns_ = 0;
  std::vector<float> nodes_;
};

}  // namespace ridgeline::oracle
