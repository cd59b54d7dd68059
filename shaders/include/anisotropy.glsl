// KHR_materials_anisotropy: reflections stretched along a direction of the surface, with the anisotropic GGX distribution
// (Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", 2014).
#ifndef ANISOTROPY_GLSL
#define ANISOTROPY_GLSL

// Sets the axes of a surface's reflection, and its roughness along the first axis.
void draw_out(inout Surface s, Place place, vec3 tangent, vec3 bitangent) {
    AnisotropyFactors given = anisotropy_of(place.material);
    vec4 texel = READ(ANISOTROPY_TEXTURE, place);
    vec2 direction = ANISOTROPY_TEXTURE != 0u ? texel.rg * 2.0 - 1.0 : vec2(1.0, 0.0);
    direction = mat2(given.cosine, given.sine, -given.sine, given.cosine) * direction;
    float strength = given.strength * texel.b;
    vec3 any = abs(s.mirror.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 along = tangent * direction.x + bitangent * direction.y;
    // Perpendicular to the normal, which a texture may have turned. An axis near a mirrored normal loses its direction there, and
    // therefore its effect.
    vec3 within = along - s.mirror * dot(s.mirror, along), before = along - s.normal * dot(s.normal, along);
    float length_within = dot(within, within), length_before = dot(before, before);
    s.along = safe_normalize(within, normalize(cross(s.mirror, any)));
    s.across = cross(s.mirror, s.along);
    float kept = length_within < length_before ? length_within / length_before : 1.0;
    s.alpha_along = mix(s.alpha, 1.0, strength * strength * kept);
}

// Distribution times visibility.
float ggx_anisotropic(Surface s, vec3 v, vec3 l, vec3 h, float n_h, float n_l, float n_v) {
    float a = s.alpha_along, b = s.alpha;
    vec3 d = vec3(b * dot(s.along, h), a * dot(s.across, h), a * b * n_h);
    float w = a * b / max(dot(d, d), 1e-20);
    float distribution = a * b * w * w / PI;
    float to_eye = length(vec3(a * dot(s.along, v), b * dot(s.across, v), n_v));
    float to_light = length(vec3(a * dot(s.along, l), b * dot(s.across, l), n_l));
    return distribution * 0.5 / (n_l * to_eye + n_v * to_light + 1e-7);
}

// The normal at which the view is mirrored to look up the environment. It is bent towards the direction that results from
// removing from `v` its part along `s.along`. The more the lobe is stretched, the more it is bent.
vec3 bent_normal(Surface s, vec3 v) {
    vec3 bent = safe_normalize(cross(cross(s.along, v), s.along), s.mirror);
    float share = clamp((s.alpha_along - s.alpha) / max(s.alpha_along + s.alpha, 1e-4), 0.0, 1.0);
    return safe_normalize(mix(s.mirror, bent, share * share), s.mirror);
}

#endif
