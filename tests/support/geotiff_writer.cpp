#include "tests/support/geotiff_writer.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include "core/base/assert.hpp"

namespace ridgeline::test {
namespace {

void set_system(GDALDatasetH dataset, const std::string& name) {
  if (name.empty()) return;
  OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  RL_ASSERT(OSRSetFromUserInput(system, name.c_str()) == OGRERR_NONE);
  RL_ASSERT(GDALSetSpatialRef(dataset, system) == CE_None);
  OSRDestroySpatialReference(system);
}

void fill_band(GDALDatasetH dataset, const GeotiffRecipe& recipe) {
  GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  if (recipe.no_data) GDALSetRasterNoDataValue(band, *recipe.no_data);
  if (recipe.scale) GDALSetRasterScale(band, *recipe.scale);
  if (recipe.offset_m) GDALSetRasterOffset(band, *recipe.offset_m);
  if (!recipe.unit.empty()) GDALSetRasterUnitType(band, recipe.unit.c_str());
  if (!recipe.samples.empty()) {
    std::vector<double> samples = recipe.samples;
    RL_ASSERT(GDALRasterIO(band, GF_Write, 0, 0, recipe.columns, recipe.rows, samples.data(),
                           recipe.columns, recipe.rows, GDT_Float64, 0, 0) == CE_None);
  }
  if (!recipe.mask.empty()) {
    std::vector<unsigned char> mask = recipe.mask;
    RL_ASSERT(GDALCreateDatasetMaskBand(dataset, GMF_PER_DATASET) == CE_None);
    RL_ASSERT(GDALRasterIO(GDALGetMaskBand(band), GF_Write, 0, 0, recipe.columns, recipe.rows,
                           mask.data(), recipe.columns, recipe.rows, GDT_Byte, 0, 0) == CE_None);
  }
}

}  // namespace

void write_geotiff(const std::string& path, const GeotiffRecipe& recipe) {
  GDALRegister_GTiff();
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
  char** options = nullptr;
  for (const std::string& option : recipe.options) options = CSLAddString(options, option.c_str());
  GDALDriverH driver = GDALGetDriverByName("GTiff");
  RL_ASSERT(driver != nullptr);
  const GDALDataType type = GDALGetDataTypeByName(recipe.type.c_str());
  GDALDatasetH dataset =
      GDALCreate(driver, path.c_str(), recipe.columns, recipe.rows, recipe.bands, type, options);
  RL_ASSERT(dataset != nullptr);
  CSLDestroy(options);
  std::array<double, 6> corner_and_steps = recipe.corner_and_steps;
  if (corner_and_steps[1] != 0) GDALSetGeoTransform(dataset, corner_and_steps.data());
  set_system(dataset, recipe.system);
  if (recipe.pixel_is_point) GDALSetMetadataItem(dataset, "AREA_OR_POINT", "Point", nullptr);
  fill_band(dataset, recipe);
  GDALClose(dataset);
}

}  // namespace ridgeline::test
