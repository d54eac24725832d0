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
constexpr double rad_per_minute = deg / 60.0;
constexpr double sea_height_m = 0.6;  ///< raster seas are 0 m; float rounding stays far below this
// With a geoid, posts of the sea follow it: 6e-4 m/m at most, over one cell of 100 m; and the
// parabola through nine undulations misses the geoid by metres.
constexpr double geoid_sea_roughness_m = 0.08, geoid_sea_height_m = 3.0;
constexpr double contour_m = 100.0;
constexpr double grid_spacing_m = 1'200.0;  ///< no ground grid is finer than half of this

/// Draws text into a layer of bytes; clips at the borders.
class TextLayer {
 public:
  TextLayer(std::span<std::uint8_t> pixels, int width, int height)
      : pixels_(pixels), width_(width), height_(height) {
    std::fill(pixels_.begin(), pixels_.end(), std::uint8_t{0});
  }

  void line(std::string_view text, int x, int y, int scale, int ink) {
    const int margin = 2 * scale;
    box(x - margin, y - margin, text_width(text, scale) + 2 * margin,
        glyph_rows * scale + 2 * margin, shader::text_plate);
    for (const char letter : text) {
      glyph(glyph_bits(letter), x, y, scale, ink);
      x += (glyph_columns + 1) * scale;
    }
  }
  void centred(std::string_view text, int y, int scale, int ink) {
    line(text, (width_ - text_width(text, scale)) / 2, y, scale, ink);
  }
  static int text_width(std::string_view text, int scale) {
    return static_cast<int>(text.size()) * (glyph_columns + 1) * scale - scale;
  }

 private:
  void glyph(std::uint64_t bits, int x, int y, int scale, int ink) {
    for (int row = 0; row < glyph_rows; ++row) {
      for (int column = 0; column < glyph_columns; ++column) {
        const int bit = glyph_rows * glyph_columns - 1 - row * glyph_columns - column;
        if ((bits >> bit & 1U) == 0) continue;
        box(x + column * scale, y + row * scale, scale, scale, ink);
      }
    }
  }
  void box(int x, int y, int width, int height, int ink) {
    const int left = std::max(x, 0), right = std::min(x + width, width_);
    for (int py = std::max(y, 0); py < std::min(y + height, height_); ++py) {
      for (int px = left; px < right; ++px) {
        pixels_[static_cast<std::size_t>(py) * width_ + px] = static_cast<std::uint8_t>(ink);
      }
    }
  }

  std::span<std::uint8_t> pixels_;
  int width_, height_;
};

float f(double value) {
  return static_cast<float>(value);
}

double remainder_of(double value, double divisor) {
  return value - divisor * std::floor(value / divisor);
}

/// Whole minutes of longitude between grid lines: more of them towards the poles.
double longitude_minutes(double cos_latitude) {
  const double minute_m = 1'855.0 * std::max(cos_latitude, 1e-3);
  for (const double minutes : {1.0, 2.0, 5.0, 10.0, 20.0, 30.0}) {
    if (minutes * minute_m >= 0.5 * grid_spacing_m) return minutes;
  }
  return 60.0;
}

void put_ground_grid(const FrameReport& report, const PostLattice& lattice, double cos_latitude,
                     shader::StyleBlock& style) {
  const double minutes = longitude_minutes(cos_latitude);
  const double line_east_deg = minutes / 60.0, line_north_deg = 1.0 / 60.0;
  const GeodeticPosition& eye = report.local.eye;
  const double post_east_deg =
      lattice.longitude_deg(std::floor(lattice.column_of(eye.longitude_deg)));
  const double post_north_deg = lattice.latitude_deg(std::floor(lattice.row_of(eye.latitude_deg)));
  style.ground_grid = {f(remainder_of(post_east_deg, line_east_deg) / line_east_deg),
                       f(remainder_of(post_north_deg, line_north_deg) / line_north_deg),
                       f(lattice.longitude_step_deg / line_east_deg),
                       f(lattice.latitude_step_deg / line_north_deg)};
  const double fx = report.camera.fx;
  const double east_m =
      minutes * rad_per_minute * report.local.prime_vertical_radius_m * cos_latitude;
  const double north_m = rad_per_minute * report.local.meridian_radius_m;
  style.grid_step = {f(east_m * east_m * fx * fx), f(north_m * north_m * fx * fx), 0.0f, 0.0f};
}

/// The parabola through the undulations at the eye and at eight places round it.
void put_geoid(const FrameReport& report, const GeoidLookup& geoid, Chart chart,
               double cos_latitude, shader::StyleBlock& style) {
  if (geoid.undulation_m == nullptr) return;
  constexpr double share = 0.6;  // of the range: where the picture shows most ground
  const GeodeticPosition& eye = report.local.eye;
  const double north_deg = share * report.range_m / (deg * report.local.meridian_radius_m);
  const double narrow = chart == Chart::geographic ? cos_latitude : 1.0;
  const double east_deg =
      share * report.range_m / (deg * report.local.prime_vertical_radius_m * narrow);
  const auto at = [&](int e, int n) {
    const GroundPlace place = place_at(chart, eye, {e * east_deg, n * north_deg});
    const double latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
    const double value = geoid.undulation_m(geoid.context, latitude_deg, place.longitude_deg);
    return std::isnan(value) ? 0.0 : value;
  };
  const double here = at(0, 0), west = at(-1, 0), east = at(1, 0), south = at(0, -1);
  const double north = at(0, 1);
  const double mixed = at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1);
  style.geoid[0] = {f(here), f(0.5 * (east - west) / share), f(0.5 * (north - south) / share),
                    f((0.5 * (east + west) - here) / (share * share))};
  style.geoid[1] = {f(0.25 * mixed / (share * share)),
                    f((0.5 * (north + south) - here) / (share * share)), 0.0f, 0.0f};
}

