// The colours of a host's image in linear light. A frame may cover only a part of the image.
#ifndef HOST_IMAGE_GLSL
#define HOST_IMAGE_GLSL
#include "interface.glsl"
layout(constant_id = CONSTANT_ENCODED) const bool ENCODED = false;     // the host has written sRGB codes into a UNORM format
layout(set = SET_BESIDE_FRAME, binding = BINDING_HOST_IMAGE) uniform texture2D host_image;

vec3 srgb_decode(vec3 c) {
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// What the host has drawn at a pixel of the frame.
vec4 drawn_at(uvec2 pixel) {
    vec4 c = texelFetch(host_image, ivec2(frame.color_corner + pixel), 0);
    return vec4(ENCODED ? srgb_decode(clamp(c.rgb, vec3(0.0), vec3(1.0))) : c.rgb, c.a);
}

#endif
