// What the samples of tiles without a list of candidates see, in the place of these: a vector a sample, its owner, cell by cell;
// then, behind those of all tiles of the round, the BLEND layers before them, a vector each, floats as bits:
//   owner: (depth of the nearest opaque or alpha-tested surface, complement of its ID, or 0 for none; while layers are placed
//     the next one, then the end of them; number of layers)
//   layer: (depth, ID, number of the owner's vector, ID of the layer at this place in the order from the farthest one on)
#ifndef OWNERS_GLSL
#define OWNERS_GLSL

// Samples of a cell may be fewer: cells have as much room as the largest.
uint owner_of(uint first_candidate, uint cell, uint sample_) {
    return 4u * first_candidate + cell * frame.sample_count + sample_;
}

uint owners_room() { return 4u * frame.list_capacity; }

// Candidates that the owners of a tile take the room of.
uint candidates_of_owners(uint cells) { return (cells * frame.sample_count + 3u) / 4u; }

// Triangles that an invocation of `scatter` takes, those of a tile as a whole, and cells that it shows each of them to, for MOST_TRIPS.
uint trips_of_cell() { return 65u + frame.sample_count; }
uint pairs_of_scatter() { return clamp(56000u / (32u * trips_of_cell()), 1u, 8u); }
uint cells_of_scatter() { return 56000u / (pairs_of_scatter() * trips_of_cell()); }

// Workgroups of `scatter` for so many pairs or triangles.
uint scatter_groups_of(uint count) {
    uint some = 64u * pairs_of_scatter();
    return (count + some - 1u) / some;
}

// A dispatch of `scatter`: of so many workgroups for each part of as many cells as a tile or an entry has at the most.
uvec4 scatter_groups(uint n, uint cells) {
    return groups(n) * uvec4(1u, 1u, (cells + cells_of_scatter() - 1u) / cells_of_scatter(), 0u);
}

// The dispatch that tries every triangle in the tiles of so many entries, of which some may not have kept their pairs.
uvec4 scatter_every(uint entries) {
    return scatter_groups(counters[COUNTER_PAIRS] > frame.pair_capacity ? entries * scatter_groups_of(frame.triangle_count) : 0u, 32u);
}

#endif
