#include "sim/synthetic/synthetic_terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/synthetic/hash_noise.hpp"

namespace ridgeline::sim {
namespace {

// The land is built on a flat map; metres per degree are those of WGS 84 at 48 degrees south.
constexpr double metres_per_latitude_degree = 111'200;
constexpr double metres_per_longitude_degree = 74'600;
constexpr double map_width_m = synthetic_tiles_a_side * metres_per_longitude_degree;
constexpr double map_height_m = synthetic_tiles_a_side * metres_per_latitude_degree;

constexpr int coarse_rows = 97;
constexpr int coarse_columns = 65;
constexpr int levels = 4;
constexpr std::array<int, levels> steps_per_level = {60, 30, 15, 8};
constexpr double coarse_cell_m = map_height_m / (coarse_rows - 1);
constexpr double fine_cell_m = coarse_cell_m / 8;
constexpr double highest_m = 3430;
constexpr double drowned_m = 70;

constexpr std::uint64_t coast_seed = 104;

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Above 0 on land: how far inside the coast, about 1 in the middle of the island.
double inland(double east_m, double north_m) {
  const double x = 2 * east_m / map_width_m - 1;
  const double y = 2 * north_m / map_height_m - 1;
  const double shape = 0.72 - 0.9 * (x * x * x * x + y * y * y * y) - 0.3 * (x * x + y * y);
  return std::min(0.0, 8 * (0.93 - std::max(std::fabs(x), std::fabs(y)))) + shape +
         1.3 * fractal_noise(east_m / 60e3, north_m / 60e3, 7, coast_seed);
}

/// Uplift in m a year; negative means sea.
Field uplift(int rows, int columns, double cell_m) {
  Field field(rows, columns);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double east_m = column * cell_m;
      const double north_m = row * cell_m;
      const double inside = inland(east_m, north_m);
      const bool border = row == 0 || column == 0 || row == rows - 1 || column == columns - 1;
      if (inside <= 0 || border) {
        field.at(row, column) = -1;
        continue;
      }
      const double belt = ridged_noise(east_m / 70e3 + 3, north_m / 70e3, 2, 200);
      const double local = 1 + 0.7 * fractal_noise(east_m / 14e3, north_m / 14e3, 3, 300);
      field.at(row, column) =
          1e-3 * local * (0.12 + smooth(0, 0.55, inside) * (0.25 + 1.6 * belt * belt));
    }
  }
  return field;
}

double cubic(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// The cell that holds a map place, kept off the border, and the place within it.
struct Cell {
  int column;
  int row;
  double u;
  double v;
};

Cell cell_at(const Field& field, double column, double row) {
  column = std::clamp(column, 0.0, field.columns - 1.0);
  row = std::clamp(row, 0.0, field.rows - 1.0);
  const int c = std::clamp(static_cast<int>(column), 1, field.columns - 3);
  const int r = std::clamp(static_cast<int>(row), 1, field.rows - 3);
  return {c, r, column - c, row - r};
}

/// Catmull-Rom interpolation.
double smooth_value(const Field& field, const Cell& cell) {
  std::array<double, 4> line{};
  for (int k = 0; k < 4; ++k) {
    const int r = cell.row - 1 + k;
    const int c = cell.column;
    line[k] =
        cubic(field.at(r, c - 1), field.at(r, c), field.at(r, c + 1), field.at(r, c + 2), cell.u);
  }
  return cubic(line[0], line[1], line[2], line[3], cell.v);
}

double bilinear_value(const Field& field, const Cell& cell) {
  const int r = cell.row;
  const int c = cell.column;
  const double south = field.at(r, c) + (field.at(r, c + 1) - field.at(r, c)) * cell.u;
  const double north = field.at(r + 1, c) + (field.at(r + 1, c + 1) - field.at(r + 1, c)) * cell.u;
  return south + (north - south) * cell.v;
}

/// The slope at every cell from its four neighbours, rise over run; 0 on the border.
Field slopes(const Field& height_m, double cell_m) {
  Field field(height_m.rows, height_m.columns);
  for (int row = 1; row < field.rows - 1; ++row) {
    for (int column = 1; column < field.columns - 1; ++column) {
      const double east = height_m.at(row, column + 1) - height_m.at(row, column - 1);
      const double north = height_m.at(row + 1, column) - height_m.at(row - 1, column);
      field.at(row, column) = std::sqrt(east * east + north * north) / (2 * cell_m);
    }
  }
  return field;
}

/// Distance outside the rectangle of the feature with corners rounded by the blend (m), 0 inside.
double outside_m(const FlatFeature& feature, double latitude_deg, double longitude_deg) {
  const double east_m = (longitude_deg - feature.longitude_deg) * metres_per_longitude_degree;
  const double north_m = (latitude_deg - feature.latitude_deg) * metres_per_latitude_degree;
  const double along_m = std::fabs(east_m * feature.axis_east + north_m * feature.axis_north);
  const double across_m = std::fabs(east_m * feature.axis_north - north_m * feature.axis_east);
  const double dx = std::max(0.0, along_m - feature.half_length_m);
  const double dy = std::max(0.0, across_m - feature.half_width_m);
  return std::sqrt(dx * dx + dy * dy);
}

/// The patch without data: a ragged disc on a mountain flank that the demo flight sees.
bool without_data(double latitude_deg, double longitude_deg) {
  const double east_m = (longitude_deg + 123.6464) * metres_per_longitude_degree;
  const double north_m = (latitude_deg + 48.3707) * metres_per_latitude_degree;
  const double distance_m = std::sqrt(east_m * east_m + north_m * north_m);
  if (distance_m > 800) return false;
  return distance_m < 450 * (1 + 0.8 * fractal_noise(east_m / 400, north_m / 400, 3, 800));
}

double flattened(const FlatFeature& feature, double latitude_deg, double longitude_deg,
                 double height_m) {
  const double outside = outside_m(feature, latitude_deg, longitude_deg);
  if (outside >= feature.blend_m) return height_m;
  return feature.height_m + (height_m - feature.height_m) * smooth(0, feature.blend_m, outside);
}

}  // namespace

