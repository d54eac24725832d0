#include "tests/unit/oracle/scenes.hpp"

#include <png.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/oracle/camera.hpp"
#include "tests/oracle/tracer.hpp"

namespace ridgeline::oracle::scenes {
namespace {

/// Noise in [0, 1) at a lattice point.
double noise(int x, int y, unsigned seed) {
  std::uint32_t h = seed * 747796405U + static_cast<std::uint32_t>(x) * 2891336453U +
                    static_cast<std::uint32_t>(y) * 1181783497U;
  h = (h ^ (h >> 16U)) * 2246822519U;
  h = (h ^ (h >> 13U)) * 3266489917U;
  return (h ^ (h >> 16U)) / 4294967296.0;
}

double smooth_noise(double x, double y, unsigned seed) {
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const double u = x - x0;
  const double v = y - y0;
  return (noise(x0, y0, seed) * (1 - u) + noise(x0 + 1, y0, seed) * u) * (1 - v) +
         (noise(x0, y0 + 1, seed) * (1 - u) + noise(x0 + 1, y0 + 1, seed) * u) * v;
}

void write_npy(const std::filesystem::path& file, const Frame& frame) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(frame.height) + ", " + std::to_string(frame.width) + "), }";
  while ((10 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::ofstream out(file, std::ios::binary);
  out.write("\x93NUMPY\x01\x00", 8);
  out.put(static_cast<char>(header.size() & 0xFFU));
  out.put(static_cast<char>(header.size() >> 8U));
  out << header;
  std::vector<char> bytes(frame.range.size() * sizeof(float));
  std::memcpy(bytes.data(), frame.range.data(), bytes.size());
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::uint32_t write_color(const std::filesystem::path& file, int width, int height) {
  std::vector<unsigned char> pixels(
      3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0x80);
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.string().c_str(), 0, pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(image.message);
  }
  return crc32_of(pixels.data(), pixels.size());
}

const char* mode_word(Mode mode) {
  if (mode == Mode::svs) return "svs";
  return mode == Mode::degraded ? "degraded" : "removed";
}

}  // namespace

Tile tile(double south_deg, double west_deg, int cells_per_degree, int cells,
          const Surface& surface) {
  Tile made;
  made.name = "scene";
  made.south_deg = south_deg;
  made.west_deg = west_deg;
  made.lat_step_deg = made.lon_step_deg = 1.0 / cells_per_degree;
  made.rows = made.columns = cells + 1;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      made.posts.push_back(static_cast<float>(
          surface(south_deg + row * made.lat_step_deg, west_deg + column * made.lon_step_deg)));
    }
  }
  return made;
}

void write_hgt(const std::filesystem::path& folder, int south_deg, int west_deg,
               const Surface& surface) {
  char name[32];
  std::snprintf(name, sizeof name, "%c%02d%c%03d.hgt", south_deg < 0 ? 'S' : 'N',
                std::abs(south_deg), west_deg < 0 ? 'W' : 'E', std::abs(west_deg));
  const Tile made = tile(south_deg, west_deg, 1200, 1200, surface);
  std::ofstream out(folder / name, std::ios::binary);
  for (int row = 1200; row >= 0; --row) {
    for (int column = 0; column <= 1200; ++column) {
      const float post = made.at(row, column);
      const auto value = static_cast<std::int16_t>(std::isnan(post) ? -32768L : std::lround(post));
      out.put(static_cast<char>(static_cast<std::uint16_t>(value) >> 8U));
      out.put(static_cast<char>(static_cast<std::uint16_t>(value) & 0xFFU));
    }
  }
}

Surface rugged(double highest_m, unsigned seed) {
  return [=](double lat, double lon) {
    const double coarse = smooth_noise(40 * lat, 40 * lon, seed);
    const double middle = smooth_noise(200 * lat, 200 * lon, seed + 1);
    const double fine = smooth_noise(1200 * lat, 1200 * lon, seed + 2);
    return std::round(highest_m * (0.7 * coarse * coarse + 0.2 * middle + 0.1 * fine));
  };
}

Frame drawn(const Terrain& terrain, const Shot& shot) {
  Frame frame;
  frame.name = "000000";
  frame.eye = shot.eye;
  frame.roll_deg = shot.roll_deg;
  frame.pitch_deg = shot.pitch_deg;
  frame.heading_deg = shot.heading_deg;
  const CameraAxes axes = camera_axes(level_frame(shot.eye.lat_deg, shot.eye.lon_deg),
                                      shot.roll_deg, shot.pitch_deg, shot.heading_deg);
  frame.ecef_from_camera = {axes.right.x, axes.down.x, axes.forward.x,
                            axes.right.y, axes.down.y, axes.forward.y,
                            axes.right.z, axes.down.z, axes.forward.z};
  frame.width = shot.width;
  frame.height = shot.height;
  frame.fx = frame.fy = shot.focal_px;
  frame.cx = 0.5 * shot.width;
  frame.cy = 0.5 * shot.height;
  frame.range_m = shot.range_m;
  frame.bound_px = shot.bound_px;
  frame.geoid = terrain.geoid().name();
  frame.has_range_file = true;
  const Tracer tracer(terrain, shot.eye, shot.range_m);
  const Camera camera(frame);
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      const FirstHit hit = tracer.first_hit(camera.direction({u + 0.5, v + 0.5}));
      frame.range.push_back(hit.must_be_unknown ? std::numeric_limits<float>::quiet_NaN()
                                                : static_cast<float>(hit.distance_m));
    }
  }
  return frame;
}

void write_frame(const std::filesystem::path& folder, const Frame& frame) {
  const std::uint32_t crc =
      write_color(folder / (frame.name + "_color.png"), frame.width, frame.height);
  if (frame.has_range_file) write_npy(folder / (frame.name + "_range.npy"), frame);
  const std::array<double, 9>& m = frame.ecef_from_camera;
  nlohmann::json json = {
      {"time_s", frame.time_s},
      {"eye",
       {{"lat_deg", frame.eye.lat_deg},
        {"lon_deg", frame.eye.lon_deg},
        {"height_m", frame.eye.height_m}}},
      {"attitude",
       {{"roll_deg", frame.roll_deg},
        {"pitch_deg", frame.pitch_deg},
        {"heading_deg", frame.heading_deg}}},
      {"ecef_from_camera", {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}},
      {"width", frame.width},
      {"height", frame.height},
      {"fx", frame.fx},
      {"fy", frame.fy},
      {"cx", frame.cx},
      {"cy", frame.cy},
      {"range_m", frame.range_m},
      {"mode", mode_word(frame.mode)},
      {"reasons", frame.reasons},
      {"crc32", crc},
      {"geoid", frame.geoid}};
  json["bound_px"] = nullptr;
  if (frame.bound_px) json["bound_px"] = *frame.bound_px;
  if (frame.proven_px) json["proven_px"] = *frame.proven_px;
  if (frame.geometry_px) json["geometry_px"] = *frame.geometry_px;
  std::ofstream(folder / (frame.name + ".json")) << json.dump(1);
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "ridgeline-oracle-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace ridgeline::oracle::scenes
