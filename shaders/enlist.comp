// enlist: gives the tiles of a round their places in the round's memory, and enters them in the work lists.
// Reads: tiles, masks, loads of stretches (from `schedule`). Writes: tiles, tile_lists, counters.
// A team takes a stretch (see load.glsl), in the order of tiles, so that lists are the same in every run.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/load.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

void main() {
    uint stretch = counters[COUNTER_ROUND_FIRST] / STRETCH + team_number();
    if (stretch >= stretch_count()) return;
    begin_loads();
    Load before = load_kept(stretch);
    uint unlisted = 0u, owned = 0u, i = 0u;
    do {
        uint index = stretch * STRETCH + i + member();
        bool taken = in_round(index);
        index = min(index, tile_count() - 1u);
        uvec4 tile = tiles[index];
        Load load = load_of(index, tile);
        bool busy = taken && load.needs.z != 0u;
        load.needs = busy ? load.needs : uvec4(0u);
        load.entries = busy ? load.entries : uvec4(0u);
        uint list = list_of(tile);
        uvec2 added = uvec2(load.needs.x, load.needs.z);
        uvec2 at = uvec2(before.needs.x, before.needs.z) + team_before(added);
        uint length_ = list == TILE_LIST_UNLISTED ? 0u : tile.x;
        uint flags = (tile.w & (TILE_HAS_MASK | TILE_HAS_BLEND | TILE_OVERFLOW)) | (list == TILE_LIST_UNLISTED ? 0u : TILE_LISTED);
        if (busy) tiles[index] = uvec4(tile.x, at, flags | length_ << TILE_COUNT_SHIFT);
        // One scan counts the entries of all lists, in a byte for each list.
        uvec4 lengths = load.entries << uvec4(0u, 8u, 16u, 24u);
        uint together = lengths.x | lengths.y | lengths.z | lengths.w;
        uint first = first_entry(list) + before.entries[list] + (team_before(together) >> (8u * list) & 0xffu);
        uint parts = load.entries[list];
        [[unroll]] for (uint part = 0u; part < PARTS_OF_TILE; part++)
            if (part < parts) tile_lists[first + part] = work_entry(index, part);
        added = team_add(added);
        before.needs += uvec4(added.x, 0u, added.y, 0u);
        before.entries += (uvec4(team_add(together)) >> uvec4(0u, 8u, 16u, 24u)) & 0xffu;
        unlisted += uint(bitCount(team_ballot(busy && list == TILE_LIST_UNLISTED)));
        owned += list == TILE_LIST_UNLISTED ? load.needs.x : 0u;
        i += TEAM;
    } while (i < STRETCH);
    owned = team_add(owned);
    if (unlisted != 0u && member() == 0u) {
        atomicAdd(counters[COUNTER_UNLISTED_TOTAL], unlisted);
        // `schedule` has counted the room of their owners as candidates.
        atomicAdd(counters[COUNTER_CANDIDATES_TOTAL], 0u - owned);
    }
}
