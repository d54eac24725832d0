#include "sim/geotiff/geotiff_reader.hpp"

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>
#include <proj.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace ridgeline {
namespace {

constexpr float unknown_m = std::numeric_limits<float>::quiet_NaN();
constexpr double snap_deg = 1e-6;
constexpr double pole_slack_deg = 1e-9;
constexpr double smallest_step_deg = 1e-6;  // 0.11 m; below it every post would be snapped
constexpr std::int64_t largest_post_count = std::int64_t{1} << 28;
constexpr double wgs84_semi_major_m = 6378137.0;

// While it lives, GDAL prints nothing; the first failure is kept for our own message.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandlerEx(&QuietGdal::keep, this); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  ~QuietGdal() { CPLPopErrorHandler(); }

  [[nodiscard]] const std::string& first_failure() const { return first_failure_; }

 private:
  static void CPL_STDCALL keep(CPLErr level, CPLErrorNum /*number*/, const char* text) {
    auto* self = static_cast<QuietGdal*>(CPLGetErrorHandlerUserData());
    if (level < CE_Failure || !self->first_failure_.empty()) return;
    self->first_failure_ = text;
    std::replace(self->first_failure_.begin(), self->first_failure_.end(), '\n', ' ');
  }

  std::string first_failure_;
};

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// An open raster whose georeference this program understands.
struct Raster {
  Dataset dataset;
  GDALRasterBandH band = nullptr;
  PostGrid grid;
  bool north_row_first = true;
};

FileProblem unsupported(const std::string& path, const std::string& detail) {
  return file_problem(path, Fault::tile_unsupported, detail);
}

FileResult<Dataset> opened(const std::string& path, const QuietGdal& gdal) {
  // GDAL's own question, so that its files in memory are files as well.
  VSIStatBufL status = {};
  if (VSIStatL(path.c_str(), &status) != 0) {
    return file_problem(path, Fault::tile_unreadable, std::strerror(errno));
  }
  if (VSI_ISDIR(status.st_mode)) {
    return file_problem(path, Fault::tile_unreadable, std::strerror(EISDIR));
  }
  if (status.st_size == 0) return file_problem(path, Fault::tile_truncated, "0 bytes");
  const char* const drivers[] = {"GTiff", nullptr};
  const unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
  Dataset dataset(GDALOpenEx(path.c_str(), flags, drivers, nullptr, nullptr));
  if (dataset == nullptr) {
    return file_problem(path, Fault::tile_header_corrupt, gdal.first_failure());
  }
  return dataset;
}

// What is wrong with the coordinate system, if anything.
std::optional<FileProblem> system_problem(const std::string& path, GDALDatasetH dataset) {
  OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
  if (system == nullptr) return unsupported(path, "no coordinate system");
  const char* const given_name = OSRGetName(system);
  const std::string name = given_name != nullptr ? given_name : "unnamed system";
  if (OSRIsProjected(system) != 0) return file_problem(path, Fault::tile_projected, name);
  if (OSRIsGeographic(system) == 0) return unsupported(path, name + " is not geographic");
  OGRErr error = OGRERR_NONE;
  const double semi_major_m = OSRGetSemiMajor(system, &error);
  if (error != OGRERR_NONE || std::abs(semi_major_m - wgs84_semi_major_m) > 0.5) {
    return unsupported(path, name + " is not on the ellipsoid of WGS 84");
  }
  const double unit_rad = OSRGetAngularUnits(system, nullptr);
  if (std::abs(unit_rad - std::numbers::pi / 180.0) > 1e-12 ||
      OSRGetPrimeMeridian(system, nullptr) != 0.0) {
    return unsupported(path, name + " does not count degrees from Greenwich");
  }
  return std::nullopt;
}

std::optional<FileProblem> band_problem(const std::string& path, const Raster& raster) {
  const int band_count = GDALGetRasterCount(raster.dataset.get());
  if (band_count != 1) return unsupported(path, std::to_string(band_count) + " bands, not 1");
  const GDALDataType type = GDALGetRasterDataType(raster.band);
  if (type != GDT_Int16 && type != GDT_UInt16 && type != GDT_Int32 && type != GDT_Float32 &&
      type != GDT_Float64) {
    return unsupported(path, std::string("samples of type ") + GDALGetDataTypeName(type));
  }
  const std::string_view unit = GDALGetRasterUnitType(raster.band);
  if (!unit.empty() && unit != "m" && unit != "metre" && unit != "meter" && unit != "metres" &&
      unit != "meters") {
    return unsupported(path, "heights in " + std::string(unit) + ", not in metres");
  }
  return std::nullopt;
}

