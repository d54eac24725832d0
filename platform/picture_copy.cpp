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

Status PictureCopy::copy(GLuint colour, int width_px, int height_px, const PictureTarget& target,
                         std::int64_t timeout_ns) const {
  if (!target.none) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.name());
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
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
    // Else the texture would outlive its owner here.
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  }
  if (const Status finished = finish(timeout_ns); !finished) return finished;
  return take_errors();
}

}  // namespace ridgeline
