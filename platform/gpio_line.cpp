#include "platform/gpio_line.hpp"

#include <gpiod.h>

#include <utility>
#if RL_GPIOD_MAJOR >= 2
#include <dirent.h>

#include <cstdio>
#endif

namespace ridgeline {
namespace {

constexpr const char* consumer = "ridgeline";

#if RL_GPIOD_MAJOR >= 2

/// The chip that has a line of this name, to be closed; null where none has.
gpiod_chip* chip_with(const char* name, unsigned& offset) {
  DIR* devices = ::opendir("/dev");
  if (devices == nullptr) return nullptr;
  gpiod_chip* found = nullptr;
  for (const dirent* entry = ::readdir(devices); entry != nullptr && found == nullptr;
       entry = ::readdir(devices)) {
    char path[300];
    std::snprintf(path, sizeof path, "/dev/%s", entry->d_name);
    if (!gpiod_is_gpiochip_device(path)) continue;
    gpiod_chip* chip = gpiod_chip_open(path);
    if (chip == nullptr) continue;
    const int at = gpiod_chip_get_line_offset_from_name(chip, name);
    if (at >= 0) {
      offset = static_cast<unsigned>(at);
      found = chip;
    } else {
      gpiod_chip_close(chip);
    }
  }
  ::closedir(devices);
  return found;
}

gpiod_line_request* request_line(gpiod_chip* chip, unsigned offset,
                                 const GpioLineSettings& settings) {
  gpiod_line_settings* line = gpiod_line_settings_new();
  gpiod_line_config* lines = gpiod_line_config_new();
  gpiod_request_config* request = gpiod_request_config_new();
  gpiod_line_request* made = nullptr;
  if (line != nullptr && lines != nullptr && request != nullptr) {
    gpiod_line_settings_set_active_low(line, settings.active_low);
    gpiod_line_settings_set_output_value(
        line, settings.initial ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
    gpiod_request_config_set_consumer(request, consumer);
    const auto direction =
        settings.output ? GPIOD_LINE_DIRECTION_OUTPUT : GPIOD_LINE_DIRECTION_INPUT;
    if (gpiod_line_settings_set_direction(line, direction) == 0 &&
        gpiod_line_config_add_line_settings(lines, &offset, 1, line) == 0) {
      made = gpiod_chip_request_lines(chip, request, lines);
    }
  }
  gpiod_request_config_free(request);
  gpiod_line_config_free(lines);
  gpiod_line_settings_free(line);
  return made;
}

#endif

}  // namespace

GpioLine::GpioLine(GpioLine&& other) noexcept
    : line_(std::exchange(other.line_, nullptr)),
      request_(std::exchange(other.request_, nullptr)),
      offset_(other.offset_) {}

GpioLine& GpioLine::operator=(GpioLine&& other) noexcept {
  std::swap(line_, other.line_);
  std::swap(request_, other.request_);
  std::swap(offset_, other.offset_);
  return *this;
}

#if RL_GPIOD_MAJOR >= 2

GpioLine::~GpioLine() {
  if (request_ != nullptr) gpiod_line_request_release(request_);
}

Result<GpioLine> GpioLine::open(const GpioLineSettings& settings) {
  GpioLine made;
  gpiod_chip* chip = chip_with(settings.name, made.offset_);
  if (chip == nullptr) return Fault::gpio_line_missing;
  made.request_ = request_line(chip, made.offset_, settings);
  gpiod_chip_close(chip);
  if (made.request_ == nullptr) return Fault::gpio_line_busy;
  return made;
}

Result<bool> GpioLine::level() const {
  const auto value = gpiod_line_request_get_value(request_, offset_);
  if (value == GPIOD_LINE_VALUE_ERROR) return Fault::gpio_line_lost;
  return value == GPIOD_LINE_VALUE_ACTIVE;
}

Status GpioLine::set_level(bool level) {
  const auto value = level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
  const bool done = gpiod_line_request_set_value(request_, offset_, value) == 0;
  return done ? Status{} : Status{Fault::gpio_line_lost};
}

#else

GpioLine::~GpioLine() {
  if (line_ != nullptr) gpiod_line_close_chip(line_);  // releases the line as well
}

Result<GpioLine> GpioLine::open(const GpioLineSettings& settings) {
  GpioLine made;
  made.line_ = gpiod_line_find(settings.name);
  if (made.line_ == nullptr) return Fault::gpio_line_missing;
  const int flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  const int error = settings.output ? gpiod_line_request_output_flags(made.line_, consumer, flags,
                                                                      settings.initial ? 1 : 0)
                                    : gpiod_line_request_input_flags(made.line_, consumer, flags);
  if (error != 0) return Fault::gpio_line_busy;
  return made;
}

Result<bool> GpioLine::level() const {
  const int value = gpiod_line_get_value(line_);
  if (value < 0) return Fault::gpio_line_lost;
  return value == 1;
}

Status GpioLine::set_level(bool level) {
  const bool done = gpiod_line_set_value(line_, level ? 1 : 0) == 0;
  return done ? Status{} : Status{Fault::gpio_line_lost};
}

#endif

}  // namespace ridgeline
