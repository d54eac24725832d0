#include "platform/screen.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "config/limits.hpp"
#include "platform/egl_context.hpp"
#include "platform/picture_copy.hpp"
#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

bool size_allowed(const ScreenSettings& settings) {
  if (settings.width_px == 0 && settings.height_px == 0) return settings.kind == ScreenKind::kms;
  return settings.width_px >= limits::min_image_px && settings.width_px <= limits::max_image_px &&
         settings.height_px >= limits::min_image_px && settings.height_px <= limits::max_image_px;
}

Status check(const ScreenSettings& settings, ScreenDetail& detail) {
  const char* wrong = !size_allowed(settings) ? "size of the picture"
                      : !std::isfinite(settings.refresh_hz) || settings.refresh_hz < 0
                          ? "refresh rate"
                      : settings.gpu_timeout_ns <= 0 || settings.flip_timeout_ns <= 0 ? "time limit"
                                                                                      : nullptr;
  if (wrong == nullptr) return {};
  std::snprintf(detail.text, sizeof detail.text, "%s out of range", wrong);
  return Fault::screen_settings;
}

ScreenMade make_output(const ScreenSettings& settings, ScreenDetail& detail) {
  switch (settings.kind) {
    case ScreenKind::window:
      return settings.window_system == WindowSystem::wayland ? make_wayland_output(settings, detail)
                                                             : make_x11_output(settings, detail);
    case ScreenKind::kms:
      return make_kms_output(settings, detail);
    case ScreenKind::surfaceless:
      break;
  }
  return make_surfaceless_output(settings);
}

}  // namespace

Screen::Screen() = default;
Screen::Screen(Screen&& other) noexcept = default;

Screen& Screen::operator=(Screen&& other) noexcept {
  if (this != &other) {
    close();
    output_ = std::move(other.output_);
    context_ = std::move(other.context_);
    copy_ = std::move(other.copy_);
    health_ = other.health_;
    gpu_timeout_ns_ = other.gpu_timeout_ns_;
  }
  return *this;
}

Screen::~Screen() {
  close();
}

void Screen::close() {
  if (context_ == nullptr) return;
  context_->make_current();
  copy_.reset();
  output_->detach();
  context_.reset();
  output_.reset();
}

Result<Screen> Screen::make(const ScreenSettings& settings, ScreenDetail& detail) {
  if (const Status checked = check(settings, detail); !checked) return checked.fault();
  Screen made;
  made.gpu_timeout_ns_ = settings.gpu_timeout_ns;
  auto output = make_output(settings, detail);
  if (!output) return output.fault();
  made.output_ = std::move(output).value();
  auto context = EglContext::make(made.output_->place());
  if (!context) {
    std::snprintf(detail.text, sizeof detail.text, "%s", made.output_->description());
    return context.fault();
  }
  made.context_ = std::make_unique<EglContext>(std::move(context).value());
  if (const Status attached = made.attach(detail); !attached) return attached.fault();
  return made;
}

Status Screen::attach(ScreenDetail& detail) {
  copy_ = std::make_unique<PictureCopy>();
  return output_->attach(*context_, detail);
}

Status Screen::keep(Status status) {
  health_.fault = status.fault();
  if (!status) ++health_.faults;
  return status;
}

Status Screen::present(GLuint colour) {
  if (context_->lost()) return keep(Fault::gl_context_lost);
  const auto target = output_->begin();
  if (!target) return keep(target.fault());
  const Status copied =
      copy_->copy(colour, width_px(), height_px(), target.value(), gpu_timeout_ns_);
  // Asked after the wait: what a reset left of the picture must not be shown.
  if (context_->lost()) return keep(Fault::gl_context_lost);
  if (!copied) return keep(copied);
  if (const Status shown = output_->show(health_.presented + 1); !shown) return keep(shown);
  ++health_.presented;
  health_.failed_shown = false;
  return keep({});
}

Status Screen::wait_shown() {
  return keep(output_->wait_shown());
}

ShownStamp Screen::shown() {
  return output_->shown();
}

void Screen::show_failed() {
  output_->show_failed();
  health_.failed_shown = true;
}

Status Screen::renew() {
  copy_.reset();
  output_->detach();
  if (const Status renewed = context_->renew(); !renewed) return keep(renewed);
  ScreenDetail detail;
  return keep(attach(detail));
}

void Screen::make_current() const {
  context_->make_current();
}

TimerFunctions Screen::timer_functions() const {
  return context_->timer_functions();
}

int Screen::width_px() const {
  return output_->width_px();
}

int Screen::height_px() const {
  return output_->height_px();
}

const char* Screen::gl_description() const {
  return context_->description();
}

const char* Screen::last_words() const {
  return output_->last_words();
}

const char* Screen::description() const {
  return output_->description();
}

void Screen::ask_reset_status(ResetStatus instead) {
  context_->ask_reset_status(instead);
}

}  // namespace ridgeline
