#pragma once
#include <cstdint>

#include "core/render/gl_object.hpp"

namespace ridgeline::test {

/// A picture drawn by OpenGL whose every pixel is known beforehand: no two rows or columns alike,
/// so that a screen that shifts, mirrors, swaps colours or mixes frames is found out.
class ShownPicture {
 public:
  /// In the current context.
  ShownPicture(int width_px, int height_px);
  /// Draws frame number `frame`; row 0 of the texture is the bottom, as the renderer's.
  void draw(std::uint32_t frame);
  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] GLuint texture() const { return colour_.name(); }

  /// 0x00RRGGBB at column `x`, row `y` from the top.
  [[nodiscard]] static std::uint32_t pixel(std::uint32_t frame, int x, int y);
  /// Pixels of the w x h rows at `shown` (XRGB8888, `stride` pixels apart) that are not the
  /// frame's.
  [[nodiscard]] static int wrong_pixels(std::uint32_t frame, const std::uint32_t* shown,
                                        std::size_t stride, int width_px, int height_px);

 private:
  int width_px_, height_px_;
  Texture colour_;
  Framebuffer target_;
  Program program_;
  VertexArray none_;
};

/// Keeps the GPU busy for a while: a draw of `steps` dependent steps a pixel.
void draw_slowly(const ShownPicture& picture, int steps);

}  // namespace ridgeline::test
