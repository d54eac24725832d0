#include "platform/wayland_link.hpp"

#include <poll.h>
#include <presentation-time-client-protocol.h>
#include <wayland-client.h>
#include <xdg-shell-client-protocol.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace ridgeline {
namespace {

/// What libwayland said last, on the thread that has the screen: of a fault of the protocol it is
/// the compositor's own text.
thread_local std::array<char, 120> said{};

/// In place of its own, which writes to standard error and may block there.
[[gnu::format(printf, 1, 0)]] void keep_words(const char* format, va_list values) {
  std::vsnprintf(said.data(), said.size(), format, values);
  said[std::strcspn(said.data(), "\n")] = '\0';
}

template <typename T>
T* bound(wl_registry* registry, std::uint32_t name, const wl_interface& interface,
         std::uint32_t version) {
  return static_cast<T*>(wl_registry_bind(registry, name, &interface, version));
}

}  // namespace

struct WaylandLink::Events {
  static WaylandLink& link(void* data) { return *static_cast<WaylandLink*>(data); }
  static void global(void* data, wl_registry* registry, std::uint32_t name, const char* interface,
                     std::uint32_t version) {
    link(data).add(registry, name, interface, version);
  }
  static void global_remove(void* data, wl_registry* /*registry*/, std::uint32_t name) {
    link(data).remove(name);
  }
  static void done(void* data, wl_callback* question, std::uint32_t /*serial*/) {
    wl_callback_destroy(question);
    link(data).question_ = nullptr;
  }
  static void ping(void* /*data*/, xdg_wm_base* shell, std::uint32_t serial) {
    xdg_wm_base_pong(shell, serial);
  }
  static void clock_id(void* data, wp_presentation* /*presentation*/, std::uint32_t clock) {
    link(data).clock_ = clock;
  }
  static void scale(void* data, wl_output* /*output*/, std::int32_t factor) {
    static_cast<Output*>(data)->scale = std::max(1, factor);
  }
  static void geometry(void* /*data*/, wl_output* /*output*/, std::int32_t /*x*/,
                       std::int32_t /*y*/, std::int32_t /*width_mm*/, std::int32_t /*height_mm*/,
                       std::int32_t /*subpixel*/, const char* /*make*/, const char* /*model*/,
                       std::int32_t /*transform*/) {}
  static void mode(void* /*data*/, wl_output* /*output*/, std::uint32_t /*flags*/,
                   std::int32_t /*width*/, std::int32_t /*height*/, std::int32_t /*refresh*/) {}
  static void output_done(void* /*data*/, wl_output* /*output*/) {}

  static constexpr wl_registry_listener registry = {global, global_remove};
  static constexpr wl_callback_listener question = {done};
  static constexpr xdg_wm_base_listener shell = {ping};
  static constexpr wp_presentation_listener presentation = {clock_id};
  // Up to version 2, which is the one asked for.
  static constexpr wl_output_listener output = {geometry, mode,    output_done,
                                                scale,    nullptr, nullptr};
};

WaylandLink::~WaylandLink() {
  if (display_ == nullptr) return;
  if (question_ != nullptr) wl_callback_destroy(question_);
  for (const Output& output : outputs_) {
    if (output.object != nullptr) wl_output_destroy(output.object);
  }
  if (presentation_ != nullptr) wp_presentation_destroy(presentation_);
  if (shell_ != nullptr) xdg_wm_base_destroy(shell_);
  if (shm_ != nullptr) wl_shm_destroy(shm_);
  if (compositor_ != nullptr) wl_compositor_destroy(compositor_);
  if (registry_ != nullptr) wl_registry_destroy(registry_);
  wl_display_disconnect(display_);
}

Status WaylandLink::open(const char* name, ScreenDetail& detail) {
  wl_log_set_handler_client(keep_words);
  said[0] = '\0';
  const char* told = *name != '\0' ? name : std::getenv("WAYLAND_DISPLAY");
  std::snprintf(name_, sizeof name_, "%s", told == nullptr ? "wayland-0" : told);
  display_ = wl_display_connect(*name != '\0' ? name : nullptr);
  if (display_ == nullptr) {
    const char* why = std::strerror(errno);
    std::snprintf(detail.text, sizeof detail.text, "no Wayland compositor at \"%s\": %s", name_,
                  said[0] != '\0' ? said.data() : why);
    return Fault::screen_missing;
  }
  registry_ = wl_display_get_registry(display_);
  wl_registry_add_listener(registry_, &Events::registry, this);
  // The first answer comes after all that the compositor has, the second after what those tell.
  for (int round = 0; round < 2; ++round) {
    ask();
    if (!wait([&] { return answered(); }, screen_time_ns() + boot_limit_ns)) {
      std::snprintf(detail.text, sizeof detail.text, "the Wayland compositor at \"%s\" %s", name_,
                    lost() ? "ends the connection" : "does not answer");
      return Fault::screen_missing;
    }
  }
  if (const char* lacks = missing(); lacks != nullptr) {
    std::snprintf(detail.text, sizeof detail.text,
                  "the Wayland compositor at \"%s\" has no %s, or an old one", name_, lacks);
    return Fault::screen_missing;
  }
  return {};
}

