#include "platform/picture_copy.hpp"

#include <GLES3/gl31.h>

namespace ridgeline {
namespace {

/// All that was asked of the GPU so far is done.
Status finish(std::int64_t timeout_ns) {
  const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (fence == nullptr) return Fault::gl_error;
  const GLenum waited =
      glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, static_cast<GLuint64>(timeout_ns));
  glDeleteSync(fence);
  if (waited == GL_TIMEOUT_EXPIRED) return Fault::gl_late;
  return waited == GL_WAIT_FAILED ? Fault::gl_error : Fault::none;
}

/// The errors of the whole frame, taken once after the GPU has finished it, when asking is free.
Status take_errors() {
  Status status;
  // A driver holds at most one flag for each of a few kinds; a lost context may go on for ever.
  for (int kind = 0; kind < 8 && glGetError() != GL_NO_ERROR; ++kind) status = Fault::gl_error;
  return status;
}

}  // namespace

PictureCopy::PictureCopy() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  source_ = Framebuffer(name);
}

void PictureCopy::blit(int width_px, int height_px, const PictureTarget& target) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  glDisable(GL_SCISSOR_TEST);
  if (target.clear) {
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  const int bottom = target.top_first ? target.y + height_px : target.y;
  const int top = target.top_first ? target.y : target.y + height_px;
  glBlitFramebuffer(0, 0, width_px, height_px, target.x, bottom, target.x + width_px, top,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void PictureCopy::read(int width_px, int height_px, const PictureTarget& target) {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, target.bytes);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

Status PictureCopy::copy(GLuint colour, int width_px, int height_px, const PictureTarget& target,
                         std::int64_t timeout_ns) const {
  const std::int64_t deadline_ns = screen_time_ns() + timeout_ns;
  if (target.bytes != 0) {
    // A driver may draw the whole picture within the call that reads it, which has no time limit.
    if (const Status drawn = finish(timeout_ns); !drawn) return drawn;
  }
  if (!target.none) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.name());
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    if (target.bytes != 0) {
      read(width_px, height_px, target);
    } else {
      blit(width_px, height_px, target);
    }
    // Else the texture would outlive its owner here.
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  }
  const std::int64_t left_ns = deadline_ns - screen_time_ns();
  if (const Status finished = finish(left_ns > 0 ? left_ns : 0); !finished) return finished;
  return take_errors();
}

}  // namespace ridgeline
