// Places at the end of a list, as a counter has its length: a subgroup counts once.
#ifndef APPEND_GLSL
#define APPEND_GLSL

uint append(uint counter, bool wanted) {
    uvec4 together = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(together), base = 0u;
    if (subgroupElect() && count != 0u) base = atomicAdd(counters[counter], count);
    return subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(together);
}

#endif
