// pose: moves the vertices of an instance of a mesh to their place. An invocation takes a vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POSED_ACCESS writeonly
#include "host.glsl"
#include "posed.glsl"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint first_vertex, vertex_count, first_posed, instance; } push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.vertex_count) return;
    Vertex v = vertices[push.first_vertex + i];
    Instance instance = instances[push.instance];
    vec4 position = vec4(v.position, 1.0);
    positions[push.first_posed + i] = instance.to_clip * position;
    posed[push.first_posed + i].position = (instance.to_world * position).xyz;
    posed[push.first_posed + i].normal = mat3(instance.to_world) * v.normal;
}
