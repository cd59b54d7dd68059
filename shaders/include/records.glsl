// Allocation of records (visibility samples).
#ifndef RECORDS_GLSL
#define RECORDS_GLSL
#include "team.glsl"

// Whether a block of the present cell lacked room or iterations. Its cell then keeps the colour that it had.
bool left_over = false;

// Counts a block that is left, once for the whole team.
void leave_block(uint counter) {
    if (member() == 0u) atomicAdd(counters[counter], 1u);
    left_over = true;
}

// Allocates records, once for the whole team. Returns the first one, and whether they fit.
uint allocate_records(uint count, out bool fits) {
    uint base = 0u;
    if (count != 0u && member() == 0u) base = atomicAdd(counters[COUNTER_RECORDS], count);
    base = of_member(base, 0u);
    fits = base + count <= frame.record_capacity;
    if (!fits) leave_block(COUNTER_UNFINISHED);
    return base;
}

#endif
