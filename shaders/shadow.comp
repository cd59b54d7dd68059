// shadow: keeps a light from the receivers that another triangle was found before. Of probes it marks for `detect` those pixels
// whose centre the light reaches otherwise.
// Reads: records of OCCLUDERS and, where some of these let light pass, their opacities; counters. Writes: words of
// `include/shadows.glsl`, or marks. Its last step adds what the passes before left undone to what the frame has left.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/layer_list.glsl"
#include "include/shadows.glsl"
layout(local_size_x = 64) in;
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_WORDS) buffer ShadowWords { uint words[]; };
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_LEFT) buffer Left { uint left, other_subgroups; };
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_MARKS_OF_PIXELS) buffer MarksOfPixels { uint marks_of_pixels[]; };     // of the frame that is shaded
layout(push_constant) uniform Push {
    uint first_place;   // of the receivers
    uint light;
    uint ends;          // whether this is the last step
    uint width;         // of the region whose pixels are probed; 0: what was found is written down
} push;

// Shares of a light that differ by no more are alike.
const float ALIKE = 1.0 / 64.0;

uint beyond(uint count, uint room) { return count > room ? count - room : 0u; }

// What part of the light passes the surfaces from the nearest one on.
float passes(uint node) {
    float through = 1.0;
    // Not do-while: see `composite.glsl`.
    while (node != ~0u) {
        through *= 1.0 - texelFetch(shaded, int(node)).a;
        node = farther(node);
    }
    return through;
}

void main() {
    uint i = invocation_number();
    if (push.ends != 0u) {
        if (i != 0u) return;
        uint tiles_ = counters[COUNTER_TILES] != 0u ? beyond(frame.tiles.x * frame.tiles.y, counters[COUNTER_NEXT_TILE]) : 0u;
        uint survivors_ = beyond(counters[COUNTER_SURVIVORS] + counters[COUNTER_LARGE], frame.survivor_capacity);
        left += tiles_ + survivors_ + counters[COUNTER_UNFINISHED] + counters[COUNTER_STALLED];
        other_subgroups |= counters[COUNTER_SUBGROUPS];
        return;
    }
    if (i >= min(counters[COUNTER_RECORDS], frame.record_capacity)) return;
    uvec4 record = texelFetch(records, int(i));
    if ((record.x & POINT_VALUE) == 0u) return;
    float share = SHADOW_WORDS > 1u ? passes(record.y != 0u ? i : farther(i)) : record.y != 0u ? 0.0 : 1.0;
    if (push.width != 0u) {
        uint pixel = record.x & POINT_LOCATION, at_pixel = pixel * SHADOW_WORDS;
        bool lit = (words[at_pixel] >> push.light & 1u) == 0u;
        float centre = lit ? 1.0 : SHADOW_WORDS > 1u ? uintBitsToFloat(words[at_pixel + 1u + push.light]) : 0.0;
        if (abs(share - centre) <= ALIKE) return;
        uvec2 at = split(pixel, push.width);
        uint tile = (at.y >> 2) * ((push.width + 7u) >> 3) + (at.x >> 3);
        atomicOr(marks_of_pixels[tile], 1u << ((at.y & 3u) * 8u + (at.x & 7u)));
        return;
    }
    if (share == 1.0) return;
    uint place = (push.first_place + (record.x & POINT_LOCATION)) * SHADOW_WORDS;
    words[place] |= 1u << push.light;
    if (SHADOW_WORDS > 1u) words[place + 1u + push.light] = floatBitsToUint(share);
}
