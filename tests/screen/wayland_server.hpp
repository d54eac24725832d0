#pragma once
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tests/screen/seen_pixels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {

struct WaylandState;

/// What a compositor has, and how it treats the window from the first moment on.
struct WaylandServerSettings {
  bool presentation = true;  ///< it tells when pictures are shown
  bool shell = true;
  bool sizes = true;  ///< it gives windows a size
  bool answers = true;
  bool insists = false;          ///< a maximized window stays so
  int maximized_px = 0;          ///< the width and height of a window that is so from the beginning
  std::uint32_t clock = 1;       ///< of what it tells; CLOCK_MONOTONIC
  std::uint32_t told_clock = 0;  ///< what it says that clock is; 0: the truth
};

/// A Wayland compositor of this test's own, without a screen, on a thread of its own: takes
/// pictures from shared memory, notes what they show and what the client does wrong, and does wrong
/// itself when told to. It gives a picture back when another has replaced it, not before.
class WaylandServer {
 public:
  explicit WaylandServer(const WaylandServerSettings& settings = {});
  WaylandServer(const WaylandServer&) = delete;
  WaylandServer& operator=(const WaylandServer&) = delete;
  ~WaylandServer();

  /// Path of its socket.
  [[nodiscard]] const char* name() const { return socket_.c_str(); }

  /// What was in the window at its last commit.
  [[nodiscard]] SeenPixels window_pixels();
  /// A pixel of the window has this colour within a second.
  [[nodiscard]] bool becomes(int x, int y, std::uint32_t colour);
  /// Rules of the protocol that the client has broken, a line each; of a picture that was written
  /// to while the compositor had it as well.
  [[nodiscard]] std::string broken_rules();
  [[nodiscard]] int pictures_taken();
  [[nodiscard]] std::string title();

  struct Size {
    int width = 0, height = 0;
    bool operator==(const Size&) const = default;
  };
  [[nodiscard]] Size least_size();
  [[nodiscard]] Size largest_size();
  [[nodiscard]] int scale_of_window();

  // Misbehaviour.
  void hide_window(bool hidden);
  void keep_buffers(bool keep);
  /// Neither yes nor no to the question when a picture was shown.
  void forget_questions(bool forget);
  [[nodiscard]] int open_questions();
  void stop();
  void go_on();
  /// The process ends: connection and socket are gone.
  void kill();
  /// Ends the connection with an error of the protocol.
  void accuse(const char* text);

  // What happens at a desk.
  void close_window();
  void size_window(int width, int height, bool maximized = false, bool fullscreen = false);
  /// Times that the client has asked to be neither maximized nor fullscreen.
  [[nodiscard]] int asked_for_less();
  /// Asks whether the client lives; whether it has answered all that was asked, within
  /// a second.
  void ping();
  [[nodiscard]] bool has_answered();
  void show_on_output_of_scale(int scale);
  void unplug_output();

 private:
  void run();
  void call(const std::function<void()>& task);

  TemporaryFolder folder_;
  std::string socket_;
  std::unique_ptr<WaylandState> state_;
  std::mutex mutex_;
  std::condition_variable done_;
  const std::function<void()>* task_ = nullptr;
  std::atomic<bool> stopped_{false}, end_{false};
  std::thread thread_;
};

}  // namespace ridgeline::test
