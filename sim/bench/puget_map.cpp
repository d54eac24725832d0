#include "sim/bench/puget_map.hpp"

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace ridgeline::sim {
namespace {

constexpr double metres_a_unit = 0.1;
constexpr int least_posts = 64, most_posts = 16'385;
constexpr int posts_1k = 1025;
// Of post (512, 512) of 1025, on the lattice of the steps.
constexpr double middle_latitude_deg = 32'583.0 / 695.0;
constexpr double middle_longitude_deg = -58'248.0 / 476.0;

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

/// While it lives, GDAL prints nothing.
struct Quiet {
  Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

}  // namespace

GeodeticPosition PugetMap::at(double column, double row) const {
  return {north_deg - row * latitude_step_deg, west_deg + column * longitude_step_deg, 0.0};
}

double PugetMap::highest_m(int column, int row, int posts_around) const {
  float highest = heights_m[static_cast<std::size_t>(row) * posts + column];
  for (int r = std::max(0, row - posts_around); r <= std::min(posts - 1, row + posts_around); ++r) {
    for (int c = std::max(0, column - posts_around);
         c <= std::min(posts - 1, column + posts_around); ++c) {
      highest = std::max(highest, heights_m[static_cast<std::size_t>(r) * posts + c]);
    }
  }
  return static_cast<double>(highest);
}

Outcome read_puget(const std::string& png_file, PugetMap& map) {
  GDALAllRegister();
  const Quiet quiet;
  std::error_code missing;
  if (!std::filesystem::is_regular_file(png_file, missing)) {
    return failed(Fault::file_unreadable, png_file, "no such file");
  }
  const char* const drivers[] = {"PNG", nullptr};
  const Dataset picture(
      GDALOpenEx(png_file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, nullptr, nullptr));
  if (picture == nullptr) return failed(Fault::file_malformed, png_file, "no PNG picture");
  const int side = GDALGetRasterXSize(picture.get());
  const GDALRasterBandH band = GDALGetRasterBand(picture.get(), 1);
  if (GDALGetRasterCount(picture.get()) != 1 || GDALGetRasterDataType(band) != GDT_UInt16) {
    return failed(Fault::file_malformed, png_file, "not 16-bit grey");
  }
  if (GDALGetRasterYSize(picture.get()) != side || side < least_posts || side > most_posts) {
    return failed(Fault::file_malformed, png_file, "not a square of 64 to 16385 posts a side");
  }
  map.posts = side;
  const double finer = (posts_1k - 1.0) / (side - 1.0);
  map.latitude_step_deg = finer / 695.0;
  map.longitude_step_deg = finer / 476.0;
  map.north_deg = middle_latitude_deg + 0.5 * (side - 1) * map.latitude_step_deg;
  map.west_deg = middle_longitude_deg - 0.5 * (side - 1) * map.longitude_step_deg;
  map.heights_m.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  if (GDALRasterIO(band, GF_Read, 0, 0, side, side, map.heights_m.data(), side, side, GDT_Float32,
                   0, 0) != CE_None) {
    return failed(Fault::file_malformed, png_file, "its pixels cannot be decoded");
  }
  for (float& height : map.heights_m) {
    height = static_cast<float>(static_cast<double>(height) * metres_a_unit);
  }
  return {};
}

Outcome write_puget_tile(const PugetMap& map, const std::string& folder) {
  GDALAllRegister();
  const Quiet quiet;
  const std::string file = folder + "/puget.tif";
  const GDALDriverH driver = GDALGetDriverByName("GTiff");
  const Dataset tile(driver == nullptr ? nullptr
                                       : GDALCreate(driver, file.c_str(), map.posts, map.posts, 1,
                                                    GDT_Float32, nullptr));
  if (tile == nullptr) return failed(Fault::file_unwritable, file);
  // A raster's corner is half a post outside its first post.
  double corner[6] = {map.west_deg - 0.5 * map.longitude_step_deg,
                      map.longitude_step_deg,
                      0,
                      map.north_deg + 0.5 * map.latitude_step_deg,
                      0,
                      -map.latitude_step_deg};
  const OGRSpatialReferenceH system = OGRSpatialReferenceH(OSRNewSpatialReference(nullptr));
  const bool named = OSRSetFromUserInput(system, "EPSG:4326") == OGRERR_NONE &&
                     GDALSetSpatialRef(tile.get(), system) == CE_None;
  OSRDestroySpatialReference(system);
  std::vector<float> heights_m = map.heights_m;
  const bool written =
      named && GDALSetGeoTransform(tile.get(), corner) == CE_None &&
      GDALRasterIO(GDALGetRasterBand(tile.get(), 1), GF_Write, 0, 0, map.posts, map.posts,
                   heights_m.data(), map.posts, map.posts, GDT_Float32, 0, 0) == CE_None;
  return written ? Outcome{} : failed(Fault::file_unwritable, file);
}

}  // namespace ridgeline::sim
