// alpha_map: converts a mipmap level of a host's alpha map to the form that alpha.glsl reads. An invocation writes a word, for a
// place between 2 x 2 texels, wrapping applied.
// Reads: the image, of any format that is sampled as floats. Writes: the atlas. Twin: `AlphaAtlas`.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "include/interface.glsl"
#include "include/workgroup.glsl"
layout(local_size_x = 64) in;
layout(set = SET_OWN, binding = ALPHA_MAP_BINDING_MAP) uniform texture2D map;
layout(std430, set = SET_OWN, binding = ALPHA_MAP_BINDING_ATLAS) writeonly buffer Atlas { uint atlas[]; };
layout(push_constant) uniform Push {
    uvec2 size;         // of the level, in texels
    uint level;
    uint first;         // first word of the level in the atlas
    uint repeats;       // bit 0: repeats along u; bit 1: along v; otherwise the texels at the border continue
} push;

int wrapped(int at, int side, uint axis) {
    bool repeats = (push.repeats >> axis & 1u) != 0u;
    return repeats ? (at + side) % side : clamp(at, 0, side - 1);
}

float texel(ivec2 at) {
    ivec2 size = ivec2(push.size);
    return texelFetch(map, ivec2(wrapped(at.x, size.x, 0u), wrapped(at.y, size.y, 1u)), int(push.level)).a;
}

void main() {
    uint i = invocation_number(), row = push.size.x + 1u;
    if (i >= row * (push.size.y + 1u)) return;
    ivec2 at = ivec2(i % row, i / row) - 1;
    vec4 texels = vec4(texel(at), texel(at + ivec2(1, 0)), texel(at + ivec2(0, 1)), texel(at + 1));
    atlas[push.first + i] = packUnorm4x8(texels);
}
