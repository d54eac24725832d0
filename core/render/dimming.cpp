#include "core/render/dimming.hpp"

namespace ridgeline {

void blend_dimmed(float kept, GLenum under) {
  glEnable(GL_BLEND);
  glBlendColor(kept, kept, kept, 1.0F);
  glBlendFunc(kept < 1.0F ? GL_CONSTANT_COLOR : GL_ONE, under);
}

}  // namespace ridgeline
