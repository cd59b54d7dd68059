// encode: converts the region's colours to the format of a host's image or of an image file, ready to be copied. An invocation takes
// a pixel.
// Reads: color (linear light, premultiplied), encoded (thresholds). Writes: encoded, rows without gaps.
//
// Codes of image files are exact: those that src/engine/color/srgb.rs computes in double precision. An estimate in single precision
// is at most one code off, and integers decide whether it is. A code is the number of thresholds that the quotient of a colour and
// its alpha reaches. src/render/passes/encode.rs makes the thresholds, and has the twin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/finite.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ENCODE_CONSTANT_FORMAT) const uint FORMAT = 0u;
layout(std430, set = SET_DATA, binding = BINDING_ENCODED) buffer Encoded { uint encoded[]; };

const uint MANTISSA = 0x7fffffu, LEADING = 0x800000u;

uvec2 doubled(uvec2 high_low) { return uvec2(high_low.x << 1 | high_low.y >> 31, high_low.y << 1); }

// Whether the quotient of two positive, finite floats reaches threshold number `index`: a fraction from 1 to 2, whose numerator has
// 28 bits of the first word, divided by the power of two of the other 4 bits.
bool reaches(float dividend, float divisor, uint index) {
    uint a = floatBitsToUint(dividend), b = floatBitsToUint(divisor);
    uint numerator = encoded[2u * index], denominator = encoded[2u * index + 1u];
    int power = int(a >> 23) - int(b >> 23) + int(numerator >> 28);
    // The quotient of the mantissas is between 1/2 and 2.
    if (abs(power) > 1) return power > 0;
    uvec2 left, right;
    umulExtended((a & MANTISSA) | LEADING, denominator, left.x, left.y);
    umulExtended((b & MANTISSA) | LEADING, numerator & 0xfffffffu, right.x, right.y);
    if (power > 0) left = doubled(left);
    if (power < 0) right = doubled(right);
    return left.x > right.x || (left.x == right.x && left.y >= right.y);
}

// Code of the quotient of a channel and a positive, finite divisor. `estimate` is about the code; `first` is the number of the
// channel's first threshold.
uint code(float channel, float divisor, float estimate, uint first) {
    if (is_nan(channel) || channel <= 0.0) return 0u;
    uint near = uint(clamp(estimate + 0.5, 0.0, 255.0));
    if (near < ENCODE_THRESHOLDS && reaches(channel, divisor, first + near)) return near + 1u;
    return near > 0u && !reaches(channel, divisor, first + near - 1u) ? near - 1u : near;
}

uint straight(vec4 c) {
    uint alpha = code(c.a, 1.0, 255.0 * c.a, ENCODE_THRESHOLDS);
    // The colour of a transparent pixel is 0, as is light divided by an infinite alpha.
    if (alpha == 0u || !is_finite(c.a)) return alpha << 24;
    vec3 estimates = 255.0 * srgb_encode(c.rgb / c.a);
    uint word = alpha << 24;
    for (int channel = 0; channel < 3; ++channel)
        word |= code(c[channel], c.a, estimates[channel], 0u) << (8 * channel);
    return word;
}

void main() {
    uint i = invocation_number();
    if (i >= frame.size.x * frame.size.y) return;
    vec4 c = color[i];
    if (FORMAT == ENCODE_RGBA16F) {
        encoded[ENCODE_THRESHOLD_WORDS + 2u * i] = packHalf2x16(c.rg);
        encoded[ENCODE_THRESHOLD_WORDS + 2u * i + 1u] = packHalf2x16(c.ba);
    } else {
        bool is_straight = FORMAT == ENCODE_STRAIGHT_RGBA8;
        encoded[ENCODE_THRESHOLD_WORDS + i] = is_straight ? straight(c) : packUnorm4x8(vec4(srgb_encode(c.rgb), c.a));
    }
}