bool has_reason(const Availability& availability, Reason reason) {
  return std::find(availability.reasons.begin(), availability.reasons.end(), reason) !=
         availability.reasons.end();
}

int ink_of(Mode mode) {
  return mode == Mode::removed    ? shader::text_warning
         : mode == Mode::degraded ? shader::text_caution
                                  : shader::text_ink;
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
  blocks.frame.window = {0, 0, 1, 0};
  blocks.frame.level_size = {64.0f, 64.0f, 1.0f / 65.0f, 1.0f / 65.0f};
  return blocks;
}

shader::StyleBlock style_block(const FrameReport& report, const PostLattice& lattice,
                               const GeoidLookup& geoid, bool attitude_valid) {
  shader::StyleBlock style{};
  const Camera& camera = report.camera;
  const bool drawn = report.availability.mode != Mode::removed;
  style.legend = {drawn ? 1.0f : 0.0f, attitude_valid ? 1.0f : 0.0f, f(1.0 / camera.width_px),
                  f(1.0 / camera.height_px)};
  const glm::dmat3& axes = camera.enu_from_camera.columns;
  const double slope_per_px = std::hypot(axes[0].z / camera.fx, axes[1].z / camera.fy);
  const double px_per_slope = 1.0 / std::max(slope_per_px, 1e-9);
  const double contour_px = contour_m * camera.fx;
  style.line = {f(contour_px * contour_px), f(px_per_slope), camera.width_px >= 1600 ? 1.6f : 1.2f,
                0.0f};
  if (!drawn) return style;
  const double a = sun_azimuth_deg * deg, e = sun_elevation_deg * deg;
  style.sun = {f(std::sin(a) * std::cos(e)), f(std::cos(a) * std::cos(e)), f(std::sin(e)), 0.0f};
  style.line.w = f(1.0 / report.range_m);
  const double cos_latitude = std::max(std::cos(report.local.eye.latitude_deg * deg), 1e-3);
  const bool ellipsoidal = geoid.undulation_m == nullptr;
  const double narrow = lattice.polar() ? 1.0 : cos_latitude;
  style.post_step = {
      f(1.0 / (lattice.longitude_step_deg * deg * report.local.prime_vertical_radius_m * narrow)),
      f(1.0 / (lattice.latitude_step_deg * deg * report.local.meridian_radius_m)),
      ellipsoidal ? 0.0f : f(geoid_sea_roughness_m),
      f(ellipsoidal ? sea_height_m : geoid_sea_height_m)};
  // Lines of longitude run together at a pole: its chart has no ground grid.
  if (!lattice.polar()) put_ground_grid(report, lattice, cos_latitude, style);
  put_geoid(report, geoid, lattice.chart, cos_latitude, style);
  return style;
}

std::span<const std::uint8_t> text_layer(const FrameReport& report, std::span<std::uint8_t> layer) {
  const int width = report.camera.width_px, height = report.camera.height_px;
  const auto used = layer.first(static_cast<std::size_t>(std::max(width, 0)) * std::max(height, 0));
  TextLayer text(used, width, height);
  const int scale = width >= 640 ? 2 : 1;
  const int step = (glyph_rows + 5) * scale, edge = 4 * scale;
  const std::string_view notice =
      report.display.declutter ? "NOT CERTIFIED" : "NOT CERTIFIED - SUPPLEMENTAL ONLY";
  text.line(notice, edge, height - step, scale, shader::text_ink);
  const Availability& availability = report.availability;
  if (availability.mode == Mode::removed) {
    text.centred("SVS OFF", height / 3, 2 * scale, shader::text_warning);
    int y = height / 3 + 3 * step;
    for (const Reason reason : availability.reasons) {
      if (reason_mode(reason) == Mode::removed) {
        text.centred(reason_word(reason), y, scale, shader::text_ink);
        y += step;
      }
    }
    return used;
  }
  char bound[48];
  const bool unproven = has_reason(availability, Reason::unproven);
  const int count = unproven ? std::snprintf(bound, sizeof bound, "NO BOUND")
                             : std::snprintf(bound, sizeof bound, "BOUND %.2f PX", report.bound_px);
  const std::string_view words(bound, static_cast<std::size_t>(std::max(count, 0)));
  const int left = width - TextLayer::text_width(words, scale) - edge;
  const bool beside = left > TextLayer::text_width(notice, scale) + 3 * edge;
  const bool raised = unproven || has_reason(availability, Reason::bound_exceeded);
  text.line(words, left, height - (beside ? step : 2 * step), scale,
            ink_of(raised ? Mode::degraded : Mode::svs));
  int y = edge;
  for (const Reason reason : availability.reasons) {
    text.line(reason_word(reason), edge, y, scale, ink_of(reason_mode(reason)));
    y += step;
  }
  return used;
}

}  // namespace ridgeline
