// grow: makes superpixels of the pixels beside superpixels that `resolve` found to contrast with these.
// The samples of a superpixel may reveal a thin feature, a corner or a hole that no pixel centre sees. It often extends into
// neighbouring pixels. Twin: twins/src/grow.rs.
// Reads: masks, marks. Writes: masks (only the new superpixels), marks (all earlier ones), COUNTER_SUPERPIXELS, COUNTER_TILES.
// An invocation takes a tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/interior.glsl"
layout(local_size_x = 64) in;
layout(constant_id = GROW_CONSTANT_BEYOND) const uint BEYOND = 0u;     // pixels around the region's own that grow, too, for later growth

void main() {
    uint tile = invocation_number();
    uint tile_count = frame.tiles.x * frame.tiles.y;
    bool inside = tile < tile_count;
    tile = min(tile, tile_count - 1u);
    ivec2 corner = ivec2(split(tile, frame.tiles.x)) * ivec2(8, 4);
    uint before = masks[tile] | marks[2u * tile_count + tile];
    uint word = inside ? marks[tile_count + tile] & ~before & interior_mask(corner, int(BEYOND)) : 0u;
    if (inside) {
        masks[tile] = word;
        marks[tile] = 0u;
        marks[tile_count + tile] = 0u;
        marks[2u * tile_count + tile] = before;
    }
    uint pixels = subgroupAdd(uint(bitCount(word & interior_mask(corner, 0))));
    uint busy = subgroupAdd(word != 0u ? 1u : 0u);
    if (subgroupElect() && busy != 0u) {
        atomicAdd(counters[COUNTER_SUPERPIXELS], pixels);
        atomicAdd(counters[COUNTER_TILES], busy);
    }
}
