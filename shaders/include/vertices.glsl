// Attributes of a host's vertices.
#ifndef VERTICES_GLSL
#define VERTICES_GLSL
#include "interface.glsl"

layout(constant_id = CONSTANT_VERTEX_FORMAT) const uint VERTEX_FORMAT = VERTEX_FLOAT;
layout(std430, set = SET_OWN, binding = BINDING_VERTICES) readonly buffer Vertices { uint vertices[]; };
layout(push_constant) uniform Push {
    vec4 scale;             // a component of a vertex is bias + scale * the number in the buffer
    vec4 bias;
    uint first_position;    // first one of a mesh or of several draws, whose positions follow each other
    uint position_count;
    uint first_draw;        // first of the draws whose positions these are
    uint draw_count;
    uint first_half;        // where the attribute of the first vertex begins, in units of 2 bytes
    uint stride;            // from vertex to vertex, in units of 2 bytes
} push;

// The number of the vertex for position `i`. An index beyond the draw's last position stands for that one.
uint vertex_of(uint i, Draw draw) {
    return min(i - draw.first_position, draw.last_position) + draw.first_position + draw.shift;
}

// The bits of component `n` of a vertex, as they are in the buffer. VERTEX_FORMAT is VERTEX_FLOAT.
uint component_bits(uint vertex, uint n) {
    return vertices[((push.first_half + vertex * push.stride) >> 1) + n];
}

// The number in the buffer that is component `n` of a vertex. Integers are not normalised, which `scale` does.
float component(uint vertex, uint n) {
    if (VERTEX_FORMAT == VERTEX_FLOAT) return uintBitsToFloat(component_bits(vertex, n));
    uint at = push.first_half + vertex * push.stride + n;
    uint bits = vertices[at >> 1] >> 16u * (at & 1u) & 0xffffu;
    if (VERTEX_FORMAT == VERTEX_HALF) return unpackHalf2x16(bits).x;
    // Signed numbers have two that mean -1.
    return VERTEX_FORMAT == VERTEX_UNORM ? float(bits) : float(max(int(bits << 16) >> 16, -32767));
}

#endif