// Axes from the 3-4-5 triangle, so that they are unit vectors to the last bit.
const FlatFeature synthetic_airfield = {-48.42878, -123.70745, -0.6, 0.8, 1000, 250, 500, 18};
const FlatFeature synthetic_lake = {-48.3268, -123.5736, 1, 0, 1300, 500, 900, 92};

SyntheticTerrain::SyntheticTerrain() : height_m_(coarse_rows, coarse_columns), slope_(0, 0) {
  double cell_m = coarse_cell_m;
  for (int level = 0; level < levels; ++level) {
    if (level > 0) {
      height_m_ = doubled(height_m_);
      cell_m /= 2;
    }
    const Field uplift_mpy = uplift(height_m_.rows, height_m_.columns, cell_m);
    for (int row = 0; row < height_m_.rows; ++row) {
      for (int column = 0; column < height_m_.columns; ++column) {
        double& height_m = height_m_.at(row, column);
        const double east_m = column * cell_m;
        const double north_m = row * cell_m;
        if (uplift_mpy.at(row, column) < 0) {
          height_m = std::min(-2.0, 250 * inland(east_m, north_m));
        } else {
          const double rough_m = level == 0 ? 900 : 0.06 * cell_m;
          const double rough =
              fractal_noise(east_m / (3 * cell_m), north_m / (3 * cell_m), 2, 400 + level);
          height_m = std::max(1.0, height_m + rough_m * (1 + rough));
        }
      }
    }
    const ErosionLaw law{cell_m, 150e3, 1.6e-6, 0.85};
    const Field area_m2 = erode(height_m_, uplift_mpy, law, steps_per_level[level]);
    if (level == levels - 1) carve_valleys(height_m_, area_m2, cell_m);
  }
  const double top_m = *std::max_element(height_m_.values.begin(), height_m_.values.end());
  for (double& height_m : height_m_.values) {
    // The sea has risen since: it drowns the mouths of the valleys, which makes a coast of bays.
    if (height_m > 0) height_m *= (highest_m + drowned_m) / top_m;
    height_m -= drowned_m;
  }
  slope_ = slopes(height_m_, fine_cell_m);
}

double SyntheticTerrain::relief_m(double east_m, double north_m) const {
  // A gentle warp hides that rivers of the erosion run in eight directions only.
  double warp_east_m = 0;
  double warp_north_m = 0;
  double wave_m = 26e3;
  for (std::uint64_t octave = 0; octave < 4; ++octave, wave_m *= 0.42) {
    warp_east_m += 0.13 * wave_m * gradient_noise(east_m / wave_m, north_m / wave_m, 500 + octave);
    warp_north_m += 0.13 * wave_m * gradient_noise(east_m / wave_m, north_m / wave_m, 510 + octave);
  }
  const Cell cell = cell_at(height_m_, (east_m + warp_east_m) / fine_cell_m,
                            (north_m + warp_north_m) / fine_cell_m);
  const double land_m = smooth_value(height_m_, cell);
  if (land_m <= 0) return 0;
  const double steepness = std::min(1.0, bilinear_value(slope_, cell) / 0.5);
  const double rock = ridged_noise(east_m / 1300, north_m / 1300, 4, 600) - 0.45;
  return std::max(0.0, land_m + 260 * steepness * (0.2 + 0.8 * steepness) * rock);
}

double SyntheticTerrain::height_m(double latitude_deg, double longitude_deg) const {
  const double east_m = (longitude_deg - synthetic_west_deg) * metres_per_longitude_degree;
  const double north_m = (latitude_deg - synthetic_south_deg) * metres_per_latitude_degree;
  if (east_m < 0 || north_m < 0 || east_m > map_width_m || north_m > map_height_m) return 0;
  if (without_data(latitude_deg, longitude_deg)) return std::numeric_limits<double>::quiet_NaN();
  double height_m = relief_m(east_m, north_m);
  height_m = flattened(synthetic_lake, latitude_deg, longitude_deg, height_m);
  height_m = flattened(synthetic_airfield, latitude_deg, longitude_deg, height_m);
  return height_m;
}

double synthetic_height_m(double latitude_deg, double longitude_deg) {
  static const SyntheticTerrain terrain;
  return terrain.height_m(latitude_deg, longitude_deg);
}

}  // namespace ridgeline::sim
