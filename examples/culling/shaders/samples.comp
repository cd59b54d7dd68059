// Shades the library's samples. The material is the number of the object.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#define SCENE_SET 1
#include "gpc_visibility.glsl"
#include "scene.glsl"
layout(local_size_x = 64) in;

void main() {
    GpcSample s;
    if (!gpc_sample(0u, s)) return;
    // The first vertex is the one whose outputs a flat input gets.
    gpc_store(s, vec4(color_of(s.material, s.vertices.x), 1.0));
}
