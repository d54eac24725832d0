#include "tests/oracle/tile_files.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

#include "tests/oracle/input_error.hpp"

namespace ridgeline::oracle {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::uintmax_t longest_file_bytes = std::uintmax_t{1} << 30U;

Bytes file_bytes(const std::filesystem::path& file) {
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(file, fault);
  std::ifstream in(file, std::ios::binary);
  if (fault || !in) throw InputError(file.string(), "cannot be opened");
  if (size > longest_file_bytes) throw InputError(file.string(), "is longer than any tile");
  Bytes bytes(static_cast<std::size_t>(size));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw InputError(file.string(), "cannot be read");
  return bytes;
}

unsigned big_endian_16(const Bytes& bytes, std::size_t at) {
  return static_cast<unsigned>(bytes[at]) << 8U | bytes[at + 1];
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// A run of digits as a number, or -1.
int number(std::string_view digits) {
  int value = -1;
  if (digits.starts_with('-')) return -1;  // a minus zero is no run of digits either
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault != std::errc() || end != digits.data() + digits.size() || value < 0) return -1;
  return value;
}

/// `DDDMMSSH` as degrees; NaN where it is not one.
double dted_angle_deg(std::string_view text, char negative, char positive) {
  const int degrees = number(text.substr(0, 3));
  const int minutes = number(text.substr(3, 2));
  const int seconds = number(text.substr(5, 2));
  const char side = text[7];
  if (degrees < 0 || minutes < 0 || seconds < 0 || (side != negative && side != positive)) {
    return std::nan("");
  }
  const double angle = (degrees * 3600.0 + minutes * 60.0 + seconds) / 3600.0;
  return side == negative ? -angle : angle;
}

Tile dted_header(const std::string& file, const Bytes& bytes) {
  if (bytes.size() < 3428) throw InputError(file, "shorter than a DTED header");
  std::string uhl(80, ' ');
  std::copy_n(bytes.begin(), uhl.size(), uhl.begin());
  const std::string_view header = uhl;
  if (header.substr(0, 4) != "UHL1") throw InputError(file, "has no DTED user header");
  Tile tile;
  tile.west_deg = dted_angle_deg(header.substr(4, 8), 'W', 'E');
  tile.south_deg = dted_angle_deg(header.substr(12, 8), 'S', 'N');
  const int lon_step = number(header.substr(20, 4));
  const int lat_step = number(header.substr(24, 4));
  tile.columns = number(header.substr(47, 4));
  tile.rows = number(header.substr(51, 4));
  if (std::isnan(tile.west_deg) || std::isnan(tile.south_deg) || lon_step <= 0 || lat_step <= 0 ||
      tile.columns < 2 || tile.rows < 2) {
    throw InputError(file, "DTED user header is corrupt");
  }
  tile.lon_step_deg = lon_step / 36000.0;
  tile.lat_step_deg = lat_step / 36000.0;
  return tile;
}

std::size_t dted_record_bytes(const Tile& tile) {
  return 8 + 2 * static_cast<std::size_t>(tile.rows) + 4;
}

/// The tile of a DTED file, its posts still to be read.
Tile dted_without_posts(const std::filesystem::path& file, const Bytes& bytes) {
  Tile tile = dted_header(file.string(), bytes);
  tile.name = file.filename().string();
  if (tile.west_deg >= 180) tile.west_deg -= 360;
  const std::optional<DegreeCell> named = cell_in_name(file);
  if (named && (named->south_deg != tile.south_deg || named->west_deg != tile.west_deg)) {
    throw InputError(file.string(), "DTED header is that of another cell");
  }
  const std::size_t expected =
      3428 + static_cast<std::size_t>(tile.columns) * dted_record_bytes(tile);
  if (bytes.size() < expected) throw InputError(file.string(), "shorter than its DTED header says");
  if (bytes.size() > expected) throw InputError(file.string(), "longer than its DTED header says");
  return tile;
}

/// The tile of an .hgt file, its posts still to be read.
Tile hgt_without_posts(const std::filesystem::path& file) {
  const std::optional<DegreeCell> corner = cell_in_name(file);
  if (!corner) throw InputError(file.string(), "name does not say which tile it is");
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(file, fault);
  if (fault) throw InputError(file.string(), "cannot be opened");
  Tile tile;
  tile.name = file.filename().string();
  for (const std::size_t side : {1201U, 3601U, 10801U}) {
    if (size == 2 * side * side) tile.rows = tile.columns = static_cast<int>(side);
  }
  if (tile.rows == 0) {
    throw InputError(file.string(), "size is not 1201, 3601 or 10801 posts squared");
  }
  tile.south_deg = corner->south_deg;
  tile.west_deg = corner->west_deg;
  tile.lat_step_deg = tile.lon_step_deg = 1.0 / (tile.rows - 1);
  return tile;
}

bool is_dted(const std::string& extension) {
  return extension == ".dt0" || extension == ".dt1" || extension == ".dt2";
}

bool is_geotiff(const std::string& extension) {
  return extension == ".tif" || extension == ".tiff";
}

}  // namespace

