#pragma once
// What the picture keeps of its light by night (docs/architecture.md, section "Switches of the
// pilot"), and when a window counts as hidden (section "Screens").
#include <cstdint>

namespace ridgeline::limits {

/// Luminance of a colour over its encoded value: a power, that of the reference display of sRGB.
inline constexpr double display_gamma = 2.2;
/// Least share of the luminance of the day. A channel then has 66 levels left of 256; with fewer,
/// slopes and the line of zero pitch are lost between them.
inline constexpr double least_night_luminance = 0.05;
inline constexpr double default_night_luminance = 0.15;
/// Below this share no word gets darker, nor the red cross: a failure must not look like a dark
/// screen. Red words then have 2.5 % of the luminance of white by day; what is behind them, snow on
/// its dark plate at the least level, has 0.5 %.
inline constexpr double least_words_luminance = 0.10;

/// A window that has taken pictures for so long and shown none of them is hidden.
inline constexpr std::int64_t hidden_window_ns = 1'000'000'000;

}  // namespace ridgeline::limits
