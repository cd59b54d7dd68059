// A host's draws, and a search for the draw of a triangle or of a position. With DRAWS_ARE_WRITTEN, the structure alone.
#ifndef DRAWS_GLSL
#define DRAWS_GLSL
#include "interface.glsl"

struct Draw {
    uint first_triangle;    // among the triangles of all draws
    uint first_index;
    uint vertex_offset;     // added to each index, modulo 2^32
    uint word;              // the triangles' last word: see frame.glsl
    uint first_position;    // among the positions in clip space
    uint last_position;     // index of the draw's last position, counted from its first
    uint shift;             // added to the index of a position, modulo 2^32: the index of the host's vertex
    uint material;          // the host's number of its material
};

#ifndef DRAWS_ARE_WRITTEN
layout(std430, set = SET_OWN, binding = BINDING_DRAWS) readonly buffer Draws { Draw draws[]; };

// Binary search: of `count` draws from the first on, the last one that begins at triangle `at` or before it. BY_POSITION: at
// position `at`.
uint draw_of(uint at, uint first, uint count) {
    uint d = 0u, step_ = 1u << uint(findMSB(count));
    do {
        uint next = d + step_;
        Draw draw = draws[first + min(next, count - 1u)];
#ifdef BY_POSITION
        bool begins = next < count && draw.first_position <= at;
#else
        bool begins = next < count && draw.first_triangle <= at;
#endif
        d = begins ? next : d;
        step_ >>= 1;
    } while (step_ > 0u);
    return first + d;
}
#endif

#endif
