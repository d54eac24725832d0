// Read as C++ and as GLSL: every binding and every uniform block of the renderer, written once.
#ifdef __cplusplus
#pragma once
#include <glm/vec4.hpp>
#define RL_BLOCK(name, number) struct alignas(16) name
#define RL_CONST(name, number) inline constexpr int name = number
namespace ridgeline::shader {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
#else
#define RL_BLOCK(name, number) layout(std140, binding = number) uniform name
// RL_CONST lines become #define lines when the file is embedded (shaders/embed.cmake).
#endif

RL_CONST(frame_block_binding, 0);
RL_CONST(grid_block_binding, 1);
RL_CONST(style_block_binding, 2);
RL_CONST(segment_count, 64);
RL_CONST(most_levels, 6);    // of the terrain window
RL_CONST(node_levels, 6);    // of the pyramid inside a block

// Texture units.
RL_CONST(posts_unit, 0);
RL_CONST(highest_unit, 1);
RL_CONST(nodes_unit, 3);
RL_CONST(range_unit, 4);
RL_CONST(text_unit, 5);
RL_CONST(shaded_unit, 6);
RL_CONST(tiles_unit, 7);
RL_CONST(slopes_unit, 8);

// Bytes of the text layer; 0 is no text.
RL_CONST(text_plate, 60);
RL_CONST(text_warning, 120);
RL_CONST(text_caution, 180);
RL_CONST(text_ink, 255);

// Image units.
RL_CONST(target_image, 0);

// Shader storage buffers.
RL_CONST(planes_buffer, 0);
RL_CONST(counters_buffer, 2);
RL_CONST(steps_buffer, 3);  // of programs that count their steps, which never fly

RL_CONST(tile_list_width, 256);  // texels of a row of tile records

// One frame: pose, window and ground map. Lengths in m; window coordinates in lattice posts, relative
// to the post south-west of the eye; heights over the ellipsoid.
RL_BLOCK(FrameBlock, 0) {
  vec4 ray_dx;        // xyz: change of the ray per pixel to the right, ENU; w: image width
  vec4 ray_dy;        // xyz: per pixel downwards; w: image height
  vec4 ray_origin;    // xyz: ray of the centre of pixel (0, 0); w: display range
  vec4 eye;           // xy: eye in its cell, 0..1; z + w: eye height, high and low part
  vec4 earth;         // x: 1/M; y: 1/N; z: unused; w: eye height, rounded
  vec4 heights;       // x: highest of the window; y: straight way; z: largest node; w: largest step
  vec4 tolerance;     // x: ground distance where the sweep ends; z: 1/range; yw: swell at the range, 03 21
  ivec4 window;       // xy: low bits of the eye's post; z: levels; w: tiles of the picture
  vec4 level_size;    // xy: columns and rows of a level; zw: one over one more, texels
  ivec4 level_eye[6];   // xy: where a level keeps the post south-west of the eye
  ivec4 level_rect[6];  // cells a level can draw: west, south, east, north (ends excluded)
  vec4 level_reach[6];  // x: ground distance up to which its nodes cover a wedge
  vec4 latitude[3];   // ground map in posts, northwards: 01 02 03 04 | 05 20 21 22 | 23 40 41 -
  vec4 longitude[3];  // eastwards: 10 11 12 13 | 14 30 31 32 | 50 - - -
  vec4 ray_target;    // one over the size of, xy: the target that holds the rays; zw: the grid's texture
  vec4 near_cells[9]; // cells round a low eye, about it: height over the eye, per column, per row, per both
  vec4 near_edges;    // of the eye's cell, in posts from the eye: west, east, south, north
  ivec4 near;         // x: 1 when they are used; y: bit k set where cell k is unknown; zw: unused
  vec4 turn;          // xy: cosine and sine of the angle from the eye's east to the lattice's;
                      // zw: one over the size of the texture that holds the nodes
};

// The projected grid of one frame.
RL_BLOCK(GridBlock, 1) {
  vec4 azimuth;    // x: start; y: span; z: segments/span; w: 1 when the circle closes
  vec4 slope;      // x: low; y: high; z: segments/(high - low); w: unused
  ivec4 grid;      // x: planes; y: rows; z: 1 when the grid is used; w: unused
  vec4 planes[64]; // x: first index; y: index per rad
  vec4 rows[64];   // x: first index; y: index per slope
};

// What the picture looks like.
RL_BLOCK(StyleBlock, 2) {
  vec4 sun;          // xyz: direction to the sun, ENU
  vec4 legend;       // x: 1 when terrain is drawn; y: 1 when the attitude is valid; zw: 1/image size
  vec4 post_step;    // xy: posts per metre east and north; z, w: roughness and height of sea, m
  vec4 line;         // x: as grid_step, contours; y: pixels per ray slope; z: width; w: 1/range
  vec4 ground_grid;  // xy: grid lines from the eye's post to the line south-west; zw: lines per post
  vec4 grid_step;    // xy: (metres from line to line / rad per pixel) squared; zw: unused
  vec4 geoid[2];     // undulation by E, N over range: 1 E N EE | EN NN - -
};

#ifdef __cplusplus
}  // namespace ridgeline::shader
#endif
#undef RL_BLOCK
#ifdef __cplusplus
#undef RL_CONST
#endif
