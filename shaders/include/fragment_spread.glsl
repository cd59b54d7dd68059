// Stores how the samples of a fragment are spread over their cell (spread.glsl), in the second half of the buffer of fragments. Without
// a pixel filter, the buffer has no second half.
#ifndef FRAGMENT_SPREAD_GLSL
#define FRAGMENT_SPREAD_GLSL
#include "spread.glsl"
#include "place.glsl"
layout(constant_id = SAMPLE_CONSTANT_SPREAD) const uint SPREAD = SPREAD_NONE;

// The bent function, times 4.
vec2 bent(vec2 at) { return SPREAD == SPREAD_ABSOLUTE ? 4.0 * abs(at) - 1.0 : 4.0 * at * at - 1.0 / 3.0; }

// The eight functions of a place, as they are stored, from twice the place and the bent functions of it.
void spread_of(vec2 doubled, vec2 bend, out float spread[8]) {
    spread[0] = doubled.x;
    spread[1] = doubled.y;
    spread[2] = bend.x;
    spread[3] = doubled.x * doubled.y;
    spread[4] = bend.y;
    spread[5] = bend.x * doubled.y;
    spread[6] = doubled.x * bend.y;
    spread[7] = bend.x * bend.y;
}

// The spread of a rectangle, as far as it lies in the cell.
uvec4 spread_of_rectangle(vec2 at, vec2 sides) {
    vec2 reach = 0.5 * min(sides, max(1.0 - 2.0 * abs(at), vec2(1e-4)));
    vec2 across = (at * at + reach * reach) / (2.0 * reach);
    vec2 bend = bent(at) + reach * reach * (4.0 / 3.0);
    if (SPREAD == SPREAD_ABSOLUTE) bend = 4.0 * mix(across, abs(at), greaterThanEqual(abs(at), reach)) - 1.0;
    float spread[8];
    spread_of(2.0 * at, bend, spread);
    return pack_spread(spread);
}

// The spread of the area that a place stands for.
uvec4 spread_of_place(uint place) { return spread_of_rectangle(place_location(place), place_sides(place)); }

void write_spread(uint fragment, uvec4 spread) { fragments_out[frame.fragment_capacity + fragment] = spread; }

#endif
