// Places at the end of a list, as a counter has its length: a subgroup counts once. All its invocations call this together.
#ifndef APPEND_GLSL
#define APPEND_GLSL

// What the first invocation of a subgroup has. A shuffle is one instruction on CPU devices, and a broadcast a loop.
uint of_first(uint v) { return subgroupShuffle(v, 0u); }

uint append(uint counter, bool wanted) {
    uvec4 together = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(together), base = 0u;
    if (gl_SubgroupInvocationID == 0u && count != 0u) base = atomicAdd(counters[counter], count);
    return of_first(base) + subgroupBallotExclusiveBitCount(together);
}

#endif
