#include <GLES3/gl31.h>
#include <presentation-time-client-protocol.h>
#include <wayland-client.h>

#include <array>
#include <cstdio>
#include <memory>

#include "core/render/gl_object.hpp"
#include "platform/screen_output.hpp"
#include "platform/wayland_buffers.hpp"
#include "platform/wayland_link.hpp"
#include "platform/wayland_window.hpp"

namespace ridgeline {
namespace {

using Feedback = struct ::wp_presentation_feedback;  // a function has the same name

/// Rows of R, G, B, A from the bottom become rows of XRGB8888 from the top.
void copy_upright(const std::uint32_t* rgba, std::span<std::uint32_t> xrgb, int width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  for (std::size_t at = 0; at < xrgb.size(); at += width) {
    const std::uint32_t* from = rgba + xrgb.size() - width - at;
    std::uint32_t* to = xrgb.data() + at;
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t one = from[x];
      to[x] =
          WaylandBuffers::unused_bits | (one & 0xFF) << 16 | (one & 0xFF00) | (one >> 16 & 0xFF);
    }
  }
}

/// A window of a Wayland compositor. Pictures are read back into memory that is shared with it, so
/// how many there are, and which of them it holds, is known here and not to a driver alone.
class WaylandOutput final : public ScreenOutput {
 public:
  WaylandOutput() = default;
  ~WaylandOutput() override;
  Status open(const ScreenSettings& settings, ScreenDetail& detail);

  [[nodiscard]] EglPlace place() const override { return {}; }
  [[nodiscard]] Status attach(EglContext& context, ScreenDetail& detail) override;
  void detach() override { bytes_ = Buffer(); }
  [[nodiscard]] Result<PictureTarget> begin() override;
  [[nodiscard]] Status show(std::uint64_t picture) override;
  [[nodiscard]] Status wait_shown() override;
  [[nodiscard]] ShownStamp shown() override;
  void show_failed() override;
  [[nodiscard]] const char* last_words() const override { return link_.last_words(); }
  [[nodiscard]] int width_px() const override { return width_px_; }
  [[nodiscard]] int height_px() const override { return height_px_; }
  [[nodiscard]] const char* description() const override { return description_; }

 private:
  /// A question whether, and when, a picture was shown.
  struct Question {
    WaylandOutput* output = nullptr;
    Feedback* object = nullptr;
    std::uint64_t picture = 0;
  };
  struct Events;

  [[nodiscard]] Status fill(int index);
  void ask_when_shown(std::uint64_t picture);
  void take_answer();
  [[nodiscard]] Status late_or_gone();
  [[nodiscard]] Status gone() const {
    if (link_.lost()) return Fault::screen_lost;
    return window_.closed() ? Fault::screen_closed : Fault::none;
  }

  // In this order: each goes before those it was made from.
  WaylandLink link_;
  WaylandBuffers buffers_;
  WaylandWindow window_;
  EglContext* context_ = nullptr;
  Buffer bytes_;  ///< the picture on its way from OpenGL
  int width_px_ = 0, height_px_ = 0;
  std::int64_t flip_timeout_ns_ = 0;
  std::array<Question, 4> questions_{};
  std::uint64_t handed_over_ = 0;  ///< number of the last picture; 0: none yet
  ShownStamp shown_;
  char description_[160] = {};
};

struct WaylandOutput::Events {
  static void sync_output(void* /*data*/, Feedback* /*feedback*/, wl_output* /*output*/) {}
  static void presented(void* data, Feedback* feedback, std::uint32_t high_s, std::uint32_t low_s,
                        std::uint32_t ns, std::uint32_t /*refresh_ns*/,
                        std::uint32_t /*high_count*/, std::uint32_t low_count,
                        std::uint32_t /*flags*/) {
    const auto& question = *static_cast<const Question*>(data);
    WaylandOutput& output = *question.output;
    if (question.picture > output.shown_.picture) {
      const std::uint64_t s = static_cast<std::uint64_t>(high_s) << 32 | low_s;
      const std::int64_t told_ns = static_cast<std::int64_t>(s) * 1'000'000'000 + ns;
      output.shown_ = {question.picture, output.link_.our_time_ns(told_ns), low_count};
    }
    discarded(data, feedback);
  }
  static void discarded(void* data, Feedback* feedback) {
    wp_presentation_feedback_destroy(feedback);
    static_cast<Question*>(data)->object = nullptr;
  }
  static constexpr wp_presentation_feedback_listener feedback = {sync_output, presented, discarded};
};

WaylandOutput::~WaylandOutput() {
  for (const Question& question : questions_) {
    if (question.object != nullptr) wp_presentation_feedback_destroy(question.object);
  }
}

Status WaylandOutput::open(const ScreenSettings& settings, ScreenDetail& detail) {
  width_px_ = settings.width_px;
  height_px_ = settings.height_px;
  flip_timeout_ns_ = settings.flip_timeout_ns;
  for (Question& question : questions_) question.output = this;
  if (const Status opened = link_.open(settings.wayland_display, detail); !opened) return opened;
  if (const Status made = buffers_.make(link_.shm(), width_px_, height_px_, detail); !made) {
    return made;
  }
  if (const Status opened = window_.open(link_, width_px_, height_px_, settings.title, detail);
      !opened) {
    return opened;
  }
  std::snprintf(description_, sizeof description_, "wayland window %dx%d at %.60s%s", width_px_,
                height_px_, link_.name(),
                link_.presentation() == nullptr ? ", which does not tell when it shows" : "");
  window_.put(buffers_.handed_over(buffers_.free_one()));
  link_.ask();
  if (link_.wait([&] { return link_.answered(); }, screen_time_ns() + WaylandLink::boot_limit_ns))
    return {};
  std::snprintf(detail.text, sizeof detail.text, "%s: the compositor %s", description_,
                link_.lost() ? link_.last_words() : "does not answer");
  return Fault::screen_missing;
}

Status WaylandOutput::attach(EglContext& context, ScreenDetail& detail) {
  context_ = &context;
  auto made =
      make_buffer(GL_PIXEL_PACK_BUFFER,
                  4 * static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_),
                  GL_STREAM_READ);
  if (!made) {
    std::snprintf(detail.text, sizeof detail.text, "%s: no buffer to read from", description_);
    return made.fault();
  }
  bytes_ = std::move(made).value();
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return {};
}

