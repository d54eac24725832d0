// One vertex of the refined grid, as loffler_refine.comp left it.
layout(location = 0) in highp vec4 clip;
layout(location = 1) in highp vec4 place;  // post coordinates, normalised error, unknown
out vec2 at;
out float error;
out float unknown;

void main() {
  gl_Position = clip;
  at = place.xy;
  error = place.z;
  unknown = place.w;
}
