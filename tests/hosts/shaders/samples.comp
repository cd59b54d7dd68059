// samples: shades each sample with its barycentric coordinates, so that a change of the library's visibility samples changes the image.
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
