// filters: what the helpers for textures, and for parts of samples, make of given places.
#version 460
#extension GL_GOOGLE_include_directive : require
#define GPC_SET 1
#include "gpc_visibility.glsl"
#include "gpc_texture.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Places { vec2 places[]; };  // three each: coordinates, and their changes
layout(set = 0, binding = 1) uniform sampler2D smooth_image;
layout(set = 0, binding = 2) uniform sampler2D coarse_image;                     // with nearest filters
layout(std430, set = 0, binding = 3) writeonly buffer Means { vec4 means[]; };   // four each

vec4 stripes(vec2 uv) {
    return vec4(step(0.5, fract(4.0 * uv)), uv * uv);
}

GPC_TEXTURE_OF(mean_stripes, stripes, 8)

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (3u * i + 2u >= places.length()) return;
    vec2 uv = places[3u * i], dx = places[3u * i + 1u], dy = places[3u * i + 2u];
    means[4u * i] = gpc_texture_unmipmapped(smooth_image, uv, dx, dy);
    means[4u * i + 1u] = gpc_texture_nearest(coarse_image, uv, dx, dy);
    means[4u * i + 2u] = mean_stripes(uv, dx, dy);
    GpcSample s;
    s.position = uv;
    s.right = dx;
    s.down = dy;
    s.weights = vec3(uv, 1.0 - uv.x - uv.y);
    s.dx = vec3(dx, -dx.x - dx.y);
    s.dy = vec3(dy, -dy.x - dy.y);
    vec4 sum = vec4(0.0);
    for (uint part = 0u; part < 9u; ++part) {
        GpcSample p = gpc_part(s, part, 3u);
        // 9 of these cover what the sample stands for.
        float area = 9.0 * (p.right.x * p.down.y - p.right.y * p.down.x);
        sum += vec4(p.weights.x * p.weights.z, p.position.x * p.position.y, p.dx.x * p.dy.y - p.dx.y * p.dy.x, area);
    }
    means[4u * i + 3u] = sum / 9.0;
}
