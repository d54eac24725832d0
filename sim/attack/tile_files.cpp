#include "sim/attack/tile_files.hpp"

#include <cpl_conv.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "sim/attack/land.hpp"
#include "sim/output/atomic_file.hpp"
#include "sim/synthetic/hash_noise.hpp"
#include "sim/synthetic/tile_writer.hpp"

namespace ridgeline::sim {
namespace {

constexpr std::size_t dted_head_bytes = 3428, dted_dsi_at = 80, dted_acc_at = 728;
constexpr int hgt_void = -32768, dted_void = -32767;

using Bytes = std::vector<std::byte>;

void append(Bytes& out, std::uint64_t value, int width) {
  for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((value >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}

std::string printed(const char* format, int a, int b = 0, int c = 0, int d = 0) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, a, b, c, d);
  return buffer;
}

Bytes hgt_bytes(const PostGrid& grid, const std::vector<float>& posts) {
  Bytes out;
  out.reserve(2 * posts.size());
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const float h = posts[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                            static_cast<std::size_t>(column)];
      append(out, static_cast<std::uint16_t>(std::isnan(h) ? hgt_void : static_cast<int>(h)), 2);
    }
  }
  return out;
}

std::string dted_head(int level, int south, int west, const PostGrid& grid) {
  const char north_south = south < 0 ? 'S' : 'N', east_west = west < 0 ? 'W' : 'E';
  const int lat_tenths = 36'000 / (grid.rows - 1), lon_tenths = 36'000 / (grid.columns - 1);
  const int lat = std::abs(south), lon = std::abs(west);
  std::string head(dted_head_bytes, ' ');
  const auto put = [&](std::size_t at, const std::string& field) {
    head.replace(at, field.size(), field);
  };
  put(0, "UHL1" + printed("%03d0000", lon) + east_west + printed("%03d0000", lat) + north_south);
  put(20, printed("%04d%04dNA  U  ", lon_tenths, lat_tenths));
  put(47, printed("%04d%04d0", grid.columns, grid.rows));
  put(dted_dsi_at, "DSIU");
  put(dted_dsi_at + 59, printed("DTED%d", level));
  put(dted_dsi_at + 141, "MSLWGS84");
  put(dted_dsi_at + 185, printed("%02d0000.0", lat) + north_south);
  put(dted_dsi_at + 194, printed("%03d0000.0", lon) + east_west);
  put(dted_dsi_at + 204, printed("%02d0000", lat) + north_south);
  put(dted_dsi_at + 211, printed("%03d0000", lon) + east_west);
  put(dted_dsi_at + 264,
      "0000000.0" + printed("%04d%04d%04d%04d00", lat_tenths, lon_tenths, grid.rows, grid.columns));
  put(dted_acc_at, "ACC");
  return head;
}

Bytes dted_bytes(int level, int south, int west, const PostGrid& grid,
                 const std::vector<float>& posts) {
  Bytes out;
  for (const char c : dted_head(level, south, west, grid)) out.push_back(static_cast<std::byte>(c));
  for (int column = 0; column < grid.columns; ++column) {
    const std::size_t start = out.size();
    append(out, 0xAA, 1);
    append(out, static_cast<std::uint64_t>(column), 3);
    append(out, static_cast<std::uint64_t>(column), 2);
    append(out, 0, 2);
    for (int row = 0; row < grid.rows; ++row) {
      const float post = posts[static_cast<std::size_t>(row * grid.columns + column)];
      const int h = std::isnan(post) ? dted_void : static_cast<int>(post);
      append(out, h < 0 ? 0x8000U | static_cast<unsigned>(-h) : static_cast<unsigned>(h), 2);
    }
    std::uint32_t sum = 0;
    for (std::size_t i = start; i < out.size(); ++i) sum += std::to_integer<std::uint32_t>(out[i]);
    append(out, sum, 4);
  }
  return out;
}

std::string dted_name(int level, int south, int west) {
  return printed(south < 0 ? "s%02d" : "n%02d", std::abs(south)) +
         printed(west < 0 ? "_w%03d.dt%d" : "_e%03d.dt%d", std::abs(west), level);
}

