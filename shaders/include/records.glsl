// Allocation of records (visibility samples).
#ifndef RECORDS_GLSL
#define RECORDS_GLSL
#include "team.glsl"

// Allocates records, once for the whole team. Returns the first one, and whether they fit.
uint allocate_records(uint count, out bool fits) {
    uint base = 0u;
    if (count != 0u && member() == 0u) base = atomicAdd(counters[COUNTER_RECORDS], count);
    base = of_member(base, 0u);
    fits = base + count <= frame.record_capacity;
    if (!fits && member() == 0u) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
    return base;
}

#endif
