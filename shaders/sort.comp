// sort: sorts visibility samples by material bin. It runs twice: the first run counts the samples of each bin, the second one
// (`scatter`) stores them in `shade_order`. Background and empty records are left out. A subgroup takes 64 records, and an
// invocation some successive ones of these, so that a bin costs one atomic operation for 64 records.
// Reads: records, the geometry. Writes: bins, shade_order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/append.glsl"
#include "include/lanes.glsl"
#include "include/triangle.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(push_constant) uniform Push { uint scatter; } push;

const uint OWN = 64u / LANES;       // records of an invocation
const uint NONE = ~0u;

void main() {
    if (in_other_subgroups(LANES)) return;
    bool scatter = push.scatter != 0u;
    uint first = workgroup_number() * 64u + gl_SubgroupInvocationID * OWN;
    uint count = min(counters[COUNTER_RECORDS], frame.record_capacity);

    uint bin[OWN], least = NONE;
    [[unroll]] for (uint r = 0u; r < OWN; r++) {
        uint i = first + r, id = i < count ? texelFetch(records, int(i)).y : 0u;
        bin[r] = id == 0u ? NONE : bin_of(triangle_word(id - 1u));
        least = min(least, bin[r]);
    }
    uint current = lanes_min(least);
    do {
        uint own = 0u;
        least = NONE;
        [[unroll]] for (uint r = 0u; r < OWN; r++) {
            own += bin[r] == current ? 1u : 0u;
            least = min(least, bin[r] > current ? bin[r] : NONE);
        }
        bool some = current != NONE;
        uint together = lanes_add(own), base = 0u;
        if (gl_SubgroupInvocationID == 0u && some) base = atomicAdd(bins[current][scatter ? 2 : 0], together);
        uint at = of_first(base) + lanes_before(own);
        [[unroll]] for (uint r = 0u; r < OWN; r++) {
            bool mine = some && bin[r] == current;
            if (scatter && mine) shade_order[at] = first + r;
            at += mine ? 1u : 0u;
        }
        current = lanes_min(least);
    } while (current != NONE);
}
