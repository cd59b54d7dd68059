// KHR_materials_iridescence: interference in a thin film over the base (Belcour and Barla, "A Practical Extension to
// Microfacet Theory for the Modeling of Varying Iridescence", 2017).
#ifndef IRIDESCENCE_GLSL
#define IRIDESCENCE_GLSL

// The colour, in linear sRGB, of a spectrum that is a cosine of the wave number: the Fourier transform of the eye's response,
// fitted by four Gaussians. `path` is the difference of optical paths in nanometres.
vec3 sensitivity(float path, vec3 shift) {
    float phase = 2.0 * PI * path * 1e-9;
    const vec3 value = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    const vec3 position = vec3(1.6810e6, 1.7953e6, 2.2084e6);
    const vec3 variance = vec3(4.3278e9, 9.3046e9, 6.6121e9);
    vec3 xyz = value * sqrt(2.0 * PI * variance) * cos(position * phase + shift) * exp(-phase * phase * variance);
    xyz.x += 9.7470e-14 * sqrt(2.0 * PI * 4.5282e9) * cos(2.2399e6 * phase + shift.x) * exp(-4.5282e9 * phase * phase);
    const mat3 to_srgb = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252);
    return to_srgb * (xyz / 1.0685e-7);
}

vec3 schlick_reflectance(vec3 f0, float cosine) {
    return f0 + (1.0 - f0) * schlick(cosine);
}

vec3 reflectance_between(vec3 n1, float n2) {
    vec3 ratio = (n1 - n2) / (n1 + n2);
    return ratio * ratio;
}

// Reflectance of a film over a base with reflectance `f0` at normal incidence. `n_v` is the cosine of the angle of view.
vec3 film_reflectance(float n_v, float film_ior, float thickness, vec3 f0) {
    // As its thickness goes to 0, the film turns into air.
    float ior = mix(1.0, film_ior, smoothstep(0.0, 0.03, thickness));
    float inner = sqrt(max(1.0 - (1.0 - n_v * n_v) / (ior * ior), 0.0));
    vec3 outer = schlick_reflectance(reflectance_between(vec3(1.0), ior), n_v);
    vec3 root = sqrt(clamp(f0, vec3(0.0), vec3(0.9999)));
    vec3 base_ior = (1.0 + root) / (1.0 - root);
    vec3 base = schlick_reflectance(reflectance_between(base_ior, ior), inner);
    // Phase shifts of the light that is reflected within the film, as in the paper: half a wave at the outer side, and half a
    // wave at the base if the film is denser than the base.
    vec3 shift = PI + mix(vec3(0.0), vec3(PI), lessThan(base_ior, vec3(ior)));
    float path = 2.0 * ior * thickness * inner;
    vec3 both = clamp(outer * base, 1e-5, 0.9999);
    vec3 entering = 1.0 - outer;
    vec3 series = entering * entering * base / (1.0 - both);
    vec3 sum = outer + series;
    vec3 order = series - entering;
    vec3 bounce = sqrt(both);
    for (int m = 1; m <= 2; m++) {
        order *= bounce;
        sum += order * 2.0 * sensitivity(float(m) * path, float(m) * shift);
    }
    return clamp(sum, vec3(0.0), vec3(1.0));
}

// The reflectance at normal incidence for which Schlick's formula gives the film's reflectance at this angle.
vec3 film_f0(Place place, vec3 f0, float n_v) {
    IridescenceFactors given = iridescence_of(place.material);
    float factor = given.factor * READ(IRIDESCENCE_TEXTURE, place).r;
    float thickness = mix(given.least, given.greatest, READ(IRIDESCENCE_THICKNESS_TEXTURE, place).g);
    vec3 film = film_reflectance(n_v, given.index, thickness, f0);
    float grazing = min(schlick(n_v), 0.9999);
    vec3 equal = clamp((film - grazing) / (1.0 - grazing), vec3(0.0), vec3(1.0));
    return mix(f0, equal, thickness > 0.0 ? factor : 0.0);
}

#endif
