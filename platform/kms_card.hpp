#pragma once
#include <xf86drmMode.h>

#include <cstdint>
#include <memory>

#include "core/base/result.hpp"
#include "platform/screen.hpp"

namespace ridgeline {

/// One monitor of a graphics card in one mode, by the kernel's mode setting: no display server, no
/// OpenGL. Gives the card back as it was found.
class KmsCard {
 public:
  /// Errors: screen_missing, screen_not_ours, screen_no_monitor, screen_no_mode, screen_refused;
  /// `detail` says more.
  [[nodiscard]] static Result<std::unique_ptr<KmsCard>> open(const ScreenSettings& settings,
                                                             ScreenDetail& detail);
  KmsCard(const KmsCard&) = delete;
  KmsCard& operator=(const KmsCard&) = delete;
  ~KmsCard();

  /// Tells the card of a buffer of the mode's size, XRGB8888. Errors: screen_refused.
  [[nodiscard]] Result<std::uint32_t> add_buffer(std::uint32_t handle, std::uint32_t stride_bytes);
  void remove_buffer(std::uint32_t buffer);

  /// Sets the mode, showing `buffer`; waits for it. Takes the card back first where another program
  /// had it. Errors: screen_not_ours, screen_refused, screen_lost.
  [[nodiscard]] Status set_mode(std::uint32_t buffer);
  /// Shows `buffer` from the next vertical blank on, which is told with `picture`; does not wait.
  /// Errors: screen_not_ours, screen_refused (the output is off, or a flip is still to come),
  /// screen_lost.
  [[nodiscard]] Status flip(std::uint32_t buffer, std::uint64_t picture);

  /// The kernel does not say that nothing is connected any more. Cost: one system call.
  [[nodiscard]] bool plugged() const;

  [[nodiscard]] int file() const { return file_; }
  [[nodiscard]] int width_px() const { return mode_.hdisplay; }
  [[nodiscard]] int height_px() const { return mode_.vdisplay; }
  [[nodiscard]] const char* description() const { return description_; }

 private:
  KmsCard() = default;
  [[nodiscard]] Status find_monitor(const ScreenSettings& settings, ScreenDetail& detail);
  [[nodiscard]] Status take_monitor(const drmModeRes& resources, const drmModeConnector& connector,
                                    const ScreenSettings& settings, ScreenDetail& detail);

  void watch_plug(const char* connector);

  int file_ = -1;
  int plug_ = -1;  ///< where the kernel says whether a monitor is connected
  std::uint32_t connector_ = 0;
  std::uint32_t crtc_ = 0;
  drmModeModeInfo mode_{};
  drmModeCrtc* found_ = nullptr;  ///< what the card showed before
  char description_[160] = {};
};

}  // namespace ridgeline
