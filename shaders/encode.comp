// encode: converts the region's colours to the format of a host's image or of an image file, ready to be copied. An invocation takes
// a pixel.
// Reads: color (linear light, premultiplied), encoded (thresholds). Writes: encoded, rows without gaps.
//
// Codes of image files are exact: those that src/engine/color/srgb.rs computes in double precision. A code is the number of
// thresholds that the quotient of a colour and its alpha reaches. An estimate in single precision says the code, unless it is near a
// threshold; there, integers decide. src/render/passes/encode.rs makes the thresholds, and has the twin.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/finite.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ENCODE_CONSTANT_FORMAT) const uint FORMAT = 0u;
layout(std430, set = SET_DATA, binding = BINDING_ENCODED) buffer Encoded { uint encoded[]; };

// How near to a threshold an estimate does not say the code, in codes. Estimates are wrong by a tenth of this: with the precision that
// Vulkan requires of a division (2.5 units in the last place), of log2 and of exp2, by less than 0.001.
const float UNSURE = 1.0 / 128.0;
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

// Codes of a colour divided by its alpha, and of its alpha.
uint straight(vec4 c) {
    vec4 estimates = 255.0 * vec4(srgb_encode(c.rgb / c.a), clamp(c.a, 0.0, 1.0));
    [[unroll]] for (int channel = 0; channel < 4; channel++)
        if (is_nan(c[channel]) || c[channel] <= 0.0) estimates[channel] = 0.0;
    vec4 rounded = estimates + 0.5, codes = floor(rounded), beyond = rounded - codes;
    uint unsure = 0u;
    [[unroll]] for (int channel = 0; channel < 4; channel++)
        unsure |= min(beyond[channel], 1.0 - beyond[channel]) < UNSURE ? 1u << channel : 0u;
    while (unsure != 0u) {
        int channel = findLSB(unsure);
        unsure &= unsure - 1u;
        bool is_alpha = channel == 3, has_passed = beyond[channel] < 0.5;
        // The threshold at which the code becomes the one that the quotient is near to.
        uint threshold = uint(codes[channel]) - (has_passed ? 1u : 0u);
        bool reached = reaches(c[channel], is_alpha ? 1.0 : c.a, threshold + (is_alpha ? ENCODE_THRESHOLDS : 0u));
        codes[channel] = float(threshold) + (reached ? 1.0 : 0.0);
    }
    uvec4 word = uvec4(codes);
    // The colour of a transparent pixel is 0, as is light divided by an infinite alpha.
    uint color = word.r | word.g << 8 | word.b << 16;
    return (word.a == 0u || !is_finite(c.a) ? 0u : color) | word.a << 24;
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
