// forward: writes the light of a fragment, and the ID of its triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "host.glsl"
#include "materials.glsl"
layout(constant_id = 0) const uint KEY = 0u;
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 turned;
layout(location = 0) out vec4 color;
layout(location = 1) out uint id;

void main() {
    vec3 paint = objects[push.object].color.rgb;
    color = vec4(light_of(KEY, paint, place, turned, push.eye.xyz, dFdx(place), dFdy(place)), 1.0);
    id = push.first_triangle + uint(gl_PrimitiveID) + 1u;
}
