// forward: transforms an object's vertices, which are in the renderer's own format.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "host.glsl"
#include "gpc_position.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 turned;

void main() {
    Object object = objects[push.object];
    gl_Position = gpc_clip_position(object.to_clip, position);
    place = (object.to_world * vec4(position, 1.0)).xyz;
    turned = mat3(object.to_world) * normal.xyz;
}
