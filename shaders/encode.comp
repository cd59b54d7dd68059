// encode: converts the region's colours to the format of a host's image, ready to be copied into it. An invocation takes a pixel.
// Reads: color (linear light, premultiplied). Writes: encoded, rows without gaps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ENCODE_CONSTANT_FORMAT) const uint FORMAT = 0u;
layout(std430, set = SET_DATA, binding = BINDING_ENCODED) writeonly buffer Encoded { uint encoded[]; };

void main() {
    uint i = invocation_number();
    if (i >= frame.size.x * frame.size.y) return;
    vec4 c = color[i];
    if (FORMAT == ENCODE_RGBA8_SRGB) {
        encoded[i] = packUnorm4x8(vec4(srgb_encode(c.rgb), c.a));
    } else {
        encoded[2u * i] = packHalf2x16(c.rg);
        encoded[2u * i + 1u] = packHalf2x16(c.ba);
    }
}
