// The work lists of `sample` and `resolve`, in `tile_lists`: a list for each kind of tile, then a second list for each kind but the
// last, of the cells that one kernel leaves to a later one. An entry is a work item (a tile, or a group of locations) and the number of
// a part of its cells: CELLS_OF_ENTRY of them. Pixels that are not superpixels cause no work.
#ifndef WORK_GLSL
#define WORK_GLSL
#include "team.glsl"
#include "locations.glsl"
#include "workarounds.glsl"

const uint LEFT = TILE_LISTS;       // added to the number of a kind's list: the list of the cells that are left
layout(constant_id = CONSTANT_CELLS_OF_ENTRY) const uint CELLS_OF_ENTRY = 8u;    // as many as the smallest team has members
const uint PARTS_OF_TILE = 32u / CELLS_OF_ENTRY;

// The place of a list's first entry.
uint first_entry(uint list) {
    return list * (LOCATIONS ? frame.group_count : frame.tiles.x * frame.tiles.y * PARTS_OF_TILE);
}

uint work_entry(uint item, uint part) { return item << 3 | part; }
uint entry_item(uint entry) { return entry >> 3; }
uint entry_part(uint entry) { return entry & 7u; }

// Writes the sizes of the dispatches over work lists with `entries` entries. An entry takes `first` teams of the first run of `sample`
// or, of tiles without a list, `unlisted` teams.
void size_of_lists(uvec4 entries, uint first, uint unlisted) {
    [[unroll]] for (uint list = 0u; list < TILE_LISTS; list++) {
        uint of_entry = list < TILE_LIST_UNLISTED ? first : unlisted;
        arguments[ARGUMENT_SAMPLE_PLAIN + list] = groups(workgroups_of(entries[list] * of_entry));
        arguments[ARGUMENT_RESOLVE_PLAIN + list] = groups(workgroups_of(entries[list]));
    }
}

// The position of the set bit number `cell` of a word, both counted from 0; 31 if fewer bits are set.
uint bit_of_cell(uint word, uint cell) {
    uint bit = 0u;
    [[unroll]] for (uint log = 0u; log < 5u; log++) {
        uint size = 16u >> log, below = uint(bitCount(word & ((1u << size) - 1u)));
        bool above = cell >= below;
        cell -= above ? below : 0u;
        word = above ? word >> size : word;
        bit += above ? size : 0u;
    }
    return bit;
}

// Leaves `cells` of a work item, a bit each, to the kernel that runs later. Cells that several teams leave of an item fill
// its entries one after the other. Only one member of a team calls this.
void leave_cells(uint list, uint item, uint cells) {
    uint more = uint(bitCount(cells)), before = uint(bitCount(atomicOr(marks[item], cells)));
    uint part = (before + CELLS_OF_ENTRY - 1u) / CELLS_OF_ENTRY;
    if (part * CELLS_OF_ENTRY < before + more)
        tile_lists[first_entry(list + LEFT) + atomicAdd(counters[COUNTER_PLAIN_LEFT + list], 1u)] = work_entry(item, part);
}

#endif
