// The lists of the pixels of crowded tiles: see refine.comp.
#ifndef REFINED_GLSL
#define REFINED_GLSL
#include "tiles.glsl"

const uint REFINED_HEADER = 8u;     // vectors of a refined list before its entries

// The number of a pixel within its tile.
uint pixel_in_tile(uvec2 pixel) { return (pixel.y & 3u) * 8u + (pixel.x & 7u); }

// The upper left corner of a pixel of a tile, relative to the tile's centre.
vec2 low_of_pixel(uint pixel) { return vec2(pixel & 7u, pixel >> 3) - vec2(4.0, 2.0); }

// The part of its pixel in which a place lies, which is given from 0 to 1. A pixel has 8 x 4 parts.
uint part_at(vec2 within) {
    uvec2 part = min(uvec2(within * vec2(8.0, 4.0)), uvec2(7u, 3u));
    return part.y * 8u + part.x;
}

#endif
