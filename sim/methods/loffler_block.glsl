// What the passes of `loffler` share; filled by sim/methods/loffler.cpp.
layout(std140, binding = 3) uniform LofflerBlock {
  vec4 view_right;    // axes of the view plane; w: height of the eye over the base plane, m
  vec4 view_ahead;    // w: lambda, mean pixels per radian
  vec4 view_upward;   // w: gamma, px
  ivec4 grid_size;    // xy: vertices across and along; z: levels of the relief pyramid; w: 1 to lift
  ivec4 relief_place; // xy: its first post, relative to the eye's; zw: its posts
  ivec4 options;      // x: 1 on a flat Earth; y: 1 to cast from the eye; z: 1 where there are voids
};
