// take: reads the colours of a host's image, or of a part of it, into which superpixels are to be written. It stores them in
// linear light, and as the codes that `detect` compares. An invocation takes a pixel.
// Reads: the image. Writes: color, display.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/host_image.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = invocation_number();
    if (i >= frame.size.x * frame.size.y) return;
    vec4 c = drawn_at(split(i, frame.size.x));
    color[i] = c;
    display_out[i] = display_code(c);
}
