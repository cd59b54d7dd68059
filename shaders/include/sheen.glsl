// KHR_materials_sheen: fibres on a surface, with the distribution of Estevez and Kulla ("Production Friendly Microfacet Sheen
// BRDF", 2017) and the visibility of Neubelt and Pettineo. Twin: twins/src/sheen.rs.
#ifndef SHEEN_GLSL
#define SHEEN_GLSL

struct Sheen {
    vec3 color;
    float roughness;
    float albedo;       // share of a uniform environment that white sheen reflects
};

// The share of a uniform environment that white sheen reflects: a fit of the integral of distribution times visibility over the
// hemisphere, for roughness of at least 0.15, with errors of up to 0.05.
float sheen_albedo(float roughness, float n_v) {
    vec3 powers = vec3(1.0, n_v, n_v * n_v);
    float exponent = dot(vec3(-0.2872, 0.3874, -0.8319), powers) + dot(vec3(0.1861, -1.3376, 0.0131), powers) / roughness
        + dot(vec3(-0.4766, -0.5986, 1.0871), powers) * roughness;
    return min(exp(exponent), 1.0);
}

// `share` is the share of its reflections that the surface keeps.
Sheen read_sheen(Place place, float n_v, float share) {
    SheenFactors given = sheen_of(place.material);
    Sheen sheen;
    sheen.color = given.color * READ(SHEEN_COLOR_TEXTURE, place).rgb * share;
    sheen.roughness = clamp(given.roughness * READ(SHEEN_ROUGHNESS_TEXTURE, place).a, 0.15, 1.0);
    sheen.albedo = sheen_albedo(sheen.roughness, n_v);
    return sheen;
}

// The share of light that passes the sheen to the surface below, and from there to the eye.
float sheen_passes(Sheen sheen) {
    return 1.0 - greatest(sheen.color) * sheen.albedo;
}

vec3 sheen_light(Sheen sheen, vec3 normal, vec3 mirror, vec3 v, vec3 l, vec3 e) {
    vec3 h = normalize(v + l);
    float n_l = max(dot(normal, l), 0.0), n_v = max(dot(mirror, v), 1e-4), n_h = clamp(dot(mirror, h), 0.0, 1.0);
    float sharpness = 1.0 / (sheen.roughness * sheen.roughness);
    float distribution = (2.0 + sharpness) * pow(1.0 - n_h * n_h, 0.5 * sharpness) / (2.0 * PI);
    return sheen.color * distribution / (4.0 * (n_l + n_v - n_l * n_v)) * n_l * e;
}

#endif
