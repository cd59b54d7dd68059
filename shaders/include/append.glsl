// Appending to a list whose length is a counter, with one atomic addition for all invocations of a subgroup that are here
// together. Whether a device runs all of them together, or some and then others, makes no difference to the list's content.
#ifndef APPEND_GLSL
#define APPEND_GLSL

// Makes room for the entries of the invocations with `wanted`, and returns the index of this invocation's entry.
uint append(uint counter, bool wanted) {
    uvec4 together = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(together), base = 0u, first = subgroupBallotFindLSB(subgroupBallot(true));
    if (gl_SubgroupInvocationID == first && count != 0u) base = atomicAdd(counters[counter], count);
    return subgroupShuffle(base, first) + subgroupBallotExclusiveBitCount(together);
}

// Makes room for `count` entries of this invocation, and returns the index of the first one.
uint append_several(uint counter, uint count) {
    uint all = subgroupAdd(count), base = 0u, first = subgroupBallotFindLSB(subgroupBallot(true));
    if (gl_SubgroupInvocationID == first && all != 0u) base = atomicAdd(counters[counter], all);
    return subgroupShuffle(base, first) + subgroupExclusiveAdd(count);
}

#endif
