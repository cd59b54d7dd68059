// What the samples of a tile need of a round's memory and of its work lists, and sums of that over stretches: STRETCH tiles
// one after the other, in the order of the region. Twin: src/reference/schedule.rs.
#ifndef LOAD_GLSL
#define LOAD_GLSL
#include "owners.glsl"
#include "pairs.glsl"
#include "tiles.glsl"
#include "work.glsl"

// What samples need is no constant of the kernels: one of each is made for all.
layout(push_constant) uniform Push {
    uint block;             // samples of a header
    uint per_sample;        // 1 where each sample is a record
    uint layers;            // BLEND layers of a list that a tile is admitted with
    uint parts;             // records of a triangle in a block
    uint subgroups_first;   // that `sample` gives an entry, where it may PROBE it
    uint subgroups;         // and where it takes all samples
    uint subgroups_unlisted;// and of tiles without a list
    uint longest_list;      // most candidates of a tile; where there are more, it has no list
    uint longest_layered;   // the same where some of them are BLEND
    uint more_records;      // that a cell of opaque or alpha-tested triangles makes beyond its number of samples, at the most
} push;

struct Load {
    uvec4 needs;    // candidates, or room for owners in their place; records, headers; entries of tiles without a list
    uvec4 entries;  // of the work lists
};

uint tile_count() { return frame.tiles.x * frame.tiles.y; }
uint stretch_count() { return (tile_count() + STRETCH - 1u) / STRETCH; }

uvec4 room;     // of a round, for needs
uint blocks;    // of a cell

void begin_loads() {
    room = uvec4(frame.list_capacity, uvec2(frame.record_capacity), max(MOST_TRIALS / max(frame.triangle_count, 1u), FEWEST_TRIED));
    blocks = (frame.sample_count + push.block - 1u) / push.block;
}

// Sums that count no further than what is too much: so they can't overflow.
uvec4 add(uvec4 a, uvec4 b) { return min(a + b, room + 1u); }

// What is kept of a stretch follows the tiles of the region: from `tally` what all its tiles need, from `schedule` what
// tiles of the round before it take.
Load load_kept(uint stretch) {
    uint at = tile_count() + 2u * stretch;
    return Load(tiles[at], tiles[at + 1u]);
}

void keep_load(uint stretch, Load load) {
    uint at = tile_count() + 2u * stretch;
    tiles[at] = load.needs;
    tiles[at + 1u] = load.entries;
}

// Number of the work list of a tile that has superpixels, one of TILE_LIST_.
uint list_of(uvec4 tile) {
    uint longest = min((tile.w & TILE_HAS_BLEND) != 0u ? push.longest_layered : push.longest_list, pair_ranks());
    bool listed = (tile.w & TILE_OVERFLOW) == 0u && tile.x <= min(longest, frame.list_capacity);
    return !listed ? TILE_LIST_UNLISTED : (tile.w & TILE_HAS_BLEND) != 0u ? TILE_LIST_BLENDED : (tile.w & TILE_HAS_MASK) != 0u ? TILE_LIST_MASKED : TILE_LIST_PLAIN;
}

// What tile `index` needs as `bin` left it.
Load load_of(uint index, uvec4 tile) {
    uvec2 located = LOCATIONS ? tile_loads[index].xy : uvec2(0u);
    uint cells = LOCATIONS ? located.x : uint(bitCount(masks[index]));
    uint samples = LOCATIONS ? located.y : cells * frame.sample_count;
    uint list = list_of(tile);
    bool busy = cells != 0u, listed = list != TILE_LIST_UNLISTED, per_sample = push.per_sample != 0u;
    bool layered = (tile.w & TILE_HAS_BLEND) != 0u || (!listed && frame.first_blend < frame.triangle_count);
    uint candidates_ = listed ? tile.x : frame.triangle_count;
    // Different lists of layers that a block is admitted with, too; most need less than half of these records. Both grow
    // where a frame found too few.
    uint lists_of_block = push.parts > 8u ? push.layers * push.parts / 4u : push.layers * 2u;
    uint lists = per_sample || POINTS ? samples : min(cells * blocks * lists_of_block, samples);
    uint records_ = layered ? lists * (2u + min(candidates_, push.layers))
        : per_sample ? samples : min(cells * blocks * min(push.parts * candidates_, push.block + push.more_records), samples + cells * push.more_records);
    uint entries = (cells + LANES - 1u) / LANES;
    // Layers are as many as they happen to be; a round has room for some.
    uint owners = candidates_of_owners(cells) * (layered ? push.layers / 2u : 1u);
    Load load;
    load.needs = uvec4(!busy ? 0u : listed ? tile.x : owners, records_, cells * blocks, listed ? 0u : entries);
    load.entries = (LOCATIONS ? 0u : entries) * uvec4(equal(uvec4(list), uvec4(0u, 1u, 2u, 3u)));
    return load;
}

Load no_load() { return Load(uvec4(0u), uvec4(0u)); }

#endif
