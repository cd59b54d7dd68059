// glTF's metallic-roughness BRDF (glTF 2.0, appendix B): GGX with height-correlated Smith visibility, Schlick
// Fresnel and a Lambertian base. Twin: twins/src/reflection.rs.
#ifndef BRDF_GLSL
#define BRDF_GLSL

const float PI = 3.14159265359;

struct Surface {
    vec3 normal;        // decides how much light arrives
    vec3 mirror;        // the normal for reflections, on the side of the eye
    vec3 diffuse;       // albedo of the base
    vec3 through;       // albedo of the base for light from behind
    vec3 f0;            // reflectance at normal incidence
    float f90;          // reflectance at grazing incidence
    float alpha;        // squared perceptual roughness
    float roughness;    // perceptual
    vec3 along, across; // ANISOTROPY: axes of the reflection, which is stretched along the first
    float alpha_along;
    vec3 emissive;
    float occlusion;
};

vec3 safe_normalize(vec3 v, vec3 otherwise) {
    float l = dot(v, v);
    return l > 1e-30 ? v * inversesqrt(l) : otherwise;
}

float greatest(vec3 v) {
    return max(max(v.x, v.y), v.z);
}

// Schlick's weight of the reflectance at grazing incidence.
float schlick(float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}

vec3 fresnel(Surface s, float v_dot_h) {
    return s.f0 + (s.f90 - s.f0) * schlick(v_dot_h);
}

// The share of light that is left for the diffuse base if the surface reflects the share `reflected`. With materials that tint
// reflections, the strongest channel counts for all, so that the base does not get the complementary tint.
vec3 remaining(vec3 reflected) {
    return SPECULAR || SPECULAR_GLOSSINESS ? vec3(1.0 - greatest(reflected)) : 1.0 - reflected;
}

// The GGX distribution times the visibility term.
float ggx(float alpha, float n_h, float n_l, float n_v) {
    float a2 = alpha * alpha;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (PI * d * d);
    float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2) + 1e-7);
    return distribution * visibility;
}

// Share of a uniform environment that the specular lobe reflects: scale and bias on f0 (a polynomial fit of the
// split sum, after Karis, "Physically Based Shading on Mobile", 2014).
vec2 environment_brdf(float roughness, float n_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
}

#include "anisotropy.glsl"

// The radiance towards `v` due to a light in direction `l`, whose irradiance on a surface that faces it is `e`. Light from
// behind is transmitted, with DIFFUSE_TRANSMISSION.
vec3 reflect_light(Surface s, vec3 v, vec3 l, vec3 e) {
    vec3 h = normalize(v + l);
    float toward = dot(s.normal, l), n_l = max(toward, 0.0), n_v = max(dot(s.mirror, v), 1e-4);
    float n_h = max(dot(s.mirror, h), 0.0), v_h = max(dot(v, h), 0.0);
    float lobe = ANISOTROPY ? ggx_anisotropic(s, v, l, h, n_h, n_l, n_v) : ggx(s.alpha, n_h, n_l, n_v);
    vec3 f = fresnel(s, v_h);
    vec3 r = (remaining(f) * s.diffuse / PI + f * lobe) * e * n_l;
    if (DIFFUSE_TRANSMISSION) r += remaining(fresnel(s, n_v)) * s.through / PI * e * max(-toward, 0.0);
    return r;
}

#endif
