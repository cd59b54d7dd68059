// The host's background in a pixel whose centre may see a triangle. Twin: twins/src/behind.rs.
#ifndef BEHIND_GLSL
#define BEHIND_GLSL
#include "host_image.glsl"

// Offsets of a pixel and of the 24 around it, nearest first. Of equally near ones the uppermost comes first, then the leftmost.
const ivec2 BEHIND_ORDER[25] = ivec2[](
    ivec2(0, 0),
    ivec2(0, -1), ivec2(-1, 0), ivec2(1, 0), ivec2(0, 1), ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1), ivec2(1, 1),
    ivec2(0, -2), ivec2(-2, 0), ivec2(2, 0), ivec2(0, 2),
    ivec2(-1, -2), ivec2(1, -2), ivec2(-2, -1), ivec2(2, -1), ivec2(-2, 1), ivec2(2, 1), ivec2(-1, 2), ivec2(1, 2),
    ivec2(-2, -2), ivec2(2, -2), ivec2(-2, 2), ivec2(2, 2));

// What the host has drawn at the nearest of these pixels whose centre sees no triangle; the frame's background if all centres
// see one.
vec4 behind(uvec2 pixel) {
    int i = 0;
    ivec2 there = ivec2(pixel);
    bool found = id_at(there) == 0u;
    while (!found && ++i < 25) {
        there = ivec2(pixel) + BEHIND_ORDER[i];
        found = all(greaterThanEqual(there, ivec2(0))) && all(lessThan(there, ivec2(frame.size))) && id_at(there) == 0u;
    }
    return found ? drawn_at(uvec2(there)) : frame.background;
}

#endif
