// spans: lists spans, which are rows of 8 pixels, by material bin, for `shade`. A span is in the lists of all bins that it shows.
// The pass runs twice: the first run counts the spans of each bin, the second one (`scatter`) stores them in `shade_order`. For
// a single bin there is only the second run, which then counts, too.
// Reads: ids, the geometry. Writes: bins, shade_order. Background is in no list: its colour is filled in beforehand.
//
// A team takes TEAM spans. First a member looks up the bins of 8 pixels, so that neighbouring members take neighbouring pixels. Then each member
// takes one of the spans that its team has looked at.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/team.glsl"
#include "include/triangle.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(push_constant) uniform Push { uint scatter; } push;
layout(constant_id = SPANS_CONSTANT_ONE_BIN) const bool ONE_BIN = false;

const uint NONE = ~0u;

void main() {
    bool scatter = push.scatter != 0u;
    uint lane = member();
    uint columns = (frame.size.x + 7u) / 8u;
    uint span_count = columns * frame.size.y;
    uint first_span = team_number() * TEAM;

    uint bin[8];
    [[unroll]] for (uint s = 0u; s < 8u; s++) {
        uint span = first_span + (s * TEAM + lane) / 8u;
        uvec2 pixel = split(span, columns) * uvec2(8u, 1u) + uvec2((s * TEAM + lane) % 8u, 0u);
        bool inside = span < span_count && pixel.x < frame.size.x;
        uint id = id_at(ivec2(inside ? pixel : uvec2(0u)));
        id = inside ? id : 0u;
        bin[s] = id == 0u ? NONE : ONE_BIN ? 0u : bin_of(triangle_word(id - 1u));
    }

    // The pixels of this member's span were looked up in STEPS_A_SPAN steps from `my_step` on, by all members.
    const uint STEPS_A_SPAN = 8u / TEAM;
    uint my_step = lane * STEPS_A_SPAN;
    uint done = NONE;       // bins up to this one are done; NONE at first
    bool more;
    do {
        uint mine = NONE;
        [[unroll]] for (uint s = 0u; s < 8u; s++) {
            uint next = team_min(done == NONE || bin[s] > done ? bin[s] : NONE);
            mine = s - my_step < STEPS_A_SPAN ? min(mine, next) : mine;
        }
        // Each trip takes the least bin of all spans of the team, so that a bin costs one atomic operation.
        uint current = team_min(mine);
        more = current != NONE;
        uint together = team_ballot(more && mine == current);
        uint n = uint(bitCount(together)), base = 0u;
        if (more && lane == 0u) base = atomicAdd(bins[current][ONE_BIN || !scatter ? 0 : 2], n);
        base = of_member(base, 0u);
        if (scatter && more && mine == current)
            shade_order[base + bits_before(together)] = first_span + lane;
        done = current;
    } while (more);
}
