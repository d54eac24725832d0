#include "platform/display/frame_dump.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "core/base/assert.hpp"
#include "platform/display/json_text.hpp"
#include "platform/file_result.hpp"

namespace ridgeline {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xedb88320u : 0u);
    table[byte] = rest;
  }
  return table;
}

std::uint32_t adler32_of(Bytes bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65'521;
    b = (b + a) % 65'521;
  }
  return b << 16 | a;
}

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void put_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
}

void put_chunk(std::string& out, const char* type, const std::string& data) {
  put_big_endian(out, static_cast<std::uint32_t>(data.size()));
  const std::string body = type + data;
  out += body;
  put_big_endian(out, crc32_of_bytes(bytes_of(body)));
}

/// A zlib stream of stored blocks.
std::string stored(const std::string& data) {
  constexpr std::size_t longest_block = 65'535;
  std::string out = "\x78\x01";
  std::size_t at = 0;
  do {
    const std::size_t count = std::min(longest_block, data.size() - at);
    out += at + count == data.size() ? '\1' : '\0';
    const auto length = static_cast<std::uint32_t>(count);
    for (const std::uint32_t half : {length, ~length}) {
      out += static_cast<char>(half & 0xff);
      out += static_cast<char>(half >> 8 & 0xff);
    }
    out.append(data, at, count);
    at += count;
  } while (at < data.size());
  put_big_endian(out, adler32_of(bytes_of(data)));
  return out;
}

std::string npy_of(int rows, int columns, std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little, "'<f4' is written from host floats");
  constexpr std::size_t prefix_bytes = 10, alignment_bytes = 64;
  std::string description = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                            std::to_string(rows) + ", " + std::to_string(columns) + "), }";
  while ((prefix_bytes + description.size() + 1) % alignment_bytes != 0) description += ' ';
  description += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(description.size() & 0xff);
  out += static_cast<char>(description.size() >> 8);
  out += description;
  out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return out;
}

std::string json_of(const FrameReport& report, const std::string& geoid_name, Bytes rgb) {
  const Camera& camera = report.camera;
  const bool promised = report.availability.mode != Mode::removed && report.bound_px > 0;
  static JsonText json;  // too large for a stack
  json.clear();
  json.open_object();
  json.add("time_s", static_cast<double>(report.time_ns) * 1e-9);
  json.open_object("eye");
  json.add("lat_deg", report.local.eye.latitude_deg);
  json.add("lon_deg", report.local.eye.longitude_deg);
  json.add("height_m", report.local.eye.height_m);
  json.close_object();
  json.open_object("attitude");
  json.add("roll_deg", camera.attitude.roll_deg);
  json.add("pitch_deg", camera.attitude.pitch_deg);
  json.add("heading_deg", camera.attitude.heading_deg);
  json.close_object();
  const auto axes = (report.local.ecef_from_enu * camera.enu_from_camera).columns;
  json.open_list("ecef_from_camera");
  for (int r = 0; r < 3; ++r) {
    json.open_list();
    for (int c = 0; c < 3; ++c) json.add(nullptr, axes[c][r]);
    json.close_list();
  }
  json.close_list();
  json.add("width", static_cast<std::int64_t>(camera.width_px));
  json.add("height", static_cast<std::int64_t>(camera.height_px));
  json.add("fx", camera.fx);
  json.add("fy", camera.fy);
  json.add("cx", camera.cx);
  json.add("cy", camera.cy);
  json.add("range_m", report.range_m);
  if (promised) {
    json.add("bound_px", report.bound_px);
    json.add("geometry_px", report.budget.geometry_px);
    json.add("proven_px", report.budget.smallest_px() + report.shared_px);
  } else {
    json.add_null("bound_px");
  }
  json.add("mode", mode_word(report.availability.mode));
  json.open_list("reasons");
  for (const Reason reason : report.availability.reasons) json.add(nullptr, reason_word(reason));
  json.close_list();
  if (const DisplayState& display = report.display; !(display == DisplayState{})) {
    json.open_object("display");
    json.add("luminance", display.luminance);
    json.add("words_luminance", words_luminance(display));
    json.add("declutter", display.declutter);
    json.close_object();
  }
  json.add("crc32", std::uint64_t{crc32_of_bytes(rgb)});
  json.add("geoid", std::string_view(geoid_name));
  json.close_object();
  return std::string(json.text());
}

std::string written(const std::string& path, const std::string& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool all =
      file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  return all && closed ? "" : file_problem(path, Fault::file_unwritable, {}).message;
}

}  // namespace

std::uint32_t crc32_of_bytes(Bytes bytes) {
  static constexpr std::array<std::uint32_t, 256> table = crc_table();
  std::uint32_t rest = 0xffffffff;
  for (const std::uint8_t byte : bytes) rest = table[(rest ^ byte) & 0xff] ^ (rest >> 8);
  return ~rest;
}

std::string png_of(int width, int height, Bytes rgb) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
  RL_ASSERT(width > 0 && height > 0 && rgb.size() == row_bytes * static_cast<std::size_t>(height));
  std::string rows;
  for (std::size_t at = 0; at < rgb.size(); at += row_bytes) {
    rows += '\0';  // no filter
    rows.append(reinterpret_cast<const char*>(rgb.data()) + at, row_bytes);
  }
  std::string header;
  put_big_endian(header, static_cast<std::uint32_t>(width));
  put_big_endian(header, static_cast<std::uint32_t>(height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB
  std::string out("\x89PNG\r\n\x1a\n", 8);
  put_chunk(out, "IHDR", header);
  put_chunk(out, "IDAT", stored(rows));
  put_chunk(out, "IEND", {});
  return out;
}

std::string write_frame_dump(const std::string& folder, const FrameReport& report,
                             const std::string& geoid_name, std::span<const float> range_m,
                             Bytes rgba) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return file_problem(folder, Fault::file_unwritable, failed.message()).message;
  const int width = report.camera.width_px, height = report.camera.height_px;
  std::vector<std::uint8_t> rgb(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = rgba[i / 3 * 4 + i % 3];
  const std::string stem = folder + "/000000";
  std::string wrong = written(stem + "_color.png", png_of(width, height, rgb));
  if (wrong.empty() && !range_m.empty()) {
    wrong = written(stem + "_range.npy", npy_of(height, width, range_m));
  }
  if (wrong.empty()) wrong = written(stem + ".json", json_of(report, geoid_name, rgb));
  return wrong;
}

}  // namespace ridgeline
