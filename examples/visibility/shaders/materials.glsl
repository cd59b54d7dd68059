// The host's materials. Both the centres of pixels and the library's samples are shaded with them.
#include "gpc_texture.glsl"

const uint WAVES = 0u, BRICKS = 1u, GLOW = 2u, FENCE = 3u;

// The mean, over a box, of circular waves around the origin of the world.
float waves(vec2 at, vec2 side) {
    const float FREQUENCY = 6.0;
    float r = length(at), across = FREQUENCY * dot(abs(at), side) / max(r, 1e-3);
    float mean = across > 1e-3 ? 2.0 * sin(0.5 * across) / across : 1.0;
    return 0.5 + 0.5 * cos(FREQUENCY * r) * mean;
}

// The light of a surface, in linear light. `weights` are the barycentric coordinates of a place on a triangle with vertices `v`;
// `dx` and `dy` are their change across the part of a pixel that is shaded.
vec3 light_of(uint key, uvec3 v, vec3 weights, vec3 dx, vec3 dy) {
    mat3 place = mat3(posed[v.x].position, posed[v.y].position, posed[v.z].position);
    mat3 turn = mat3(posed[v.x].normal, posed[v.y].normal, posed[v.z].normal);
    vec3 position = place * weights, normal = normalize(turn * weights);
    float to_light = dot(normal, normalize(vec3(0.4, 0.8, 0.45)));
    float lit = 0.25 + 0.75 * max(to_light, 0.0);
    if (key == WAVES) {
        vec2 side = abs((place * dx).xz) + abs((place * dy).xz);
        return lit * mix(vec3(0.05, 0.12, 0.2), vec3(0.6, 0.65, 0.6), waves(position.xz, side));
    }
    if (key == BRICKS) {
        mat3x2 uv = mat3x2(coordinates[v.x], coordinates[v.y], coordinates[v.z]);
        return lit * gpc_texture(bricks, uv * weights, uv * dx, uv * dy).rgb;
    }
    if (key == FENCE) {
        // The fence is a sheet, of which both sides are visible and lit.
        return (0.3 + 0.7 * abs(to_light)) * vec3(0.1, 0.3, 0.12);
    }
    return vec3(1.0, 0.6, 0.15);
}
