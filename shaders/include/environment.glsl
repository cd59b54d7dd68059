// Light from all around: the scene's environment map, or else the studio.
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

// The environment's radiance around direction `r`, averaged over a specular lobe of this perceptual roughness.
vec3 environment_reflection(vec3 r, float roughness) {
    if (!ENVIRONMENT) return studio_reflection(r, roughness * roughness);
    return textureLod(environment_map, to_environment(r), roughness * frame.environment[1].w).rgb * frame.environment[0].w;
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
