// sort: sorts visibility samples by material bin. It runs twice: the first run counts the samples of each bin, the second one
// (`scatter`) stores them in `shade_order`. Background and empty fragments are left out. A team takes 64 fragments, and a
// member some successive ones of these, so that a bin costs one atomic operation for 64 fragments.
// Reads: fragments, the geometry. Writes: bins, shade_order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/team.glsl"
#include "include/triangle.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(push_constant) uniform Push { uint scatter; } push;

const uint OWN = 64u / TEAM;       // fragments of a member
const uint NONE = ~0u;

void main() {
    bool scatter = push.scatter != 0u;
    uint first = team_number() * 64u + member() * OWN;
    uint count = min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity);

    uint bin[OWN], least = NONE;
    [[unroll]] for (uint r = 0u; r < OWN; r++) {
        uint i = first + r, id = i < count ? texelFetch(fragments, int(i)).y : 0u;
        bin[r] = id == 0u ? NONE : bin_of(triangle_word(id - 1u));
        least = min(least, bin[r]);
    }
    uint current = team_min(least);
    do {
        uint own = 0u;
        least = NONE;
        [[unroll]] for (uint r = 0u; r < OWN; r++) {
            own += bin[r] == current ? 1u : 0u;
            least = min(least, bin[r] > current ? bin[r] : NONE);
        }
        bool some = current != NONE;
        uint together = team_add(own), base = 0u;
        if (some && member() == 0u) base = atomicAdd(bins[current][scatter ? 2 : 0], together);
        uint at = of_member(base, 0u) + team_before(own);
        [[unroll]] for (uint r = 0u; r < OWN; r++) {
            bool mine = some && bin[r] == current;
            if (scatter && mine) shade_order[at] = first + r;
            at += mine ? 1u : 0u;
        }
        current = team_min(least);
    } while (current != NONE);
}
