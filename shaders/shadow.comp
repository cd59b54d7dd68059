// shadow: stores that a light is blocked, or how much of it passes, at receivers in front of which another triangle was found.
// With probes it instead marks pixels for `detect`: those at whose centre and probe different shares of the light arrive. An
// invocation takes a record.
// Reads: records of OCCLUDERS and, if casters may let light pass, their opacities; counters. Writes: words of
// `include/shadows.glsl`, or marks_of_pixels. Its last step adds what the passes before it could not finish to the frame's count
// of that.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/layer_list.glsl"
#include "include/shadows.glsl"
layout(local_size_x = 64) in;
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_WORDS) buffer ShadowWords { uint words[]; };
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_LEFT) buffer Left { uint left; };
layout(std430, set = SET_BESIDE_FRAME, binding = SHADOW_BINDING_MARKS_OF_PIXELS) buffer MarksOfPixels { uint marks_of_pixels[]; };     // of the frame that is shaded
layout(push_constant) uniform Push {
    uint first_place;   // place of the first receiver
    uint light;
    uint ends;          // whether this is the last step
    uint width;         // width of the region whose pixels are probed; 0 if there are no probes, and words are written
} push;

// Shares of a light that differ by no more than this are taken as equal.
const float ALIKE = 1.0 / 64.0;

uint beyond(uint count, uint room) { return count > room ? count - room : 0u; }

// The share of the light that passes all surfaces of a list. `node` is the nearest one.
float passes(uint node) {
    float through = 1.0;
    // The exception of DO_WHILE, see workarounds.glsl.
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
