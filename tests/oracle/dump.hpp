#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/oracle/wgs84.hpp"

namespace ridgeline::oracle {

enum class Mode { svs, degraded, removed };

/// One frame of a dump, as contract.md section 3 describes it.
struct Frame {
  std::string name;  ///< the six digits
  double time_s = 0;
  Geodetic eye;
  double roll_deg = 0;
  double pitch_deg = 0;
  double heading_deg = 0;
  std::array<double, 9> ecef_from_camera{};  ///< row-major; columns right, down, forward
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  double range_m = 0;
  std::optional<double> bound_px;
  std::optional<double> proven_px;    ///< what the frame's terms add up to, if it says so
  std::optional<double> geometry_px;  ///< the part of it that is no terrain level's, if it says so
  Mode mode = Mode::svs;
  std::vector<std::string> reasons;
  std::uint32_t crc32 = 0;  ///< as the JSON says
  std::string geoid;
  bool has_range_file = false;
  std::vector<float> range;  ///< height x width; +inf sky, NaN unknown; empty when absent
  int color_width = 0;       ///< of the colour image as stored
  int color_height = 0;
  std::uint32_t color_crc32 = 0;  ///< of the 8-bit RGB bytes of the colour image

  [[nodiscard]] double z(int u, int v) const {
    return static_cast<double>(range[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(u)]);
  }
};

/// The JSON files of a dump, in order.
/// Errors: InputError where the folder cannot be read or holds no frame.
[[nodiscard]] std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder);

/// What a frame's JSON says; the range and colour files are not opened.
/// Errors: InputError naming the file and the field.
[[nodiscard]] Frame read_frame_header(const std::filesystem::path& json);

/// The same for the text of such a file.
[[nodiscard]] Frame frame_header_in(const std::filesystem::path& json, const std::string& text,
                                    bool has_range_file);

/// The distances in the bytes of a range file of the frame's shape; the colour image in the bytes
/// of its file. Errors: InputError naming the file.
[[nodiscard]] std::vector<float> range_in(const std::string& file, const std::string& bytes,
                                          int width, int height);
void take_color(const std::string& file, const std::string& bytes, Frame& frame);

/// A whole frame.
/// Errors: InputError naming the file: a missing or malformed range file (unless the frame is
///         `removed`), a shape that does not match, a missing or malformed colour image.
[[nodiscard]] Frame read_frame(const std::filesystem::path& json);

/// What contradicts the contract in a frame as a whole, one sentence each: a bound or range file
/// where there must be none or none where there must be one, camera axes that are not orthonormal
/// or not those of the attitude (1e-9), a CRC that is not that of the image, impossible distances.
[[nodiscard]] std::vector<std::string> frame_faults(const Frame& frame);

/// CRC-32 (ISO 3309), as zlib and PNG use it.
[[nodiscard]] std::uint32_t crc32_of(const unsigned char* bytes, std::size_t count);

}  // namespace ridgeline::oracle
