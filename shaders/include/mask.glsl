// Sets of a cell's samples as masks, a bit for each sample in the order of the pattern, and sums over such sets.
#ifndef MASK_GLSL
#define MASK_GLSL
#include "interface.glsl"

// Whether loops over samples take four at a time, which needs fewer registers and instructions. For CPU devices they are
// unrolled.
layout(constant_id = SAMPLE_MASKS_CONSTANT_ROLLED) const bool ROLLED = false;

// Offsets of samples from the middle of their cell, two a vector.
layout(std140, set = SET_FRAME, binding = BINDING_PATTERN) uniform Pattern { vec4 pattern[32]; };

vec2 offsets[SAMPLES];      // the same offsets, read once for unrolled loops

vec2 offset_of(int n) { return n % 2 == 0 ? pattern[n / 2].xy : pattern[n / 2].zw; }

void load_offsets() {
    [[unroll]] for (int n = 0; n < SAMPLES; n++) offsets[n] = offset_of(n);
}

// The set of all samples of the pattern.
uvec2 all_samples() {
    uint count = frame.sample_count;
    return uvec2(count < 32u ? (1u << count) - 1u : ~0u, count < 64u ? (1u << max(count, 32u) - 32u) - 1u : ~0u);
}

// A comparison at samples: of three linear functions E of the position with their least values, or of the depths of two
// surfaces.
struct Comparison {
    vec3 a, b, c;           // E = a x + b y + c
    vec3 least;             // value that each E has to reach
    bool depths;            // the first E has to reach the second one instead
    vec2 low, high;         // bounds to which the first and the second E are clamped
};

// Whether a comparison holds at offset `p`. `c` are the values of its functions at offset 0.
bool holds_at(Comparison k, vec3 c, vec2 p) {
    precise float e0 = k.a.x * p.x + k.b.x * p.y + c.x;
    precise float e1 = k.a.y * p.x + k.b.y * p.y + c.y;
    precise float e2 = k.a.z * p.x + k.b.z * p.y + c.z;
    e0 = clamp(e0, k.low.x, k.high.x);
    e1 = clamp(e1, k.low.y, k.high.y);
    return e0 >= (k.depths ? e1 : k.least.x) && e1 >= k.least.y && e2 >= k.least.z;
}

// The samples of a cell around `at` where a comparison holds.
uvec2 mask_of(Comparison k, vec2 at) {
    precise vec3 c = k.a * at.x + k.b * at.y + k.c;
    uvec2 mask = uvec2(0u);
    if (ROLLED) {
        [[dont_unroll]] for (int four = 0; four < SAMPLES; four += 4) {
            uint bits = 0u;
            [[unroll]] for (int n = 0; n < 4; n++) bits |= holds_at(k, c, offset_of(four + n)) ? 1u << n : 0u;
            bits <<= four & 31;
            mask |= four < 32 ? uvec2(bits, 0u) : uvec2(0u, bits);
        }
    } else {
        [[unroll]] for (int n = 0; n < SAMPLES; n++) mask[n / 32] |= holds_at(k, c, offsets[n]) ? 1u << (n % 32) : 0u;
    }
    return mask;
}

uint samples_of(uvec2 mask) {
    return uint(bitCount(mask.x) + bitCount(mask.y));
}

// The sum of the offsets of a mask's samples.
vec2 sum_of_offsets(uvec2 mask) {
    vec2 sum = vec2(0.0);
    if (ROLLED) {
        [[dont_unroll]] for (int four = 0; four < SAMPLES; four += 4) {
            uint bits = (four < 32 ? mask.x : mask.y) >> (four & 31);
            [[unroll]] for (int n = 0; n < 4; n++) sum += (bits >> n & 1u) != 0u ? offset_of(four + n) : vec2(0.0);
        }
    } else {
        [[unroll]] for (int n = 0; n < SAMPLES; n++) {
            int inside = int(mask[n / 32]) << (31 - n % 32) >> 31;
            sum += intBitsToFloat(floatBitsToInt(offsets[n]) & inside);
        }
    }
    return sum;
}

// The sum of the offsets of up to 8 samples from number `first` on. Behind the pattern's offsets stands a table of sums for runs
// of four samples: 16 vectors for each run, by the bits of a mask. Two of them are added here.
vec2 sum_of_run(uint first, uint samples) {
    uint four = first >> 2, bits = samples << (first & 3u);
    int at = int(frame.sample_count + PROBE_SAMPLES + four * 16u);
    return texelFetch(pattern_offsets, at + int(bits & 15u)).xy + texelFetch(pattern_offsets, at + 16 + int(bits >> 4)).xy;
}

// The runs of `length` samples of which a mask has any, by the bit of their first sample. `length` is 1, 2, 4 or 8.
uvec2 runs_of(uvec2 mask, uint length) {
    uint every = length == 1u ? ~0u : length == 2u ? 0x55555555u : length == 4u ? 0x11111111u : 0x01010101u;
    mask |= length >= 2u ? mask >> 1 : uvec2(0u);
    mask |= length >= 4u ? mask >> 2 : uvec2(0u);
    mask |= length >= 8u ? mask >> 4 : uvec2(0u);
    return mask & every;
}

#endif
