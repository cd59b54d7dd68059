// screen: shades the centre of each pixel, from the visibility buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "host.glsl"
#include "posed.glsl"
#include "materials.glsl"
#include "barycentric.glsl"
layout(push_constant) uniform Push { vec2 half_size; } push;
layout(location = 0) out vec4 color;

vec4 in_pixels(uint v) {
    return positions[v] * vec4(push.half_size.x, -push.half_size.y, 1.0, 1.0);
}

void main() {
    uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).x;
    if (id == 0u) {
        color = vec4(0.2, 0.35, 0.6, 1.0);
        return;
    }
    Draw draw = draws[draw_of[id - 1u]];
    uint i = draw.first_index + 3u * (id - 1u - draw.first_triangle);
    uvec3 v = uvec3(indices[i], indices[i + 1u], indices[i + 2u]) + draw.vertex_offset;
    Barycentric b = barycentric(in_pixels(v.x), in_pixels(v.y), in_pixels(v.z), gl_FragCoord.xy - push.half_size);
    color = vec4(light_of(draw.key, v, b.at, b.dx, b.dy), 1.0);
}
