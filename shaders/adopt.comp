// adopt: a host's triangles, in the order of its draws, as the other passes read them.
// Reads: the host's indices, draws. Writes: triangles. Indices that are out of range are clamped: what they draw is
// wrong, and nothing else is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/workgroup.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 1) readonly buffer Draws { uvec4 draws[]; };      // first triangle, first index, vertex offset, word
layout(std430, set = 0, binding = 2) writeonly buffer TrianglesOut { uvec4 triangles_out[]; };
layout(push_constant) uniform Push {
    uint triangle_count;
    uint draw_count;
    uint index_count;
    uint vertex_count;
} push;

uint vertex(uint index, uint offset) {
    return min(indices[min(index, push.index_count - 1u)] + offset, push.vertex_count - 1u);
}

void main() {
    uint t = invocation_number();
    if (t >= push.triangle_count) return;
    // The last draw that begins at the triangle or before it.
    uint d = 0u, step_ = 1u << uint(findMSB(push.draw_count));
    do {
        uint next = d + step_;
        bool begins = next < push.draw_count && draws[min(next, push.draw_count - 1u)].x <= t;
        d = begins ? next : d;
        step_ >>= 1;
    } while (step_ > 0u);
    uvec4 draw = draws[d];
    uint index = draw.y + 3u * (t - draw.x);
    triangles_out[t] = uvec4(vertex(index, draw.z), vertex(index + 1u, draw.z), vertex(index + 2u, draw.z), draw.w);
}
