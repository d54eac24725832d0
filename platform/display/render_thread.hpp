#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/frame/frame_input.hpp"
#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"
#include "platform/gpu_clock.hpp"
#include "platform/scene.hpp"
#include "platform/screen.hpp"

namespace ridgeline {

/// Draws the newest ownship at a steady rate and says what each frame proved.
/// Rules: boot() and everything after it belong to one thread, the one that has the GL context.
class RenderThread {
 public:
  enum class Boot : std::uint8_t { going_on, done, refused };

  RenderThread(const DisplayConfig& config, Exchange& exchange);
  ~RenderThread() { close(); }

  /// Boots, then draws until the exchange says stop; writes the last frame where that is wanted.
  void run();
  /// Opens terrain, screen and renderer. The message is for the one line on standard error; empty
  /// when all is well.
  [[nodiscard]] std::string boot();
  /// One frame that should have begun at `due_ns`: state in, picture shown, proof out.
  void draw(std::int64_t due_ns);

  /// Writes the last frame where the configuration wants it; dump_problem() then says what is
  /// wrong.
  void dump();

  [[nodiscard]] Boot boot_state() const { return boot_state_.load(std::memory_order_acquire); }
  /// Domain: boot_state() is not going_on.
  [[nodiscard]] const std::string& boot_problem() const { return boot_problem_; }
  /// Empty when the dump was written or is not wanted. Domain: the thread has ended.
  [[nodiscard]] const std::string& dump_problem() const { return dump_problem_; }
  [[nodiscard]] Screen& screen() { return *screen_; }
  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] const FrameFact& fact() const { return fact_; }
  [[nodiscard]] const char* driver() const { return screen_->gl_description(); }
  [[nodiscard]] std::int64_t period_ns() const { return period_ns_; }

 private:
  /// What a picture on its way to the screen shows.
  struct Shown {
    std::uint64_t picture = 0;
    std::int64_t attitude_ns = 0;
  };

  void loop();
  void prepare_real_time();
  [[nodiscard]] FrameInput frame_input_now(std::int64_t now_ns);
  [[nodiscard]] DisplayState display_now() const;
  void check_ground(std::int64_t started_ns);
  Fault present();
  [[nodiscard]] int newly_decoded();
  void judge(std::int64_t started_ns, std::int64_t finished_ns, Fault presented);
  void note_shown(std::int64_t now_ns, Fault presented);
  void note_latency(const ShownStamp& stamp);
  void tell_change(const Availability& before);
  void close();

  const DisplayConfig& config_;
  Exchange& exchange_;
  StateLimits limits_;
  std::int64_t period_ns_;
  GpuClock clock_;
  std::optional<FramePace> pace_;  ///< keeps frames in time; none where that is switched off
  OwnshipState state_;
  std::uint32_t decoded_told_ = 0;  ///< frames of the bus that earlier frames were drawn from
  std::optional<Screen> screen_;
  std::optional<Scene> scene_;
  Texture blank_;
  FrameReport report_;
  GroundCheck ground_;
  AirGroundCheck air_ground_;
  PoseValue radio_height_m_;
  AirGroundFacts air_ground_facts_;  ///< of the frame being drawn
  FrameFact fact_;
  std::int64_t attitude_ns_ = 0, newest_input_ns_ = 0;
  std::array<Shown, 4> on_the_way_{};
  std::uint64_t picture_told_ = 0;
  std::int64_t seen_ns_ = 0;  ///< when the screen last showed all that it had taken, or more of it
  bool hidden_ = false;
  std::int64_t attitude_told_ns_ = 0;
  Fault present_fault_ = Fault::none;
  std::vector<float> range_m_;
  std::vector<std::uint8_t> rgba_;
  std::string boot_problem_, dump_problem_;
  std::atomic<Boot> boot_state_{Boot::going_on};
};

}  // namespace ridgeline
