// samples: light by the weights of a triangle's corners, which anything but the library's own records would change.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#include "gpc_visibility.glsl"
layout(local_size_x = 64) in;

void main() {
    GpcSample s;
    if (!gpc_sample(0u, s)) return;
    gpc_store(s, vec4(s.weights, 1.0));
}
