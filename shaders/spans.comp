// spans: lists spans, which are rows of 8 pixels, by material bin, for `shade`. A span is in the lists of all bins that it shows.
// The pass runs twice: the first run counts the spans of each bin, the second one (`scatter`) stores them in `shade_order`. For
// a single bin there is only the second run, which then counts, too.
// Reads: ids, the geometry. Writes: bins, shade_order. Background is in no list: its colour is filled in beforehand.
//
// First an invocation looks up the bins of 8 pixels, so that neighbouring invocations take neighbouring pixels. Then each
// invocation takes one of the spans that its subgroup has looked at.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/append.glsl"
#include "include/lanes.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint scatter; } push;
layout(constant_id = SPANS_CONSTANT_ONE_BIN) const bool ONE_BIN = false;

const uint NONE = ~0u;

// The least value of 8 neighbouring invocations, or of the whole subgroup if it has 4.
uint octet_min(uint v) {
    v = min(v, subgroupShuffleXor(v, 1u));
    v = min(v, subgroupShuffleXor(v, 2u));
    return LANES < 8u ? v : min(v, subgroupShuffleXor(v, 4u));
}

void main() {
    if (in_other_subgroups(64u)) return;
    bool scatter = push.scatter != 0u;
    uint lane = gl_SubgroupInvocationID;
    uint columns = (frame.size.x + 7u) / 8u;
    uint span_count = columns * frame.size.y;
    uint first_span = workgroup_number() * 64u + gl_SubgroupID * LANES;

    uint bin[8];
    [[unroll]] for (uint s = 0u; s < 8u; s++) {
        uint span = first_span + (s * LANES + lane) / 8u;
        uvec2 pixel = split(span, columns) * uvec2(8u, 1u) + uvec2((s * LANES + lane) % 8u, 0u);
        bool inside = span < span_count && pixel.x < frame.size.x;
        uint id = id_at(ivec2(inside ? pixel : uvec2(0u)));
        id = inside ? id : 0u;
        bin[s] = id == 0u ? NONE : ONE_BIN ? 0u : bin_of(triangle_word(id - 1u));
    }

    // The pixels of this invocation's span were looked up in STEPS_A_SPAN steps from `my_step` on, by the invocations from
    // `my_source` on.
    const uint SPANS_A_STEP = LANES < 8u ? 1u : LANES / 8u, STEPS_A_SPAN = LANES < 8u ? 8u / LANES : 1u;
    uint my_step = lane / SPANS_A_STEP * STEPS_A_SPAN, my_source = lane % SPANS_A_STEP * 8u;
    uint done = NONE;       // bins up to this one are done; NONE at first
    bool more;
    do {
        uint mine = NONE;
        [[unroll]] for (uint s = 0u; s < 8u; s++) {
            uint next = octet_min(done == NONE || bin[s] > done ? bin[s] : NONE);
            uint there = subgroupShuffle(next, my_source);
            mine = s - my_step < STEPS_A_SPAN ? min(mine, there) : mine;
        }
        // Each trip takes the least bin of all spans of the subgroup, so that a bin costs one atomic operation.
        uint current = lanes_min(mine);
        more = current != NONE;
        uvec4 together = subgroupBallot(more && mine == current);
        uint n = subgroupBallotBitCount(together), base = 0u;
        if (lane == 0u && more) base = atomicAdd(bins[current][ONE_BIN || !scatter ? 0 : 2], n);
        base = of_first(base);
        if (scatter && more && mine == current)
            shade_order[base + subgroupBallotExclusiveBitCount(together)] = first_span + lane;
        done = current;
    } while (more);
}
