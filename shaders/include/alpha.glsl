// The alpha test of MASK materials, at any position of any triangle: the alpha channel of each base colour
// texture lies in one buffer, since a descriptor can't be indexed by a value that differs within a subgroup.
//
// A word holds the 2 x 2 texels that a bilinear lookup at its place needs, wrapping applied:
// (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1) from the low byte up. The grid of words is one wider and
// higher than the image, as lookups start half a texel outside of it. Levels follow each other.
#ifndef ALPHA_GLSL
#define ALPHA_GLSL
#include "barycentric.glsl"

#define ALPHA_TEXTURED 1u
#define ALPHA_NEAREST_MAG 2u
#define ALPHA_NEAREST_MIN 4u
#define ALPHA_NO_MIP 8u
#define ALPHA_NEAREST_MIP 16u

float alpha_bilinear(uint first, uvec2 size, vec2 uv, bool nearest) {
    vec2 t = uv * vec2(size);
    t = nearest ? floor(t) + 0.5 : t;
    t = clamp(t - 0.5, vec2(-0.5), vec2(size) - 0.5);
    vec2 base = floor(t), f = t - base;
    uvec2 cell = uvec2(ivec2(base) + 1);
    vec4 texels = unpackUnorm4x8(alpha_atlas[first + cell.y * (size.x + 1u) + cell.x]);
    vec2 row = mix(texels.xz, texels.yw, f.x);
    return mix(row.x, row.y, f.y);
}

// Folds a coordinate into 0 to 1 by the wrap mode: 0 repeat, 1 mirrored, 2 clamp.
float alpha_wrap(float u, uint mode) {
    float repeated = u - floor(u);
    float period = u * 0.5 - floor(u * 0.5);
    float mirrored = 1.0 - abs(period * 2.0 - 1.0);
    return mode == 0u ? repeated : mode == 1u ? mirrored : clamp(u, 0.0, 1.0);
}

float alpha_texture(uvec4 atlas, vec2 uv, vec2 dx, vec2 dy) {
    uvec2 size = uvec2(atlas.y & 0xffffu, atlas.y >> 16);
    vec2 gx = dx * vec2(size), gy = dy * vec2(size);
    float rho = sqrt(max(dot(gx, gx), dot(gy, gy)));
    float level = log2(max(rho, 1e-30));
    uint flags = atlas.w, levels = atlas.z;
    bool nearest = (flags & (level <= 0.0 ? ALPHA_NEAREST_MAG : ALPHA_NEAREST_MIN)) != 0u;
    level = (flags & ALPHA_NO_MIP) != 0u ? 0.0 : clamp(level, 0.0, float(levels - 1u));
    level = (flags & ALPHA_NEAREST_MIP) != 0u ? ceil(level + 0.5) - 1.0 : level;
    uv = vec2(alpha_wrap(uv.x, flags >> 8 & 3u), alpha_wrap(uv.y, flags >> 10 & 3u));
    uint low = uint(level), high = min(low + 1u, levels - 1u);
    uint first = atlas.x;
    uvec2 s = size;
    uint first_low = first, first_high = first;
    uvec2 size_low = s, size_high = s;
    for (uint l = 0u; l < levels; l++) {
        first_low = l == low ? first : first_low;
        size_low = l == low ? s : size_low;
        first_high = l == high ? first : first_high;
        size_high = l == high ? s : size_high;
        first += (s.x + 1u) * (s.y + 1u);
        s = max(s >> 1u, uvec2(1u));
    }
    float a = alpha_bilinear(first_low, size_low, uv, nearest);
    float b = alpha_bilinear(first_high, size_high, uv, nearest);
    return mix(a, b, level - float(low));
}

uint material_of(uint t) {
    return texelFetch(triangles, int(t)).w & 0xffffu;
}

float alpha_cutoff(uint t) {
    return materials[material_of(t)].roughness_normal_occlusion_cutoff.w;
}

// Alpha of triangle t at pixel position p: factor, vertex colour and texture.
float alpha_at(uint t, vec2 p) {
    uvec4 indices = texelFetch(triangles, int(t));
    ivec3 v = ivec3(indices.xyz);
    uint m = indices.w & 0xffffu;
    Barycentric b = barycentric(texelFetch(clip, v.x), texelFetch(clip, v.y), texelFetch(clip, v.z), p);
    float alpha = materials[m].base_color.w
        * dot(b.at, vec3(texelFetch(colors, v.x).w, texelFetch(colors, v.y).w, texelFetch(colors, v.z).w));
    uvec4 atlas = materials[m].alpha;
    vec4 row_u = materials[m].uv_rows[0], row_v = materials[m].uv_rows[1];
    vec4 t0 = texelFetch(uvs, v.x), t1 = texelFetch(uvs, v.y), t2 = texelFetch(uvs, v.z);
    bool second = row_u.w != 0.0;
    vec2 u0 = second ? t0.zw : t0.xy, u1 = second ? t1.zw : t1.xy, u2 = second ? t2.zw : t2.xy;
    mat3x2 corners = mat3x2(u0, u1, u2);
    vec2 uv = corners * b.at, dx = corners * b.dx * frame.footprint, dy = corners * b.dy * frame.footprint;
    mat2 linear = mat2(row_u.x, row_v.x, row_u.y, row_v.y);
    uv = linear * uv + vec2(row_u.z, row_v.z);
    bool textured = (atlas.w & ALPHA_TEXTURED) != 0u;
    float texel = alpha_texture(textured ? atlas : uvec4(0u, 0x10001u, 1u, ALPHA_NO_MIP), uv, linear * dx, linear * dy);
    return textured ? alpha * texel : alpha;
}

#endif
