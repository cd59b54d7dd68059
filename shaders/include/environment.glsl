// Light from all around: the scene's environment map, or else the studio. Twin: `gpc::reference::prefilter`.
#ifndef ENVIRONMENT_GLSL
#define ENVIRONMENT_GLSL
#include "interface.glsl"
#include "studio.glsl"

layout(constant_id = CONSTANT_ENVIRONMENT) const bool ENVIRONMENT = false;
layout(set = SET_DATA, binding = BINDING_ENVIRONMENT_MAP) uniform samplerCube environment_map;   // a level for each roughness

// Turns a direction of the world into the axes of the environment map.
vec3 to_environment(vec3 d) {
    return vec3(dot(frame.environment[0].xyz, d), dot(frame.environment[1].xyz, d), dot(frame.environment[2].xyz, d));
}

// Light of one sun, the part of a texel that was taken out of the map, averaged over a lobe: the GGX distribution seen along the
// normal, spread over the texel. `square` is the squared distance of two unit vectors, to the sun and along the lobe, and `size` the
// texel's solid angle. A narrow lobe sees the texel as a Gaussian spot about as wide as interpolation would show it, and a wide one
// sees a point. The constants are fitted to the exact average.
float sun_share(float square, float size, float alpha) {
    const float PI = 3.14159265359;
    float spot = exp(-square / (0.42 * size)) / (0.42 * PI * size);
    float wide = min(alpha * alpha + 0.18 * size, 1.0), a = sqrt(wide);
    float half_ = wide + 0.25 * square * (1.0 - wide);
    // The mean cosine of the lobe.
    float mean = 1.0 / (1.0 + a * (0.4296 + a * (3.7139 + a * (1.1406 * a - 2.2706))));
    float lobe = wide / (4.0 * PI * half_ * half_) * max(1.0 - 0.5 * square, 0.0) / mean;
    float ratio = alpha * alpha / (0.086 * size), weight = ratio * (1.0 + 1.7 * ratio);
    return mix(spot, lobe, weight / (1.0 + weight));
}

// The environment's radiance around direction `r`, averaged over a specular lobe of this perceptual roughness.
vec3 environment_reflection(vec3 r, float roughness) {
    if (!ENVIRONMENT) return studio_reflection(r, roughness * roughness);
    vec3 d = to_environment(r);
    vec3 sum = textureLod(environment_map, d, roughness * frame.environment[1].w).rgb * frame.environment[0].w;
    uint suns = uint(frame.environment[2].w);
    for (uint i = 0u; i < suns; i++) {
        Light sun = lights[frame.light_count + i];
        vec3 apart = d - sun.direction_kind.xyz;
        sum += sun.color_scale.rgb * sun_share(dot(apart, apart), sun.direction_kind.w, roughness * roughness);
    }
    return sum;
}

// Irradiance over pi at a surface with normal `n`, from spherical harmonics. Small bright lights can make the sum negative, so
// it is clamped.
vec3 environment_irradiance(vec3 n) {
    if (!ENVIRONMENT) return studio_irradiance(n);
    vec3 d = to_environment(n);
    vec3 sum = frame.irradiance[0].rgb * 0.282094792;
    sum += (frame.irradiance[1].rgb * d.y + frame.irradiance[2].rgb * d.z + frame.irradiance[3].rgb * d.x) * 0.488602512;
    sum += (frame.irradiance[4].rgb * (d.x * d.y) + frame.irradiance[5].rgb * (d.y * d.z) + frame.irradiance[7].rgb * (d.x * d.z)) * 1.092548431;
    sum += frame.irradiance[6].rgb * (0.946174696 * d.z * d.z - 0.315391565) + frame.irradiance[8].rgb * (0.546274215 * (d.x * d.x - d.y * d.y));
    return max(sum, vec3(0.0));
}

#endif
