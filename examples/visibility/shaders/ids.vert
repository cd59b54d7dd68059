// ids: draws the host's visibility buffer. MASKED: surfaces with holes, which need texture coordinates.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "host.glsl"
#include "posed.glsl"

#ifdef MASKED
layout(location = 0) out vec2 uv;
#endif

void main() {
#ifdef MASKED
    uv = coordinates[gl_VertexIndex];
#endif
    gl_Position = positions[gl_VertexIndex];
}