/// Where it does not tell when pictures are shown: with the answer it has the picture, and shows it
/// when it next draws.
void WaylandOutput::take_answer() {
  if (link_.presentation() != nullptr || !link_.answered()) return;
  if (handed_over_ != shown_.picture) shown_ = {handed_over_, screen_time_ns(), 0};
}

ShownStamp WaylandOutput::shown() {
  link_.take_events(0);
  take_answer();
  return shown_;
}

Status WaylandOutput::late_or_gone() {
  const Status why = gone();
  return why ? Status(Fault::screen_flip_late) : why;
}

Status WaylandOutput::wait_shown() {
  const auto is_shown = [&] {
    take_answer();
    return window_.closed() || shown_.picture == handed_over_;
  };
  if (!link_.wait(is_shown, screen_time_ns() + flip_timeout_ns_)) return late_or_gone();
  return gone();
}

/// Waits for the compositor, not for the screen: a window that is hidden is shown nothing for as
/// long as it is. A compositor that lives answers, and gives back what a newer picture replaced.
Result<PictureTarget> WaylandOutput::begin() {
  const auto is_free = [&] {
    return window_.closed() || (link_.answered() && buffers_.free_one() >= 0);
  };
  if (!link_.wait(is_free, screen_time_ns() + flip_timeout_ns_)) return late_or_gone().fault();
  take_answer();
  if (const Status lost = gone(); !lost) return lost.fault();
  PictureTarget target;
  target.bytes = bytes_.name();
  return target;
}

/// Takes the bytes out of the buffer that they were read into. The GPU has finished that.
Status WaylandOutput::fill(int index) {
  const std::span<std::uint32_t> pixels = buffers_.pixels(index);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, bytes_.name());
  const void* bytes = glMapBufferRange(
      GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(pixels.size_bytes()), GL_MAP_READ_BIT);
  bool good = bytes != nullptr;
  if (good) {
    copy_upright(static_cast<const std::uint32_t*>(bytes), pixels, width_px_);
    good = glUnmapBuffer(GL_PIXEL_PACK_BUFFER) == GL_TRUE;
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  // Asked once more: what a reset left of the picture must not be shown.
  if (context_->lost()) return Fault::gl_context_lost;
  return good ? Fault::none : Fault::gl_error;
}

Status WaylandOutput::show(std::uint64_t picture) {
  const int index = buffers_.free_one();  // begin() has found one, and nothing was taken since
  if (const Status filled = fill(index); !filled) return filled;
  ask_when_shown(picture);
  window_.put(buffers_.handed_over(index));
  link_.ask();
  link_.send();
  handed_over_ = picture;
  return link_.lost() ? Fault::screen_lost : Fault::none;
}

/// Of the picture that is put next. With as many questions open as there may be, none: a window
/// that is hidden for a day must not have a day of them.
void WaylandOutput::ask_when_shown(std::uint64_t picture) {
  if (link_.presentation() == nullptr) return;
  for (Question& question : questions_) {
    if (question.object != nullptr) continue;
    question.picture = picture;
    question.object = wp_presentation_feedback(link_.presentation(), window_.surface());
    wp_presentation_feedback_add_listener(question.object, &Events::feedback, &question);
    return;
  }
}

void WaylandOutput::show_failed() {
  if (link_.lost()) return;
  window_.put(buffers_.failure());
  link_.send();
}

}  // namespace

ScreenMade make_wayland_output(const ScreenSettings& settings, ScreenDetail& detail) {
  auto made = std::make_unique<WaylandOutput>();
  if (const Status opened = made->open(settings, detail); !opened) return opened.fault();
  return {std::move(made)};
}

}  // namespace ridgeline
