#include "core/frame/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "core/frame/font.hpp"

namespace ridgeline {
namespace {

constexpr double deg = std::numbers::pi / 180.0;
constexpr double sun_azimuth_deg = 315.0, sun_elevation_deg = 42.0;  ///< the cartographers' light
constexpr double haze_range_share = 0.55;  ///< haze reaches 63 % at this share of the range

/// Draws text into a layer of bytes; clips at the borders.
class TextLayer {
 public:
  TextLayer(std::span<std::uint8_t> pixels, int width, int height)
      : pixels_(pixels), width_(width), height_(height) {
    std::fill(pixels_.begin(), pixels_.end(), std::uint8_t{0});
  }

  void line(std::string_view text, int x, int y, int scale) {
    for (const char letter : text) {
      glyph(glyph_bits(letter), x, y, scale);
      x += (glyph_columns + 1) * scale;
    }
  }
  void centred(std::string_view text, int y, int scale) {
    line(text, (width_ - text_width(text, scale)) / 2, y, scale);
  }
  static int text_width(std::string_view text, int scale) {
    return static_cast<int>(text.size()) * (glyph_columns + 1) * scale - scale;
  }

 private:
  void glyph(std::uint64_t bits, int x, int y, int scale) {
    for (int row = 0; row < glyph_rows; ++row) {
      for (int column = 0; column < glyph_columns; ++column) {
        const int bit = glyph_rows * glyph_columns - 1 - row * glyph_columns - column;
        if ((bits >> bit & 1U) == 0) continue;
        square(x + column * scale, y + row * scale, scale);
      }
    }
  }
  void square(int x, int y, int size) {
    for (int py = std::max(y, 0); py < std::min(y + size, height_); ++py) {
      for (int px = std::max(x, 0); px < std::min(x + size, width_); ++px) {
        pixels_[static_cast<std::size_t>(py) * width_ + px] = 255;
      }
    }
  }

  std::span<std::uint8_t> pixels_;
  int width_, height_;
};

float f(double value) {
  return static_cast<float>(value);
}

}  // namespace

FrameBlocks camera_blocks(const Camera& camera) {
  FrameBlocks blocks{};
  const glm::dmat3& axes = camera.enu_from_camera.columns;
  const auto put = [](const glm::dvec3& v, double w) {
    return glm::vec4(f(v.x), f(v.y), f(v.z), f(w));
  };
  blocks.frame.ray_dx = put(axes[0] / camera.fx, camera.width_px);
  blocks.frame.ray_dy = put(axes[1] / camera.fy, camera.height_px);
  blocks.frame.ray_origin = put(camera.ray(0.5, 0.5).xyz, 0.0);
  blocks.frame.earth = {1.57e-7f, 1.57e-7f, 0.0f, 0.0f};
  blocks.frame.window = {0, 0, 2, 2};
  return blocks;
}

shader::StyleBlock style_block(const FrameReport& report, const WindowGrid& window,
                               bool attitude_valid) {
  shader::StyleBlock style{};
  const double a = sun_azimuth_deg * deg, e = sun_elevation_deg * deg;
  const double haze = report.range_m > 0 ? 1.0 / (haze_range_share * report.range_m) : 0.0;
  style.sun = {f(std::sin(a) * std::cos(e)), f(std::cos(a) * std::cos(e)), f(std::sin(e)), f(haze)};
  const bool drawn = report.availability.mode != Mode::removed;
  // Horizon dip of a smooth sea, as the slope of the line a pilot expects.
  const double radius = std::max(report.local.meridian_radius_m, 6.3e6);
  const double height = std::max(report.local.eye.height_m, 0.0);
  style.legend = {drawn ? 1.0f : 0.0f, attitude_valid ? 1.0f : 0.0f,
                  f(-std::sqrt(2.0 * height / radius)), 0.0f};
  const double cos_latitude = std::cos(report.local.eye.latitude_deg * deg);
  style.post_step = {
      f(window.longitude_step_deg * deg * report.local.prime_vertical_radius_m * cos_latitude),
      f(window.latitude_step_deg * deg * report.local.meridian_radius_m), 0.0f, 0.0f};
  return style;
}

std::span<const std::uint8_t> text_layer(const FrameReport& report, std::span<std::uint8_t> layer) {
  const int width = report.camera.width_px, height = report.camera.height_px;
  const auto used = layer.first(static_cast<std::size_t>(std::max(width, 0)) * std::max(height, 0));
  TextLayer text(used, width, height);
  const int scale = width >= 640 ? 2 : 1;
  const int step = (glyph_rows + 3) * scale, edge = 4 * scale;
  constexpr std::string_view notice = "NOT CERTIFIED - SUPPLEMENTAL ONLY";
  text.line(notice, edge, height - step, scale);
  const Availability& availability = report.availability;
  if (availability.mode == Mode::removed) {
    text.centred("SVS OFF", height / 3, 2 * scale);
    int y = height / 3 + 3 * step;
    for (const Reason reason : availability.reasons) {
      if (reason_mode(reason) == Mode::removed) {
        text.centred(reason_word(reason), y, scale);
        y += step;
      }
    }
    return used;
  }
  char bound[48];
  const int count = std::snprintf(bound, sizeof bound, "BOUND %.2f PX", report.bound_px);
  const std::string_view words(bound, static_cast<std::size_t>(std::max(count, 0)));
  text.line(words, width - TextLayer::text_width(words, scale) - edge, height - step, scale);
  int y = edge;
  for (const Reason reason : availability.reasons) {
    text.line(reason_word(reason), edge, y, scale);
    y += step;
  }
  return used;
}

}  // namespace ridgeline
