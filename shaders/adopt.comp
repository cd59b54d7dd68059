// adopt: a host's triangles, in the order of its draws, as the other passes read them.
// Reads: draws, the host's indices. Writes: triangles, and the draw of each. Indices that are out of range are clamped: what
// they draw is wrong, and nothing else is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ADOPT_CONSTANT_SHORT) const bool SHORT = false;       // indices have 16 bits
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_INDICES) readonly buffer Indices { uint indices[]; };
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_TRIANGLES_OUT) writeonly buffer TrianglesOut { uvec4 triangles_out[]; };
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_DRAW_OF_OUT) writeonly buffer DrawOfOut { uint draw_of_out[]; };
layout(push_constant) uniform Push {
    uint triangle_count;
    uint draw_count;
    uint first_index;       // in the buffer, of those that there are
    uint index_count;
} push;

uint position(Draw draw, uint index) {
    uint at = push.first_index + min(index, push.index_count - 1u);
    uint found = SHORT ? indices[at >> 1] >> 16u * (at & 1u) & 0xffffu : indices[at];
    return draw.first_position + min(found + draw.vertex_offset, draw.last_position);
}

void main() {
    uint t = invocation_number();
    if (t >= push.triangle_count) return;
    uint d = draw_of(t, push.draw_count);
    Draw draw = draws[d];
    uint index = draw.first_index + 3u * (t - draw.first_triangle);
    triangles_out[t] = uvec4(position(draw, index), position(draw, index + 1u), position(draw, index + 2u), draw.word);
    draw_of_out[t] = d;
}
