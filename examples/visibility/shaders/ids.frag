// ids: 1 + the triangle's index in the order of the frame's draws.
#version 460
layout(push_constant) uniform Push { uint first_triangle; } push;
layout(location = 0) out uint id;

void main() {
    id = push.first_triangle + uint(gl_PrimitiveID) + 1u;
}
