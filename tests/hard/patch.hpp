#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tests/gl/scene.hpp"

namespace ridgeline::test {

/// Where a patch of posts lies. Frame: WGS 84; post (row, column) counts from the south-west.
struct PatchShape {
  double south_deg = 46, west_deg = 8;
  int rows = 0, columns = 0;
  double rows_a_degree = 1200, columns_a_degree = 1200;
  std::string type = "Int16";  ///< of a sample, by GDAL's name
};

/// A rectangle of posts that becomes one file.
struct PatchPart {
  int row = 0, column = 0;
  int rows = 0, columns = 0;
};

/// Height of the post (row from the south, column from the west), m; NaN = void.
using PatchHeight = std::function<double(int row, int column)>;

/// A small piece of land of any step as GeoTIFF, whose places are named by post.
class Patch : public Land {
 public:
  /// One file, or one for each of `parts` (neighbours share a line of posts).
  /// Domain: heights -32766..32767 for the type Int16; a sample is rounded as the type asks.
  Patch(const PatchShape& shape, PatchHeight height_m, std::vector<PatchPart> parts = {});

  [[nodiscard]] double latitude_deg(double row) const {
    return (shape_.south_deg * shape_.rows_a_degree + row) / shape_.rows_a_degree;
  }
  [[nodiscard]] double longitude_deg(double column) const {
    return (shape_.west_deg * shape_.columns_a_degree + column) / shape_.columns_a_degree;
  }
  /// The bilinear surface between the posts, m; NaN in an unknown cell.
  [[nodiscard]] double surface_m(double row, double column) const;
  /// The place `over_m` above that surface.
  [[nodiscard]] GeodeticPosition over(double row, double column, double over_m) const {
    return {latitude_deg(row), longitude_deg(column), surface_m(row, column) + over_m};
  }
  /// The place at a height over the ellipsoid.
  [[nodiscard]] GeodeticPosition at(double row, double column, double height_m) const {
    return {latitude_deg(row), longitude_deg(column), height_m};
  }

 private:
  [[nodiscard]] double stored_m(int row, int column) const;

  PatchShape shape_;
  PatchHeight post_m_;
};

}  // namespace ridgeline::test
