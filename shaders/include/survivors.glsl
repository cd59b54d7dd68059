// The list of triangles that `thin` or `cull` keeps: some from the front, others from the back.
#ifndef SURVIVORS_GLSL
#define SURVIVORS_GLSL
#include "append.glsl"

// Lists the triangles `first` + 64 k of this invocation, for each k whose bit is set: in `bits.x` from the front, in `bits.y`
// from the back. `counters_` are the lengths of both parts. All invocations of the subgroup call this together.
void list_survivors(uint first, uvec2 bits, uvec2 counters_) {
    uvec2 at = uvec2(append(counters_.x, uint(bitCount(bits.x))), append(counters_.y, uint(bitCount(bits.y))));
    do {
        uvec2 t = first + uvec2(findLSB(bits)) * 64u;
        if (bits.x != 0u && at.x < frame.survivor_capacity) survivors[at.x] = t.x;
        if (bits.y != 0u && at.y < frame.survivor_capacity) survivors[frame.survivor_capacity - 1u - at.y] = t.y;
        bits &= bits - 1u;
        at++;
    } while ((bits.x | bits.y) != 0u);
}

#endif
