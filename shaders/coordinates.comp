// coordinates: gathers the texture coordinates of a host's vertices, for each position in clip space, which an invocation takes.
// Reads: draws, the host's vertices. Writes: coordinates. OBJECT: see transform.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BY_POSITION
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
#include "include/vertices.glsl"
layout(local_size_x = 64) in;
layout(constant_id = COORDINATES_CONSTANT_OBJECT) const bool OBJECT = false;
layout(std430, set = SET_OWN, binding = COORDINATES_BINDING_COORDINATES_OUT) writeonly buffer CoordinatesOut { vec2 coordinates_out[]; };

void main() {
    uint vertex = invocation_number();
    if (vertex >= push.position_count) return;
    uint i = push.first_position + vertex;
    if (OBJECT) vertex = vertex_of(i, draws[draw_of(i, push.first_draw, push.draw_count)]);
    coordinates_out[i] = push.bias.xy + push.scale.xy * vec2(component(vertex, 0u), component(vertex, 1u));
}
