// Colour transforms; the twins are src/engine/color/tonemap.rs and src/engine/color/srgb.rs.
#include "interface.glsl"

// Khronos PBR Neutral tone mapping, in the form of its specification (2024): linear in, linear out.
vec3 tonemap_neutral(vec3 c) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float x = min(c.r, min(c.g, c.b));
    float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    c -= offset;
    float peak = max(c.r, max(c.g, c.b));
    const float d = 1.0 - start;
    float compressed = 1.0 - d * d / (peak + d - start);
    float g = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
    vec3 bent = mix(c * (compressed / max(peak, 1e-20)), vec3(compressed), g);
    return peak < start ? c : bent;
}

vec3 srgb_encode(vec3 c) {
    c = clamp(c, vec3(0.0), vec3(1.0));
    return mix(1.055 * pow(max(c, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// Tone-maps premultiplied radiance.
vec4 tonemap(vec4 c) {
    return c.a >= 1.0 ? vec4(tonemap_neutral(c.rgb), c.a) : vec4(tonemap_neutral(c.rgb / max(c.a, 1e-6)) * c.a, c.a);
}

layout(constant_id = CONSTANT_TONEMAP) const bool TONEMAP = true;         // the output is display-referred
layout(constant_id = CONSTANT_TONEMAP_CODES) const bool TONEMAP_CODES = true;   // detection compares tone-mapped colours

// Converts premultiplied radiance to what the output holds.
vec4 to_output(vec4 c) {
    return TONEMAP ? tonemap(c) : c;
}

// What `detect` compares: the 8-bit sRGB codes of a colour of the output, and its alpha.
uint display_code(vec4 c) {
    c = TONEMAP_CODES && !TONEMAP ? tonemap(c) : c;
    return packUnorm4x8(vec4(srgb_encode(c.rgb), c.a));
}
