// Marks pixels beside a superpixel that contrast with its colour: they may show a part of a detail that their centres miss.
#ifndef SEEN_BESIDE_GLSL
#define SEEN_BESIDE_GLSL
#include "contrast.glsl"

// Marks those of the 8 neighbours of a superpixel that are no superpixels and contrast with it. `code` is its display code.
void mark_contrasting_neighbours(uvec2 pixel, uint code) {
    uint tile_count = frame.tiles.x * frame.tiles.y;
    // ROLLED, see workarounds.glsl.
    ivec2 way = ivec2(-1);
    do {
        ivec2 there = ivec2(pixel) + way;
        bool exists = way != ivec2(0) && all(greaterThanEqual(there, ivec2(0))) && all(lessThan(there, ivec2(frame.size)));
        uvec2 beside = exists ? uvec2(there) : pixel;
        uint seen = texelFetch(display, int(beside.y * frame.size.x + beside.x)).x;
        uint tile = beside.y / 4u * frame.tiles.x + beside.x / 8u, bit = 1u << (beside.y % 4u * 8u + beside.x % 8u);
        bool differs = contrasting(spread(code), spread(seen)) || abs(int(code >> 24) - int(seen >> 24)) > int(frame.contrast);
        if (exists && differs && (masks[tile] & bit) == 0u) atomicOr(marks[tile_count + tile], bit);
        way = way.x < 1 ? ivec2(way.x + 1, way.y) : ivec2(-1, way.y + 1);
    } while (way.y <= 1);
}

#endif