Outcome write_geotiff(const std::string& path, const TilePlan& tile, const PostGrid& grid,
                      std::vector<float> posts) {
  GDALRegister_GTiff();
  CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
  const bool whole = tile.format == TileFormat::tif16;
  constexpr float no_data = -32768;
  for (float& post : posts) {
    if (std::isnan(post)) post = no_data;
  }
  GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), grid.columns,
                                 grid.rows, 1, whole ? GDT_Int16 : GDT_Float32, nullptr);
  if (file == nullptr) return failed(Fault::file_unwritable, path);
  double corner[6] = {grid.west_deg - 0.5 * grid.longitude_step_deg,
                      grid.longitude_step_deg,
                      0,
                      grid.south_deg + (grid.rows - 0.5) * grid.latitude_step_deg,
                      0,
                      -grid.latitude_step_deg};
  OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  bool good = OSRSetFromUserInput(system, "EPSG:4326") == OGRERR_NONE;
  good = good && GDALSetSpatialRef(file, system) == CE_None;
  OSRDestroySpatialReference(system);
  good = good && GDALSetGeoTransform(file, corner) == CE_None;
  GDALRasterBandH band = GDALGetRasterBand(file, 1);
  good = good && GDALSetRasterNoDataValue(band, static_cast<double>(no_data)) == CE_None;
  for (int row = 0; row < grid.rows && good; ++row) {
    float* from = posts.data() + static_cast<std::ptrdiff_t>(grid.rows - 1 - row) * grid.columns;
    good = GDALRasterIO(band, GF_Write, 0, row, grid.columns, 1, from, grid.columns, 1, GDT_Float32,
                        0, 0) == CE_None;
  }
  GDALClose(file);
  return good ? Outcome{} : failed(Fault::file_unwritable, path);
}

std::string sea_text(const AttackCase& c) {
  std::string text;
  for (const SeaCell& cell : c.sea) {
    text += "sea " + tile_name(cell.south_deg, cell.west_deg).substr(0, 7) + "\n";
  }
  return text;
}

std::string edit_text(const AttackCase& c) {
  std::string text;
  for (const EditPlan& e : c.edits) {
    char line[240];
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g %.17g %.17g %d %d fill ", e.time_s,
                  std::round(e.south_deg * e.lat_per_deg) / e.lat_per_deg,
                  std::round(e.west_deg * e.lon_per_deg) / e.lon_per_deg, 3600.0 / e.lat_per_deg,
                  3600.0 / e.lon_per_deg, e.rows, e.columns);
    text += line;
    char height[40];
    std::snprintf(height, sizeof height, "%.9g\n", e.height_m);
    text += std::isnan(e.height_m) ? "void\n" : height;
  }
  return text;
}

/// A GTX grid once round the Earth; the last meridian repeats the first.
Bytes geoid_bytes(const GeoidPlan& geoid) {
  const int rows = static_cast<int>(180 / geoid.step_deg) + 1;
  const int columns = 2 * (rows - 1) + 1;
  Bytes out;
  for (const double value : {-90.0, -180.0, geoid.step_deg, geoid.step_deg}) {
    append(out, std::bit_cast<std::uint64_t>(value), 8);
  }
  append(out, static_cast<std::uint64_t>(rows), 4);
  append(out, static_cast<std::uint64_t>(columns), 4);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool pole = row == 0 || row == rows - 1;
      const std::uint64_t bits = lattice_hash(pole ? 0 : column % (columns - 1), row,
                                              static_cast<std::uint64_t>(geoid.seed));
      const double unit = static_cast<double>(bits >> 11U) * 0x1p-52 - 1.0;
      append(out, std::bit_cast<std::uint32_t>(static_cast<float>(geoid.amplitude_m * unit)), 4);
    }
  }
  return out;
}

}  // namespace

Outcome write_tile(const std::string& folder, std::size_t index, const TilePlan& tile,
                   const std::vector<float>& posts) {
  const PostGrid grid = grid_of(tile);
  const int south = static_cast<int>(tile.south_deg), west = static_cast<int>(tile.west_deg);
  if (tile.format == TileFormat::hgt) {
    return write_file(folder + "/" + tile_name(south, west), hgt_bytes(grid, posts));
  }
  if (tile.format == TileFormat::dt0 || tile.format == TileFormat::dt1) {
    const int level = tile.format == TileFormat::dt0 ? 0 : 1;
    return write_file(folder + "/" + dted_name(level, south, west),
                      dted_bytes(level, south, west, grid, posts));
  }
  return write_geotiff(folder + "/tile" + std::to_string(index) + ".tif", tile, grid, posts);
}

Outcome write_case(const std::string& folder, const AttackCase& c, CaseFiles& files) {
  files.terrain_folder = folder + "/tiles";
  Outcome done = make_folder(files.terrain_folder);
  for (std::size_t tile = 0; tile < c.tiles.size() && done.ok(); ++tile) {
    done = write_tile(files.terrain_folder, tile, c.tiles[tile], posts_of(c, tile));
  }
  const auto write = [&](bool wanted, const char* name, std::string& path, const auto& contents) {
    if (!wanted || !done.ok()) return;
    path = folder + name;
    done = write_file(path, contents);
  };
  write(!c.sea.empty(), "/coverage.txt", files.coverage_file, std::string_view(sea_text(c)));
  write(!c.edits.empty(), "/edits.txt", files.edit_file, std::string_view(edit_text(c)));
  if (c.geoid.amplitude_m != 0) {
    write(true, "/geoid.gtx", files.geoid_file, geoid_bytes(c.geoid));
  }
  return done;
}

}  // namespace ridgeline::sim
