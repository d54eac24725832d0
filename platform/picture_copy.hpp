#pragma once
#include <cstdint>

#include "core/render/gl_object.hpp"
#include "platform/screen_output.hpp"

namespace ridgeline {

/// Copies a finished picture, texel for pixel, to where a screen wants it, and waits for the GPU.
class PictureCopy {
 public:
  /// Makes its one GL object in the current context.
  PictureCopy();

  /// Domain: `colour` is a texture of width_px x height_px, row 0 at the bottom.
  /// Errors: gl_late after `timeout_ns`, gl_error for whatever the frame did wrong.
  [[nodiscard]] Status copy(GLuint colour, int width_px, int height_px, const PictureTarget& target,
                            std::int64_t timeout_ns) const;

 private:
  static void blit(int width_px, int height_px, const PictureTarget& target);
  static void read(int width_px, int height_px, const PictureTarget& target);
  Framebuffer source_;
};

}  // namespace ridgeline
