// How light is spread over a cell, for pixel filters: the means, over the places in the cell, of light times eight functions of the
// place. The functions are products of x or a bent function of x, and y or the same function of y: x, y, bent x, x y, bent y,
// bent x y, x bent y, bent x bent y, where x and y go from -1/2 to 1/2. Each has the mean 0, so that the means of evenly spread light
// are 0. What is stored is divided by 2^-1 for each x or y and by 2^-2 for each bent function, and by the mean of the light.
#ifndef SPREAD_GLSL
#define SPREAD_GLSL
#include "interface.glsl"

// A superpixel has SPREAD_VECTORS vectors: two words for each function, with the means of its four channels in 16 bits each. A fragment
// has one vector: the means over its samples, in 16 bits each.
uvec4 pack_spread(float spread[8]) {
    return uvec4(packSnorm2x16(vec2(spread[0], spread[1])), packSnorm2x16(vec2(spread[2], spread[3])),
        packSnorm2x16(vec2(spread[4], spread[5])), packSnorm2x16(vec2(spread[6], spread[7])));
}

void unpack_spread(uvec4 packed, out float spread[8]) {
    [[unroll]] for (uint i = 0u; i < 4u; i++) {
        vec2 pair = unpackSnorm2x16(packed[i]);
        spread[2u * i] = pair.x;
        spread[2u * i + 1u] = pair.y;
    }
}

#endif
