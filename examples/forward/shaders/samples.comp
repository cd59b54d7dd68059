// samples: shades the library's samples with the renderer's materials, in a dispatch for each material. An invocation takes a
// sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 0
#define HOST_SET 1
#include "gpc_visibility.glsl"
#include "host.glsl"
#include "materials.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint KEY = 0u;

void main() {
    GpcSample s;
    if (!gpc_sample(KEY, s)) return;
    Object object = objects[s.draw];
    uvec3 v = s.vertices;
    mat3 corners = mat3(object.to_world) * mat3(position_of(v.x), position_of(v.y), position_of(v.z));
    mat3 normals = mat3(object.to_world) * mat3(normal_of(v.x), normal_of(v.y), normal_of(v.z));
    vec3 place = corners * s.weights + object.to_world[3].xyz;
    vec3 light = light_of(KEY, object.color.rgb, place, normals * s.weights, push.eye.xyz, corners * s.dx, corners * s.dy);
    gpc_store(s, vec4(light, 1.0));
}
