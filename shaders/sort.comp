// sort: what is to be shaded, ordered by material bin. Runs twice: COUNT, then SCATTER into `shade_order`.
// Sources: PIXELS (the triangle IDs of `raster`) or visibility records. Both skip the background.
// Reads: ids or records, triangles. Writes: bins, shade_order; for background pixels their colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/color.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool SCATTER = false;
layout(constant_id = 1) const bool PIXELS = false;
layout(constant_id = 2) const bool DISPLAY_CODES = false;

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    uint count = PIXELS ? frame.size.x * frame.size.y : min(counters[COUNTER_RECORDS], frame.record_capacity);
    bool exists = i < count;
    i = min(i, count - 1u);
    uint id;
    if (PIXELS) {
        id = texelFetch(ids, ivec2(i % frame.size.x, i / frame.size.x), 0).x;
        if (!SCATTER && exists && id == 0u) {
            imageStore(color, int(i), frame.background);
            if (DISPLAY_CODES) imageStore(display_out, int(i), uvec4(display_code(frame.background)));
        }
    } else {
        id = texelFetch(records, int(i)).y;
    }
    uint bin = texelFetch(triangles, int(max(id, 1u) - 1u)).w >> 16 & 0x7fffu;
    bool left = exists && id != 0u;
    uint slot = 0u;
    // One atomic a bin a subgroup.
    uvec4 waiting = subgroupBallot(left);
    bool wanted = left;
    while (subgroupBallotBitCount(waiting) != 0u) {
        uint current = subgroupShuffle(bin, subgroupBallotFindLSB(waiting));
        bool mine = left && bin == current;
        uvec4 together = subgroupBallot(mine);
        uint base = 0u;
        if (subgroupElect()) {
            uint n = subgroupBallotBitCount(together);
            base = SCATTER ? atomicAdd(bins[current].z, n) : atomicAdd(bins[current].x, n);
        }
        base = subgroupBroadcastFirst(base);
        slot = mine ? base + subgroupBallotExclusiveBitCount(together) : slot;
        left = left && !mine;
        waiting &= ~together;
    }
    if (SCATTER && wanted) shade_order[slot] = i;
}
