// ids: the host's visibility buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "host.glsl"
#include "posed.glsl"

void main() {
    gl_Position = positions[gl_VertexIndex];
}
