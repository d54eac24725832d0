#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>
#include <gbm.h>
#include <sys/mman.h>
#include <xf86drm.h>

// After the header whose types it needs.
#include <GLES2/gl2ext.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "platform/flip_events.hpp"
#include "platform/kms_card.hpp"
#include "platform/screen_output.hpp"

namespace ridgeline {
namespace {

/// A buffer that both the card and OpenGL know.
struct SharedBuffer {
  gbm_bo* memory = nullptr;
  std::uint32_t card_name = 0;
  EGLImageKHR image = EGL_NO_IMAGE_KHR;
  GLuint renderbuffer = 0;
  GLuint framebuffer = 0;
};

/// A buffer drawn by the CPU, once.
struct DrawnBuffer {
  std::uint32_t memory = 0;
  std::uint32_t card_name = 0;
};

/// A monitor by mode setting: two buffers take turns, a third holds the failure picture.
class KmsOutput final : public ScreenOutput {
 public:
  KmsOutput(std::unique_ptr<KmsCard> card, std::int64_t flip_timeout_ns)
      : card_(std::move(card)), events_(card_->file()), flip_timeout_ns_(flip_timeout_ns) {}
  ~KmsOutput() override;
  /// Errors: screen_refused.
  Status make_buffers(ScreenDetail& detail);

  [[nodiscard]] EglPlace place() const override {
    return {EGL_PLATFORM_GBM_MESA, device_, nullptr, 0};
  }
  [[nodiscard]] Status attach(EglContext& context, ScreenDetail& detail) override;
  void detach() override;
  [[nodiscard]] Result<PictureTarget> begin() override;
  [[nodiscard]] Status show(std::uint64_t picture) override;
  [[nodiscard]] Status wait_shown() override;
  [[nodiscard]] ShownStamp shown() override;
  void show_failed() override;
  [[nodiscard]] int width_px() const override { return card_->width_px(); }
  [[nodiscard]] int height_px() const override { return card_->height_px(); }
  [[nodiscard]] const char* description() const override { return card_->description(); }

 private:
  [[nodiscard]] Status make_failure_picture();
  [[nodiscard]] Status attach(SharedBuffer& buffer);
  void take(const FlipEvent& event);

