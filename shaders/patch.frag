// patch: draws the colours of superpixels into a host's image. Other pixels keep their colours. ALL: draws all pixels.
// ENCODED: the host writes sRGB codes into a UNORM format. An invocation takes a pixel.
// Reads: masks, marks, color. Writes: the host's image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/color.glsl"
layout(constant_id = PATCH_CONSTANT_ENCODED) const bool ENCODED = false;
layout(constant_id = PATCH_CONSTANT_GROWN) const bool GROWN = false;       // masks hold only what `grow` added last
layout(constant_id = PATCH_CONSTANT_ALL) const bool ALL = false;
layout(std430, set = SET_DATA, binding = BINDING_COLOR) readonly buffer ColorIn { vec4 color_in[]; };
layout(std430, set = SET_DATA, binding = BINDING_MASKS) readonly buffer MasksIn { uint masks_in[]; };
layout(std430, set = SET_DATA, binding = BINDING_MARKS) readonly buffer MarksIn { uint marks_in[]; };
layout(location = 0) out vec4 drawn;

void main() {
    uvec2 pixel = min(uvec2(gl_FragCoord.xy) - frame.color_corner, frame.size - 1u);
    uint tile = pixel.y / 4u * frame.tiles.x + pixel.x / 8u, word = masks_in[tile];
    if (GROWN) word |= marks_in[2u * frame.tiles.x * frame.tiles.y + tile];
    if (!ALL && (word >> (pixel.y % 4u * 8u + pixel.x % 8u) & 1u) == 0u) discard;
    vec4 c = color_in[pixel.y * frame.size.x + pixel.x];
    drawn = vec4(ENCODED ? srgb_encode(c.rgb) : c.rgb, c.a);
}
