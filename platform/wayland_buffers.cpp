#include "platform/wayland_buffers.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <wayland-client.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

/// A file without a name, of fixed size and with memory behind all of it; -1 and errno.
int memory_file(std::size_t bytes) {
  const int file = ::memfd_create("ridgeline pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0) return -1;
  // Without memory behind it a page that cannot be had later would end the program.
  const int refused = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
  // Sealed, so that the compositor need not fear that it shrinks.
  if (refused == 0 && ::fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0) {
    return file;
  }
  const int why = refused != 0 ? refused : errno;
  ::close(file);
  errno = why;
  return -1;
}

}  // namespace

struct WaylandBuffers::Events {
  static void release(void* data, wl_buffer* /*buffer*/) {
    static_cast<Buffer*>(data)->held = false;
  }
  static constexpr wl_buffer_listener buffer = {release};
};

WaylandBuffers::~WaylandBuffers() {
  for (const Buffer& buffer : buffers_) {
    if (buffer.object != nullptr) wl_buffer_destroy(buffer.object);
  }
  if (memory_ != nullptr) ::munmap(memory_, sizeof *memory_ * pixel_count_ * buffers_.size());
}

Status WaylandBuffers::make(wl_shm* shm, int width_px, int height_px, ScreenDetail& detail) {
  pixel_count_ = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  const std::size_t picture_bytes = sizeof *memory_ * pixel_count_;
  const std::size_t bytes = picture_bytes * buffers_.size();
  const int file = memory_file(bytes);
  void* mapped =
      file < 0 ? MAP_FAILED : ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (mapped == MAP_FAILED) {
    std::snprintf(detail.text, sizeof detail.text, "no memory for four pictures: %s",
                  std::strerror(errno));
    if (file >= 0) ::close(file);
    return Fault::screen_refused;
  }
  memory_ = static_cast<std::uint32_t*>(mapped);
  std::memset(memory_, 0, bytes);
  draw_failure_picture(memory_ + picture_count * pixel_count_, static_cast<std::size_t>(width_px),
                       width_px, height_px);
  for (std::uint32_t& pixel : std::span(memory_, bytes / sizeof *memory_)) pixel |= unused_bits;
  wl_shm_pool* pool = wl_shm_create_pool(shm, file, static_cast<std::int32_t>(bytes));
  std::size_t at = 0;
  for (Buffer& buffer : buffers_) {
    buffer.object = wl_shm_pool_create_buffer(pool, static_cast<std::int32_t>(at), width_px,
                                              height_px, width_px * 4, WL_SHM_FORMAT_XRGB8888);
    wl_buffer_add_listener(buffer.object, &Events::buffer, &buffer);
    at += picture_bytes;
  }
  wl_shm_pool_destroy(pool);  // the buffers keep it
  // A copy of the descriptor is on its way to the compositor.
  ::close(file);
  return {};
}

int WaylandBuffers::free_one() const {
  for (std::size_t i = 0; i < picture_count; ++i) {
    if (!buffers_[i].held) return static_cast<int>(i);
  }
  return -1;
}

std::span<std::uint32_t> WaylandBuffers::pixels(int index) const {
  return {memory_ + static_cast<std::size_t>(index) * pixel_count_, pixel_count_};
}

wl_buffer* WaylandBuffers::handed_over(int index) {
  Buffer& buffer = buffers_[static_cast<std::size_t>(index)];
  buffer.held = true;
  return buffer.object;
}

}  // namespace ridgeline
