#pragma once
#include <GLES3/gl31.h>

namespace ridgeline {

/// What colours keep of themselves on their way into the picture, as it is encoded: factors of all
/// three channels alike. 1: everything, and not a bit is touched.
struct Dimming {
  float picture = 1.0F;  ///< ground, sky, line of zero pitch
  float words = 1.0F;
};

/// What is drawn from now on keeps so much of its colours and goes over `under` of what is there:
/// dimming needs no pass, no shader and no uniform.
void blend_dimmed(float kept, GLenum under);

}  // namespace ridgeline
