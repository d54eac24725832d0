// SRTM tiles: the cell that a name names, the posts that a size means, posts, boxes. An input is
// the size (2 bytes), a place in the tile (4), a box (4), eight posts (16), a name.
#include "core/terrain/hgt_tile.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/tile_files.hpp"

using namespace ridgeline;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

constexpr int side = 1201;
constexpr std::size_t posts_read = 8;

std::optional<TileLocation> cell_of(std::string_view name) {
  const Result<TileLocation> location = location_from_name(name);
  // What a path makes of these is not the name's business.
  const bool is_plain = name.find('/') == std::string_view::npos && !name.empty();
  if (is_plain) {
    const std::optional<oracle::DegreeCell> truth = oracle::cell_in_name(std::string(name));
    must(truth.has_value() == location.ok(), "the oracle names a cell where the display does");
    must(!truth || (truth->south_deg == location.value().south_deg &&
                    truth->west_deg == location.value().west_deg),
         "the oracle names the same cell");
  }
  if (!location) return std::nullopt;
  const TileLocation cell = location.value();
  must(cell.south_deg >= -90 && cell.south_deg <= 89 && cell.west_deg >= -180 &&
           cell.west_deg <= 179,
       "a cell is on the Earth");
  return cell;
}

void check_size(InputBytes& input, TileLocation cell) {
  constexpr std::array<std::size_t, 4> sides = {1201, 3601, 10801, 7};
  const std::size_t posts = sides[input.below(4)];
  const std::size_t size_bytes = 2 * posts * posts + static_cast<std::int8_t>(input.u8());
  const Result<PostGrid> grid = hgt_grid(size_bytes, cell);
  const bool is_known = size_bytes == 2 * posts * posts && posts != 7;
  must(grid.ok() == is_known, "three sizes are tiles");
  if (!grid) return;
  must(std::size_t{2} * static_cast<std::size_t>(grid.value().rows * grid.value().columns) ==
           size_bytes,
       "a tile has its posts");
  must(std::abs(grid.value().north_deg() - cell.south_deg - 1) < 1e-9 &&
           std::abs(grid.value().east_deg() - cell.west_deg - 1) < 1e-9,
       "a tile is one degree square");
}

/// Big-endian, from north to south; -32768 and -9999 are no heights, nor is what the Earth has not.
float expected_m(const std::byte* at) {
  const int raw = std::to_integer<int>(at[0]) << 8 | std::to_integer<int>(at[1]);
  const int height_m = raw < 32768 ? raw : raw - 65536;
  const bool is_known = height_m >= -12000 && height_m <= 9000 && height_m != -9999;
  return is_known ? static_cast<float>(height_m) : NAN;
}

void check_posts(InputBytes& input, TileLocation cell) {
  static std::vector<std::byte> file(std::size_t{2} * side * side);
  const int row = input.u16() % side;
  const int column = input.u16() % (side - static_cast<int>(posts_read) + 1);
  const std::size_t at =
      2 * (static_cast<std::size_t>(side - 1 - row) * side + static_cast<std::size_t>(column));
  const auto posts = input.bytes(2 * posts_read);
  for (std::size_t i = 0; i < posts.size(); ++i) file[at + i] = std::byte{posts[i]};
  const Result<HeightTile> tile = parse_hgt(file, cell.south_deg, cell.west_deg);
  must(tile.ok(), "a tile of the right size is read");
  std::array<float, posts_read> heights_m{};
  read_posts(tile.value(), row, column, heights_m);
  for (std::size_t i = 0; i < posts_read; ++i) {
    const float want_m = expected_m(&file[at + 2 * i]);
    must(heights_m[i] == want_m || (std::isnan(want_m) && std::isnan(heights_m[i])),
         "a post is what its two bytes say");
  }
  for (std::size_t i = 0; i < 2 * posts_read; ++i) file[at + i] = std::byte{0};
}

void check_box(InputBytes& input, TileLocation cell) {
  constexpr double per_degree = 0.5;
  GeoBox box;
  box.south_deg = static_cast<std::int8_t>(input.u8()) * per_degree;
  box.north_deg = box.south_deg + input.u8() * per_degree;
  box.west_deg = static_cast<std::int8_t>(input.u8()) * 2 * per_degree;
  box.east_deg = box.west_deg + input.u8() * 2 * per_degree;
  const PostGrid grid = hgt_grid(std::size_t{2} * side * side, cell).value();
  const bool meets = overlaps(box, grid);
  const GeoBox turned{box.south_deg, box.west_deg + 360, box.north_deg, box.east_deg + 360};
  must(overlaps(turned, grid) == meets, "a box is the same on every turn");
  const double middle_north_deg = cell.south_deg + 0.5, middle_east_deg = cell.west_deg + 0.5;
  bool holds_middle = false;
  for (const double turn_deg : {-360.0, 0.0, 360.0}) {
    const double east_deg = middle_east_deg + turn_deg;
    holds_middle = holds_middle || (box.west_deg <= east_deg && east_deg <= box.east_deg);
  }
  holds_middle =
      holds_middle && box.south_deg <= middle_north_deg && middle_north_deg <= box.north_deg;
  must(meets || !holds_middle, "a box that holds the middle of a tile meets it");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  InputBytes numbers(data, size);
  input.bytes(2 + 4 + 4 + 2 * posts_read);
  const TileLocation cell = cell_of(input.text()).value_or(TileLocation{46, 8});
  check_size(numbers, cell);
  check_posts(numbers, cell);
  check_box(numbers, cell);
  return 0;
}
