// DTED files, read by the display and by the oracle. An input shapes a small whole file and then
// damages it: counts (2 bytes), corner (2), what is done besides (1), places and bytes that are
// put there (count, then 3 each), posts.
#include "core/terrain/dted_tile.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/oracle/input_error.hpp"
#include "tests/oracle/tile_files.hpp"

using namespace ridgeline;
using ridgeline::fuzz::InputBytes;
using ridgeline::fuzz::must;

namespace {

using Bytes = std::vector<unsigned char>;

struct Shape {
  int rows = 0, columns = 0, south_deg = 0, west_deg = 0;
};

/// `value` in `width` decimal digits.
void put_number(Bytes& file, std::size_t at, int value, int width) {
  for (int digit = width; digit-- > 0; value /= 10) {
    file[at + static_cast<std::size_t>(digit)] = static_cast<unsigned char>('0' + value % 10);
  }
}

void put_text(Bytes& file, std::size_t at, const char* text) {
  std::memcpy(&file[at], text, std::strlen(text));
}

/// Degrees, no minutes and seconds, and the side.
void put_angle(Bytes& file, std::size_t at, int degrees, int width, const char* sides) {
  put_number(file, at, degrees < 0 ? -degrees : degrees, width);
  put_text(file, at + static_cast<std::size_t>(width), "0000");
  file[at + static_cast<std::size_t>(width) + 4] =
      static_cast<unsigned char>(sides[degrees < 0 ? 1 : 0]);
}

void put_header(Bytes& file, const Shape& shape) {
  constexpr std::size_t data_set = 80;
  const int latitude_step = 36000 / (shape.rows - 1), longitude_step = 36000 / (shape.columns - 1);
  put_text(file, 0, "UHL1");
  put_angle(file, 4, shape.west_deg, 3, "EW");
  put_angle(file, 12, shape.south_deg, 3, "NS");
  put_number(file, 20, longitude_step, 4);
  put_number(file, 24, latitude_step, 4);
  put_number(file, 47, shape.columns, 4);
  put_number(file, 51, shape.rows, 4);
  put_text(file, data_set, "DSI");
  put_text(file, data_set + 59, "DTED1");
  put_angle(file, data_set + 204, shape.south_deg, 2, "NS");
  put_angle(file, data_set + 211, shape.west_deg, 3, "EW");
  put_number(file, data_set + 273, latitude_step, 4);
  put_number(file, data_set + 277, longitude_step, 4);
  put_number(file, data_set + 281, shape.rows, 4);
  put_number(file, data_set + 285, shape.columns, 4);
  put_text(file, data_set + 648, "ACC");
}

void put_records(Bytes& file, const Shape& shape, InputBytes& input) {
  for (int column = 0; column < shape.columns; ++column) {
    const std::size_t stride = dted_record_bytes(shape.rows);
    unsigned char* record = &file[dted_header_bytes + static_cast<std::size_t>(column) * stride];
    std::memset(record, 0, stride);
    record[0] = 0xaa;
    record[3] = record[5] = static_cast<unsigned char>(column);
    const auto posts = input.bytes(2 * static_cast<std::size_t>(shape.rows));
    if (!posts.empty()) std::memcpy(record + 8, posts.data(), posts.size());
    std::uint32_t sum = 0;
    for (std::size_t at = 0; at < stride - 4; ++at) sum += record[at];
    for (std::size_t at = 0; at < 4; ++at) {
      record[stride - 4 + at] = static_cast<unsigned char>(sum >> (24U - 8U * at));
    }
  }
}

const Bytes& file_from(InputBytes& input) {
  // Counts that make whole cells: their intervals have at most four digits.
  constexpr std::array<int, 8> counts = {5, 6, 7, 9, 10, 11, 13, 16};
  static Bytes file;
  Shape shape;
  shape.rows = counts[input.below(8)];
  shape.columns = counts[input.below(8)];
  shape.south_deg = static_cast<std::int8_t>(input.u8()) % 92;
  shape.west_deg = static_cast<int>(input.u8()) * 2 - 256;
  const std::uint8_t besides = input.u8();
  const std::size_t patch_count = besides & 7U;
  const auto patches = input.bytes(3 * patch_count);
  file.assign(
      dted_header_bytes + static_cast<std::size_t>(shape.columns) * dted_record_bytes(shape.rows),
      ' ');
  put_header(file, shape);
  put_records(file, shape, input);
  for (std::size_t at = 0; at + 3 <= patches.size(); at += 3) {
    const std::size_t place = (std::size_t{patches[at]} << 8U | patches[at + 1]) % file.size();
    file[place] = patches[at + 2];
  }
  if ((besides & 8U) != 0) file.resize(file.size() - 1 - input.u8());
  if ((besides & 16U) != 0) file.push_back(0);
  return file;
}

/// The posts of the display's tile and the oracle's, one by one.
void check_posts(const HeightTile& tile, const oracle::Tile& truth) {
  const PostGrid& grid = tile.grid;
  must(grid.rows == truth.rows && grid.columns == truth.columns &&
           grid.south_deg == truth.south_deg && grid.west_deg == truth.west_deg,
       "the oracle has the same grid");
  std::array<float, 16> row_m{}, part_m{};
  for (int row = 0; row < grid.rows; ++row) {
    const std::span<float> whole(row_m.data(), static_cast<std::size_t>(grid.columns));
    read_posts(tile, row, 0, whole);
    for (int column = 0; column < grid.columns; ++column) {
      const float post_m = row_m[static_cast<std::size_t>(column)];
      must(std::isnan(post_m) || (post_m >= lowest_post_m && post_m <= highest_post_m),
           "a post is a height of the Earth or unknown");
      const float true_m = truth.at(row, column);
      must(post_m == true_m || (std::isnan(post_m) && std::isnan(true_m)),
           "the oracle has the same posts");
    }
    const int from = row % grid.columns;
    const std::span<float> part(part_m.data(), static_cast<std::size_t>(grid.columns - from));
    read_posts(tile, row, from, part);
    must(std::memcmp(part.data(), whole.data() + from, part.size_bytes()) == 0,
         "part of a row is that part of the row");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  InputBytes input(data, size);
  const Bytes& file = file_from(input);
  const auto bytes = std::as_bytes(std::span(file));
  const Result<PostGrid> grid = dted_grid(bytes, bytes.size());
  const Result<HeightTile> tile = parse_dted(bytes);
  if (!grid) must(!tile && tile.fault() == grid.fault(), "a bad header refuses the tile");
  if (!tile) {
    must(!grid || tile.fault() == Fault::tile_record_corrupt ||
             tile.fault() == Fault::tile_checksum_mismatch,
         "a good header leaves the records to refuse");
    return 0;
  }
  must(tile.value().grid == grid.value(), "the header alone says where the posts are");
  try {
    check_posts(tile.value(), oracle::dted_in("tile.dt1", file));
  } catch (const oracle::InputError&) {
    must(false, "the oracle reads what the display reads");
  }
  return 0;
}