std::optional<FileProblem> place_posts(const std::string& path, Raster& raster) {
  double corner[6] = {};
  if (GDALGetGeoTransform(raster.dataset.get(), corner) != CE_None) {
    return unsupported(path, "no georeference");
  }
  const int columns = GDALGetRasterXSize(raster.dataset.get());
  const int rows = GDALGetRasterYSize(raster.dataset.get());
  if (corner[2] != 0 || corner[4] != 0) return unsupported(path, "rotated raster");
  if (!(corner[1] > 0) || !(std::abs(corner[5]) > 0)) return unsupported(path, "mirrored raster");
  if (corner[1] < smallest_step_deg || std::abs(corner[5]) < smallest_step_deg) {
    return unsupported(path, "posts less than 1e-6 degree apart");
  }
  if (columns < 2 || rows < 2 || std::int64_t{columns} * rows > largest_post_count) {
    return unsupported(path, std::to_string(columns) + " x " + std::to_string(rows) + " posts");
  }
  raster.north_row_first = corner[5] < 0;
  const double row_step_deg = std::abs(corner[5]);
  const double south_row = raster.north_row_first ? rows - 0.5 : 0.5;
  const PostAxis latitude = snapped_axis({corner[3] + south_row * corner[5], row_step_deg}, rows);
  const PostAxis longitude = snapped_axis({corner[0] + 0.5 * corner[1], corner[1]}, columns);
  PostGrid& grid = raster.grid;
  grid = PostGrid{.south_deg = latitude.first_deg,
                  .west_deg = longitude.first_deg,
                  .latitude_step_deg = latitude.step_deg,
                  .longitude_step_deg = longitude.step_deg,
                  .rows = rows,
                  .columns = columns};
  if (!(grid.south_deg >= -90.0 - pole_slack_deg && grid.north_deg() <= 90.0 + pole_slack_deg &&
        grid.west_deg >= -360.0 && grid.west_deg < 360.0 &&
        grid.east_deg() - grid.west_deg <= 360.0 + pole_slack_deg)) {
    return unsupported(path, "posts beyond the poles or more than once round the Earth");
  }
  if (grid.west_deg >= 180.0) grid.west_deg -= 360.0;
  if (grid.west_deg < -180.0) grid.west_deg += 360.0;
  return std::nullopt;
}

FileResult<Raster> opened_raster(const std::string& path, const QuietGdal& gdal) {
  FileResult<Dataset> dataset = opened(path, gdal);
  if (!dataset.ok()) return dataset.problem();
  Raster raster;
  raster.dataset = std::move(dataset).value();
  raster.band = GDALGetRasterBand(raster.dataset.get(), 1);
  if (raster.band == nullptr) return unsupported(path, "no band");
  if (auto problem = system_problem(path, raster.dataset.get())) return *problem;
  if (auto problem = band_problem(path, raster)) return *problem;
  if (auto problem = place_posts(path, raster)) return *problem;
  return raster;
}

// Raw samples to heights; what the file itself calls no data becomes NaN before it is scaled.
void scale_posts(GDALRasterBandH band, std::vector<float>& posts_m) {
  int has_no_data = 0;
  const double no_data = GDALGetRasterNoDataValue(band, &has_no_data);
  const auto no_data_sample = static_cast<float>(no_data);
  const double scale = GDALGetRasterScale(band, nullptr);
  const double offset_m = GDALGetRasterOffset(band, nullptr);
  for (float& post : posts_m) {
    const bool no_height = has_no_data != 0 && post == no_data_sample;
    const auto height_m = static_cast<float>(offset_m + scale * static_cast<double>(post));
    const bool known = height_m >= lowest_post_m && height_m <= highest_post_m;  // false for NaN
    post = known && !no_height ? height_m : unknown_m;
  }
}