std::optional<DegreeCell> cell_in_name(const std::filesystem::path& file) {
  std::string name = lower(file.filename().string());
  if (name.size() > 3 && name[3] == '_') name.erase(3, 1);
  if (name.size() < 7 || (name.size() > 7 && std::isalnum(static_cast<unsigned char>(name[7])))) {
    return std::nullopt;
  }
  const std::string_view view = name;
  const int lat = number(view.substr(1, 2));
  const int lon = number(view.substr(4, 3));
  const bool sides = (name[0] == 'n' || name[0] == 's') && (name[3] == 'e' || name[3] == 'w');
  if (!sides || lat < 0 || lon < 0) return std::nullopt;
  const DegreeCell cell{name[0] == 's' ? -lat : lat, name[3] == 'w' ? -lon : lon};
  if (cell.south_deg < -90 || cell.south_deg > 89 || cell.west_deg < -180 || cell.west_deg > 179) {
    return std::nullopt;
  }
  return cell;
}

/// Tools without a void of their own write this to .hgt files.
constexpr int hgt_void_m = -9999;

Tile read_hgt(const std::filesystem::path& file) {
  Tile tile = hgt_without_posts(file);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), "cannot be opened");
  tile.posts.resize(tile.index(tile.rows, 0));
  Bytes bytes(2 * static_cast<std::size_t>(tile.columns));
  for (int row = tile.rows - 1; row >= 0; --row) {
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw InputError(file.string(), "cannot be read");
    for (int column = 0; column < tile.columns; ++column) {
      const unsigned raw = big_endian_16(bytes, 2 * static_cast<std::size_t>(column));
      const auto value = static_cast<std::int16_t>(raw);
      tile.set(row, column, value == hgt_void_m ? void_post : known_or_void(value));
    }
  }
  return tile;
}

Tile read_dted(const std::filesystem::path& file) {
  return dted_in(file, file_bytes(file));
}

Tile dted_in(const std::filesystem::path& file, const Bytes& bytes) {
  Tile tile = dted_without_posts(file, bytes);
  const std::size_t record = dted_record_bytes(tile);
  tile.posts.resize(tile.index(tile.rows, 0));
  for (int column = 0; column < tile.columns; ++column) {
    const std::size_t start = 3428 + static_cast<std::size_t>(column) * record;
    if (bytes[start] != 0xAA) throw InputError(file.string(), "DTED record without its sentinel");
    std::uint32_t sum = 0;
    for (std::size_t at = start; at < start + record - 4; ++at) sum += bytes[at];
    const std::uint32_t stored =
        big_endian_16(bytes, start + record - 4) << 16U | big_endian_16(bytes, start + record - 2);
    if (stored != sum) throw InputError(file.string(), "DTED record checksum does not match");
    for (int row = 0; row < tile.rows; ++row) {
      const unsigned raw = big_endian_16(bytes, start + 8 + 2 * static_cast<std::size_t>(row));
      const int magnitude = static_cast<int>(raw & 0x7FFFU);
      const int value = (raw & 0x8000U) != 0 ? -magnitude : magnitude;
      tile.set(row, column, known_or_void(value));
    }
  }
  return tile;
}

std::optional<Tile> read_tile(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension == ".hgt") return read_hgt(file);
  if (is_dted(extension)) return read_dted(file);
  if (is_geotiff(extension)) return read_geotiff(file);
  return std::nullopt;
}

std::optional<Grid> grid_of_file(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  try {
    if (extension == ".hgt") return hgt_without_posts(file);
    if (is_dted(extension)) return dted_without_posts(file, file_bytes(file));
    if (is_geotiff(extension)) return geotiff_grid(file);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace ridgeline::oracle
