// transform: every vertex to pixel-scaled clip space, once a frame; raster and sample read the same result.
// Reads: positions. Writes: clip (pixel x * w, pixel y * w, z, w).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
layout(local_size_x = 64) in;

void main() {
    uint v = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (v >= frame.vertex_count) return;
    vec4 p = texelFetch(positions, int(v));
    imageStore(clip_out, int(v), frame.transform * vec4(p.xyz, 1.0));
}
