#include "tests/oracle/geoid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "tests/oracle/input_error.hpp"

namespace ridgeline::oracle {
namespace {

std::uint64_t big_endian(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

struct PgmHeader {
  double offset_m = std::nan("");
  double scale_m = std::nan("");
  int columns = 0;
  int rows = 0;
  int largest = 0;
  std::size_t data_at = 0;
};

/// The header of GeographicLib's PGM: comments carry `Offset` and `Scale`.
PgmHeader pgm_header(const std::string& file, const std::string& bytes) {
  PgmHeader header;
  std::istringstream in(bytes.substr(0, std::min<std::size_t>(bytes.size(), 65536)));
  std::string line;
  std::getline(in, line);
  while (in.peek() == '#' && std::getline(in, line)) {
    std::istringstream words(line.substr(1));
    std::string key;
    words >> key;
    if (key == "Offset") words >> header.offset_m;
    if (key == "Scale") words >> header.scale_m;
  }
  in >> header.columns >> header.rows >> header.largest;
  if (!in || std::isnan(header.offset_m) || std::isnan(header.scale_m) || header.columns < 2 ||
      header.rows < 2 || header.largest != 65535) {
    throw InputError(file, "geoid PGM header is corrupt");
  }
  header.data_at = static_cast<std::size_t>(in.tellg()) + 1;
  const std::size_t count =
      static_cast<std::size_t>(header.columns) * static_cast<std::size_t>(header.rows);
  if (bytes.size() < header.data_at + 2 * count) throw InputError(file, "geoid PGM is truncated");
  return header;
}

}  // namespace

Geoid Geoid::from_nodes(double south_deg, double west_deg, double lat_step_deg, double lon_step_deg,
                        int rows, int columns, std::vector<float> nodes_m) {
  Geoid geoid;
  geoid.name_ = "nodes";
  geoid.south_deg_ = south_deg;
  geoid.west_deg_ = west_deg;
  geoid.lat_step_deg_ = lat_step_deg;
  geoid.lon_step_deg_ = lon_step_deg;
  geoid.rows_ = rows;
  geoid.columns_ = columns;
  geoid.nodes_ = std::move(nodes_m);
  return geoid;
}

Geoid Geoid::read(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return in(path, bytes);
}

Geoid Geoid::in(const std::filesystem::path& path, const std::string& bytes) {
  const std::string file = path.string();
  Geoid geoid;
  if (bytes.starts_with("P5")) {
    const PgmHeader header = pgm_header(file, bytes);
    std::vector<float> nodes;
    for (int row = header.rows - 1; row >= 0; --row) {
      for (int column = 0; column < header.columns; ++column) {
        const std::size_t index =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(header.columns) +
            static_cast<std::size_t>(column);
        const auto raw = static_cast<double>(big_endian(bytes, header.data_at + 2 * index, 2));
        nodes.push_back(static_cast<float>(header.offset_m + header.scale_m * raw));
      }
    }
    geoid = from_nodes(-90, 0, 180.0 / (header.rows - 1), 360.0 / header.columns, header.rows,
                       header.columns, std::move(nodes));
  } else {
    if (bytes.size() < 40) throw InputError(file, "shorter than a GTX header");
    const auto real = [&](std::size_t at) {
      return std::bit_cast<double>(big_endian(bytes, at, 8));
    };
    const auto rows = static_cast<std::int32_t>(big_endian(bytes, 32, 4));
    const auto columns = static_cast<std::int32_t>(big_endian(bytes, 36, 4));
    if (rows < 2 || columns < 2 || rows > 100000 || columns > 100000 || !(real(16) > 0) ||
        !(real(24) > 0) || !(std::abs(real(0)) <= 90) || !(std::abs(real(8)) <= 360)) {
      throw InputError(file, "is neither a geoid PGM nor a GTX grid");
    }
    const std::size_t count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    if (bytes.size() < 40 + 4 * count) throw InputError(file, "geoid GTX is truncated");
    std::vector<float> nodes(count);
    for (std::size_t i = 0; i < count; ++i) {
      nodes[i] = std::bit_cast<float>(static_cast<std::uint32_t>(big_endian(bytes, 40 + 4 * i, 4)));
    }
    geoid = from_nodes(real(0), real(8), real(16), real(24), rows, columns, std::move(nodes));
  }
  geoid.name_ = path.filename().string();
  return geoid;
}

double Geoid::node(int row, int column) const {
  return static_cast<double>(
      nodes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(column)]);
}

GeoidPatch Geoid::patch(double lat_deg, double lon_deg) const {
  GeoidPatch patch;
  if (is_none()) return patch;
  const double beyond_deg = columns_ * lon_step_deg_ - 360.0;
  const bool wraps = beyond_deg > -1e-9 && beyond_deg < 1e-3 * lon_step_deg_;
  // Held within the grid before they become whole numbers: a header may give any step.
  const int row = static_cast<int>(
      std::clamp(std::floor((lat_deg - south_deg_) / lat_step_deg_), 0.0, rows_ - 2.0));
  // A longitude that rounding puts just west of the grid is on its edge, not a turn further on.
  const double turns = std::floor((lon_deg - west_deg_) / 360.0 + 1e-12);
  const double lon = lon_deg - 360.0 * turns;
  const double east_steps = (lon - west_deg_) / lon_step_deg_;
  int column = static_cast<int>(std::clamp(std::floor(east_steps), 0.0, columns_ - 1.0));
  // The last column of a grid that ends there belongs to the cells before it.
  const bool is_on_edge = !wraps && east_steps - (columns_ - 1) <= 1e-9;
  if (is_on_edge && column == columns_ - 1) --column;
  const int next = wraps ? (column + 1) % columns_ : column + 1;
  patch.west_deg = west_deg_ + 360.0 * turns + column * lon_step_deg_;
  patch.south_deg = south_deg_ + row * lat_step_deg_;
  patch.lon_step_deg = lon_step_deg_;
  patch.lat_step_deg = lat_step_deg_;
  if (next >= columns_) return patch;
  patch.c0 = node(row, column);
  patch.cx = node(row, next) - patch.c0;
  patch.cy = node(row + 1, column) - patch.c0;
  patch.cxy = node(row + 1, next) - node(row, next) - node(row + 1, column) + patch.c0;
  return patch;
}

}  // namespace ridgeline::oracle
