// KHR_materials_clearcoat: a layer of varnish over everything else. What the varnish reflects is missing from the light of what
// lies below.
#ifndef CLEARCOAT_GLSL
#define CLEARCOAT_GLSL

struct Coat {
    vec3 normal;        // decides how much light arrives
    vec3 mirror;        // the normal for reflections, on the side of the eye
    float alpha, roughness;
    float weight;       // share of the light towards the eye that is the coat's
};

// The coat at a place. The tangent, bitangent and normal are those of the mesh: the base's normal texture does not turn them.
Coat read_coat(Place place, vec3 tangent, vec3 bitangent, vec3 normal, vec3 v) {
    ClearcoatFactors given = clearcoat_of(place.material);
    Coat coat;
    coat.normal = normal;
    if (CLEARCOAT_NORMAL_TEXTURE != 0u)
        coat.normal = bumped(READ(CLEARCOAT_NORMAL_TEXTURE, place), given.normal_scale, tangent, bitangent, normal);
    coat.mirror = facing(coat.normal, v);
    coat.roughness = clamp(given.roughness * READ(CLEARCOAT_ROUGHNESS_TEXTURE, place).g, 0.04, 1.0);
    coat.alpha = coat.roughness * coat.roughness;
    float f = 0.04 + 0.96 * schlick(dot(coat.mirror, v));
    coat.weight = given.factor * READ(CLEARCOAT_TEXTURE, place).r * f * facing_share(coat.normal, v);
    return coat;
}

// Radiance that a coat of weight 1 reflects of a light.
vec3 coat_light(Coat coat, vec3 v, vec3 l, vec3 e) {
    vec3 h = normalize(v + l);
    float n_l = max(dot(coat.normal, l), 0.0);
    return ggx(coat.alpha, max(dot(coat.mirror, h), 0.0), n_l, max(dot(coat.mirror, v), 1e-4)) * n_l * e;
}

// Radiance that a coat of weight 1 reflects of the environment.
vec3 coat_environment(Coat coat, vec3 v) {
    vec2 split = environment_brdf(coat.roughness, max(dot(coat.mirror, v), 1e-4));
    return min(split.x + split.y, 1.0) * environment_reflection(reflect(-v, coat.mirror), coat.roughness);
}

#endif
