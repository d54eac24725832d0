#pragma once
#include "core/base/result.hpp"

struct gpiod_line;
struct gpiod_line_request;

namespace ridgeline {

struct GpioLineSettings {
  const char* name = "";  ///< as the kernel knows it, on any chip
  bool active_low = false;
  bool output = false;
  bool initial = false;  ///< level of an output from the first moment on
};

/// One GPIO line, held until the object ends. The only file that knows which libgpiod it is (1.x of
/// Debian 12 or 2.x).
class GpioLine {
 public:
  /// Domain: a line of that name, else Fault::gpio_line_missing; free and able, else
  /// gpio_line_busy.
  [[nodiscard]] static Result<GpioLine> open(const GpioLineSettings& settings);
  GpioLine(GpioLine&& other) noexcept;
  GpioLine& operator=(GpioLine&& other) noexcept;
  ~GpioLine();

  /// Level, logical (active is true). Fault::gpio_line_lost when the chip is gone. Cost: one system
  /// call; no allocation.
  [[nodiscard]] Result<bool> level() const;
  [[nodiscard]] Status set_level(bool level);

 private:
  GpioLine() = default;
  gpiod_line* line_ = nullptr;             ///< libgpiod 1.x
  gpiod_line_request* request_ = nullptr;  ///< libgpiod 2.x
  unsigned offset_ = 0;
};

}  // namespace ridgeline
