// pose: the vertices of an object in clip space, which the renderer draws and the library samples.
#version 460
#extension GL_GOOGLE_include_directive : require
#define CLIP_ACCESS writeonly
#include "host.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.vertex_count) return;
    Object object = objects[push.object];
    clip[object.first_position + i] = object.to_clip * vec4(position_of(object.first_vertex + i), 1.0);
}
