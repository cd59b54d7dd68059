// schedule: decides which tiles are in a round: as many as fit, from where the last round ended. `enlist` then gives each of
// them its place.
// Reads: loads of stretches (see load.glsl), tiles, masks. Writes: loads of the round's stretches, arguments of the round,
// counters.
// LOCATIONS: `groups` then lists groups of cells instead of tiles.
// One team, the largest that the device has, takes all tiles in their order, so that the content of a round is the same in every
// run. A member takes a stretch or, of a stretch that does not fit as a whole, a tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/load.glsl"
#include "include/pairs.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

// The sum of needs over the members up to and including this one.
uvec4 sums_up_to(uvec4 needs) {
    uint lane = member();
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) {
        uint apart = 1u << log;
        if (apart < TEAM) {
            uvec4 before = of_member(needs, (lane - apart) & (TEAM - 1u));
            needs = add(needs, lane >= apart ? before : uvec4(0u));
        }
    }
    return needs;
}

void main() {
    uint lane = member();
    if (team_number() != 0u) return;
    bool any_tile = counters[COUNTER_TILES] != 0u;
    uint start = any_tile ? counters[COUNTER_NEXT_TILE] : tile_count();
    begin_loads();
    Load taken = no_load();
    uint next = start;
    bool divided = false;       // a stretch was met that does not fit as a whole
    bool open_ = start < tile_count();
    while (open_) {
        bool whole = next % STRETCH == 0u && !divided;
        uint stretch = next / STRETCH;
        uint first = whole ? stretch : next;
        uint end = whole ? stretch_count() : min((stretch + 1u) * STRETCH, tile_count());
        uint item = min(first + lane, end - 1u), tile = whole ? 0u : item;
        Load load = load_of(tile, tiles[tile]), kept = load_kept(whole ? item : stretch);
        load.needs = whole ? kept.needs : load.needs;
        load.entries = whole ? kept.entries : load.entries;
        bool exists = first + lane < end;
        uvec4 sums = sums_up_to(exists ? min(load.needs, room + 1u) : uvec4(0u));
        // The first tile of a round is always taken. If it does not fit, `sample` counts what is missing.
        bool fits = all(lessThanEqual(add(taken.needs, sums), room)) || (!whole && next == start && lane == 0u);
        uint refused = team_ballot(exists && !fits);
        bool any_refused = refused != 0u;
        uint count = any_refused ? uint(findLSB(refused)) : min(end - first, TEAM);
        bool mine = exists && lane < count;
        load.needs = mine ? load.needs : uvec4(0u);
        load.entries = mine ? load.entries : uvec4(0u);
        Load before;
        before.needs = taken.needs + (whole ? sums - load.needs : uvec4(0u));
        before.entries = taken.entries + team_before(load.entries);
        // At the first tile of a stretch that is in the round, the load before it is stored for `enlist`.
        bool begins = whole ? mine : mine && lane == 0u && (next == start || next % STRETCH == 0u);
        if (begins) keep_load(whole ? item : stretch, before);
        taken.needs += team_add(load.needs);
        taken.entries += team_add(load.entries);
        next = min(next + count * (whole ? STRETCH : 1u), tile_count());
        open_ = next < tile_count() && (whole || !any_refused);
        divided = divided || any_refused;
    }

    if (lane == 0u) {
        bool idle = taken.needs.z == 0u;
        counters[COUNTER_ROUND_FIRST] = start;
        counters[COUNTER_NEXT_TILE] = next;
        counters[COUNTER_WAITING] = tile_count() - next;
        counters[COUNTER_FRAGMENTS] = 0u;
        [[unroll]] for (uint list = 0u; list < TILE_LISTS; list++) counters[COUNTER_PLAIN_TILES + list] = taken.entries[list];
        [[unroll]] for (uint list = 0u; list < TILE_LIST_UNLISTED; list++) counters[COUNTER_PLAIN_LEFT + list] = 0u;
        counters[COUNTER_ROUNDS] += idle ? 0u : 1u;
        counters[COUNTER_CANDIDATES_TOTAL] += taken.needs.x;
        arguments[ARGUMENT_ENLIST] = idle ? uvec4(0u) : groups(workgroups_of((next + STRETCH - 1u) / STRETCH - start / STRETCH));
        uint pairs_of_group = 64u * PAIRS_OF_SETUP;
        arguments[ARGUMENT_SETUP] = idle ? uvec4(0u) : groups((min(counters[COUNTER_PAIRS], frame.pair_capacity) + pairs_of_group - 1u) / pairs_of_group);
        arguments[ARGUMENT_GROUPS] = idle ? uvec4(0u) : groups((counters[COUNTER_GROUPS] + 63u) / 64u);
        counters[COUNTER_OWNERS] = 4u * min(taken.needs.x, frame.list_capacity);
        counters[COUNTER_LAYERS] = counters[COUNTER_OWNERS];
        bool scattered = taken.needs.w != 0u;
        uint most_cells = LOCATIONS ? counters[COUNTER_MOST_CELLS] : 32u;
        arguments[ARGUMENT_OWNERS] = scattered ? groups((counters[COUNTER_OWNERS] + 63u) / 64u) : uvec4(0u);
        arguments[ARGUMENT_SCATTER] = scattered ? scatter_groups(scatter_groups_of(min(counters[COUNTER_PAIRS], frame.pair_capacity)), most_cells) : uvec4(0u);
        arguments[ARGUMENT_SCATTER_EVERY] = scatter_every(taken.entries.w);
        size_of_lists(taken.entries, push.teams_first, push.teams_unlisted);
    }
}
