// sort: visibility samples ordered by material bin. Runs twice: COUNT, then SCATTER into `shade_order`.
// Background and empty records are left out.
// Reads: records, the geometry. Writes: bins, shade_order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint scatter; } push;

void main() {
    bool scatter = push.scatter != 0u;
    uint i = invocation_number();
    uint count = min(counters[COUNTER_RECORDS], frame.record_capacity);
    uint id = i < count ? texelFetch(records, int(i)).y : 0u;
    uint bin = id == 0u ? ~0u : triangle_word(id - 1u) >> 16 & 0x3fffu;
    uint current = subgroupMin(bin);
    // One atomic a bin a subgroup.
    do {
        bool some = current != ~0u;
        bool mine = some && bin == current;
        uvec4 together = subgroupBallot(mine);
        uint n = subgroupBallotBitCount(together), base = 0u;
        if (subgroupElect() && some) base = atomicAdd(bins[current][scatter ? 2 : 0], n);
        base = subgroupBroadcastFirst(base);
        if (scatter && mine) shade_order[base + subgroupBallotExclusiveBitCount(together)] = i;
        current = some ? subgroupMin(bin > current ? bin : ~0u) : ~0u;
    } while (current != ~0u);
}
