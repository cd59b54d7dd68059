// glTF's metallic-roughness BRDF (glTF 2.0, appendix B): GGX with height-correlated Smith visibility, Schlick
// Fresnel and a Lambertian base.

const float PI = 3.14159265359;

struct Surface {
    vec3 normal;
    vec3 diffuse;       // albedo of the base
    vec3 f0;            // reflectance at normal incidence
    float alpha;        // squared perceptual roughness
    vec3 emissive;
    float occlusion;
    float opacity;
};

vec3 fresnel(vec3 f0, float v_dot_h) {
    float m = 1.0 - clamp(v_dot_h, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}

// Radiance reflected to `v` of light from `l` with irradiance `e` on a surface facing it.
vec3 reflect_light(Surface s, vec3 v, vec3 l, vec3 e) {
    vec3 h = normalize(v + l);
    float n_l = max(dot(s.normal, l), 0.0), n_v = max(dot(s.normal, v), 1e-4);
    float n_h = max(dot(s.normal, h), 0.0), v_h = max(dot(v, h), 0.0);
    float a2 = s.alpha * s.alpha;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (PI * d * d);
    float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2) + 1e-7);
    vec3 f = fresnel(s.f0, v_h);
    return ((1.0 - f) * s.diffuse / PI + f * distribution * visibility) * e * n_l;
}

// Share of a uniform environment that the specular lobe reflects: scale and bias on f0 (a polynomial fit of the
// split sum, after Karis, "Physically Based Shading on Mobile", 2014).
vec2 environment_brdf(float roughness, float n_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
}
