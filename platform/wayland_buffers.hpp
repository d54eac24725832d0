#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/result.hpp"
#include "platform/screen.hpp"

struct wl_buffer;
struct wl_shm;

namespace ridgeline {

/// Pictures in memory that is shared with a Wayland compositor: three that take turns, so that one
/// is free where one is shown and one is about to be, and the failure picture.
/// Rules: stays where it was made, for libwayland knows its address.
class WaylandBuffers {
 public:
  /// Of each pixel. Set, so that whoever takes them for an alpha, as a program that saves what the
  /// compositor shows may, sees a picture that is opaque.
  static constexpr std::uint32_t unused_bits = 0xFF000000;

  WaylandBuffers() = default;
  WaylandBuffers(const WaylandBuffers&) = delete;
  WaylandBuffers& operator=(const WaylandBuffers&) = delete;
  ~WaylandBuffers();

  /// All there will ever be, black; every page of it is in memory afterwards.
  /// Errors: screen_refused.
  [[nodiscard]] Status make(wl_shm* shm, int width_px, int height_px, ScreenDetail& detail);

  /// A picture that the compositor does not hold; -1: it holds all of them.
  [[nodiscard]] int free_one() const;
  /// Its pixels, XRGB8888, top row first, without gaps. Domain: the compositor does not hold it.
  [[nodiscard]] std::span<std::uint32_t> pixels(int index) const;
  /// To be handed over: the compositor holds it from here on until it says otherwise.
  [[nodiscard]] wl_buffer* handed_over(int index);
  /// Never drawn again, so it does not matter who holds it.
  [[nodiscard]] wl_buffer* failure() const { return buffers_.back().object; }

 private:
  static constexpr std::size_t picture_count = 3;
  struct Buffer {
    wl_buffer* object = nullptr;
    bool held = false;  ///< by the compositor
  };
  struct Events;
  std::array<Buffer, picture_count + 1> buffers_{};
  std::uint32_t* memory_ = nullptr;
  std::size_t pixel_count_ = 0;  ///< of one picture
};

}  // namespace ridgeline
