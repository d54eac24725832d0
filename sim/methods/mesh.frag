in float unknown;
in vec2 at;
flat in int level;

void main() {
  if (level > 0) {  // where a finer level is, that is drawn
    vec4 finer = vec4(level_rect[level - 1]);
    if (all(greaterThan(at, finer.xy)) && all(lessThan(at, finer.zw))) discard;
  }
  put_ground(unknown);
}
