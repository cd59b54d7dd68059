// bin: makes pairs of a surviving triangle and a tile that it may touch, with the triangle's rank in the tile's list. The pass runs
// in three steps:
//   BUSY     an invocation takes a run of 32 tiles, and finds out which of them have superpixels, a bit each
//   SMALL    an invocation takes a small triangle
//   LARGE    some workgroups take a large triangle
// Runs are parts of a row of tiles. Most tiles have no superpixels, so that a triangle is tested against few tiles of a run.
// Reads: the geometry, masks, survivors. Writes: pairs, tiles (lengths, bits of runs, flags), COUNTER_PAIRS.
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
layout(constant_id = BIN_CONSTANT_STEP) const uint STEP = BIN_SMALL;

const bool LARGE = STEP == BIN_LARGE;
uint runs_of_row() { return (frame.tiles.x + 31u) / 32u; }

void find_busy() {
    uint run = invocation_number(), runs = runs_of_row(), busy = 0u, k = 0u;
    uvec2 at = split(run, runs);
    if (at.y >= frame.tiles.y) return;
    do {
        uint column = 32u * at.x + k;
        busy |= column < frame.tiles.x && masks[at.y * frame.tiles.x + min(column, frame.tiles.x - 1u)] != 0u ? 1u << k : 0u;
    } while (++k < 32u);
    tiles[run].y = busy;
}

void make_pairs() {
    uint i = LARGE ? workgroup_number() : invocation_number();
    uint listed = min(counters[LARGE ? COUNTER_LARGE : COUNTER_SURVIVORS], frame.survivor_capacity);
    bool exists = i < listed;
    i = min(i, frame.survivor_capacity - 1u);
    uint t = exists ? survivors[LARGE ? frame.survivor_capacity - 1u - i : i] : 0u;
    Triangle corners = triangle_at(t);
    Footprint f = footprint_of(corners.v0, corners.v1, corners.v2);
    uint flag = t >= frame.first_blend ? TILE_HAS_BLEND : t >= frame.first_mask ? TILE_HAS_MASK : 0u;

    ivec2 low = f.low / ivec2(8, 4), high = f.high / ivec2(8, 4);
    uint first_run = uint(low.x) / 32u, runs = uint(high.x) / 32u - first_run + 1u, count = exists ? runs * uint(high.y - low.y + 1) : 0u;
    uint number = LARGE ? gl_WorkGroupID.z * 64u + gl_LocalInvocationID.x : 0u, apart = LARGE ? gl_NumWorkGroups.z * 64u : 1u;
    do {
        uvec2 place = split(min(number, max(count, 1u) - 1u), runs);
        uint run = first_run + place.x, row = uint(low.y) + place.y;
        int before = max(low.x - 32 * int(run), 0), last = min(high.x - 32 * int(run), 31);
        uint busy = number < count ? tiles[row * runs_of_row() + run].y & ~0u << before & ~0u >> (31 - last) : 0u, touched = 0u;
        do {
            uint bit = busy != 0u ? uint(findLSB(busy)) : uint(before);
            ivec2 tile = ivec2(32u * run + bit, row);
            bool some = busy != 0u && (masks[row * frame.tiles.x + uint(tile.x)] & footprint_mask(f, tile)) != 0u;
            // A pixel's centre is at most (3.5, 1.5) from the tile's; a quarter of a pixel more covers rounding.
            Setup s = setup_triangle(corners.v0, corners.v1, corners.v2, tile_center(tile), false);
            vec3 reach = s.c + (3.75 + frame.reach) * abs(s.a) + (1.75 + frame.reach) * abs(s.b);
            touched |= some && !(min(reach.x, min(reach.y, reach.z)) < 0.0) ? 1u << bit : 0u;
            busy &= busy - 1u;
        } while (busy != 0u);
        uint slot = append(COUNTER_PAIRS, uint(bitCount(touched)));
        do {
            uint index = row * frame.tiles.x + 32u * run + (touched != 0u ? uint(findLSB(touched)) : uint(before));
            if (touched != 0u) {
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
        number += apart;
        // All invocations of a subgroup append together, so that none leaves the loop before the others.
    } while (subgroupAny(number < count));
}

void main() {
    if (STEP == BIN_BUSY) find_busy();
    else make_pairs();
}
