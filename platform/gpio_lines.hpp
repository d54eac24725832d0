#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "config/limits_bus.hpp"
#include "core/base/result.hpp"
#include "core/monitor/debounce.hpp"
#include "core/monitor/discretes.hpp"
#include "platform/gpio_line.hpp"

namespace ridgeline {

/// One line as an installer names it; without a name it is not connected.
struct DiscreteSettings {
  const char* name = "";
  bool active_low = false;
};

struct GpioSettings {
  std::array<DiscreteSettings, discrete_input_count> inputs;    ///< by DiscreteInput
  std::array<DiscreteSettings, discrete_output_count> outputs;  ///< by DiscreteOutput
  /// Level of an input that is not connected.
  std::array<bool, discrete_input_count> defaults = {true, false, false, false};
  std::int64_t hold_ns = limits::discrete_hold_ns;
};

/// The discrete lines of the display.
/// Rules: a line lost in flight is told once and for good: its input keeps its last level, and from
///        then on driven_levels() lets the heartbeat stop and reports SVS fail.
/// Cost:  one system call a line and call; no allocation after open().
class GpioLines {
 public:
  /// Outputs have boot_levels from the first moment on. The fault of GpioLine::open(); `refused` is
  /// then the name of the line.
  [[nodiscard]] static Result<GpioLines> open(const GpioSettings& settings, std::int64_t now_ns,
                                              const char*& refused);

  /// Reads and debounces every input. Fault::gpio_line_lost once, when a line is lost.
  [[nodiscard]] Status read(std::int64_t now_ns);
  [[nodiscard]] bool level(DiscreteInput input) const {
    return inputs_[static_cast<std::size_t>(input)].level;
  }
  [[nodiscard]] const Debounce& input(DiscreteInput input) const {
    return inputs_[static_cast<std::size_t>(input)];
  }

  /// Puts levels on the outputs, those that change. Fault::gpio_line_lost once, when a line is
  /// lost.
  [[nodiscard]] Status write(const OutputLevels& wanted);
  [[nodiscard]] bool line_lost() const { return line_lost_; }

 private:
  GpioLines() = default;
  Fault lose();
  bool put(const OutputLevels& levels);

  std::array<std::optional<GpioLine>, discrete_input_count> input_lines_;
  std::array<std::optional<GpioLine>, discrete_output_count> output_lines_;
  std::array<Debounce, discrete_input_count> inputs_{};
  OutputLevels present_ = boot_levels;
  std::int64_t hold_ns_ = 0;
  bool line_lost_ = false;
};

}  // namespace ridgeline
