// Where a location of a list lies in its tile of 8 x 4 pixels. All passes call this function, and so get the same bits.
#ifndef PLACE_IN_TILE_GLSL
#define PLACE_IN_TILE_GLSL

// The position relative to the tile's centre. `at` is the location's first vector: pixel x, y as signed integers, place in the
// pixel x, y from 0 to 1 as floats.
vec2 place_in_tile(uvec4 at) { return vec2((ivec2(at.xy) & ivec2(7, 3)) - ivec2(4, 2)) + uintBitsToFloat(at.zw); }

#endif
