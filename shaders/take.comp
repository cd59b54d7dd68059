// take: a host's image, or a part of it, as what superpixels stand in: its colours in linear light, and the codes that detection compares.
// Reads: the image. Writes: color, display. ENCODED: the host has written sRGB codes into a format of plain numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
layout(local_size_x = 64) in;
layout(constant_id = TAKE_CONSTANT_ENCODED) const bool ENCODED = false;
layout(set = SET_BESIDE_FRAME, binding = TAKE_BINDING_HOST_IMAGE) uniform texture2D host_image;

vec3 srgb_decode(vec3 c) {
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

void main() {
    uint i = invocation_number();
    if (i >= frame.size.x * frame.size.y) return;
    vec4 c = texelFetch(host_image, ivec2(frame.color_corner + split(i, frame.size.x)), 0);
    c.rgb = ENCODED ? srgb_decode(clamp(c.rgb, vec3(0.0), vec3(1.0))) : c.rgb;
    color[i] = c;
    display_out[i] = display_code(c);
}
