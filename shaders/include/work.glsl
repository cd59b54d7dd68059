// What `sample` and `resolve` work through: lists of entries in `tile_lists`, one for each kind of tile and, after
// these, one for each kind that a PROBE leaves cells of. An entry is an owner of cells - a tile, or a group of sites -
// and which of its cells are meant: as many as a subgroup has invocations. Nothing is launched for cells that are none.
#ifndef WORK_GLSL
#define WORK_GLSL
#include "lanes.glsl"
#include "sites.glsl"

const uint LEFT = 4u;               // from the list of a kind to that of the cells left
const uint PARTS_OF_TILE = 32u / LANES;
// Mesa's CPU driver ends all loops of an invocation after 65,535 trips in all; what takes more than these is reported as
// STALLED instead.
const uint MOST_TRIPS = 50000u;

// First entry of a list.
uint first_entry(uint list) {
    return list * (SITES ? frame.group_count : frame.tiles.x * frame.tiles.y * PARTS_OF_TILE);
}

uint work_entry(uint owner, uint part) { return owner << 2 | part; }
uint entry_owner(uint entry) { return entry >> 2; }
uint entry_part(uint entry) { return entry & 3u; }

// Bit number of the cell that is number `first + lane` of a word.
uint bit_of_cell(uint word, uint first, uint lane) {
    uint bit = 0u, n = 0u;
    do {
        bit = n == first + lane ? uint(findLSB(word)) : bit;
        word &= word - 1u;
    } while (++n < first + LANES);
    return bit;
}

#endif
