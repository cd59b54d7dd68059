// samples: the colour of a draw, in the shade that its vertices have.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#include "gpc_visibility.glsl"
#include "host.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint KEY = 0u;

void main() {
    GpcSample s;
    if (!gpc_sample(KEY, s)) return;
    // Draws that the device wrote have 1 + their number in the upper half of the material.
    uint part = s.material > 0xffffu ? (s.material >> 16) - 1u : s.draw;
    float paint = dot(vec3(paints[s.vertices.x], paints[s.vertices.y], paints[s.vertices.z]), s.weights);
    if (!s.front) paint *= push.back;
    gpc_store(s, vec4(colors[part].rgb * paint, colors[part].a));
}