void WaylandLink::add(wl_registry* registry, std::uint32_t name, const char* interface,
                      std::uint32_t version) {
  const auto is = [&](const wl_interface& wanted) {
    return std::strcmp(interface, wanted.name) == 0;
  };
  if (is(wl_compositor_interface) && version >= 4) {  // damage in pixels of the buffer
    compositor_ = bound<wl_compositor>(registry, name, wl_compositor_interface, 4);
  } else if (is(wl_shm_interface)) {
    shm_ = bound<wl_shm>(registry, name, wl_shm_interface, 1);
  } else if (is(xdg_wm_base_interface)) {
    shell_ = bound<xdg_wm_base>(registry, name, xdg_wm_base_interface, std::min(version, 3U));
    xdg_wm_base_add_listener(shell_, &Events::shell, this);
  } else if (is(wp_presentation_interface)) {
    presentation_ = bound<wp_presentation>(registry, name, wp_presentation_interface, 1);
    wp_presentation_add_listener(presentation_, &Events::presentation, this);
  } else if (is(wl_output_interface) && version >= 2) {  // which tells its scale
    for (Output& output : outputs_) {
      if (output.object != nullptr) continue;
      output = {bound<wl_output>(registry, name, wl_output_interface, 2), name, 1, false};
      wl_output_add_listener(output.object, &Events::output, &output);
      return;
    }
  }
}

void WaylandLink::remove(std::uint32_t name) {
  for (Output& output : outputs_) {
    if (output.object == nullptr || output.name != name) continue;
    wl_output_destroy(output.object);
    output = {};
  }
}

const char* WaylandLink::missing() const {
  return compositor_ == nullptr ? wl_compositor_interface.name
         : shm_ == nullptr      ? wl_shm_interface.name
         : shell_ == nullptr    ? xdg_wm_base_interface.name
                                : nullptr;
}

void WaylandLink::take_events(std::int64_t deadline_ns) {
  // Reading may be announced only where all that came before has been handled.
  while (wl_display_prepare_read(display_) != 0) {
    if (wl_display_dispatch_pending(display_) < 0) return;
    deadline_ns = 0;
  }
  pollfd told{wl_display_get_fd(display_), POLLIN, 0};
  if (wl_display_flush(display_) < 0 && errno == EAGAIN) told.events |= POLLOUT;
  const std::int64_t left_ns = std::max<std::int64_t>(0, deadline_ns - screen_time_ns());
  const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
  const int count = ::ppoll(&told, 1, &left, nullptr);
  if (count > 0 && (told.revents & ~POLLOUT) != 0) {
    wl_display_read_events(display_);
  } else {
    wl_display_cancel_read(display_);
  }
  wl_display_dispatch_pending(display_);
  wl_display_flush(display_);  // what was answered to that
}

void WaylandLink::send() {
  wl_display_flush(display_);
}

void WaylandLink::ask() {
  question_ = wl_display_sync(display_);
  wl_callback_add_listener(question_, &Events::question, this);
}

bool WaylandLink::lost() const {
  return wl_display_get_error(display_) != 0;
}

const char* WaylandLink::last_words() const {
  const int fault = wl_display_get_error(display_);
  return fault == 0 ? "" : said[0] != '\0' ? said.data() : std::strerror(fault);
}

std::int64_t WaylandLink::our_time_ns(std::int64_t told_ns) const {
  const std::int64_t now_ns = screen_time_ns();
  timespec theirs{};
  if (clock_gettime(static_cast<clockid_t>(clock_), &theirs) != 0) return now_ns;
  const std::int64_t ago_ns =
      static_cast<std::int64_t>(theirs.tv_sec) * 1'000'000'000 + theirs.tv_nsec - told_ns;
  return ago_ns > 0 ? now_ns - ago_ns : now_ns;
}

void WaylandLink::enter(const wl_output* output, bool entered) {
  for (Output& one : outputs_) {
    if (one.object != nullptr && one.object == output) one.entered = entered;
  }
}

int WaylandLink::scale() const {
  int largest = 1;
  for (const Output& output : outputs_) {
    if (output.object != nullptr && output.entered) largest = std::max(largest, output.scale);
  }
  return largest;
}

}  // namespace ridgeline
