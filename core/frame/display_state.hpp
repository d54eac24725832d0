#pragma once
#include "core/render/dimming.hpp"

namespace ridgeline {

/// How the pilot wants the picture. The ground that is shown and its bound are the same either way.
struct DisplayState {
  /// Share of the luminance of the day that the picture keeps, in linear light. 1: day.
  double luminance = 1.0;
  /// Without what is not needed to see terrain and bound: contours, ground grid, second half of the
  /// notice. Never without bound, reasons, horizon.
  bool declutter = false;

  friend bool operator==(const DisplayState&, const DisplayState&) = default;
};

/// Share that words keep: that of the picture, but never less than limits::least_words_luminance.
[[nodiscard]] double words_luminance(const DisplayState& display);
/// Share that the picture keeps. `attitude_valid`: false where a red cross is all there is, which
/// keeps as much as words do.
[[nodiscard]] double picture_luminance(const DisplayState& display, bool attitude_valid);

/// The same as factors of encoded colours. Colours keep their order: every channel of every pixel
/// has one factor.
[[nodiscard]] Dimming dimming_of(const DisplayState& display, bool attitude_valid);

}  // namespace ridgeline
