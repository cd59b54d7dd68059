// A host's draws, and which of them a triangle or a position is of.
#ifndef DRAWS_GLSL
#define DRAWS_GLSL
#include "interface.glsl"

struct Draw {
    uint first_triangle;    // among those of all draws
    uint first_index;
    uint vertex_offset;     // added to each index, modulo 2^32
    uint word;              // the triangles' last word: see frame.glsl
    uint first_position;    // among those in clip space
    uint last_position;     // of its own, counted from the first
    uint shift;             // from a position to the host's vertex, modulo 2^32
    uint material;          // the host's number
};

layout(std430, set = SET_OWN, binding = BINDING_DRAWS) readonly buffer Draws { Draw draws[]; };

// The last draw of `count` that begins at a triangle or before it; BY_POSITION: at a position.
uint draw_of(uint at, uint count) {
    uint d = 0u, step_ = 1u << uint(findMSB(count));
    do {
        uint next = d + step_;
        Draw draw = draws[min(next, count - 1u)];
#ifdef BY_POSITION
        bool begins = next < count && draw.first_position <= at;
#else
        bool begins = next < count && draw.first_triangle <= at;
#endif
        d = begins ? next : d;
        step_ >>= 1;
    } while (step_ > 0u);
    return d;
}

#endif
