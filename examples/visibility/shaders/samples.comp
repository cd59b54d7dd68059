// samples: shades the library's samples with the host's materials, in a dispatch for each material. An invocation takes a sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#define HOST_SET 1
#include "gpc_visibility.glsl"
#include "host.glsl"
#include "posed.glsl"
#include "materials.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint KEY = 0u;

void main() {
    GpcSample s;
    if (!gpc_sample(KEY, s)) return;
    gpc_store(s, vec4(light_of(KEY, s.vertices, s.weights, s.dx, s.dy), 1.0));
}
