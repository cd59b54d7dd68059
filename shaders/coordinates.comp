// coordinates: copies the texture coordinates of a host's vertices, for each position in clip space, which an invocation takes.
// Reads: draws, the host's vertices. Writes: coordinates. OBJECT: see transform.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BY_POSITION
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
layout(local_size_x = 64) in;
layout(constant_id = COORDINATES_CONSTANT_OBJECT) const bool OBJECT = false;
layout(std430, set = SET_OWN, binding = COORDINATES_BINDING_VERTICES) readonly buffer Vertices { uint vertices[]; };
layout(std430, set = SET_OWN, binding = COORDINATES_BINDING_COORDINATES_OUT) writeonly buffer CoordinatesOut { uvec2 coordinates_out[]; };
layout(push_constant) uniform Push {
    uint first_position;    // first one of a mesh, whose positions follow each other
    uint position_count;
    uint draw_count;
    uint first_word;        // where the coordinates of the first vertex begin
    uint stride;            // from vertex to vertex, in words
} push;

void main() {
    if (invocation_number() >= push.position_count) return;
    uint i = push.first_position + invocation_number();
    uint vertex = OBJECT ? i + draws[draw_of(i, push.draw_count)].shift : invocation_number();
    uint word = push.first_word + vertex * push.stride;
    coordinates_out[i] = uvec2(vertices[word], vertices[word + 1u]);
}
