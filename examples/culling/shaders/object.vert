// Draws the objects of the list that `cull` wrote.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "gpc_instance.glsl"
layout(std430, set = SCENE_SET, binding = 4) readonly buffer Instances { GpcInstance instances[]; };
layout(location = 0) flat out vec3 color;

void main() {
    uint vertex = uint(gl_VertexIndex);
    gl_Position = instances[gl_InstanceIndex].to_clip * vec4(position_of(vertex), 1.0);
    color = color_of(instances[gl_InstanceIndex].material, vertex);
}
