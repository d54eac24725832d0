// GeoTIFF tiles, read by the display through GDAL from its files in memory. An input is the bytes
// of a file. GDAL itself is built without sanitizers and gives no coverage.
#include <cpl_vsi.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "sim/geotiff/geotiff_reader.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using namespace ridgeline;
using ridgeline::fuzz::must;

namespace {

const std::string path = "/vsimem/tile.tif";

// Tables that libgeotiff has asked for, each with whether it is lent.
struct Table {
  void* memory = nullptr;
  bool lent = false;
};
constexpr std::size_t table_bytes = 65'536 * sizeof(int);  // its MAX_KEYINDEX
std::array<Table, 8> tables;

void check_problem(const FileProblem& problem) {
  must(problem.message.starts_with(path + ": "), "a message names its file");
  must(problem.message.find('\n') == std::string::npos, "a message is one line");
}

void check_tile(const DecodedTile& tile) {
  const PostGrid& grid = tile.grid;
  must(tile.posts_m.size() ==
           static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns),
       "a tile has its posts");
  must(grid.west_deg >= -180 && grid.west_deg < 180 && grid.south_deg >= -90 - 1e-6 &&
           grid.north_deg() <= 90 + 1e-6,
       "a tile is on the Earth");
  must(grid.latitude_step_deg > 5e-7 && grid.longitude_step_deg > 5e-7, "posts are apart");
  for (const float post_m : tile.posts_m) {
    must(std::isnan(post_m) || (post_m >= lowest_post_m && post_m <= highest_post_m),
         "a post is a height of the Earth or unknown");
  }
}

}  // namespace

// libgeotiff's own names for calloc() and free(). It asks for a zeroed table of 256 KiB four times
// an input, which the sanitizer maps and unmaps each time: a third of the time of a run. These are
// kept.
extern "C" void* _GTIFcalloc(std::size_t bytes) {
  if (bytes != table_bytes) return std::calloc(1, bytes);
  for (Table& table : tables) {
    if (table.lent) continue;
    if (table.memory == nullptr) table.memory = std::malloc(bytes);
    table.lent = table.memory != nullptr;
    return table.lent ? std::memset(table.memory, 0, bytes) : nullptr;
  }
  return std::calloc(1, bytes);
}

extern "C" void _GTIFFree(void* memory) {
  for (Table& table : tables) {
    if (memory == nullptr || table.memory != memory) continue;
    table.lent = false;
    return;
  }
  std::free(memory);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static GeotiffReader reader;
  constexpr int most_posts = 4096;  // larger ones only cost time, and a bare directory claims any
  VSILFILE* file = VSIFileFromMemBuffer(path.c_str(), const_cast<std::uint8_t*>(data), size, FALSE);
  VSIFCloseL(file);
  const FileResult<PostGrid> grid = reader.describe(path);
  if (!grid.ok()) check_problem(grid.problem());
  if (grid.ok() && grid.value().rows <= most_posts / grid.value().columns) {
    const FileResult<DecodedTile> tile = reader.load(path);
    if (tile.ok()) {
      must(tile.value().grid == grid.value(), "the header alone says where the posts are");
      check_tile(tile.value());
    } else {
      check_problem(tile.problem());
    }
  }
  VSIUnlink(path.c_str());
  return 0;
}
