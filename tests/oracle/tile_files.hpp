#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "tests/oracle/tile.hpp"

namespace ridgeline::oracle {

/// The cell that a file name begins with, such as `N46E008.hgt`, `n46_e008.dt1` or
/// `s20w180.SRTMGL1.hgt`, in any case; nothing where it names none.
[[nodiscard]] std::optional<DegreeCell> cell_in_name(const std::filesystem::path& file);

/// The tile in a file, or nothing where the name is not one of a terrain tile. The name decides
/// the format: `.hgt`, `.dt0` to `.dt2`, `.tif`/`.tiff`, in either case.
/// Errors: InputError naming the file.
[[nodiscard]] std::optional<Tile> read_tile(const std::filesystem::path& file);

/// Where a terrain file has its posts, as its size or header says, even though its posts cannot be
/// read; nothing where that is not known.
[[nodiscard]] std::optional<Grid> grid_of_file(const std::filesystem::path& file);

/// SRTM `.hgt`: 1201, 3601 or 10801 posts a side, rows from the north, big-endian, -32768 void;
/// the name gives the south-west corner.
[[nodiscard]] Tile read_hgt(const std::filesystem::path& file);

/// DTED level 0, 1 or 2: the header gives origin, interval and counts (so every latitude zone is
/// read alike), heights are sign-magnitude, -32767 void; record checksums are compared. A name that
/// names another cell is an error.
/// Source: MIL-PRF-89020B.
[[nodiscard]] Tile read_dted(const std::filesystem::path& file);
/// The same for the bytes of a file.
[[nodiscard]] Tile dted_in(const std::filesystem::path& file,
                           const std::vector<unsigned char>& bytes);

/// A geographic GeoTIFF through GDAL. GDAL places the corner of the first pixel whatever the
/// file says about points and areas, so a post is half a pixel inside it. Posts are snapped to
/// exact multiples of the step where they lie within a thousandth of a step of one.
/// Errors: InputError, also for projected or rotated rasters.
[[nodiscard]] Tile read_geotiff(const std::filesystem::path& file);
/// The same without its posts.
[[nodiscard]] Grid geotiff_grid(const std::filesystem::path& file);

}  // namespace ridgeline::oracle
