// The tint of a layer: the share of light that it lets through, for each channel. It is packed into the fourth number of a
// shaded fragment: ten bits for the square root of each channel, so that dark tints keep their colour. Bit 30 is the opposite of bit 29,
// so that the exponent of the number is neither 0 nor the largest one: devices may change numbers with such exponents to 0 or NaN.
#ifndef TINT_GLSL
#define TINT_GLSL
#include "interface.glsl"

layout(constant_id = CONSTANT_TINTED) const bool TINTED = false;     // layers have tints, not opacities; light is premultiplied

float pack_tint(vec3 through) {
    uvec3 q = uvec3(round(sqrt(clamp(through, vec3(0.0), vec3(1.0))) * 1023.0));
    uint word = q.x | q.y << 10 | q.z << 20;
    return uintBitsToFloat(word | (~word & 0x20000000u) << 1);
}

vec3 unpack_tint(float word) {
    vec3 root = vec3(uvec3(floatBitsToUint(word)) >> uvec3(0u, 10u, 20u) & 0x3ffu) * (1.0 / 1023.0);
    return root * root;
}

#endif
