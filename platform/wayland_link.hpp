#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/result.hpp"
#include "platform/screen_output.hpp"

struct wl_callback;
struct wl_compositor;
struct wl_display;
struct wl_output;
struct wl_registry;
struct wl_shm;
struct wp_presentation;
struct xdg_wm_base;

namespace ridgeline {

/// A connection to a Wayland compositor and what a window needs of it. No call waits without a
/// limit, and a compositor that is gone is told, never the end of the program.
/// Rules: one thread; stays where it was opened, for libwayland knows its address.
class WaylandLink {
 public:
  /// What a question at boot may take to be answered.
  static constexpr std::int64_t boot_limit_ns = 2'000'000'000;

  WaylandLink() = default;
  WaylandLink(const WaylandLink&) = delete;
  WaylandLink& operator=(const WaylandLink&) = delete;
  ~WaylandLink();

  /// `name` as ScreenSettings::wayland_display has it. Errors: screen_missing.
  [[nodiscard]] Status open(const char* name, ScreenDetail& detail);

  /// Sends what there is to send, answers pings, takes in what has come; where nothing has, waits
  /// for it until `deadline_ns`.
  void take_events(std::int64_t deadline_ns);
  /// Takes in events until `done()`; false: the deadline came first, or the compositor is gone.
  template <typename Done>
  [[nodiscard]] bool wait(const Done& done, std::int64_t deadline_ns) {
    take_events(0);
    while (!done()) {
      if (lost() || screen_time_ns() >= deadline_ns) return false;
      take_events(deadline_ns);
    }
    return true;
  }
  /// Sends what there is to send, without waiting.
  void send();

  /// Asks a question that is answered once all that was asked before is taken in. Domain:
  /// answered().
  void ask();
  [[nodiscard]] bool answered() const { return question_ == nullptr; }

  /// The compositor has ended, or ended the connection; last_words() may say why.
  [[nodiscard]] bool lost() const;
  [[nodiscard]] const char* last_words() const;

  /// An output begins or ceases to show our window.
  void enter(const wl_output* output, bool entered);
  /// The largest scale of the outputs that show it; 1 where none does.
  [[nodiscard]] int scale() const;

  [[nodiscard]] wl_compositor* compositor() const { return compositor_; }
  [[nodiscard]] wl_shm* shm() const { return shm_; }
  [[nodiscard]] xdg_wm_base* shell() const { return shell_; }
  /// Null where the compositor does not tell when pictures are shown.
  [[nodiscard]] wp_presentation* presentation() const { return presentation_; }
  /// A time of presentation, on the compositor's clock, on ours; never one to come.
  [[nodiscard]] std::int64_t our_time_ns(std::int64_t told_ns) const;
  /// The display it was found at.
  [[nodiscard]] const char* name() const { return name_; }

 private:
  struct Events;  ///< what libwayland calls
  struct Output {
    wl_output* object = nullptr;
    std::uint32_t name = 0;
    int scale = 1;
    bool entered = false;
  };
  void add(wl_registry* registry, std::uint32_t name, const char* interface, std::uint32_t version);
  void remove(std::uint32_t name);
  [[nodiscard]] const char* missing() const;

  wl_display* display_ = nullptr;
  wl_registry* registry_ = nullptr;
  wl_callback* question_ = nullptr;
  wl_compositor* compositor_ = nullptr;
  wl_shm* shm_ = nullptr;
  xdg_wm_base* shell_ = nullptr;
  wp_presentation* presentation_ = nullptr;
  std::uint32_t clock_ = 0;          ///< of presentation, as clock_gettime() has it
  std::array<Output, 8> outputs_{};  ///< more are taken for unscaled
  char name_[108] = {};
};

}  // namespace ridgeline
