// How `distribute` orders the locations of a tile. A buffer has LOAD_WORDS words for each tile: for each pixel its number of
// locations, later its first place in the order; then the tile's first place, number of locations, and first group.
#ifndef TILE_LOCATIONS_GLSL
#define TILE_LOCATIONS_GLSL
#include "interface.glsl"

// Words of a tile behind those of its 32 pixels.
#define LOAD_FIRST 32u
#define LOAD_COUNT 33u
#define LOAD_FIRST_GROUP 34u

// A tile's locations follow a Morton curve through its pixels. The number, row by row in its tile, of the pixel at a place of the
// curve.
uint bit_at(uint place) { return (place & 1u) | (place >> 1 & 2u) | (place >> 2 & 4u) | (place & 2u) << 2 | (place & 8u) << 1; }

// The place of a pixel on the curve.
uint morton_of(uvec2 pixel) {
    return (pixel.x & 1u) | (pixel.y & 1u) << 1 | (pixel.x & 2u) << 1 | (pixel.y & 2u) << 2 | (pixel.x & 4u) << 2;
}

#endif
