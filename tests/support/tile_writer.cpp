#include "tests/support/tile_writer.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {
namespace {

constexpr std::size_t dted_data_at = 3428;

void append_big_endian(std::vector<std::byte>& out, std::uint32_t value, int width) {
  for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>((value >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}

std::string text(const char* format, int a, int b = 0, int c = 0, int d = 0) {
  char buffer[64] = {};
  std::snprintf(buffer, sizeof buffer, format, a, b, c, d);
  return buffer;
}

void put(std::string& header, std::size_t at, std::string_view field) {
  header.replace(at, field.size(), field);
}

// Multiples of the latitude interval, from the equator to the pole.
int zone_factor(int south_deg) {
  const int nearest = south_deg >= 0 ? south_deg : -south_deg - 1;
  if (nearest < 50) return 1;
  if (nearest < 70) return 2;
  if (nearest < 75) return 3;
  return nearest < 80 ? 4 : 6;
}

std::string dted_header(int level, int south_deg, int west_deg) {
  const DtedShape shape = dted_shape(level, south_deg);
  const char* latitude_letter = south_deg < 0 ? "S" : "N";
  const char* longitude_letter = west_deg < 0 ? "W" : "E";
  const int latitude = std::abs(south_deg);
  const int longitude = std::abs(west_deg);
  const int latitude_interval = 36000 / (shape.rows - 1);
  const int longitude_interval = 36000 / (shape.columns - 1);
  std::string header(dted_data_at, ' ');
  put(header, 0, "UHL1" + text("%03d0000", longitude) + longitude_letter);
  put(header, 12, text("%03d0000", latitude) + latitude_letter);
  put(header, 20, text("%04d%04dNA  U  ", longitude_interval, latitude_interval));
  put(header, 47, text("%04d%04d0", shape.columns, shape.rows));
  put(header, 80, "DSIU");
  put(header, 80 + 59, text("DTED%d", level));
  put(header, 80 + 141, "MSLWGS84");
  put(header, 80 + 185, text("%02d0000.0", latitude) + latitude_letter);
  put(header, 80 + 194, text("%03d0000.0", longitude) + longitude_letter);
  put(header, 80 + 204, text("%02d0000", latitude) + latitude_letter);
  put(header, 80 + 211, text("%03d0000", longitude) + longitude_letter);
  put(header, 80 + 264,
      "0000000.0" +
          text("%04d%04d%04d%04d", latitude_interval, longitude_interval, shape.rows,
               shape.columns) +
          "00");
  put(header, 728, "ACC");
  return header;
}

}  // namespace

std::vector<std::byte> hgt_bytes(int size, const PostHeight& height_m) {
  std::vector<std::byte> out;
  out.reserve(2 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int row = size - 1; row >= 0; --row) {
    for (int column = 0; column < size; ++column) {
      const int value = height_m(row, column).value_or(-32768);
      append_big_endian(out, static_cast<std::uint16_t>(value), 2);
    }
  }
  return out;
}

void write_hgt(const std::string& path, int size, const PostHeight& height_m) {
  write_bytes(path, hgt_bytes(size, height_m));
}

DtedShape dted_shape(int level, int south_deg) {
  const int intervals = level == 0 ? 120 : level == 1 ? 1200 : 3600;
  return {intervals + 1, intervals / zone_factor(south_deg) + 1};
}

std::vector<std::byte> dted_bytes(int level, int south_deg, int west_deg,
                                  const PostHeight& height_m) {
  const DtedShape shape = dted_shape(level, south_deg);
  std::vector<std::byte> out;
  out.reserve(dted_data_at + static_cast<std::size_t>(shape.columns) * (12 + 2 * shape.rows));
  for (const char c : dted_header(level, south_deg, west_deg)) {
    out.push_back(static_cast<std::byte>(c));
  }
  for (int column = 0; column < shape.columns; ++column) {
    append_big_endian(out, 0xAA, 1);
    append_big_endian(out, static_cast<std::uint32_t>(column), 3);
    append_big_endian(out, static_cast<std::uint32_t>(column), 2);
    append_big_endian(out, 0, 2);
    for (int row = 0; row < shape.rows; ++row) {
      const int value = height_m(row, column).value_or(-32767);
      const unsigned magnitude = static_cast<unsigned>(std::abs(value));
      append_big_endian(out, value < 0 ? 0x8000U | magnitude : magnitude, 2);
    }
    append_big_endian(out, 0, 4);
    seal_dted_record(out, shape.rows, column);
  }
  return out;
}

void write_dted(const std::string& path, int level, int south_deg, int west_deg,
                const PostHeight& height_m) {
  write_bytes(path, dted_bytes(level, south_deg, west_deg, height_m));
}

void seal_dted_record(std::vector<std::byte>& file, int rows, int column) {
  const std::size_t summed_bytes = 8 + 2 * static_cast<std::size_t>(rows);
  const std::size_t start = dted_data_at + static_cast<std::size_t>(column) * (summed_bytes + 4);
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < summed_bytes; ++i) {
    sum += std::to_integer<std::uint32_t>(file[start + i]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    file[start + summed_bytes + i] = static_cast<std::byte>((sum >> (24 - 8 * i)) & 0xFFU);
  }
}

}  // namespace ridgeline::test
