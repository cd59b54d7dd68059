// cull: keeps the triangles that may touch a superpixel, and counts the others by reason. In doubt it keeps a triangle: `setup`
// decides finally which ones have area and face the camera. An invocation takes PER_INVOCATION triangles.
// Reads: the geometry, masks. Writes: survivors (small ones from the front, large ones from the back), counters.
// THIN_ALONE keeps only triangles that may be thin in some cell, for `crossings`.
// The host discards a frame with more survivors than there is room for. In `bin` an invocation takes a small triangle, and some
// workgroups take a large one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/survivors.glsl"
#include "include/thin.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = CULL_CONSTANT_THIN_ALONE) const bool THIN_ALONE = false;

const int SMALL_TILES = 16;
const uint PER_INVOCATION = 8u;

void main() {
    uint outside = 0u, backfacing = 0u, degenerate = 0u, untouching = 0u;
    uint small = 0u, large = 0u;        // a bit for each step
    uint first = workgroup_number() * 64u * PER_INVOCATION + gl_LocalInvocationID.x;
    uint step_ = 0u;
    do {
        uint t = first + step_ * 64u;
        Triangle k = triangle_at(min(t, frame.triangle_count - 1u));
        bool exists = k.exists && t < frame.triangle_count;
        Footprint f = footprint_of(k.v0, k.v1, k.v2);
        bool is_outside = exists && f.outside;
        bool is_degenerate = exists && !is_outside && (k.v0 == k.v1 || k.v1 == k.v2 || k.v2 == k.v0);
        bool is_backfacing = exists && !is_outside && !is_degenerate && single_sided(k.word)
            && surely_backfacing(k.v0, k.v1, k.v2, frame.origin);
        bool wide = THIN_ALONE && exists && !f.unprojected
            && height_of(k.v0.xy / k.v0.w, k.v1.xy / k.v1.w, k.v2.xy / k.v2.w) >= THIN * uintBitsToFloat(counters[COUNTER_WIDEST]);
        bool candidate = exists && !is_outside && !is_degenerate && !is_backfacing && !wide;

        ivec2 low = f.low / ivec2(8, 4), high = f.high / ivec2(8, 4);
        int count = (high.x - low.x + 1) * (high.y - low.y + 1);
        bool is_large = candidate && count > SMALL_TILES;
        ivec2 tile = low;
        uint touched = 0u;
        int left = candidate && !is_large ? count : 1;
        do {
            touched |= masks[tile.y * int(frame.tiles.x) + tile.x] & footprint_mask(f, tile);
            bool wrap = tile.x == high.x;
            tile = wrap ? ivec2(low.x, tile.y + 1) : tile + ivec2(1, 0);
        } while (--left > 0);
        bool is_small = candidate && !is_large;
        small |= is_small && touched != 0u ? 1u << step_ : 0u;
        large |= is_large ? 1u << step_ : 0u;
        outside += uint(is_outside);
        degenerate += uint(is_degenerate);
        backfacing += uint(is_backfacing);
        untouching += uint(is_small && touched == 0u);
    } while (++step_ < PER_INVOCATION);

    list_survivors(first, uvec2(small, large), uvec2(COUNTER_SURVIVORS, COUNTER_LARGE));

    outside = subgroupAdd(outside);
    backfacing = subgroupAdd(backfacing);
    degenerate = subgroupAdd(degenerate);
    untouching = subgroupAdd(untouching);
    if (subgroupElect()) {
        atomicAdd(counters[COUNTER_OUTSIDE], outside);
        atomicAdd(counters[COUNTER_BACKFACING], backfacing);
        atomicAdd(counters[COUNTER_DEGENERATE], degenerate);
        atomicAdd(counters[COUNTER_UNTOUCHING], untouching);
    }
}
