#include "tests/screen/wayland_state.hpp"

#include <presentation-time-server-protocol.h>
#include <wayland-server.h>
#include <xdg-shell-server-protocol.h>

#include <algorithm>
#include <cstring>
#include <ctime>

namespace ridgeline::test {
namespace {

WaylandState& state_of(wl_resource* resource) {
  return *static_cast<WaylandState*>(wl_resource_get_user_data(resource));
}

void destroy(wl_client* /*client*/, wl_resource* resource) {
  wl_resource_destroy(resource);
}

/// A new object of the client's, whose end is noted where the state remembers it.
template <wl_resource* WaylandState::*Place = nullptr>
wl_resource* made(wl_client* client, const wl_interface& interface, int version, std::uint32_t id,
                  const void* calls, WaylandState& state) {
  wl_resource* resource = wl_resource_create(client, &interface, version, id);
  wl_resource_set_implementation(resource, calls, &state, [](wl_resource* gone) {
    if constexpr (Place != nullptr) state_of(gone).*Place = nullptr;
  });
  if constexpr (Place != nullptr) state.*Place = resource;
  return resource;
}

void attach(wl_client* /*client*/, wl_resource* surface, wl_resource* buffer, std::int32_t x,
            std::int32_t y) {
  WaylandState& state = state_of(surface);
  if (x != 0 || y != 0) state.break_rule("attached at another place");
  state.attached = buffer;
}

void damage(wl_client* /*client*/, wl_resource* surface, std::int32_t x, std::int32_t y,
            std::int32_t width, std::int32_t height) {
  WaylandState& state = state_of(surface);
  wl_shm_buffer* buffer = state.attached == nullptr ? nullptr : wl_shm_buffer_get(state.attached);
  if (buffer == nullptr || x != 0 || y != 0 || width != wl_shm_buffer_get_width(buffer) ||
      height != wl_shm_buffer_get_height(buffer)) {
    state.break_rule("the damage is not the whole picture");
  }
}

void set_scale(wl_client* /*client*/, wl_resource* surface, std::int32_t scale) {
  state_of(surface).next_scale = scale;
}

void commit(wl_client* /*client*/, wl_resource* surface) {
  state_of(surface).commit();
}

const struct wl_surface_interface surface_calls = {destroy,   attach,  nullptr, nullptr,
                                                   nullptr,   nullptr, commit,  nullptr,
                                                   set_scale, damage,  nullptr};

void create_surface(wl_client* client, wl_resource* compositor, std::uint32_t id) {
  WaylandState& state = state_of(compositor);
  if (state.surface != nullptr) state.break_rule("a second surface");
  state.has_agreed = state.mapped = false;  // one of a client before may have been
  state.told.clear();
  state.held.clear();
  state.asked.clear();
  state.scale = state.next_scale = 1;
  made<&WaylandState::surface>(client, wl_surface_interface, wl_resource_get_version(compositor),
                               id, &surface_calls, state);
}

const struct wl_compositor_interface compositor_calls = {create_surface, nullptr};

void set_title(wl_client* /*client*/, wl_resource* window, const char* title) {
  state_of(window).title = title;
}

void set_app_id(wl_client* /*client*/, wl_resource* /*window*/, const char* /*name*/) {}

void set_largest(wl_client* /*client*/, wl_resource* window, std::int32_t width,
                 std::int32_t height) {
  state_of(window).largest = {width, height};
}

void set_least(wl_client* /*client*/, wl_resource* window, std::int32_t width,
               std::int32_t height) {
  state_of(window).least = {width, height};
}

void ask_for_less(wl_client* /*client*/, wl_resource* window) {
  WaylandState& state = state_of(window);
  ++state.asked_for_less;
  const WaylandState::Told last = state.told.empty() ? state.agreed : state.told.back();
  const bool insists = state.settings.insists;
  state.tell_size(insists ? last.size : WaylandState::Size{}, insists && last.maximized,
                  insists && last.fullscreen);
}

const struct xdg_toplevel_interface window_calls = {
    destroy,     nullptr,   set_title, set_app_id,   nullptr, nullptr,      nullptr,
    set_largest, set_least, nullptr,   ask_for_less, nullptr, ask_for_less, nullptr};

void get_window(wl_client* client, wl_resource* shell_surface, std::uint32_t id) {
  made<&WaylandState::window>(client, xdg_toplevel_interface,
                              wl_resource_get_version(shell_surface), id, &window_calls,
                              state_of(shell_surface));
}

void acknowledge(wl_client* /*client*/, wl_resource* shell_surface, std::uint32_t serial) {
  WaylandState& state = state_of(shell_surface);
  const auto found = std::find_if(state.told.begin(), state.told.end(),
                                  [&](const auto& told) { return told.serial == serial; });
  if (found == state.told.end()) return state.break_rule("acknowledged what was never told");
  state.agreed = *found;
  state.has_agreed = true;
  state.told.erase(state.told.begin(), found + 1);
}

const struct xdg_surface_interface shell_surface_calls = {destroy, get_window, nullptr, nullptr,
                                                          acknowledge};

void get_shell_surface(wl_client* client, wl_resource* shell, std::uint32_t id,
                       wl_resource* /*surface*/) {
  made<&WaylandState::shell_surface>(client, xdg_surface_interface, wl_resource_get_version(shell),
                                     id, &shell_surface_calls, state_of(shell));
}

void pong(wl_client* /*client*/, wl_resource* shell, std::uint32_t /*serial*/) {
  ++state_of(shell).pongs;
}

const struct xdg_wm_base_interface shell_calls = {destroy, nullptr, get_shell_surface, pong};

void ask_when_shown(wl_client* client, wl_resource* presentation, wl_resource* /*surface*/,
                    std::uint32_t id) {
  WaylandState& state = state_of(presentation);
  state.asked_next.push_back(
      made(client, wp_presentation_feedback_interface, 1, id, nullptr, state));
}

const struct wp_presentation_interface presentation_calls = {destroy, ask_when_shown};

template <const wl_interface* Interface, const auto* Calls, wl_resource* WaylandState::*Place>
void bind(wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
  made<Place>(client, *Interface, static_cast<int>(version), id, Calls,
              *static_cast<WaylandState*>(data));
}

void bind_presentation(wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
  auto& state = *static_cast<WaylandState*>(data);
  wl_resource* presentation = made(client, wp_presentation_interface, static_cast<int>(version), id,
                                   &presentation_calls, state);
  wp_presentation_send_clock_id(presentation, state.settings.told_clock != 0
                                                  ? state.settings.told_clock
                                                  : state.settings.clock);
}

void bind_output(wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
  auto& state = *static_cast<WaylandState*>(data);
  wl_resource* output = made<&WaylandState::output>(client, wl_output_interface,
                                                    static_cast<int>(version), id, nullptr, state);
  wl_output_send_scale(output, state.output_scale);
  wl_output_send_done(output);
}

}  // namespace

SeenPixels pixels_of(wl_resource* resource) {
  wl_shm_buffer* buffer = wl_shm_buffer_get(resource);
  if (buffer == nullptr) return {};
  SeenPixels pixels{wl_shm_buffer_get_width(buffer), wl_shm_buffer_get_height(buffer), {}};
  const auto width = static_cast<std::size_t>(pixels.width_px);
  pixels.rows.resize(width * static_cast<std::size_t>(pixels.height_px));
  wl_shm_buffer_begin_access(buffer);
  const auto* from = static_cast<const char*>(wl_shm_buffer_get_data(buffer));
  for (std::size_t y = 0; y < static_cast<std::size_t>(pixels.height_px); ++y) {
    std::memcpy(pixels.rows.data() + y * width,
                from + y * static_cast<std::size_t>(wl_shm_buffer_get_stride(buffer)), 4 * width);
  }
  wl_shm_buffer_end_access(buffer);
  return pixels;
}

WaylandState::WaylandState(const WaylandServerSettings& how)
    : settings(how), display(wl_display_create()) {
  wl_display_init_shm(display);
  wl_global_create(display, &wl_compositor_interface, 4, this,
                   bind<&wl_compositor_interface, &compositor_calls, nullptr>);
  if (settings.shell) {
    wl_global_create(display, &xdg_wm_base_interface, 4, this,
                     bind<&xdg_wm_base_interface, &shell_calls, &WaylandState::shell>);
  }
  if (settings.presentation) {
    wl_global_create(display, &wp_presentation_interface, 1, this, bind_presentation);
  }
  output_global = wl_global_create(display, &wl_output_interface, 3, this, bind_output);
}

WaylandState::~WaylandState() {
  kill();
}

void WaylandState::kill() {
  if (display == nullptr) return;
  wl_display_destroy_clients(display);
  wl_display_destroy(display);
  display = nullptr;
}

void WaylandState::tell_size(Size size, bool maximized, bool fullscreen) {
  wl_array states;
  wl_array_init(&states);
  const auto add = [&](std::uint32_t one) {
    *static_cast<std::uint32_t*>(wl_array_add(&states, sizeof one)) = one;
  };
  if (maximized) add(XDG_TOPLEVEL_STATE_MAXIMIZED);
  if (fullscreen) add(XDG_TOPLEVEL_STATE_FULLSCREEN);
  told.push_back({++serial, size, maximized, fullscreen});
  xdg_toplevel_send_configure(window, size.width, size.height, &states);
  xdg_surface_send_configure(shell_surface, serial);
  wl_array_release(&states);
}

/// As real compositors do: what replaces a picture gives it back, and what was asked of it is
/// answered with no.
void WaylandState::commit() {
  scale = next_scale;
  if (attached == nullptr) {
    if (!settings.sizes || mapped) return;
    const int side = settings.maximized_px;
    return tell_size({side, side}, side > 0, false);
  }
  if (!has_agreed) {
    wl_resource_post_error(shell_surface, XDG_SURFACE_ERROR_UNCONFIGURED_BUFFER,
                           "no size was agreed to");
    return;
  }
  look_at_held();
  Held next{attached, pixels_of(attached)};
  attached = nullptr;
  const int width = next.pixels.width_px / scale, height = next.pixels.height_px / scale;
  if (next.pixels.width_px % scale != 0 || next.pixels.height_px % scale != 0) {
    break_rule("the scale does not divide the picture");
  }
  if ((agreed.maximized && agreed.size != Size{width, height}) ||
      (agreed.fullscreen && (width > agreed.size.width || height > agreed.size.height))) {
    wl_resource_post_error(shell, XDG_WM_BASE_ERROR_INVALID_SURFACE_STATE,
                           "the window has not the size that was agreed to");
    return;
  }
  take_questions();
  const bool again = std::any_of(held.begin(), held.end(),
                                 [&](const Held& one) { return one.buffer == next.buffer; });
  if (again && next.pixels.at(width / 2, height / 2) != 0xE00000) {
    break_rule("a picture came again before it was given back");
  }
  if (!keep_buffers) {
    for (Held& one : held) {
      if (one.buffer != next.buffer) wl_buffer_send_release(one.buffer);
    }
    held.clear();
  }
  seen = next.pixels;
  held.push_back(std::move(next));
  mapped = true;
  ++pictures;
  if (!hidden && !forgetful) show();
}

void WaylandState::take_questions() {
  for (wl_resource* no : asked) {
    if (forgetful) break;
    wp_presentation_feedback_send_discarded(no);
    wl_resource_destroy(no);
  }
  if (!forgetful) asked.clear();
  asked.insert(asked.end(), asked_next.begin(), asked_next.end());
  asked_next.clear();
}

void WaylandState::show() {
  if (surface == nullptr) return asked.clear();  // the client has gone
  timespec now{};
  clock_gettime(static_cast<clockid_t>(settings.clock), &now);
  const auto s = static_cast<std::uint64_t>(now.tv_sec);
  for (wl_resource* yes : asked) {
    wp_presentation_feedback_send_presented(yes, static_cast<std::uint32_t>(s >> 32),
                                            static_cast<std::uint32_t>(s),
                                            static_cast<std::uint32_t>(now.tv_nsec), 16'666'667, 0,
                                            static_cast<std::uint32_t>(pictures), 0);
    wl_resource_destroy(yes);
  }
  asked.clear();
}

void WaylandState::look_at_held() {
  if (surface == nullptr) held.clear();  // the client has gone, and its buffers with it
  for (const Held& one : held) {
    if (pixels_of(one.buffer).rows != one.pixels.rows) {
      break_rule("a picture was written to that the compositor had");
    }
  }
}

}  // namespace ridgeline::test
