// A list of sample locations, which are sampled instead of pixels, and the tiles to which `distribute` sorts them. A cell is
// one location, sampled at the pattern's offsets times its Jacobian. With POINTS, a cell is a few locations of a tile, each
// sampled once. A group is as many cells of a tile as a subgroup takes. Results are stored by the index of a location in the
// list.
#ifndef LOCATIONS_GLSL
#define LOCATIONS_GLSL
#include "interface.glsl"
#include "place_in_tile.glsl"

layout(constant_id = CONSTANT_LOCATIONS) const bool LOCATIONS = false;
layout(constant_id = CONSTANT_POINTS) const bool POINTS = false;

// Two vectors a location, floats as bits: (pixel x, y as signed integers, place in the pixel x, y from 0 to 1), (its Jacobian:
// change of x and y per column of the output, change per row).
layout(set = SET_DATA, binding = BINDING_LOCATIONS) uniform utextureBuffer locations;
// Two vectors a cell, floats as bits: (x, y of its middle relative to its tile's centre, half its width and height), (its
// location, 1, 0, 0). POINTS: the second is (where in `location_order` its locations begin, how many it has, 0, 0).
layout(set = SET_DATA, binding = BINDING_LOCATION_CELLS) uniform utextureBuffer location_cells;
// A vector a group: (tile, first cell, number of cells, number of the first cell within its tile).
layout(set = SET_DATA, binding = BINDING_LOCATION_GROUPS) uniform utextureBuffer location_groups;
layout(std430, set = SET_DATA, binding = BINDING_TILE_LOADS) readonly buffer TileLoads { uvec4 tile_loads[]; };     // cells, samples, first cell, 0

// POINTS: indices of locations, tile by tile, those of a cell one after the other.
layout(set = SET_DATA, binding = BINDING_LOCATION_ORDER) uniform utextureBuffer location_order;

// A fragment of POINTS holds its location in the lower 31 bits of its first word. The topmost bit marks the fragment that stands
// for all that the location sees: its leaf, or its only fragment.
#define POINT_VALUE 0x80000000u
#define POINT_LOCATION 0x7fffffffu

uint location_at(uint place) { return texelFetch(location_order, int(place)).x; }

// The Jacobian of a location.
mat2 location_jacobian(uint location) {
    vec4 j = uintBitsToFloat(texelFetch(locations, int(2u * location + 1u)));
    return mat2(j.xy, j.zw);
}

#endif
