// What the samples of tiles without a list of candidates see. It is stored in the memory of candidates: for each sample, cell by
// cell, a vector that is called its owner; then, behind the owners of all tiles of the round, a vector for each BLEND layer.
// Floats are stored as bits:
//   owner: (depth of the nearest opaque or alpha-tested surface, complement of its ID or 0 for none, a cursor over its layers
//     that is the end of these when all are placed, number of layers or NO_ROOM_FOR_LAYERS)
//   layer: (depth, ID, index of the owner; ID of the layer that has this place in the order from the farthest one on)
#ifndef OWNERS_GLSL
#define OWNERS_GLSL

const uint NO_ROOM_FOR_LAYERS = ~0u;

// Index of a sample's owner. Every cell has room for `frame.sample_count` samples; some cells have fewer.
uint owner_of(uint first_candidate, uint cell, uint sample_) {
    return 4u * first_candidate + cell * frame.sample_count + sample_;
}

uint owners_room() { return 4u * frame.list_capacity; }

// Number of candidates whose room the owners of a tile's cells take.
uint candidates_of_owners(uint cells) { return (cells * frame.sample_count + 3u) / 4u; }

// The work of an invocation of `scatter` is limited, since the driver ends long loops (MOST_TRIPS of workarounds.glsl). These
// functions return the most trips that its team takes to show triangles to a cell, those of its members one after the other, the number
// of triangles (or pairs) of an invocation, and the number of a tile's cells that it shows each triangle to.
uint trips_of_cell() { return 8u * 18u * ((frame.sample_count + 63u) / 64u); }
uint pairs_of_scatter() { return clamp(56000u / (32u * trips_of_cell()), 1u, 8u); }
uint cells_of_scatter() { return 56000u / (pairs_of_scatter() * trips_of_cell()); }

// Workgroups of `scatter` for `count` pairs or triangles.
uint scatter_groups_of(uint count) {
    uint some = 64u * pairs_of_scatter();
    return (count + some - 1u) / some;
}

// The size of a dispatch of `scatter`: `n` workgroups for each run of `cells_of_scatter()` cells, if tiles or entries have at
// most `cells` cells.
uvec4 scatter_groups(uint n, uint cells) {
    return groups(n) * uvec4(1u, 1u, (cells + cells_of_scatter() - 1u) / cells_of_scatter(), 0u);
}

// The size of the dispatch that tries every triangle in the tiles of `entries` of a work list. Nothing is dispatched if all
// pairs were kept.
uvec4 scatter_every(uint entries) {
    return scatter_groups(counters[COUNTER_PAIRS] > frame.pair_capacity ? entries * scatter_groups_of(frame.triangle_count) : 0u, 32u);
}

#endif
