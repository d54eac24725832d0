#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <poll.h>
#include <xcb/xcb.h>
#include <xcb/xcbext.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

struct Free {
  void operator()(void* block) const { std::free(block); }  // what xcb hands out
};
template <typename T>
using Reply = std::unique_ptr<T, Free>;

/// WM_NORMAL_HINTS as the window managers' convention (ICCCM 4.1.2.3) lays it out: the size may not
/// change.
std::array<std::uint32_t, 18> size_hints(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t min_and_max_size = (1U << 4) | (1U << 5);
  std::array<std::uint32_t, 18> hints{};
  hints[0] = min_and_max_size;
  hints[5] = hints[7] = width;
  hints[6] = hints[8] = height;
  return hints;
}

/// A window of an X11 server. Through xcb, which tells of a lost server; Xlib ends the program.
class X11Output final : public ScreenOutput {
 public:
  X11Output() = default;
  ~X11Output() override {
    if (server_ != nullptr) xcb_disconnect(server_);  // the server then frees what was made there
  }
  Status open(const ScreenSettings& settings, ScreenDetail& detail);

  [[nodiscard]] EglPlace place() const override {
    return {EGL_PLATFORM_XCB_EXT, server_, details_.data(), screen_->root_visual};
  }
  [[nodiscard]] Status attach(EglContext& context, ScreenDetail& detail) override;
  void detach() override {}
  [[nodiscard]] Result<PictureTarget> begin() override;
  [[nodiscard]] Status show(std::uint64_t picture) override;
  [[nodiscard]] Status wait_shown() override;
  [[nodiscard]] ShownStamp shown() override;
  void show_failed() override;
  [[nodiscard]] int width_px() const override { return width_px_; }
  [[nodiscard]] int height_px() const override { return height_px_; }
  [[nodiscard]] const char* description() const override { return description_; }

 private:
  [[nodiscard]] xcb_atom_t atom(const char* name);
  void make_window(const char* title);
  void wait_mapped(std::int64_t timeout_ns);
  void draw_failure_picture();
  void take_events();
  void take(const xcb_generic_event_t& event);
  [[nodiscard]] Status ask();
  bool take_answer();
  Status gone() {
    if (xcb_connection_has_error(server_) != 0) return Fault::screen_lost;
    return closed_ ? Fault::screen_closed : Fault::none;
  }

  xcb_connection_t* server_ = nullptr;
  const xcb_screen_t* screen_ = nullptr;
  std::array<intptr_t, 3> details_{EGL_PLATFORM_XCB_SCREEN_EXT, 0, EGL_NONE};
  xcb_window_t window_ = 0;
  xcb_pixmap_t failure_ = 0;
  xcb_atom_t close_message_ = 0;
  EglContext* context_ = nullptr;
  bool opened_ = false;
  bool closed_ = false;
  bool failed_ = false;
  int width_px_ = 0, height_px_ = 0;                ///< of the picture
  int window_width_px_ = 0, window_height_px_ = 0;  ///< as the window manager has it
  std::int64_t flip_timeout_ns_ = 0;
  bool asked_ = false;         ///< and not answered
  std::uint64_t pending_ = 0;  ///< number of the picture the answer will be for; 0: none
  xcb_get_input_focus_cookie_t question_{};
  ShownStamp shown_;
  char description_[120] = {};
};

xcb_atom_t X11Output::atom(const char* name) {
  const auto asked =
      xcb_intern_atom(server_, 0, static_cast<std::uint16_t>(std::strlen(name)), name);
  const Reply<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(server_, asked, nullptr));
  return reply == nullptr ? static_cast<xcb_atom_t>(XCB_ATOM_NONE) : reply->atom;
}

