// The cells of a work list's entry that a team of `sample` or `sample_lines` takes. Each member holds one of them.
#ifndef TAKEN_GLSL
#define TAKEN_GLSL
#include "tiles.glsl"
#include "work.glsl"

const float ROUNDING = 1.0 / 64.0;      // of positions and edge functions in a tile, in pixels

struct Taken {
    bool exists;            // whether there is a cell for this team
    uint cells;             // number of cells that the team takes, at least 1
    uint item;              // the tile or the group of locations that the cells belong to
    ivec2 tile_at;          // column and row of their tile
    vec2 center;            // centre of the tile
    uvec4 tile;             // vector of the tile
    uint first_number;      // number of the item's first cell among those of the tile
    uint all_cells;         // cells of the item, a bit each
};

// The cell that this member holds.
uint my_bit;                // bit in words of the item
vec2 my_at, my_half;        // middle relative to the tile's centre, and half the sides of the rectangle around it
uvec2 my_locations;         // the cell's first location, and how many it has

// The pixel of a cell.
uvec2 pixel_of_cell(Taken t, uint bit) { return uvec2(t.tile_at) * uvec2(8u, 4u) + uvec2(bit & 7u, bit >> 3); }

// The number of a cell among those of its tile.
uint number_of_cell(Taken t, uint bit) { return t.first_number + uint(bitCount(t.all_cells & ((1u << bit) - 1u))); }

// Takes cells of entry `number` of work list LIST: share `share` of the entry, with CELLS_AT_ONCE cells. LEFT_CELLS: of the list of
// cells that an earlier kernel left.
Taken take_cells(uint number, uint share) {
    Taken t;
    t.exists = number < counters[(LEFT_CELLS ? COUNTER_PLAIN_LEFT : COUNTER_PLAIN_TILES) + LIST];
    uint entry = t.exists ? tile_lists[first_entry(LEFT_CELLS ? LIST + LEFT : LIST) + number] : 0u;
    t.item = entry_item(entry);
    uvec4 group = LOCATIONS ? texelFetch(location_groups, int(t.item)) : uvec4(0u);
    uint tile = LOCATIONS ? group.x : t.item;
    t.tile_at = ivec2(split(tile, frame.tiles.x));
    t.center = tile_center(t.tile_at);
    t.tile = tiles[tile];
    t.first_number = group.w;
    t.all_cells = LOCATIONS ? ~0u >> (32u - group.z) : masks[tile];
    uint word = LEFT_CELLS ? t.all_cells & marks[t.item] : t.all_cells, cells = uint(bitCount(word));
    uint first = entry_part(entry) * CELLS_OF_ENTRY + share * CELLS_AT_ONCE;
    t.exists = t.exists && first < cells;
    t.cells = t.exists ? min(cells - first, CELLS_AT_ONCE) : 1u;
    my_bit = bit_of_cell(word, first + min(member(), t.cells - 1u));
    my_at = vec2(my_bit & 7u, my_bit >> 3) - vec2(3.5, 1.5);
    my_half = vec2(0.5 + ROUNDING);
    my_locations = uvec2(0u);
    if (LOCATIONS) {
        int at = int(2u * (group.y + my_bit));
        vec4 rectangle = uintBitsToFloat(texelFetch(location_cells, at));
        my_at = rectangle.xy;
        my_half = rectangle.zw;
        my_locations = texelFetch(location_cells, at + 1).xy;
    }
    return t;
}

#endif
