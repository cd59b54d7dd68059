// spans: rows of 8 pixels, listed by material bin, for `shade`. A span stands in the list of every bin it shows.
// Runs twice: COUNT, then SCATTER into `shade_order`.
// Reads: ids, triangles. Writes: bins, shade_order; COUNT gives background pixels their colour and display code.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/color.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool SCATTER = false;
layout(constant_id = 1) const bool DISPLAY_CODES = false;
layout(constant_id = 2) const bool ONE_BIN = false;

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    uint columns = (frame.size.x + 7u) / 8u;
    bool exists = i < columns * frame.size.y;
    ivec2 first = exists ? ivec2(i % columns * 8u, i / columns) : ivec2(0);
    uint background_code = DISPLAY_CODES && !SCATTER ? display_code(frame.background) : 0u;
    uint bin[8];
    [[unroll]] for (int k = 0; k < 8; k++) {
        ivec2 p = ivec2(first.x + k, first.y);
        bool inside = exists && p.x < int(frame.size.x);
        uint id = inside ? texelFetch(ids, p, 0).x : 0u;
        bin[k] = id == 0u ? ~0u : ONE_BIN ? 0u : texelFetch(triangles, int(id - 1u)).w >> 16 & 0x7fffu;
        if (!SCATTER && inside && id == 0u) {
            int at = p.y * int(frame.size.x) + p.x;
            imageStore(color, at, frame.background);
            if (DISPLAY_CODES) imageStore(display_out, at, uvec4(background_code));
        }
    }
    uint current = ~0u;
    [[unroll]] for (int k = 0; k < 8; k++) current = min(current, bin[k]);
    current = subgroupMin(current);
    do {
        bool some = current != ~0u;
        bool mine = false;
        uint following = ~0u;
        [[unroll]] for (int k = 0; k < 8; k++) {
            mine = mine || bin[k] == current;
            following = min(following, bin[k] > current ? bin[k] : ~0u);
        }
        mine = mine && some;
        uvec4 together = subgroupBallot(mine);
        uint n = subgroupBallotBitCount(together), base = 0u;
        if (subgroupElect() && some) base = SCATTER ? atomicAdd(bins[current].z, n) : atomicAdd(bins[current].x, n);
        base = subgroupBroadcastFirst(base);
        if (SCATTER && mine) shade_order[base + subgroupBallotExclusiveBitCount(together)] = i;
        current = some ? subgroupMin(following) : ~0u;
    } while (current != ~0u);
}
