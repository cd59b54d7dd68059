// Appending to a list whose length is a counter, with one atomic addition per subgroup. All invocations of the subgroup have
// to call these functions together.
#ifndef APPEND_GLSL
#define APPEND_GLSL

// The value that the first invocation of the subgroup has. On CPU devices a shuffle is one instruction, and a broadcast a loop.
uint of_first(uint v) { return subgroupShuffle(v, 0u); }

// Makes room for the entries of the invocations with `wanted`, and returns the index of this invocation's entry.
uint append(uint counter, bool wanted) {
    uvec4 together = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(together), base = 0u;
    if (gl_SubgroupInvocationID == 0u && count != 0u) base = atomicAdd(counters[counter], count);
    return of_first(base) + subgroupBallotExclusiveBitCount(together);
}

// Makes room for `count` entries of this invocation, and returns the index of the first one.
uint append_several(uint counter, uint count) {
    uint all = subgroupAdd(count), base = 0u;
    if (gl_SubgroupInvocationID == 0u && all != 0u) base = atomicAdd(counters[counter], all);
    return of_first(base) + subgroupExclusiveAdd(count);
}

#endif
