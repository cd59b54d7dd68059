// centres: makes visibility samples of the centres of pixels, for hosts that draw no colours. It runs twice over a band of
// pixels. The first run makes a fragment for each pixel. After these are shaded, the second run (GATHER) stores their colours. An
// invocation takes a pixel.
// Reads: ids; GATHER: ids, shaded. Writes: fragments; GATHER: color, display.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/place.glsl"
layout(local_size_x = 64) in;
layout(constant_id = CENTRES_CONSTANT_GATHER) const bool GATHER = false;
layout(push_constant) uniform Push {
    uint first;         // first pixel of the band
    uint count;
} band;

void main() {
    uint i = invocation_number();
    if (i >= band.count) return;
    uvec2 pixel = split(band.first + i, frame.size.x);
    uint id = id_at(ivec2(pixel));
    if (GATHER) {
        vec4 c = id == 0u ? frame.background : to_output(vec4(texelFetch(shaded, int(i)).rgb, 1.0));
        color[band.first + i] = c;
        display_out[band.first + i] = display_code(c);
    } else {
        fragments_out[i] = uvec4(pixel.x | pixel.y << 16, id, pack_place(vec2(0.0), 1.0, false), floatBitsToUint(1.0));
        if (i == 0u) counters[COUNTER_FRAGMENTS] = band.count;
    }
}
