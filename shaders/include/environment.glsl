// Light from all around: the scene's environment map, or else the studio. Twin: twins/src/prefilter.rs.
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

// Bright parts that were taken out of the map are in at most 32 groups, which come first behind the scene's lights. Then come the
// nodes of the groups' trees, each in the order of a depth-first walk. Indices begin at the first group. These are the fields of both:
//   position_range  of a group: x = its first node, y = the first node behind it. Of a node: xy = column and row in the map's grid,
//                   w = the first node behind this one and its parts. Of both: z = square of the distance, or width of the lobe, from
//                   which on the parts count as one light; 0 for a single part
//   direction_kind  xyz = unit vector, w = variance of the parts' directions along one axis
//   color_scale     rgb = radiance times solid angle, w = width of a column in radians
//   offset          x = height of a row in radians, y = columns of the grid, z = rows

// Light of parts around a direction, averaged over a lobe: the GGX distribution seen along the normal. `square` is the squared distance
// of two unit vectors, to the parts and along the lobe. The lobe is widened by the variance of the parts, with constants that are
// fitted to the exact average over a texel.
float lobe_share(float square, float variance, float alpha) {
    float narrow = alpha * alpha, spread = variance / (4.0 * narrow + square);
    float wide = min(narrow * (1.0 + 4.0 * spread / (1.0 + 2.2 * spread)), 1.0), a = sqrt(wide);
    float half_ = wide + 0.25 * square * (1.0 - wide);
    // The mean cosine of the lobe.
    float mean = 1.0 / (1.0 + a * (0.4296 + a * (3.7139 + a * (1.1406 * a - 2.2706))));
    return wide / (4.0 * 3.14159265359 * half_ * half_) * max(1.0 - 0.5 * square, 0.0) / mean;
}

// Area from the left up to each x under a tent from -1 to 1.
vec4 tent_area(vec4 x) {
    vec4 rest = 1.0 - abs(clamp(x, -1.0, 1.0)), tail = 0.5 * rest * rest;
    return mix(tail, 1.0 - tail, greaterThan(x, vec4(0.0)));
}

// Means of a tent from -1 to 1 over intervals around x.
vec4 tent_mean(float x, vec4 reach) {
    return (tent_area(x + reach) - tent_area(x - reach)) / (2.0 * reach);
}

// Quantiles of a narrow lobe: half the sides of four squares, whose mean is about the lobe.
const vec4 SQUARES = vec4(0.655, 1.11, 1.72, 3.36);

// The same average for a single part, whose light is interpolated to the parts beside it, over a lobe that is about as narrow. The lobe
// is taken for the mean of SQUARES. `apart` is in columns and rows, and `width` the radius of the lobe in them.
float texel_share(vec2 apart, vec2 width) {
    return 0.25 * dot(tent_mean(apart.x, max(SQUARES * width.x, 1e-3)), tent_mean(apart.y, max(SQUARES * width.y, 1e-3)));
}

// Distance of a place from the part, in distances at which the largest square ends.
float texel_distance(vec2 apart, vec2 width) {
    vec2 ends = abs(apart) / (1.0 + SQUARES.w * width);
    return max(ends.x, ends.y);
}

// Squared distance of a group or node from direction `d` of the map, and square of the distance from which on it counts as one light.
vec2 distance_reach(uint light, vec3 d) {
    vec3 offset = d - lights[light].direction_kind.xyz;
    return vec2(dot(offset, offset), lights[light].position_range.z);
}

// Light of the bright parts from around direction `d` of the map. Parts are taken together where they are close to each other for
// their distance from `d` and the width of the lobe.
vec3 suns_reflection(vec3 d, float alpha) {
    const float PI = 3.14159265359;
    uint first = frame.light_count, groups = uint(frame.environment[2].w);
    if (groups == 0u) return vec3(0.0);
    float lobe_square = 4.0 * alpha * alpha;
    vec3 sum = vec3(0.0);
    uint near = 0u;     // a bit for each group whose parts count one by one
    for (uint i = 0u; i < groups; i++) {
        Light group = lights[first + i];
        vec2 found = distance_reach(first + i, d);
        if (found.y > lobe_square + found.x) near |= 1u << i;
        else sum += lobe_share(found.x, group.direction_kind.w, alpha) * group.color_scale.rgb;
    }
    vec2 grid = lights[first].offset.yz;
    // Straight up and down, all columns are equally near, and the angle of (0, 0) is undefined.
    float column_angle = atan(d.x, d.x == 0.0 && d.z == 0.0 ? 1.0 : -d.z);
    vec2 place = vec2(column_angle / (2.0 * PI) + 0.5, acos(clamp(d.y, -1.0, 1.0)) / PI) * grid - 0.5;
    place.y = clamp(place.y, 0.0, grid.y - 1.0);
    uint node = 0u, end = 0u;
    while (node < end || near != 0u) {
        if (node == end) {
            uint group = findLSB(near);
            near &= near - 1u;
            node = uint(lights[first + group].position_range.x);
            end = uint(lights[first + group].position_range.y);
        }
        // Finds the next node whose parts count as one. A single part does. (In lavapipe 22.3, what a loop computes before a `break` is
        // lost for invocations that leave it before others. So nothing is computed before the condition.)
        vec2 found = distance_reach(first + node, d);
        while (found.y > lobe_square + found.x) {
            node++;
            found = distance_reach(first + node, d);
        }
        Light sun = lights[first + node];
        node = uint(sun.position_range.w);
        vec2 size = vec2(sun.color_scale.w, sun.offset.x);
        // How much the lobe is wider than a single part.
        float wide = found.y > 0.0 ? 1.0 : smoothstep(0.7, 1.4, 2.0 * alpha / size.y);
        float share = lobe_share(found.x, sun.direction_kind.w, alpha);
        if (wide < 1.0) {
            vec2 apart = place - sun.position_range.xy;
            apart.x -= grid.x * round(apart.x / grid.x);
            // The squares of `texel_share` end where the lobe still has a tail.
            vec2 width = 2.0 * alpha / size;
            float lobe = max(wide, smoothstep(0.6, 1.0, texel_distance(apart, width)));
            if (lobe < 1.0) share = mix(texel_share(apart, width) / (size.x * size.y), share, lobe);
        }
        sum += share * sun.color_scale.rgb;
    }
    return sum;
}

// The environment's radiance around direction `r`, averaged over a specular lobe of this perceptual roughness.
vec3 environment_reflection(vec3 r, float roughness) {
    if (!ENVIRONMENT) return studio_reflection(r, roughness * roughness);
    vec3 d = to_environment(r);
    vec3 averaged = textureLod(environment_map, d, roughness * frame.environment[1].w).rgb * frame.environment[0].w;
    return averaged + suns_reflection(d, roughness * roughness);
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
