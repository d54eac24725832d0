#include "core/frame/display_state.hpp"

#include <algorithm>
#include <cmath>

#include "config/limits_display.hpp"

namespace ridgeline {
namespace {

/// Factor of an encoded colour for a share of its luminance; exactly 1 for 1.
float encoded(double share) {
  return static_cast<float>(std::pow(std::clamp(share, 0.0, 1.0), 1.0 / limits::display_gamma));
}

}  // namespace

double words_luminance(const DisplayState& display) {
  return std::max(display.luminance, limits::least_words_luminance);
}

double picture_luminance(const DisplayState& display, bool attitude_valid) {
  return attitude_valid ? display.luminance : words_luminance(display);
}

Dimming dimming_of(const DisplayState& display, bool attitude_valid) {
  return {encoded(picture_luminance(display, attitude_valid)), encoded(words_luminance(display))};
}

}  // namespace ridgeline
