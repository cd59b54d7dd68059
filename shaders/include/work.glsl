// What `sample` and `resolve` work through: lists of entries in `tile_lists`, one for each kind of tile and, after
// these, one for each kind that a PROBE leaves cells of. An entry is a work item - a tile, or a group of locations -
// and which of its cells are meant: as many as a subgroup has invocations. Nothing is launched for cells that are none.
#ifndef WORK_GLSL
#define WORK_GLSL
#include "lanes.glsl"
#include "locations.glsl"
#include "workarounds.glsl"

const uint LEFT = 4u;               // from the list of a kind to that of the cells left
const uint PARTS_OF_TILE = 32u / LANES;

// First entry of a list.
uint first_entry(uint list) {
    return list * (LOCATIONS ? frame.group_count : frame.tiles.x * frame.tiles.y * PARTS_OF_TILE);
}

uint work_entry(uint item, uint part) { return item << 3 | part; }
uint entry_item(uint entry) { return entry >> 3; }
uint entry_part(uint entry) { return entry & 7u; }

// Bit number of a word's set bit number `cell`, from 0; 31 where it has no more than that.
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

// Lists cells of a work item, a bit each, for the kernel that takes what others leave of a list. These and the cells that
// others left fill entries one after the other. One invocation of a subgroup calls it.
void leave_cells(uint list, uint item, uint cells) {
    uint more = uint(bitCount(cells)), before = uint(bitCount(atomicOr(marks[item], cells)));
    uint part = (before + LANES - 1u) / LANES;
    if (part * LANES < before + more)
        tile_lists[first_entry(list + LEFT) + atomicAdd(counters[COUNTER_PLAIN_LEFT + list], 1u)] = work_entry(item, part);
}

#endif