Status X11Output::open(const ScreenSettings& settings, ScreenDetail& detail) {
  const char* name = *settings.x_display == '\0' ? nullptr : settings.x_display;
  const char* told = name != nullptr ? name : std::getenv("DISPLAY");
  int number = 0;
  server_ = xcb_connect(name, &number);
  if (xcb_connection_has_error(server_) != 0) {
    std::snprintf(detail.text, sizeof detail.text, "no X11 server answers at \"%s\"",
                  told == nullptr ? "" : told);
    return Fault::screen_missing;
  }
  details_[1] = number;
  auto screens = xcb_setup_roots_iterator(xcb_get_setup(server_));
  for (; number > 0 && screens.rem > 1; --number) xcb_screen_next(&screens);
  screen_ = screens.data;
  if (screen_->root_depth != 24 && screen_->root_depth != 32) {
    std::snprintf(detail.text, sizeof detail.text, "the X11 server shows %u bits a pixel, not 24",
                  static_cast<unsigned>(screen_->root_depth));
    return Fault::screen_no_mode;
  }
  flip_timeout_ns_ = settings.flip_timeout_ns;
  width_px_ = window_width_px_ = settings.width_px;
  height_px_ = window_height_px_ = settings.height_px;
  make_window(settings.title);
  wait_mapped(2'000'000'000);
  draw_failure_picture();
  std::snprintf(description_, sizeof description_, "x11 window %dx%d at %.60s", width_px_,
                height_px_, told == nullptr ? "" : told);
  return gone();
}

void X11Output::make_window(const char* title) {
  const auto width = static_cast<std::uint16_t>(width_px_);
  const auto height = static_cast<std::uint16_t>(height_px_);
  const std::array<std::uint32_t, 2> values{screen_->black_pixel, XCB_EVENT_MASK_STRUCTURE_NOTIFY};
  window_ = xcb_generate_id(server_);
  xcb_create_window(server_, XCB_COPY_FROM_PARENT, window_, screen_->root, 0, 0, width, height, 0,
                    XCB_WINDOW_CLASS_INPUT_OUTPUT, screen_->root_visual,
                    XCB_CW_BACK_PIXEL | XCB_CW_EVENT_MASK, values.data());
  xcb_change_property(server_, XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_NAME, XCB_ATOM_STRING, 8,
                      static_cast<std::uint32_t>(std::strlen(title)), title);
  const auto hints = size_hints(width, height);
  xcb_change_property(server_, XCB_PROP_MODE_REPLACE, window_, XCB_ATOM_WM_NORMAL_HINTS,
                      XCB_ATOM_WM_SIZE_HINTS, 32, hints.size(), hints.data());
  close_message_ = atom("WM_DELETE_WINDOW");
  xcb_change_property(server_, XCB_PROP_MODE_REPLACE, window_, atom("WM_PROTOCOLS"), XCB_ATOM_ATOM,
                      32, 1, &close_message_);
  xcb_map_window(server_, window_);
  xcb_flush(server_);
}

/// Until the window is there, what is drawn would be lost. Not for ever: a window manager may keep
/// it hidden, and show it later with the picture of then.
void X11Output::wait_mapped(std::int64_t timeout_ns) {
  const std::int64_t deadline_ns = screen_time_ns() + timeout_ns;
  while (xcb_connection_has_error(server_) == 0 && screen_time_ns() < deadline_ns) {
    const Reply<xcb_generic_event_t> event(xcb_poll_for_event(server_));
    if (event != nullptr) {
      take(*event);  // a window manager may say what size it gives before it shows the window
      if ((event->response_type & 0x7f) == XCB_MAP_NOTIFY) return;
      continue;
    }
    pollfd told{xcb_get_file_descriptor(server_), POLLIN, 0};
    ::poll(&told, 1, 50);
  }
}

/// Drawn once and kept by the server, which can then show it when this program's OpenGL cannot.
void X11Output::draw_failure_picture() {
  const auto width = static_cast<std::uint16_t>(width_px_);
  const auto height = static_cast<std::uint16_t>(height_px_);
  failure_ = xcb_generate_id(server_);
  xcb_create_pixmap(server_, screen_->root_depth, failure_, window_, width, height);
  const xcb_gcontext_t pen = xcb_generate_id(server_);
  std::array<std::uint32_t, 2> style{screen_->black_pixel,
                                     static_cast<std::uint32_t>(failure_line_px(width_px_))};
  xcb_create_gc(server_, pen, failure_, XCB_GC_FOREGROUND | XCB_GC_LINE_WIDTH, style.data());
  const xcb_rectangle_t all{0, 0, width, height};
  xcb_poly_fill_rectangle(server_, failure_, pen, 1, &all);
  style[0] = failure_colour;
  xcb_change_gc(server_, pen, XCB_GC_FOREGROUND, style.data());
  const auto right = static_cast<std::int16_t>(width_px_);
  const auto bottom = static_cast<std::int16_t>(height_px_);
  const std::array<xcb_segment_t, 2> cross{xcb_segment_t{0, 0, right, bottom},
                                           xcb_segment_t{0, bottom, right, 0}};
  xcb_poly_segment(server_, failure_, pen, cross.size(), cross.data());
  xcb_free_gc(server_, pen);
  xcb_flush(server_);
}

Status X11Output::attach(EglContext& context, ScreenDetail& detail) {
  context_ = &context;
  if (opened_) return {};  // a new context draws to the same EGL surface
  if (const Status opened = context.open_window(&window_); !opened) {
    std::snprintf(detail.text, sizeof detail.text, "%s: no EGL surface", description_);
    return opened;
  }
  opened_ = true;
  return {};
}

void X11Output::take_events() {
  while (xcb_generic_event_t* next = xcb_poll_for_event(server_)) {
    const Reply<xcb_generic_event_t> event(next);
    take(*event);
  }
}

void X11Output::take(const xcb_generic_event_t& event) {
  switch (event.response_type & 0x7f) {
    case XCB_CONFIGURE_NOTIFY: {
      const auto& now = reinterpret_cast<const xcb_configure_notify_event_t&>(event);
      window_width_px_ = now.width;
      window_height_px_ = now.height;
      break;
    }
    case XCB_CLIENT_MESSAGE: {
      const auto& told = reinterpret_cast<const xcb_client_message_event_t&>(event);
      closed_ = closed_ || told.data.data32[0] == close_message_;
      break;
    }
    case XCB_DESTROY_NOTIFY:
      closed_ = true;
      break;
    default:
      break;
  }
}

/// The server answers in order: with the answer it has also shown what was sent before.
Status X11Output::ask() {
  question_ = xcb_get_input_focus(server_);
  asked_ = true;
  return xcb_flush(server_) > 0 ? Fault::none : Fault::screen_lost;
}

bool X11Output::take_answer() {
  void* reply = nullptr;
  xcb_generic_error_t* error = nullptr;
  if (xcb_poll_for_reply(server_, question_.sequence, &reply, &error) == 0) return false;
  std::free(reply);
  std::free(error);
  if (xcb_connection_has_error(server_) != 0) return false;
  asked_ = false;
  if (pending_ != 0) shown_ = {pending_, screen_time_ns(), 0};
  pending_ = 0;
  return true;
}

ShownStamp X11Output::shown() {
  if (asked_) take_answer();
  return shown_;
}

Status X11Output::wait_shown() {
  const std::int64_t deadline_ns = screen_time_ns() + flip_timeout_ns_;
  take_events();
  while (asked_ && !take_answer()) {
    if (const Status lost = gone(); !lost) return lost;
    const std::int64_t left_ns = deadline_ns - screen_time_ns();
    if (left_ns <= 0) return Fault::screen_flip_late;
    const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
    pollfd told{xcb_get_file_descriptor(server_), POLLIN, 0};
    ::ppoll(&told, 1, &left, nullptr);
  }
  return gone();
}

Result<PictureTarget> X11Output::begin() {
  if (const Status waited = wait_shown(); !waited) return waited.fault();
  // Asked once more, now: the driver will ask the server for the window's size and wait without
  // end.
  if (const Status asked = ask(); !asked) return asked.fault();
  if (const Status waited = wait_shown(); !waited) return waited.fault();
  if (window_width_px_ < width_px_ || window_height_px_ < height_px_) return Fault::screen_small;
  PictureTarget target;
  target.x = (window_width_px_ - width_px_) / 2;
  target.y = (window_height_px_ - height_px_) / 2;
  target.clear = window_width_px_ != width_px_ || window_height_px_ != height_px_;
  return target;
}

Status X11Output::show(std::uint64_t picture) {
  if (failed_) {
    xcb_change_window_attributes(server_, window_, XCB_CW_BACK_PIXEL, &screen_->black_pixel);
    failed_ = false;
  }
  if (const Status swapped = context_->swap(); !swapped) return swapped;
  pending_ = picture;
  return ask();
}

void X11Output::show_failed() {
  if (xcb_connection_has_error(server_) != 0) return;
  failed_ = true;
  // As the window's ground the server itself draws it again after the window was covered.
  xcb_change_window_attributes(server_, window_, XCB_CW_BACK_PIXMAP, &failure_);
  xcb_clear_area(server_, 0, window_, 0, 0, 0, 0);
  xcb_flush(server_);
}

}  // namespace

ScreenMade make_x11_output(const ScreenSettings& settings, ScreenDetail& detail) {
  auto made = std::make_unique<X11Output>();
  if (const Status opened = made->open(settings, detail); !opened) return opened.fault();
  return {std::move(made)};
}

}  // namespace ridgeline
