#include "tests/screen/x_server.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace ridgeline::test {
namespace {

[[noreturn]] void give_up(const char* why) {
  std::fprintf(stderr, "x_server: %s\n", why);
  std::exit(1);
}

xcb_atom_t atom(xcb_connection_t* client, const char* name) {
  auto* reply = xcb_intern_atom_reply(
      client, xcb_intern_atom(client, 0, static_cast<std::uint16_t>(std::strlen(name)), name),
      nullptr);
  const xcb_atom_t found = reply->atom;
  std::free(reply);
  return found;
}

}  // namespace

XServer::XServer() {
  std::array<int, 2> told{};
  if (::pipe(told.data()) != 0) give_up("no pipe");
  process_ = ::fork();
  if (process_ == 0) {
    ::close(told[0]);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // not to outlive a test that crashes
    const int quiet = ::open("/dev/null", O_WRONLY);
    ::dup2(quiet, 2);
    const std::string number = std::to_string(told[1]);
    ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "640x480x24",
             "-nolisten", "tcp", "-noreset", nullptr);
    ::_exit(127);
  }
  ::close(told[1]);
  std::array<char, 16> number{};
  std::size_t used = 0;
  while (used + 1 < number.size() && std::strchr(number.data(), '\n') == nullptr) {
    const ssize_t count = ::read(told[0], number.data() + used, number.size() - 1 - used);
    if (count <= 0) give_up("Xvfb does not start (config/install-deps)");
    used += static_cast<std::size_t>(count);
  }
  ::close(told[0]);
  name_ = ":" + std::to_string(std::atoi(number.data()));
  client_ = xcb_connect(name_.c_str(), nullptr);
  if (xcb_connection_has_error(client_) != 0) give_up("Xvfb does not answer");
  screen_ = xcb_setup_roots_iterator(xcb_get_setup(client_)).data;
}

XServer::~XServer() {
  xcb_disconnect(client_);
  kill();
}

void XServer::kill() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

void XServer::stop() const {
  ::kill(process_, SIGSTOP);
}

void XServer::go_on() const {
  ::kill(process_, SIGCONT);
}

bool XServer::becomes(int x, int y, std::uint32_t colour) {
  for (int wait = 0; wait < 100; ++wait) {
    if (window_pixels().at(x, y) == colour) return true;
    ::usleep(10'000);
  }
  return false;
}

xcb_window_t XServer::window() {
  auto* tree = xcb_query_tree_reply(client_, xcb_query_tree(client_, screen_->root), nullptr);
  if (tree == nullptr || xcb_query_tree_children_length(tree) != 1) give_up("not one window");
  const xcb_window_t found = *xcb_query_tree_children(tree);
  std::free(tree);
  return found;
}

/// A reply proves that the server has done all that was asked before.
void XServer::settle() {
  std::free(xcb_get_input_focus_reply(client_, xcb_get_input_focus(client_), nullptr));
}

XServer::Pixels XServer::window_pixels() {
  const xcb_window_t seen = window();
  auto* shape = xcb_get_geometry_reply(client_, xcb_get_geometry(client_, seen), nullptr);
  if (shape == nullptr) give_up("no window");
  Pixels pixels{shape->width, shape->height, {}};
  std::free(shape);
  auto* image =
      xcb_get_image_reply(client_,
                          xcb_get_image(client_, XCB_IMAGE_FORMAT_Z_PIXMAP, seen, 0, 0,
                                        static_cast<std::uint16_t>(pixels.width_px),
                                        static_cast<std::uint16_t>(pixels.height_px), ~0U),
                          nullptr);
  if (image == nullptr) give_up("the window cannot be read");
  pixels.rows.resize(static_cast<std::size_t>(pixels.width_px) *
                     static_cast<std::size_t>(pixels.height_px));
  if (static_cast<std::size_t>(xcb_get_image_data_length(image)) != 4 * pixels.rows.size()) {
    give_up("the window's picture has another size");
  }
  std::memcpy(pixels.rows.data(), xcb_get_image_data(image), 4 * pixels.rows.size());
  std::free(image);
  return pixels;
}

void XServer::resize_window(int width_px, int height_px) {
  const std::array<std::uint32_t, 2> size{static_cast<std::uint32_t>(width_px),
                                          static_cast<std::uint32_t>(height_px)};
  xcb_configure_window(client_, window(), XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT,
                       size.data());
  settle();
}

void XServer::ask_to_close() {
  xcb_client_message_event_t message{};
  message.response_type = XCB_CLIENT_MESSAGE;
  message.format = 32;
  message.window = window();
  message.type = atom(client_, "WM_PROTOCOLS");
  message.data.data32[0] = atom(client_, "WM_DELETE_WINDOW");
  xcb_send_event(client_, 0, message.window, XCB_EVENT_MASK_NO_EVENT,
                 reinterpret_cast<const char*>(&message));
  settle();
}

void XServer::cover_window() {
  const xcb_window_t cover = xcb_generate_id(client_);
  xcb_create_window(client_, XCB_COPY_FROM_PARENT, cover, screen_->root, 0, 0, 640, 480, 0,
                    XCB_WINDOW_CLASS_INPUT_OUTPUT, screen_->root_visual, XCB_CW_BACK_PIXEL,
                    &screen_->white_pixel);
  xcb_map_window(client_, cover);
  settle();
  xcb_destroy_window(client_, cover);
  settle();
}

}  // namespace ridgeline::test