  std::unique_ptr<KmsCard> card_;
  FlipEvents events_;
  std::int64_t flip_timeout_ns_;
  gbm_device* device_ = nullptr;
  std::array<SharedBuffer, 2> buffers_{};
  DrawnBuffer failure_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  int free_ = 0;               ///< the buffer that the card neither shows nor is about to
  std::uint64_t pending_ = 0;  ///< number of the picture whose flip has not happened; 0: none
  bool mode_set_ = false;
  bool begun_ = false;  ///< the screen is ours and was black once
  ShownStamp shown_;
};

KmsOutput::~KmsOutput() {
  for (SharedBuffer& buffer : buffers_) {
    if (buffer.card_name != 0) card_->remove_buffer(buffer.card_name);
    if (buffer.memory != nullptr) gbm_bo_destroy(buffer.memory);
  }
  if (failure_.card_name != 0) card_->remove_buffer(failure_.card_name);
  if (device_ != nullptr) gbm_device_destroy(device_);
}

Status KmsOutput::make_buffers(ScreenDetail& detail) {
  device_ = gbm_create_device(card_->file());
  if (device_ == nullptr) {
    std::snprintf(detail.text, sizeof detail.text, "%s: no GBM device", description());
    return Fault::screen_refused;
  }
  for (SharedBuffer& buffer : buffers_) {
    buffer.memory = gbm_bo_create(device_, static_cast<std::uint32_t>(width_px()),
                                  static_cast<std::uint32_t>(height_px()), GBM_FORMAT_XRGB8888,
                                  GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING);
    if (buffer.memory == nullptr) {
      std::snprintf(detail.text, sizeof detail.text, "%s: no buffer: %s", description(),
                    std::strerror(errno));
      return Fault::screen_refused;
    }
    const auto added =
        card_->add_buffer(gbm_bo_get_handle(buffer.memory).u32, gbm_bo_get_stride(buffer.memory));
    if (!added) {
      std::snprintf(detail.text, sizeof detail.text, "%s: the card refuses the buffer: %s",
                    description(), std::strerror(errno));
      return added.fault();
    }
    buffer.card_name = added.value();
  }
  return make_failure_picture();
}

Status KmsOutput::make_failure_picture() {
  drm_mode_create_dumb made{};
  made.width = static_cast<std::uint32_t>(width_px());
  made.height = static_cast<std::uint32_t>(height_px());
  made.bpp = 32;
  if (drmIoctl(card_->file(), DRM_IOCTL_MODE_CREATE_DUMB, &made) != 0) return Fault::screen_refused;
  failure_.memory = made.handle;  // closing the card frees it
  drm_mode_map_dumb map{};
  map.handle = made.handle;
  if (drmIoctl(card_->file(), DRM_IOCTL_MODE_MAP_DUMB, &map) != 0) return Fault::screen_refused;
  void* pixels = ::mmap(nullptr, made.size, PROT_READ | PROT_WRITE, MAP_SHARED, card_->file(),
                        static_cast<off_t>(map.offset));
  if (pixels == MAP_FAILED) return Fault::screen_refused;
  draw_failure_picture(static_cast<std::uint32_t*>(pixels), made.pitch / 4, width_px(),
                       height_px());
  ::munmap(pixels, made.size);
  const auto added = card_->add_buffer(made.handle, made.pitch);
  if (!added) return added.fault();
  failure_.card_name = added.value();
  return {};
}

Status KmsOutput::attach(EglContext& context, ScreenDetail& detail) {
  display_ = context.display();
  for (SharedBuffer& buffer : buffers_) {
    if (const Status attached = attach(buffer); !attached) {
      std::snprintf(detail.text, sizeof detail.text, "%s: OpenGL cannot draw to its buffers",
                    description());
      return attached;
    }
    if (begun_) continue;
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  if (begun_) return {};
  glFinish();
  if (const Status set = card_->set_mode(buffers_[0].card_name); !set) {
    std::snprintf(detail.text, sizeof detail.text, "%s: the card refuses the mode: %s",
                  description(), std::strerror(errno));
    return set;
  }
  free_ = 1;
  begun_ = mode_set_ = true;
  return {};
}

Status KmsOutput::attach(SharedBuffer& buffer) {
  const auto create =
      reinterpret_cast<PFNEGLCREATEIMAGEKHRPROC>(eglGetProcAddress("eglCreateImageKHR"));
  const auto bind = reinterpret_cast<PFNGLEGLIMAGETARGETRENDERBUFFERSTORAGEOESPROC>(
      eglGetProcAddress("glEGLImageTargetRenderbufferStorageOES"));
  const auto* able = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  if (create == nullptr || bind == nullptr || able == nullptr ||
      std::strstr(able, "GL_OES_EGL_image") == nullptr) {
    return Fault::egl_unavailable;
  }
  buffer.image = create(display_, EGL_NO_CONTEXT, EGL_NATIVE_PIXMAP_KHR, buffer.memory, nullptr);
  if (buffer.image == EGL_NO_IMAGE_KHR) return Fault::egl_unavailable;
  glGenRenderbuffers(1, &buffer.renderbuffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.renderbuffer);
  bind(GL_RENDERBUFFER, buffer.image);
  glGenFramebuffers(1, &buffer.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, buffer.framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                            buffer.renderbuffer);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE
             ? Fault::none
             : Fault::gl_out_of_memory;
}

void KmsOutput::detach() {
  const auto destroy =
      reinterpret_cast<PFNEGLDESTROYIMAGEKHRPROC>(eglGetProcAddress("eglDestroyImageKHR"));
  for (SharedBuffer& buffer : buffers_) {
    glDeleteFramebuffers(1, &buffer.framebuffer);
    glDeleteRenderbuffers(1, &buffer.renderbuffer);
    if (buffer.image != EGL_NO_IMAGE_KHR) destroy(display_, buffer.image);
    buffer.framebuffer = buffer.renderbuffer = 0;
    buffer.image = EGL_NO_IMAGE_KHR;
  }
}

void KmsOutput::take(const FlipEvent& event) {
  if (event.picture != pending_) return;  // of a flip that was given up
  shown_ = {pending_, event.time_ns, event.vertical_blank};
  pending_ = 0;
}

Status KmsOutput::wait_shown() {
  while (pending_ != 0) {
    const auto event = events_.next(flip_timeout_ns_);
    if (event) {
      take(event.value());
      continue;
    }
    // Asked for once more: where the flip happened and only its event was lost, the next call has
    // it; where it did not, the card says so and nothing changes.
    if (event.fault() == Fault::screen_flip_late) {
      (void)card_->flip(buffers_[static_cast<std::size_t>(1 - free_)].card_name, pending_);
    }
    return event.fault();
  }
  return {};
}

ShownStamp KmsOutput::shown() {
  while (pending_ != 0) {
    const auto event = events_.next(0);
    if (!event) break;
    take(event.value());
  }
  return shown_;
}

Result<PictureTarget> KmsOutput::begin() {
  if (!card_->plugged()) {
    mode_set_ = false;  // what comes back may be another monitor, and is off
    return Fault::screen_no_monitor;
  }
  if (const Status waited = wait_shown(); !waited) return waited.fault();
  PictureTarget target;
  target.framebuffer = buffers_[static_cast<std::size_t>(free_)].framebuffer;
  target.top_first = true;
  return target;
}

Status KmsOutput::show(std::uint64_t picture) {
  const std::uint32_t buffer = buffers_[static_cast<std::size_t>(free_)].card_name;
  if (!mode_set_) {
    if (const Status set = card_->set_mode(buffer); !set) return set;
    mode_set_ = true;
    shown_ = {picture, screen_time_ns(), 0};
  } else if (const Status asked = card_->flip(buffer, picture); !asked) {
    mode_set_ = false;  // someone else may have had the card and left it in another mode, or off
    return asked;
  } else {
    pending_ = picture;
  }
  free_ = 1 - free_;
  return {};
}

void KmsOutput::show_failed() {
  if (!card_->set_mode(failure_.card_name)) return;
  mode_set_ = true;
  pending_ = 0;  // a mode set ends every flip
}

}  // namespace

ScreenMade make_kms_output(const ScreenSettings& settings, ScreenDetail& detail) {
  auto card = KmsCard::open(settings, detail);
  if (!card) return card.fault();
  auto made = std::make_unique<KmsOutput>(std::move(card).value(), settings.flip_timeout_ns);
  if (const Status buffers = made->make_buffers(detail); !buffers) return buffers.fault();
  return {std::move(made)};
}

}  // namespace ridgeline
