// The LOAD_WORDS words of a tile in the buffer that `distribute` sorts a list's locations by: for each pixel how many there are, later its first
// place in the order; then the tile's first place, its locations, and its first group.
#ifndef TILE_LOCATIONS_GLSL
#define TILE_LOCATIONS_GLSL
#include "interface.glsl"

// A tile's locations follow a Morton curve through its pixels. The number in its tile, row by row, of the pixel at a place of it.
uint bit_at(uint place) { return (place & 1u) | (place >> 1 & 2u) | (place >> 2 & 4u) | (place & 2u) << 2 | (place & 8u) << 1; }

// The place of a pixel.
uint morton_of(uvec2 pixel) {
    return (pixel.x & 1u) | (pixel.y & 1u) << 1 | (pixel.x & 2u) << 1 | (pixel.y & 2u) << 2 | (pixel.x & 4u) << 2;
}

#endif
