// transform: computes the positions of a host's vertices in clip space. An invocation takes a position.
// Reads: draws, the host's vertices, matrices. Writes: positions. Twin: twins/src/transform.rs.
// Positions of vertices are four floats in clip space, and are copied. With OBJECT they are three numbers in object space; each
// draw has positions of its own, which are multiplied by its matrix.
#version 460
#extension GL_GOOGLE_include_directive : require
#define BY_POSITION
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
#include "include/vertices.glsl"
#include "include/gpc_position.glsl"
layout(local_size_x = 64) in;
layout(constant_id = TRANSFORM_CONSTANT_OBJECT) const bool OBJECT = false;
layout(std430, set = SET_OWN, binding = TRANSFORM_BINDING_MATRICES) readonly buffer Matrices { mat4 matrices[]; };
layout(std430, set = SET_OWN, binding = TRANSFORM_BINDING_POSITIONS_OUT) writeonly buffer PositionsOut { uvec4 positions_out[]; };

void main() {
    uint vertex = invocation_number();
    if (vertex >= push.position_count) return;
    uint i = push.first_position + vertex;
    if (OBJECT) {
        uint d = draw_of(i, push.first_draw, push.draw_count);
        vertex = vertex_of(i, draws[d]);
        vec3 numbers = vec3(component(vertex, 0u), component(vertex, 1u), component(vertex, 2u));
        precise vec3 scaled = push.scale.xyz * numbers;
        precise vec3 position = push.bias.xyz + scaled;
        positions_out[i] = floatBitsToUint(gpc_clip_position(matrices[d], position));
    } else {
        positions_out[i] = uvec4(component_bits(vertex, 0u), component_bits(vertex, 1u), component_bits(vertex, 2u),
                                 component_bits(vertex, 3u));
    }
}
