// transform: computes the positions of a host's vertices in clip space. An invocation takes a position.
// Reads: draws, the host's vertices, matrices. Writes: positions. Twin: `gpc::reference::transform`.
// Positions of vertices are four floats in clip space, and are copied. With OBJECT they are three floats in object space; each
// draw has positions of its own, which are multiplied by its matrix.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BY_POSITION
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
#include "include/gpc_position.glsl"
layout(local_size_x = 64) in;
layout(constant_id = TRANSFORM_CONSTANT_OBJECT) const bool OBJECT = false;
layout(std430, set = SET_OWN, binding = TRANSFORM_BINDING_VERTICES) readonly buffer Vertices { uint vertices[]; };
layout(std430, set = SET_OWN, binding = TRANSFORM_BINDING_MATRICES) readonly buffer Matrices { mat4 matrices[]; };
layout(std430, set = SET_OWN, binding = TRANSFORM_BINDING_POSITIONS_OUT) writeonly buffer PositionsOut { uvec4 positions_out[]; };
layout(push_constant) uniform Push {
    uint first_position;    // first one of a mesh, whose positions follow each other
    uint position_count;
    uint draw_count;
    uint first_word;        // where the position of the first vertex begins
    uint stride;            // from vertex to vertex, in words
} push;

void main() {
    if (invocation_number() >= push.position_count) return;
    uint i = push.first_position + invocation_number();
    uint d = OBJECT ? draw_of(i, push.draw_count) : 0u;
    uint vertex = OBJECT ? i + draws[d].shift : invocation_number();
    uint word = push.first_word + vertex * push.stride;
    uvec3 xyz = uvec3(vertices[word], vertices[word + 1u], vertices[word + 2u]);
    positions_out[i] = OBJECT ? floatBitsToUint(gpc_clip_position(matrices[d], uintBitsToFloat(xyz)))
                              : uvec4(xyz, vertices[word + 3u]);
}
