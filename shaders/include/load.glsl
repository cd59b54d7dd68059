// The load of a tile: what its samples need of a round's memory and of the work lists. Loads are summed over stretches, runs
// of STRETCH tiles in the order of the region. Twin: twins/src/schedule.rs.
#ifndef LOAD_GLSL
#define LOAD_GLSL
#include "owners.glsl"
#include "pairs.glsl"
#include "tiles.glsl"
#include "work.glsl"

// Options of sampling are pushed, not specialised, so that one pipeline of each pass serves all of them.
layout(push_constant) uniform Push {
    uint block;             // samples of a block, which has one header
    uint per_sample;        // 1 if each sample is a fragment
    uint layers;            // BLEND layers before a sample that memory is reserved for
    uint parts;             // fragments that a triangle makes in a block, at most
    uint teams_first;       // teams of the first run of `sample` for an entry of a work list
    uint teams_unlisted;    // the same for tiles without a list
    uint longest_list;      // most candidates of a tile; a tile with more has no list
    uint longest_layered;   // the same if some candidates are BLEND
    uint more_fragments;      // most fragments of a cell that `sample_lines` takes in excess of its number of samples
} push;

struct Load {
    uvec4 needs;    // candidates (without a list: room for owners, in candidates), fragments, headers, entries without a list
    uvec4 entries;  // entries in each of the work lists
};

uint tile_count() { return frame.tiles.x * frame.tiles.y; }
uint stretch_count() { return (tile_count() + STRETCH - 1u) / STRETCH; }

uvec4 room;     // what a round has room for, in the order of `needs`
uint blocks;    // blocks of a cell

void begin_loads() {
    room = uvec4(frame.list_capacity, uvec2(frame.fragment_capacity), max(MOST_TRIALS / max(frame.triangle_count, 1u), FEWEST_TRIED));
    blocks = (frame.sample_count + push.block - 1u) / push.block;
}

// The sum of two needs. It saturates just above what a round has room for, so that it can't overflow.
uvec4 add(uvec4 a, uvec4 b) { return min(a + b, room + 1u); }

// The load that is stored for a stretch, behind the tiles of the region: at first the load of all its tiles, from `tally`.
// `schedule` replaces it by the load of those tiles of the round that come before the stretch.
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

// The load of tile `index`. `tile` is its vector as `bin` left it.
Load load_of(uint index, uvec4 tile) {
    uvec2 located = LOCATIONS ? tile_loads[index].xy : uvec2(0u);
    uint cells = LOCATIONS ? located.x : uint(bitCount(masks[index]));
    uint samples = LOCATIONS ? located.y : cells * frame.sample_count;
    uint list = list_of(tile);
    bool busy = cells != 0u, listed = list != TILE_LIST_UNLISTED, per_sample = push.per_sample != 0u;
    bool layered = (tile.w & TILE_HAS_BLEND) != 0u || (!listed && frame.first_blend < frame.triangle_count);
    uint candidates_ = listed ? tile.x : frame.triangle_count;
    // Number of different lists of layers that memory is reserved for in a block. Most blocks need less than half of these
    // fragments. If a frame found too little room, it is made again with more layers.
    uint lists_of_block = push.parts > 8u ? push.layers * push.parts / 4u : push.layers * 2u;
    uint lists = per_sample || POINTS ? samples : min(cells * blocks * lists_of_block, samples);
    uint fragments_ = layered ? lists * (2u + min(candidates_, push.layers))
        : per_sample ? samples : min(cells * blocks * min(push.parts * candidates_, push.block + push.more_fragments), samples + cells * push.more_fragments);
    uint entries = (cells + CELLS_OF_ENTRY - 1u) / CELLS_OF_ENTRY;
    // The number of layers is not known yet: room is reserved for half of `push.layers` vectors a sample.
    uint owners = candidates_of_owners(cells) * (layered ? push.layers / 2u : 1u);
    Load load;
    load.needs = uvec4(!busy ? 0u : listed ? tile.x : owners, fragments_, cells * blocks, listed ? 0u : entries);
    load.entries = (LOCATIONS ? 0u : entries) * uvec4(equal(uvec4(list), uvec4(0u, 1u, 2u, 3u)));
    return load;
}

Load no_load() { return Load(uvec4(0u), uvec4(0u)); }

#endif