// A hole of a sparse file has no pixels; GDAL gives zeros there, which would be ground at 0 m.
void forget_holes(GDALRasterBandH band, const PostGrid& grid, std::vector<float>& posts_m) {
  int block_columns = 0;
  int block_rows = 0;
  GDALGetBlockSize(band, &block_columns, &block_rows);
  for (int row = 0; row < grid.rows; row += block_rows) {
    for (int column = 0; column < grid.columns; column += block_columns) {
      const int height = std::min(block_rows, grid.rows - row);
      const int width = std::min(block_columns, grid.columns - column);
      const int status = GDALGetDataCoverageStatus(band, column, row, width, height, 0, nullptr);
      if ((status & GDAL_DATA_COVERAGE_STATUS_EMPTY) == 0) continue;
      for (int y = row; y < row + height; ++y) {
        const auto at = static_cast<std::size_t>(y) * grid.columns + column;
        std::fill_n(posts_m.begin() + static_cast<std::ptrdiff_t>(at), width, unknown_m);
      }
    }
  }
}

// Posts that a mask of the file's own hides. False when the mask cannot be read.
bool forget_masked(GDALRasterBandH band, const PostGrid& grid, std::vector<float>& posts_m) {
  if ((GDALGetMaskFlags(band) & (GMF_PER_DATASET | GMF_ALPHA)) == 0) return true;
  std::vector<std::uint8_t> mask(posts_m.size());
  if (GDALRasterIO(GDALGetMaskBand(band), GF_Read, 0, 0, grid.columns, grid.rows, mask.data(),
                   grid.columns, grid.rows, GDT_Byte, 0, 0) != CE_None) {
    return false;
  }
  for (std::size_t i = 0; i < posts_m.size(); ++i) {
    if (mask[i] == 0) posts_m[i] = unknown_m;
  }
  return true;
}

void turn_south_row_first(const PostGrid& grid, std::vector<float>& posts_m) {
  const std::ptrdiff_t columns = grid.columns;
  for (std::ptrdiff_t low = 0, high = grid.rows - 1; low < high; ++low, --high) {
    std::swap_ranges(posts_m.begin() + low * columns, posts_m.begin() + (low + 1) * columns,
                     posts_m.begin() + high * columns);
  }
}

}  // namespace

PostAxis snapped_axis(PostAxis axis, int count) {
  const double posts_per_degree = std::round(1.0 / axis.step_deg);
  if (!(posts_per_degree >= 1.0) || !std::isfinite(axis.first_deg)) return axis;
  const double last_deg = axis.first_deg + (count - 1) * axis.step_deg;
  const double first_index = std::round(axis.first_deg * posts_per_degree);
  const double snapped_first_deg = first_index / posts_per_degree;
  const double snapped_last_deg = (first_index + (count - 1)) / posts_per_degree;
  if (std::abs(snapped_first_deg - axis.first_deg) > snap_deg ||
      std::abs(snapped_last_deg - last_deg) > snap_deg) {
    return axis;
  }
  return {snapped_first_deg, 1.0 / posts_per_degree};
}

GeotiffReader::GeotiffReader() {
  GDALRegister_GTiff();
  // PROJ prints damaged coordinate systems past GDAL's error handler; new contexts copy this one.
  proj_log_level(PJ_DEFAULT_CTX, PJ_LOG_NONE);
}

bool GeotiffReader::accepts(const std::string& path) const {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".tif" || extension == ".tiff";
}

FileResult<PostGrid> GeotiffReader::describe(const std::string& path) {
  const QuietGdal gdal;
  FileResult<Raster> raster = opened_raster(path, gdal);
  if (!raster.ok()) return raster.problem();
  return raster.value().grid;
}

FileResult<DecodedTile> GeotiffReader::load(const std::string& path) {
  const QuietGdal gdal;
  FileResult<Raster> raster = opened_raster(path, gdal);
  if (!raster.ok()) return raster.problem();
  const PostGrid& grid = raster.value().grid;
  GDALRasterBandH band = raster.value().band;
  DecodedTile tile;
  tile.grid = grid;
  tile.posts_m.resize(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  if (GDALRasterIO(band, GF_Read, 0, 0, grid.columns, grid.rows, tile.posts_m.data(), grid.columns,
                   grid.rows, GDT_Float32, 0, 0) != CE_None) {
    return file_problem(path, Fault::tile_record_corrupt, gdal.first_failure());
  }
  scale_posts(band, tile.posts_m);
  forget_holes(band, grid, tile.posts_m);
  if (!forget_masked(band, grid, tile.posts_m)) {
    return file_problem(path, Fault::tile_record_corrupt, gdal.first_failure());
  }
  if (raster.value().north_row_first) turn_south_row_first(grid, tile.posts_m);
  return tile;
}

}  // namespace ridgeline
