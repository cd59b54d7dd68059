// schedule: places the candidate lists of as many tiles as fit, from where the last round ended, and sorts
// these tiles by what their samples need: PLAIN, MASKED (alpha tests), BLENDED (lists of layers) or UNLISTED
// (a list that outgrows the buffer: every triangle is a candidate).
// Reads: tiles (counts from `bin`), masks. Writes: tiles, tile_lists, arguments of the round, counters.
// LOCATIONS: `groups` then lists groups of cells in the place of tiles.
// One subgroup does it all, in tile order, so that a round's content is the same in every run.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
#include "include/work.glsl"
layout(local_size_x_id = 0) in;
// What samples need is no constant of the kernel: one is made for all.
layout(push_constant) uniform Push {
    uint block;             // samples of a header
    uint per_sample;        // 1 where each sample is a record
    uint layers;            // BLEND layers of a list that a tile is admitted with
    uint parts;             // records of a triangle in a block
    uint subgroups_first;   // that `sample` gives an entry, where it may PROBE it
    uint subgroups;         // and where it takes all samples
} push;

void main() {
    uint lane = gl_SubgroupInvocationID;
    uint tile_count = frame.tiles.x * frame.tiles.y;
    bool any_tile = counters[COUNTER_TILES] != 0u && !in_other_subgroups(LANES);
    uint start = any_tile ? counters[COUNTER_NEXT_TILE] : tile_count;
    uint previous = any_tile ? counters[COUNTER_ROUND_FIRST] : tile_count;
    // Lists of the round before are spent.
    uint p = previous + lane;
    while (p < start) {
        tiles[p].w = 0u;
        p += LANES;
    }

    uint blocks = (frame.sample_count + push.block - 1u) / push.block;
    bool per_sample = push.per_sample != 0u;
    // Different lists of layers that a block is admitted with, too; most need less than half of these records. Both grow
    // where a frame found too few.
    uint lists_of_block = push.parts > 8u ? push.layers * push.parts / 4u : push.layers * 2u;
    // Records of a block that it is admitted with where a cell has several: these are small, and see few triangles.
    uint crowd = push.layers * 4u;
    uint most_records = blocks == 1u ? push.block : crowd;
    uint list_used = 0u, records_used = 0u, headers_used = 0u, placed = 0u, unlisted = 0u;
    uvec4 entries = uvec4(0u);      // of each list
    uint next = start;
    bool open_ = start < tile_count;
    while (open_) {
        uint tile = next + lane;
        bool exists = tile < tile_count;
        uint word = exists ? masks[tile] : 0u;
        uvec4 t = exists ? tiles[tile] : uvec4(0u);
        uvec2 load = LOCATIONS && exists ? tile_loads[tile] : uvec2(0u);
        uint cells = LOCATIONS ? load.x : bitCount(word);
        uint samples = LOCATIONS ? load.y : cells * frame.sample_count;
        bool busy = cells != 0u;
        bool listed = busy && (t.w & TILE_OVERFLOW) == 0u;
        bool blend = (t.w & TILE_HAS_BLEND) != 0u, mask_ = (t.w & TILE_HAS_MASK) != 0u;
        uint candidates_ = listed ? t.x : frame.triangle_count;
        uint lists = per_sample || POINTS ? samples : min(cells * blocks * lists_of_block, samples);
        uint record_need = blend || (!listed && frame.first_blend < frame.triangle_count)
            ? lists * (2u + min(candidates_, push.layers))
            : per_sample ? samples : min(cells * blocks * min(push.parts * candidates_, most_records), samples);
        uint list_need = listed ? t.x : 0u, header_need = cells * blocks;
        uint list_first = list_used + subgroupExclusiveAdd(list_need);
        uint record_end = records_used + subgroupInclusiveAdd(record_need);
        uint header_first = headers_used + subgroupExclusiveAdd(header_need);
        bool fits = list_first + list_need <= frame.list_capacity
            && max(record_end, header_first + header_need) <= frame.record_capacity;
        // The first tile of a round is always taken: what does not fit then is counted by `sample`.
        fits = fits || (next == start && lane == 0u);
        uvec4 refused = subgroupBallot(!fits);
        uint taken = subgroupBallotBitCount(refused) == 0u ? LANES : subgroupBallotFindLSB(refused);
        bool mine = busy && lane < taken;
        if (mine) {
            tiles[tile] = uvec4(t.x, list_first, header_first,
                (t.w & (TILE_HAS_MASK | TILE_HAS_BLEND)) | TILE_PLACED | (listed ? TILE_LISTED : 0u) | (listed ? t.x : 0u) << TILE_COUNT_SHIFT);
        }
        uint list = !listed ? 3u : blend ? 2u : mask_ ? 1u : 0u;
        // Lengths of all lists in one scan, a byte each.
        uint parts = !mine || LOCATIONS ? 0u : (cells + LANES - 1u) / LANES;
        uint before = subgroupExclusiveAdd(parts << (8u * list)), added = subgroupAdd(parts << (8u * list));
        uint at = first_entry(list) + entries[list] + (before >> (8u * list) & 0xffu);
        [[unroll]] for (uint part = 0u; part < PARTS_OF_TILE; part++)
            if (part < parts) tile_lists[at + part] = work_entry(tile, part);
        entries += uvec4(added, added >> 8, added >> 16, added >> 24) & 0xffu;
        unlisted += subgroupBallotBitCount(subgroupBallot(mine && !listed));
        list_used += subgroupAdd(mine ? list_need : 0u);
        records_used += subgroupAdd(mine ? record_need : 0u);
        headers_used += subgroupAdd(mine ? header_need : 0u);
        placed += subgroupBallotBitCount(subgroupBallot(mine));
        next += taken;
        open_ = taken == LANES && next < tile_count;
    }
    next = min(next, tile_count);

    if (subgroupElect()) {
        bool idle = placed == 0u;
        counters[COUNTER_ROUND_FIRST] = start;
        counters[COUNTER_NEXT_TILE] = next;
        counters[COUNTER_RECORDS] = 0u;
        [[unroll]] for (uint list = 0u; list < 4u; list++) counters[COUNTER_PLAIN_TILES + list] = entries[list];
        counters[COUNTER_PLAIN_LEFT] = 0u;
        counters[COUNTER_MASKED_LEFT] = 0u;
        counters[COUNTER_ROUNDS] += idle ? 0u : 1u;
        counters[COUNTER_CANDIDATES_TOTAL] += list_used;
        counters[COUNTER_UNLISTED_TOTAL] += unlisted;
        arguments[ARGUMENT_SETUP] = idle ? uvec4(0u) : groups((min(counters[COUNTER_PAIRS], frame.pair_capacity) + 63u) / 64u);
        arguments[ARGUMENT_GROUPS] = idle ? uvec4(0u) : groups((frame.group_count + 63u) / 64u);
        arguments[ARGUMENT_SAMPLE_PLAIN] = groups(entries.x * push.subgroups_first);
        arguments[ARGUMENT_SAMPLE_MASKED] = groups(entries.y * push.subgroups_first);
        arguments[ARGUMENT_SAMPLE_BLENDED] = groups(entries.z * push.subgroups);
        arguments[ARGUMENT_SAMPLE_UNLISTED] = groups(entries.w * push.subgroups);
    }
}
