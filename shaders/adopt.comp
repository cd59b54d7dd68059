// adopt: converts a host's triangles, in the order of its draws, to the form that the other passes read. A dispatch takes
// consecutive draws with the same mesh, topology and front face, and an invocation a triangle. Twin:
// twins/src/topology.rs.
// Reads: draws, the host's indices. Writes: triangles, and the draw of each. Indices that are out of range are clamped: only
// their own triangles are wrong then. All other passes take counter-clockwise triangles for front faces, so if a draw's front
// faces are clockwise, two corners of its triangles are exchanged here.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ADOPT_CONSTANT_SHORT) const bool SHORT = false;       // indices have 16 bits
layout(constant_id = ADOPT_CONSTANT_INDEXED) const bool INDEXED = true;    // otherwise index n is n, and there is no buffer
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_INDICES) readonly buffer Indices { uint indices[]; };
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_TRIANGLES_OUT) writeonly buffer TrianglesOut { uvec4 triangles_out[]; };
layout(std430, set = SET_OWN, binding = ADOPT_BINDING_DRAW_OF_OUT) writeonly buffer DrawOfOut { uint draw_of_out[]; };
layout(push_constant) uniform Push {
    uint first_triangle;    // among the triangles of all draws
    uint triangle_count;
    uint first_draw;        // first of the draws whose triangles these are
    uint draw_count;
    uint first_index;       // first index of the mesh in the buffer
    uint index_count;       // indices of the mesh
    uint topology;          // TOPOLOGY_LIST, _STRIP or _FAN
    uint clockwise;         // whether front faces are clockwise
} push;

uint index_at(uint number) {
    if (!INDEXED) return number;
    uint at = push.first_index + min(number, push.index_count - 1u);
    return SHORT ? indices[at >> 1] >> 16u * (at & 1u) & 0xffffu : indices[at];
}

uint position(Draw draw, uint number) {
    uint vertex = index_at(draw.first_index + number) + draw.vertex_offset;
    return draw.first_position + min(vertex, draw.last_position);
}

// The numbers of the indices of a draw's triangle, in Vulkan's order of vertices.
uvec3 corners(uint triangle) {
    uint odd = triangle & 1u;
    if (push.topology == TOPOLOGY_STRIP) return triangle + uvec3(0u, 1u + odd, 2u - odd);
    if (push.topology == TOPOLOGY_FAN) return uvec3(triangle + 1u, triangle + 2u, 0u);
    return 3u * triangle + uvec3(0u, 1u, 2u);
}

void main() {
    uint i = invocation_number();
    if (i >= push.triangle_count) return;
    uint t = push.first_triangle + i, d = draw_of(t, push.first_draw, push.draw_count);
    Draw draw = draws[d];
    uvec3 numbers = corners(t - draw.first_triangle);
    // The first corner, whose attributes flat inputs have, stays the first.
    if (push.clockwise != 0u) numbers = numbers.xzy;
    triangles_out[t] = uvec4(position(draw, numbers.x), position(draw, numbers.y), position(draw, numbers.z), draw.word);
    draw_of_out[t] = d;
}
