// Allocation of records (visibility samples).
#ifndef RECORDS_GLSL
#define RECORDS_GLSL

// Allocates records, once for the whole subgroup. Returns the first one, and whether they fit.
uint allocate_records(uint count, out bool fits) {
    uint base = 0u;
    if (subgroupElect() && count != 0u) base = atomicAdd(counters[COUNTER_RECORDS], count);
    base = subgroupBroadcastFirst(base);
    fits = base + count <= frame.record_capacity;
    if (subgroupElect() && !fits) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
    return base;
}

#endif
