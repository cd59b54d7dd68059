// composite: computes the colour of each list of layers, and stores it as that of the list's leaf. A team takes 64 fragments.
// Its members first look which of these are leaves, since CPU devices also execute code that no invocation needs.
// Reads: fragments, shaded. Writes: shaded.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/team.glsl"
#include "include/color.glsl"
#include "include/composite.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

void main() {
    uint first = team_number() * 64u + member();
    uint count = min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity);
    uint leaves = 0u;
    [[unroll]] for (uint r = 0u; r < 64u / TEAM; r++) {
        uint i = first + r * TEAM;
        leaves |= i < count && texelFetch(fragments, int(i)).y == 0u ? 1u << r : 0u;
    }
    do {
        bool exists = leaves != 0u;
        uint i = first + (exists ? uint(findLSB(leaves)) : 0u) * TEAM;
        uint nearest = exists ? farther(i) : ~0u;
        vec4 color = composite(nearest);
        if (nearest != ~0u) shaded_out[i] = color;
        leaves &= leaves - 1u;
    } while (team_or(leaves) != 0u);
}
