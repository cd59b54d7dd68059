// sort: sorts visibility samples by material bin. It runs twice: the first run counts the samples of each bin, the second one
// (`scatter`) stores them in `shade_order`. Background and empty records are left out. An invocation takes a record.
// Reads: records, the geometry. Writes: bins, shade_order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/append.glsl"
#include "include/lanes.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint scatter; } push;

void main() {
    if (in_other_subgroups(64u)) return;
    bool scatter = push.scatter != 0u;
    uint i = invocation_number();
    uint count = min(counters[COUNTER_RECORDS], frame.record_capacity);
    uint id = i < count ? texelFetch(records, int(i)).y : 0u;
    uint bin = id == 0u ? ~0u : triangle_word(id - 1u) >> 16 & 0x3fffu;
    uint current = lanes_min(bin);
    // One atomic operation for each bin of the subgroup.
    do {
        bool some = current != ~0u;
        bool mine = some && bin == current;
        uvec4 together = subgroupBallot(mine);
        uint n = subgroupBallotBitCount(together), base = 0u;
        if (gl_SubgroupInvocationID == 0u && some) base = atomicAdd(bins[current][scatter ? 2 : 0], n);
        base = of_first(base);
        if (scatter && mine) shade_order[base + subgroupBallotExclusiveBitCount(together)] = i;
        current = some ? lanes_min(bin > current ? bin : ~0u) : ~0u;
    } while (current != ~0u);
}
