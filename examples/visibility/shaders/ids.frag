// ids: writes the triangle's ID: 1 + its index in the order of the frame's draws.
#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef MASKED
#include "host.glsl"
const float CUTOFF = 0.5;   // as in the alpha map that the library gets
layout(location = 0) in vec2 uv;
#endif
layout(push_constant) uniform Push { uint first_triangle; } push;
layout(location = 0) out uint id;

void main() {
#ifdef MASKED
    // The finest level is read, since thin parts may vanish in the others.
    if (textureLod(fence, uv, 0.0).a < CUTOFF) discard;
#endif
    id = push.first_triangle + uint(gl_PrimitiveID) + 1u;
}
