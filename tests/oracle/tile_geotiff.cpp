#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <memory>
#include <mutex>

#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tile_files.hpp"

namespace ridgeline::oracle {
namespace {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

Dataset open_raster(const std::string& file) {
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
  CPLPushErrorHandler(CPLQuietErrorHandler);
  Dataset dataset(GDALOpen(file.c_str(), GA_ReadOnly));
  CPLPopErrorHandler();
  if (!dataset) throw InputError(file, "GDAL cannot open it");
  return dataset;
}

/// The step as 1/n degree where it is one to a millionth, so that posts are exact.
double snapped_step(double step_deg) {
  const double per_degree = std::round(1.0 / step_deg);
  if (per_degree >= 1 && std::abs(per_degree * step_deg - 1.0) < 1e-6) return 1.0 / per_degree;
  return step_deg;
}

double snapped_origin(double origin_deg, double step_deg) {
  const double index = std::round(origin_deg / step_deg);
  if (std::abs(origin_deg / step_deg - index) > 1e-3) return origin_deg;
  // Dividing by the whole number of posts in a degree keeps whole degrees whole.
  const double per_degree = std::round(1.0 / step_deg);
  if (std::abs(per_degree * step_deg - 1.0) < 1e-12) return index / per_degree;
  return index * step_deg;
}

void require_geographic(const std::string& file, GDALDatasetH dataset) {
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(dataset);
  if (reference == nullptr) throw InputError(file, "raster has no coordinate system");
  if (OSRIsGeographic(reference) == 0) {
    throw InputError(file, "raster is not geographic (projected coordinates)");
  }
}

Tile without_posts(const std::filesystem::path& path, GDALDatasetH dataset) {
  const std::string file = path.string();
  double transform[6] = {};
  if (GDALGetGeoTransform(dataset, transform) != CE_None) {
    throw InputError(file, "raster has no georeference");
  }
  require_geographic(file, dataset);
  if (transform[2] != 0 || transform[4] != 0 || transform[1] <= 0 || transform[5] >= 0) {
    throw InputError(file, "raster is not north up");
  }
  Tile tile;
  tile.name = path.filename().string();
  tile.columns = GDALGetRasterXSize(dataset);
  tile.rows = GDALGetRasterYSize(dataset);
  if (tile.rows < 2 || tile.columns < 2 || GDALGetRasterCount(dataset) < 1) {
    throw InputError(file, "raster has no cell");
  }
  tile.lon_step_deg = snapped_step(transform[1]);
  tile.lat_step_deg = snapped_step(-transform[5]);
  const double west = transform[0] + 0.5 * transform[1];
  const double south = transform[3] + (tile.rows - 0.5) * transform[5];
  tile.west_deg = snapped_origin(west, tile.lon_step_deg);
  tile.south_deg = snapped_origin(south, tile.lat_step_deg);
  if (tile.west_deg >= 180) tile.west_deg -= 360;
  return tile;
}

void read_posts(const std::string& file, GDALRasterBandH band, Tile& tile) {
  int has_no_data = 0;
  const double no_data = GDALGetRasterNoDataValue(band, &has_no_data);
  const double scale = GDALGetRasterScale(band, nullptr);
  const double offset = GDALGetRasterOffset(band, nullptr);
  const bool is_int16 = GDALGetRasterDataType(band) == GDT_Int16;
  std::vector<double> values(static_cast<std::size_t>(tile.columns));
  tile.posts.resize(values.size() * static_cast<std::size_t>(tile.rows));
  for (int row = tile.rows - 1; row >= 0; --row) {
    if (GDALRasterIO(band, GF_Read, 0, tile.rows - 1 - row, tile.columns, 1, values.data(),
                     tile.columns, 1, GDT_Float64, 0, 0) != CE_None) {
      throw InputError(file, "raster cannot be decoded");
    }
    for (int column = 0; column < tile.columns; ++column) {
      const double value = values[static_cast<std::size_t>(column)];
      // The two customary voids of 16-bit terrain hold even where a file forgets to declare one.
      const bool is_void = (has_no_data != 0 && value == no_data) || !std::isfinite(value) ||
                           (is_int16 && value <= -32767);
      tile.set(row, column, is_void ? void_post : known_or_void(value * scale + offset));
    }
  }
}

}  // namespace

Tile read_geotiff(const std::filesystem::path& path) {
  const Dataset dataset = open_raster(path.string());
  Tile tile = without_posts(path, dataset.get());
  read_posts(path.string(), GDALGetRasterBand(dataset.get(), 1), tile);
  return tile;
}

Grid geotiff_grid(const std::filesystem::path& path) {
  const Dataset dataset = open_raster(path.string());
  return without_posts(path, dataset.get());
}

}  // namespace ridgeline::oracle
