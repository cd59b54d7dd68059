// multisample: makes visibility samples of what the device's own multisampling saw: one for each triangle in each pixel, at
// the pixel's centre, weighted by the triangle's samples. `shade` and `resolve` then treat all pixels as superpixels. An
// invocation takes a pixel.
// Reads: ids_ms. Writes: fragments, headers, masks, tiles, tile_lists, arguments, counters; every tile is PLAIN and in this round.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/tiles.glsl"
#include "include/work.glsl"
layout(local_size_x = 64) in;

uint sample_id(ivec2 pixel, int s) {
    return packUnorm4x8(texelFetch(ids_ms, pixel, s));
}

void main() {
    uint i = invocation_number();
    uint tile_count = frame.tiles.x * frame.tiles.y;
    uint tile = i / 32u, bit = i % 32u;
    bool exists = tile < tile_count;
    tile = min(tile, tile_count - 1u);
    uvec2 pixel = split(tile, frame.tiles.x) * uvec2(8u, 4u) + uvec2(bit & 7u, bit >> 3);
    bool inside = exists && all(lessThan(pixel, frame.size));
    ivec2 at = ivec2(min(pixel, frame.size - 1u));
    // Every pixel has room for as many fragments as it has samples. All pixels of a tile have headers, in the order of the mask's
    // bits.
    uint first = (tile * 32u + bit) * frame.sample_count;
    uint used = 0u, previous = 0u;
    bool more;
    do {
        uint next = ~0u, n = 0u;
        for (uint s = 0u; s < frame.sample_count; s++) {
            uint id = sample_id(at, int(s));
            bool smaller = id > previous && id < next;
            n = smaller ? 1u : n + uint(id == next);
            next = smaller ? id : next;
        }
        more = next != ~0u;
        if (more && inside) fragments_out[first + used] = uvec4(pixel.x | pixel.y << 16, next, 0u, floatBitsToUint(float(n)));
        used += more ? 1u : 0u;
        previous = next;
    } while (more);
    for (uint s = used; s < frame.sample_count; s++)
        if (exists) fragments_out[first + s] = uvec4(0u);
    if (exists) headers[tile * 32u + bit] = uvec2(first, inside ? used : 0u);
    if (exists && bit < PARTS_OF_TILE) tile_lists[tile * PARTS_OF_TILE + bit] = work_entry(tile, bit);
    if (exists && bit == 0u) {
        masks[tile] = ~0u;
        tiles[tile] = uvec4(0u, 0u, tile * 32u, 0u);
    }
    if (i == 0u) {
        counters[COUNTER_FRAGMENTS] = tile_count * 32u * frame.sample_count;
        counters[COUNTER_PLAIN_TILES] = tile_count * PARTS_OF_TILE;
        size_of_lists(uvec4(tile_count * PARTS_OF_TILE, 0u, 0u, 0u), 1u, 1u);
    }
}
