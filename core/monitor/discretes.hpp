#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ridgeline {

/// Switches that the display reads.
enum class DiscreteInput : std::uint8_t { display_on, declutter, night, on_ground };
inline constexpr std::size_t discrete_input_count = 4;

/// What the air/ground switch says; unknown where there is none, or it can no longer be read.
enum class AirGround : std::uint8_t { unknown, air, ground };

/// Lines that the display drives. Initial levels are those of a display that shows nothing yet.
enum class DiscreteOutput : std::uint8_t { heartbeat, svs_valid, svs_fail };
inline constexpr std::size_t discrete_output_count = 3;

/// A level for each output, by DiscreteOutput.
using OutputLevels = std::array<bool, discrete_output_count>;
inline constexpr OutputLevels boot_levels = {false, false, true};

/// What is put on the lines: what is wanted as long as every line works. Once one is lost the
/// heartbeat stays as it was, so that the watchdog runs out, SVS valid goes and SVS fail comes.
[[nodiscard]] constexpr OutputLevels driven_levels(const OutputLevels& wanted,
                                                   const OutputLevels& present, bool line_lost) {
  if (!line_lost) return wanted;
  return {present[0], false, true};
}

}  // namespace ridgeline
