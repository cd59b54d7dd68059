// bin: makes pairs of a surviving triangle and a tile that it may touch, with the triangle's rank in the tile's list. An
// invocation takes a small triangle, or some workgroups take a large one.
// Reads: the geometry, masks, survivors. Writes: pairs, tiles (lengths and flags), COUNTER_PAIRS.
// The order of pairs and ranks varies from run to run; `sample` does not depend on it.
// If there is no room for a pair, its tile gets a flag, and `scatter` tries every triangle there.
// Whether a triangle is large depends on how much of it a region shows. Both kinds get the same test against a tile, so that
// the same kernel samples a tile however an image is divided into regions.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/append.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
#include "include/pairs.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint large; } push;     // 1: takes large triangles

const uint CHUNK = 32u;                                         // most tiles that an invocation tests before it stores pairs

void main() {
    bool large = push.large != 0u;
    uint i = large ? workgroup_number() : invocation_number();
    uint listed = min(counters[large ? COUNTER_LARGE : COUNTER_SURVIVORS], frame.survivor_capacity);
    bool exists = i < listed;
    i = min(i, frame.survivor_capacity - 1u);
    uint t = exists ? survivors[large ? frame.survivor_capacity - 1u - i : i] : 0u;
    Triangle corners = triangle_at(t);
    Footprint f = footprint_of(corners.v0, corners.v1, corners.v2);
    uint flag = t >= frame.first_blend ? TILE_HAS_BLEND : t >= frame.first_mask ? TILE_HAS_MASK : 0u;

    ivec2 low = f.low / ivec2(8, 4), high = f.high / ivec2(8, 4);
    uint columns = uint(high.x - low.x + 1), count = exists ? columns * uint(high.y - low.y + 1) : 0u;
    float inverse_columns = 1.0 / float(columns);
    uint first = large ? gl_WorkGroupID.z * 64u + gl_LocalInvocationID.x : 0u, apart = large ? gl_NumWorkGroups.z * 64u : 1u;
    do {
        uint touched = 0u, k = 0u;
        do {
            uint number = min(first + k * apart, max(count, 1u) - 1u);
            uint row = uint((float(number) + 0.5) * inverse_columns);
            ivec2 tile = low + ivec2(number - row * columns, row);
            bool touches = first + k * apart < count && (masks[uint(tile.y) * frame.tiles.x + uint(tile.x)] & footprint_mask(f, tile)) != 0u;
            // A pixel's centre is at most (3.5, 1.5) from the tile's; a quarter of a pixel more covers rounding.
            Setup s = setup_triangle(corners.v0, corners.v1, corners.v2, tile_center(tile), false);
            vec3 reach = s.c + (3.75 + frame.reach) * abs(s.a) + (1.75 + frame.reach) * abs(s.b);
            touches = touches && !(min(reach.x, min(reach.y, reach.z)) < 0.0);
            touched |= touches ? 1u << k : 0u;
        } while (++k < CHUNK && first + k * apart < count);
        uint slot = append_several(COUNTER_PAIRS, uint(bitCount(touched)));
        do {
            bool some = touched != 0u;
            uint number = first + (some ? uint(findLSB(touched)) : 0u) * apart;
            uint row = uint((float(number) + 0.5) * inverse_columns);
            uint index = (uint(low.y) + row) * frame.tiles.x + uint(low.x) + number - row * columns;
            if (some) {
                uint rank = atomicAdd(tiles[index].x, 1u);
                bool kept = slot < frame.pair_capacity;
                uint flags = flag | (kept ? 0u : TILE_OVERFLOW);
                if (flags != 0u) atomicOr(tiles[index].w, flags);
                // A pair that is not kept leaves no gap in a list, since its tile gets none. Neither does a tile with more triangles
                // than there are ranks.
                if (kept) pairs_out[slot] = make_pair(t, index, rank);
            }
            slot++;
            touched &= touched - 1u;
        } while (touched != 0u);
        first += CHUNK * apart;
    } while (first < count);
}
