// Appending to a list whose length is a counter, with one atomic addition for all invocations of a subgroup.
#ifndef APPEND_GLSL
#define APPEND_GLSL

// Makes room for `count` entries of this invocation, and returns the index of the first one. All invocations of the subgroup call this
// together, in workgroups of 64. They exchange data by shuffles alone: SHUFFLES_ALONE of workarounds.glsl.
uint append(uint counter, uint count) {
    uint lane = gl_SubgroupInvocationID, size = min(gl_SubgroupSize, 64u), sum = count, base = 0u;
    for (uint apart = 1u; apart < size; apart *= 2u) {
        uint below = subgroupShuffle(sum, max(lane, apart) - apart);
        sum += lane >= apart ? below : 0u;
    }
    uint all = subgroupShuffle(sum, size - 1u);
    if (lane == 0u && all != 0u) base = atomicAdd(counters[counter], all);
    return subgroupShuffle(base, 0u) + sum - count;
}

#endif
