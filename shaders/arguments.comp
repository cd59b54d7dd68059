// arguments: computes the sizes of the indirect dispatches that follow from what earlier passes counted, so that nothing is
// read back. One invocation.
// Reads: counters, bins. Writes: arguments, bins, counters.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/owners.glsl"
#include "include/pairs.glsl"
#include "include/work.glsl"
layout(local_size_x = 1) in;
layout(push_constant) uniform Push {
    uint after;             // one of AFTER_
    uint teams_first;       // this and the next: as in load.glsl
    uint teams_unlisted;
    uint teams_left;        // teams of `sample` for an entry of the cells that `sample_lines` left
} push;

const uint BIN_WORKGROUPS = 8u;         // workgroups that share a large triangle in `bin`; one on CPU devices, which run few at once

void main() {
    if (push.after == AFTER_DETECT) {
        bool any_tile = counters[COUNTER_TILES] != 0u;
        counters[COUNTER_WAITING] = counters[COUNTER_TILES];
        arguments[ARGUMENT_CULL] = any_tile ? groups((frame.triangle_count + 511u) / 512u) : uvec4(0u);
        arguments[ARGUMENT_TALLY] = any_tile ? groups(workgroups_of((frame.tiles.x * frame.tiles.y + STRETCH - 1u) / STRETCH)) : uvec4(0u);
    } else if (push.after == AFTER_CULL) {
        arguments[ARGUMENT_BIN_BUSY] = groups(((frame.tiles.x + 31u) / 32u * frame.tiles.y + 63u) / 64u);
        arguments[ARGUMENT_BIN_SMALL] = groups((counters[COUNTER_SURVIVORS] + 63u) / 64u);
        arguments[ARGUMENT_BIN_LARGE] = groups(counters[COUNTER_LARGE]) * uvec4(1u, 1u, TEAMS == 1u ? 1u : BIN_WORKGROUPS, 0u);
    } else if (push.after == AFTER_SAMPLE) {
        uint n = min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity);
        counters[COUNTER_FRAGMENTS_TOTAL] += n;
        arguments[ARGUMENT_FRAGMENTS] = groups((n + 63u) / 64u);
        arguments[ARGUMENT_SORT] = groups(workgroups_of((n + 63u) / 64u));
    } else if (push.after == AFTER_GROUPS) {
        uvec4 entries = uvec4(counters[COUNTER_PLAIN_TILES], counters[COUNTER_MASKED_TILES], counters[COUNTER_BLENDED_TILES], counters[COUNTER_UNLISTED_TILES]);
        size_of_lists(entries, push.teams_first, push.teams_unlisted);
        arguments[ARGUMENT_SCATTER_EVERY] = scatter_every(counters[COUNTER_UNLISTED_TILES]);
    } else if (push.after == AFTER_SCATTER) {
        uint layers = min(counters[COUNTER_LAYERS], owners_room());
        arguments[ARGUMENT_LAYERS] = groups((layers - min(counters[COUNTER_OWNERS], layers) + 63u) / 64u);
    } else if (push.after == AFTER_LINES) {
        [[unroll]] for (uint list = 0u; list < TILE_LIST_UNLISTED; list++)
            arguments[ARGUMENT_PLAIN_LEFT + list] = groups(workgroups_of(counters[COUNTER_PLAIN_LEFT + list] * push.teams_left));
    } else if (push.after == AFTER_THIN) {
        arguments[ARGUMENT_THIN] = groups((counters[COUNTER_THIN] + 63u) / 64u);
        arguments[ARGUMENT_THIN_LONG] = groups(counters[COUNTER_THIN_LONG]);
    } else if (push.after == AFTER_PAIRS) {
        uint in_workgroup = 64u / INVOCATIONS_OF_PAIR;
        arguments[ARGUMENT_THIN] = groups((min(counters[COUNTER_PAIRS], frame.pair_capacity) + in_workgroup - 1u) / in_workgroup);
    } else {
        // `shade` takes an invocation for a fragment, or 8 for a span. Bins follow each other in `shade_order`; the dispatch of a
        // bin begins at its first entry.
        uint first = 0u;
        for (uint b = 0u; b < frame.bin_count; b++) {
            uint n = bins[b].x;
            bins[b] = uvec4(n, first, first, 0u);
            arguments[ARGUMENT_SHADE + b] = groups(push.after == AFTER_SPANS ? (n + 7u) / 8u : (n + 63u) / 64u);
            first += n;
        }
        if (push.after == AFTER_FRAGMENTS) counters[COUNTER_SHADED_TOTAL] += first;
    }
}
