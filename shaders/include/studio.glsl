// The neutral studio, which lights scenes without lights: a grey room, brighter above, and three soft boxes (key, fill,
// rim). A soft box is a spherical Gaussian. Its convolutions with a rough reflection lobe and with the cosine have closed
// forms (Wang et al., "All-Frequency Rendering of Dynamic, Spatially-Varying Reflectance", 2009).

struct Box { vec3 axis; float sharpness; vec3 radiance; };

const Box STUDIO[3] = Box[3](
    Box(vec3(0.491, 0.737, 0.465), 14.0, vec3(5.2, 5.0, 4.8)),
    Box(vec3(-0.800, 0.360, 0.480), 8.0, vec3(1.25, 1.35, 1.5)),
    Box(vec3(-0.250, 0.550, -0.797), 18.0, vec3(3.0, 3.0, 3.1)));

vec3 studio_room(float up) {
    return mix(vec3(0.17, 0.165, 0.16), vec3(0.52, 0.53, 0.55), 0.5 + 0.5 * up);
}

// The studio's radiance around direction `r`, averaged over a specular lobe of GGX roughness `alpha`.
vec3 studio_reflection(vec3 r, float alpha) {
    float lobe = 2.0 / max(alpha * alpha, 1e-3);
    vec3 sum = studio_room(r.y * (1.0 - 0.5 * alpha));
    for (int i = 0; i < 3; i++) {
        float sharpness = STUDIO[i].sharpness * lobe / (STUDIO[i].sharpness + lobe);
        sum += STUDIO[i].radiance * (sharpness / STUDIO[i].sharpness) * exp(sharpness * (dot(r, STUDIO[i].axis) - 1.0));
    }
    return sum;
}

// Irradiance over pi at a surface with normal `n`.
vec3 studio_irradiance(vec3 n) {
    vec3 sum = studio_room(n.y * 0.66);
    for (int i = 0; i < 3; i++) {
        // A Gaussian of this sharpness acts on the cosine like a directional light of power 2 / sharpness.
        float c = dot(n, STUDIO[i].axis);
        float soft = 1.0 / sqrt(STUDIO[i].sharpness);
        float cosine = 0.5 * (c + sqrt(c * c + 0.25 * soft * soft));
        sum += STUDIO[i].radiance * (2.0 / STUDIO[i].sharpness) * cosine;
    }
    return sum;
}
