// Allocation of fragments (visibility samples).
#ifndef FRAGMENTS_GLSL
#define FRAGMENTS_GLSL
#include "team.glsl"

// Whether a block of the present cell lacked room or iterations. Its cell then keeps the colour that it had.
bool left_over = false;

// Counts a block that is left, once for the whole team.
void leave_block(uint counter) {
    if (member() == 0u) atomicAdd(counters[counter], 1u);
    left_over = true;
}

// Allocates fragments, once for the whole team. Returns the first one, and whether they fit.
uint allocate_fragments(uint count, out bool fits) {
    uint base = 0u;
    if (count != 0u && member() == 0u) base = atomicAdd(counters[COUNTER_FRAGMENTS], count);
    base = of_member(base, 0u);
    fits = base + count <= frame.fragment_capacity;
    if (!fits) leave_block(COUNTER_UNFINISHED);
    return base;
}

#endif
