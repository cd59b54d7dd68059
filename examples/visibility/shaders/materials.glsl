// The host's three materials, wherever they are shaded: at the centres of pixels, or at what the library samples.
#include "gpc_texture.glsl"

const uint WAVES = 0u, BRICKS = 1u, GLOW = 2u;

// The mean of a wave around the origin of the world over a box.
float waves(vec2 at, vec2 side) {
    const float FREQUENCY = 6.0;
    float r = length(at), across = FREQUENCY * dot(abs(at), side) / max(r, 1e-3);
    float mean = across > 1e-3 ? 2.0 * sin(0.5 * across) / across : 1.0;
    return 0.5 + 0.5 * cos(FREQUENCY * r) * mean;
}

// Linear light that a surface gives off: of a triangle's vertices at weights, whose change covers what is shaded.
vec3 light_of(uint key, uvec3 v, vec3 weights, vec3 dx, vec3 dy) {
    mat3x4 place = mat3x4(posed[v.x].position_u, posed[v.y].position_u, posed[v.z].position_u);
    mat3x4 turn = mat3x4(posed[v.x].normal_v, posed[v.y].normal_v, posed[v.z].normal_v);
    vec4 position_u = place * weights, normal_v = turn * weights;
    vec3 normal = normalize(normal_v.xyz);
    float lit = 0.25 + 0.75 * max(dot(normal, normalize(vec3(0.4, 0.8, 0.45))), 0.0);
    if (key == WAVES) {
        vec2 side = abs((place * dx).xz) + abs((place * dy).xz);
        return lit * mix(vec3(0.05, 0.12, 0.2), vec3(0.6, 0.65, 0.6), waves(position_u.xz, side));
    }
    if (key == BRICKS) {
        vec2 uv = vec2(position_u.w, normal_v.w);
        vec2 uv_dx = vec2((place * dx).w, (turn * dx).w), uv_dy = vec2((place * dy).w, (turn * dy).w);
        return lit * gpc_texture(bricks, uv, uv_dx, uv_dy).rgb;
    }
    return vec3(1.0, 0.6, 0.15);
}
