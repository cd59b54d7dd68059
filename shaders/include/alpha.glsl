// The alpha of materials that are not opaque, and the alpha test of MASK ones, at any position of any triangle. Invocations of a subgroup may test triangles with
// different textures, but can't index an array of textures by values that differ. So the alpha channels of all base colour
// textures are stored in one buffer, the alpha atlas.
//
// A word of the atlas holds the 2 x 2 texels of one bilinear lookup, wrapping applied:
// (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1) from the low byte up. The grid of words is one wider and
// higher than the image, since lookups begin half a texel outside of it. In front of a texture's levels stands a table with
// the first word of each level.
#ifndef ALPHA_GLSL
#define ALPHA_GLSL
#include "finite.glsl"
#include "material.glsl"
#include "triangle.glsl"

// What the alpha test of one triangle needs. `weight`, `u`, `v` and `opacity` are linear functions (planes) of the position
// relative to a centre. Texture coordinates and alpha are the values of the latter three divided by that of `weight`.
struct AlphaTest {
    vec3 weight, u, v, opacity;
    uvec2 first;            // first words of the two levels between which is interpolated, the finer one first
    uvec2 size_low, size_high;
    float level_blend;
    bool nearest;
    uint flags;
    float cutoff;
};

// The test of triangle `t`, for positions relative to `center`. Its mipmap level is chosen for a footprint at `at`: a
// parallelogram whose sides are the columns of `pixel`.
AlphaTest alpha_test(uint t, vec2 center, vec2 at, mat2 pixel) {
    Triangle k = triangle_at(t);
    ivec3 v = k.vertices;
    uint m = material_of(k.word);
    vec4 c0 = k.v0, c1 = k.v1, c2 = k.v2;
    vec3 p0 = vec3(c0.xy - center * c0.w, c0.w), p1 = vec3(c1.xy - center * c1.w, c1.w), p2 = vec3(c2.xy - center * c2.w, c2.w);
    mat3 edges = mat3(cross(p1, p2), cross(p2, p0), cross(p0, p1));

    UvTransform row = uv_transform_of(m, 0u);
    vec4 t0 = texelFetch(uvs, v.x), t1 = texelFetch(uvs, v.y), t2 = texelFetch(uvs, v.z);
    vec3 us = row.second ? vec3(t0.z, t1.z, t2.z) : vec3(t0.x, t1.x, t2.x);
    vec3 vs = row.second ? vec3(t0.w, t1.w, t2.w) : vec3(t0.y, t1.y, t2.y);

    AlphaTest r;
    r.weight = edges * vec3(1.0);
    r.u = edges * (row.u.x * us + row.u.y * vs + row.u.z);
    r.v = edges * (row.v.x * us + row.v.y * vs + row.v.z);
    r.opacity = edges * vec3(texelFetch(colors, v.x).w, texelFetch(colors, v.y).w, texelFetch(colors, v.z).w) * base_color_of(m).w;
    r.cutoff = factors_of(m).cutoff;

    AlphaMap map = alpha_map_of(m);
    uvec2 size = map.size;
    r.flags = map.flags;
    float w = 1.0 / dot(r.weight, vec3(at, 1.0));
    vec2 uv = vec2(dot(r.u, vec3(at, 1.0)), dot(r.v, vec3(at, 1.0))) * w;
    mat2 slope = mat2(vec2(r.u.x, r.v.x) - uv * r.weight.x, vec2(r.u.y, r.v.y) - uv * r.weight.y) * pixel;
    vec2 dx = slope[0] * w * vec2(size), dy = slope[1] * w * vec2(size);
    float level = 0.5 * log2(clamp(max(dot(dx, dx), dot(dy, dy)), 1e-30, 1e30));
    r.nearest = (r.flags & (level <= 0.0 ? ALPHA_NEAREST_MAG : ALPHA_NEAREST_MIN)) != 0u;
    level = (r.flags & ALPHA_NO_MIP) != 0u ? 0.0 : clamp(level, 0.0, float(map.levels - 1u));
    level = (r.flags & ALPHA_NEAREST_MIP) != 0u ? ceil(level + 0.5) - 1.0 : level;
    uint low = uint(level), high = min(low + 1u, map.levels - 1u);
    r.level_blend = level - float(low);
    r.first = uvec2(texelFetch(alpha_atlas, int(map.table + low)).x, texelFetch(alpha_atlas, int(map.table + high)).x);
    r.size_low = max(size >> low, uvec2(1u));
    r.size_high = max(size >> high, uvec2(1u));
    return r;
}

float alpha_bilinear(uint first, uvec2 size, vec2 uv, bool nearest) {
    vec2 t = uv * vec2(size);
    t = nearest ? floor(t) + 0.5 : t;
    t = clamp(t - 0.5, vec2(-0.5), vec2(size) - 0.5);
    vec2 base = floor(t), f = t - base;
    uvec2 cell = uvec2(ivec2(base) + 1);
    vec4 texels = unpackUnorm4x8(texelFetch(alpha_atlas, int(first + cell.y * (size.x + 1u) + cell.x)).x);
    vec2 row = mix(texels.xz, texels.yw, f.x);
    return mix(row.x, row.y, f.y);
}

// Folds a coordinate into 0 to 1 by the wrap mode.
float alpha_wrap(float u, uint mode) {
    float repeated = u - floor(u);
    float period = u * 0.5 - floor(u * 0.5);
    float mirrored = 1.0 - abs(period * 2.0 - 1.0);
    float folded = mode == WRAP_REPEAT ? repeated : mode == WRAP_MIRRORED_REPEAT ? mirrored : u;
    return clamp(folded, 0.0, 1.0);
}

// The triangle's alpha at `p`: the product of the alphas of factor, vertex colour and texture.
float alpha_at(AlphaTest test, vec2 p) {
    vec3 at = vec3(p, 1.0);
    float w = 1.0 / dot(test.weight, at);
    float alpha = dot(test.opacity, at) * w;
    vec2 uv = vec2(dot(test.u, at), dot(test.v, at)) * w;
    uv = vec2(alpha_wrap(uv.x, test.flags >> 8 & 3u), alpha_wrap(uv.y, test.flags >> 10 & 3u));
    uv = mix(uv, vec2(0.0), bvec2(is_nan(uv.x), is_nan(uv.y)));
    float low = alpha_bilinear(test.first.x, test.size_low, uv, test.nearest);
    float high = alpha_bilinear(test.first.y, test.size_high, uv, test.nearest);
    float texel = mix(low, high, test.level_blend);
    return alpha * ((test.flags & ALPHA_TEXTURED) != 0u ? texel : 1.0);
}

// Whether the triangle passes the alpha test at `p`: whether its alpha reaches the cutoff.
bool alpha_passes(AlphaTest test, vec2 p) { return alpha_at(test, p) >= test.cutoff; }

#endif
