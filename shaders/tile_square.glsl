// A square of a tile (core/render/tile_list.cpp): number of the tile; place in it and side.
layout(location = 0) in highp uvec2 square;
vec3 place_of(uint bits) { return vec3(bits & 0xFFFu, bits >> 12 & 0xFFFu, bits >> 24); }
