#include "tests/screen/wayland_server.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <wayland-server.h>
#include <xdg-shell-server-protocol.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/screen/wayland_state.hpp"

namespace ridgeline::test {
namespace {

int listening_at(const std::string& path) {
  const int file = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "%s", path.c_str());
  if (file < 0 || ::bind(file, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(file, 4) != 0) {
    std::fprintf(stderr, "wayland_server: no socket at %s\n", path.c_str());
    std::exit(1);
  }
  return file;
}

}  // namespace

WaylandServer::WaylandServer(const WaylandServerSettings& settings)
    : socket_(folder_.file("socket")), state_(std::make_unique<WaylandState>(settings)) {
  stopped_ = !settings.answers;
  wl_display_add_socket_fd(state_->display, listening_at(socket_));
  thread_ = std::thread([this] { run(); });
}

WaylandServer::~WaylandServer() {
  end_ = true;
  thread_.join();
}

void WaylandServer::run() {
  while (!end_) {
    {
      const std::lock_guard lock(mutex_);
      if (task_ != nullptr) (*task_)();
      // Told before the test goes on.
      if (task_ != nullptr && !stopped_ && state_->display != nullptr) {
        wl_display_flush_clients(state_->display);
      }
      task_ = nullptr;
    }
    done_.notify_all();
    if (stopped_ || state_->display == nullptr) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    wl_display_flush_clients(state_->display);
    wl_event_loop_dispatch(wl_display_get_event_loop(state_->display), 1);
  }
  state_->kill();
}

/// Done on the compositor's thread, and done when this returns.
void WaylandServer::call(const std::function<void()>& task) {
  std::unique_lock lock(mutex_);
  task_ = &task;
  done_.wait(lock, [&] { return task_ == nullptr; });
}

SeenPixels WaylandServer::window_pixels() {
  SeenPixels seen;
  call([&] { seen = state_->seen; });
  return seen;
}

bool WaylandServer::becomes(int x, int y, std::uint32_t colour) {
  for (int wait = 0; wait < 100; ++wait) {
    if (window_pixels().at(x, y) == colour) return true;
    ::usleep(10'000);
  }
  return false;
}

std::string WaylandServer::broken_rules() {
  std::string rules;
  call([&] {
    state_->look_at_held();
    rules = state_->broken;
  });
  return rules;
}

int WaylandServer::pictures_taken() {
  int count = 0;
  call([&] { count = state_->pictures; });
  return count;
}

std::string WaylandServer::title() {
  std::string text;
  call([&] { text = state_->title; });
  return text;
}

WaylandServer::Size WaylandServer::least_size() {
  Size size;
  call([&] { size = state_->least; });
  return size;
}

WaylandServer::Size WaylandServer::largest_size() {
  Size size;
  call([&] { size = state_->largest; });
  return size;
}

int WaylandServer::scale_of_window() {
  int scale = 0;
  call([&] { scale = state_->scale; });
  return scale;
}

void WaylandServer::hide_window(bool hidden) {
  call([&] {
    state_->hidden = hidden;
    if (!hidden) state_->show();
  });
}

void WaylandServer::keep_buffers(bool keep) {
  call([&] {
    state_->keep_buffers = keep;
    if (keep) return;
    for (const auto& one : state_->held) wl_buffer_send_release(one.buffer);
    state_->held.clear();
  });
}

void WaylandServer::forget_questions(bool forget) {
  call([&] {
    state_->forgetful = forget;
    if (!forget && !state_->hidden) state_->show();
  });
}

int WaylandServer::open_questions() {
  int count = 0;
  call([&] { count = static_cast<int>(state_->asked.size()); });
  return count;
}

void WaylandServer::stop() {
  call([&] { stopped_ = true; });
}

void WaylandServer::go_on() {
  call([&] { stopped_ = false; });
}

void WaylandServer::kill() {
  call([&] {
    state_->held.clear();
    state_->kill();
  });
}

void WaylandServer::accuse(const char* text) {
  call([&] {
    state_->held.clear();
    wl_resource_post_error(state_->shell, XDG_WM_BASE_ERROR_INVALID_SURFACE_STATE, "%s", text);
  });
}

void WaylandServer::close_window() {
  call([&] { xdg_toplevel_send_close(state_->window); });
}

void WaylandServer::size_window(int width, int height, bool maximized, bool fullscreen) {
  call([&] { state_->tell_size({width, height}, maximized, fullscreen); });
}

int WaylandServer::asked_for_less() {
  int times = 0;
  call([&] { times = state_->asked_for_less; });
  return times;
}

void WaylandServer::ping() {
  call([&] { xdg_wm_base_send_ping(state_->shell, static_cast<std::uint32_t>(++state_->pings)); });
}

bool WaylandServer::has_answered() {
  bool all = false;
  for (int wait = 0; wait < 100 && !all; ++wait) {
    call([&] { all = state_->pings > 0 && state_->pongs == state_->pings; });
    if (!all) ::usleep(10'000);
  }
  return all;
}

void WaylandServer::show_on_output_of_scale(int scale) {
  call([&] {
    state_->output_scale = scale;
    wl_output_send_scale(state_->output, scale);
    wl_output_send_done(state_->output);
    wl_surface_send_enter(state_->surface, state_->output);
  });
}

void WaylandServer::unplug_output() {
  call([&] { wl_global_remove(state_->output_global); });
}

}  // namespace ridgeline::test
