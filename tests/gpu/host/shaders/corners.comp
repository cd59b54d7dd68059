// corners: positions that the library has in clip space.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#include "gpc_visibility.glsl"
#include "host.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= 3u * push.triangle_count) return;
    corners[i] = gpc_positions[gpc_triangles[i / 3u][i % 3u]];
}
