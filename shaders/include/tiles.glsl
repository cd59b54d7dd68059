// Which tiles of 8 x 4 pixels a triangle touches. `cull` and `bin` both use this, and so agree.
#ifndef TILES_GLSL
#define TILES_GLSL
#include "finite.glsl"
#include "setup.glsl"

struct Footprint {
    ivec2 low, high;    // touched pixels of the region, inclusive
    bool outside;       // whether it touches no pixel of the region
    bool unprojected;   // whether a vertex lies at or behind the eye, or very far off the region
};

// How far a sample of a pixel can be from its centre, with a margin for rounding, since positions are relative to the region
// here, and to the tile elsewhere.
#define REACH (frame.reach + 1.0 / 64.0)

// The pixels of the region whose samples the triangle's bounding box may touch.
Footprint footprint_of(vec4 c0, vec4 c1, vec4 c2) {
    Footprint f;
    vec4 v0 = relative_to(c0, frame.origin), v1 = relative_to(c1, frame.origin), v2 = relative_to(c2, frame.origin);
    vec2 limit = vec2(frame.size) - 1.0 + REACH;
    f.unprojected = !(projectable(v0) && projectable(v1) && projectable(v2));
    vec2 q0 = v0.xy / v0.w, q1 = v1.xy / v1.w, q2 = v2.xy / v2.w;
    vec2 low = min(q0, min(q1, q2)), high = max(q0, max(q1, q2));
    // The triangle is outside if all vertices are on the outer side of one border. Homogeneous tests need no division.
    bvec2 before = bvec2(
        v0.x < -REACH * v0.w && v1.x < -REACH * v1.w && v2.x < -REACH * v2.w,
        v0.y < -REACH * v0.w && v1.y < -REACH * v1.w && v2.y < -REACH * v2.w);
    bvec2 after = bvec2(
        v0.x > limit.x * v0.w && v1.x > limit.x * v1.w && v2.x > limit.x * v2.w,
        v0.y > limit.y * v0.w && v1.y > limit.y * v1.w && v2.y > limit.y * v2.w);
    bool clipped = (v0.z > v0.w && v1.z > v1.w && v2.z > v2.w) || (v0.z < 0.0 && v1.z < 0.0 && v2.z < 0.0);
    bool finite = !is_nan(v0.x + v0.y + v0.z + v0.w + v1.x + v1.y + v1.z + v1.w + v2.x + v2.y + v2.z + v2.w);
    f.outside = any(before) || any(after) || clipped || !finite;
    low = f.unprojected ? vec2(0.0) : low;
    high = f.unprojected ? limit : high;
    f.low = ivec2(clamp(ceil(low - REACH), vec2(0.0), vec2(frame.size) - 1.0));
    f.high = ivec2(clamp(floor(high + REACH), vec2(0.0), vec2(frame.size) - 1.0));
    return f;
}

// The pixels of tile `tile` within the footprint, as bits of a mask word.
uint footprint_mask(Footprint f, ivec2 tile) {
    ivec2 low = clamp(f.low - tile * ivec2(8, 4), ivec2(0), ivec2(8, 4));
    ivec2 high = clamp(f.high - tile * ivec2(8, 4) + 1, ivec2(0), ivec2(8, 4));
    uint columns = ((1u << high.x) - 1u) & ~((1u << low.x) - 1u);
    uint rows = (high.y >= 4 ? ~0u : (1u << (high.y * 8)) - 1u) & ~(low.y >= 4 ? ~0u : (1u << (low.y * 8)) - 1u);
    return columns * 0x01010101u & rows;
}

// Position of a tile's centre.
vec2 tile_center(ivec2 tile) {
    return frame.origin + vec2(tile * ivec2(8, 4)) + vec2(3.5, 1.5);
}

// Flags in tiles[].w. The bits above them hold the length of the tile's list, once `enlist` has placed it.
#define TILE_HAS_MASK 1u
#define TILE_HAS_BLEND 2u
#define TILE_LISTED 4u
#define TILE_OVERFLOW 8u    // a pair of the tile was not kept
#define TILE_REFINED 16u     // tiles[].z is the first vector of a refined list, see refine.comp
#define TILE_COUNT_SHIFT 8

// Whether a tile is in the current round. What `enlist` wrote for tiles of earlier rounds is no longer valid.
bool in_round(uint tile) {
    return tile >= counters[COUNTER_ROUND_FIRST] && tile < counters[COUNTER_NEXT_TILE];
}

#endif
