// setup: computes the edge functions and the depth plane of each pair's triangle, relative to the centre of the pair's tile, and
// stores them in the tile's list. An invocation takes PAIRS_OF_SETUP pairs.
// Reads: pairs, the geometry, tiles. Writes: candidates, 4 vectors each:
// (a0, b0, c0, a1), (b1, c1, a2, b2), (c2, depth x, depth y, depth at centre), (nearest, farthest depth, ID, pixels of the
// tile that it may touch).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/tiles.glsl"
#include "include/touches.glsl"
#include "include/candidate.glsl"
#include "include/triangle.glsl"
#include "include/pairs.glsl"
layout(local_size_x = 64) in;
layout(constant_id = SETUP_CONSTANT_SCANNED) const bool SCANNED = false;     // see candidate.glsl

// Writes the candidate of pair `i`.
void set_up(uint i) {
    uvec2 pair = texelFetch(pairs, int(i)).xy;
    uint tile_index = pair_tile(pair);
    uvec4 tile = tiles[tile_index];
    Triangle k = triangle_at(pair.x);
    ivec2 tile_at = ivec2(split(tile_index, frame.tiles.x));
    Setup s = setup_triangle(k.v0, k.v1, k.v2, tile_center(tile_at), single_sided(k.word));
    // A triangle that can't be seen keeps its place in the list, but touches nothing.
    s.c = s.valid ? s.c : vec3(-3.4e38);
    uint touches = s.valid ? pixels_touched(s) & footprint_mask(footprint_of(k.v0, k.v1, k.v2), tile_at) : 0u;
    if ((tile.w & TILE_LISTED) == 0u) return;
    uint rank = pair_rank(pair);
    int o = candidate_at(tile.y, rank, tile.w >> TILE_COUNT_SHIFT, SCANNED);
    candidates_out[o] = floatBitsToUint(vec4(s.a.x, s.b.x, s.c.x, s.a.y));
    candidates_out[o + 1] = floatBitsToUint(vec4(s.b.y, s.c.y, s.a.z, s.b.z));
    candidates_out[o + 2] = floatBitsToUint(vec4(s.c.z, s.depth));
    candidates_out[last_of_candidate(tile.y, rank, SCANNED)] = uvec4(floatBitsToUint(s.near), floatBitsToUint(s.far), pair.x + 1u, touches);
}

// Each round looks at all pairs, and sets up those of its tiles. An invocation looks at several pairs before it sets up any,
// since CPU devices also execute code that no invocation of a subgroup needs.
void main() {
    uint count = min(counters[COUNTER_PAIRS], frame.pair_capacity);
    uint first = workgroup_number() * 64u * PAIRS_OF_SETUP + gl_LocalInvocationID.x;
    uint wanted = 0u, first_tile = counters[COUNTER_ROUND_FIRST], tile_end = counters[COUNTER_NEXT_TILE];
    [[unroll]] for (uint k = 0u; k < PAIRS_OF_SETUP; k++) {
        uint i = first + k * 64u, tile = pair_tile(texelFetch(pairs, int(min(i, count - 1u))).xy);
        wanted |= i < count && tile >= first_tile && tile < tile_end ? 1u << k : 0u;
    }
    while (wanted != 0u) {
        set_up(first + uint(findLSB(wanted)) * 64u);
        wanted &= wanted - 1u;
    }
}
