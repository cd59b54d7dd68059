// A list of sample locations, in the place of pixels, and the tiles that `distribute` finds them in. A cell is one location
// that is sampled by the pattern, moved by its Jacobian, or (POINTS) a few locations of a tile that are sampled once each,
// where they are. A group is as many cells of a tile as a subgroup takes. All that a list's owner sees of a location is by
// its index in the list.
#ifndef LOCATIONS_GLSL
#define LOCATIONS_GLSL
#include "interface.glsl"
#include "place_in_tile.glsl"

layout(constant_id = CONSTANT_LOCATIONS) const bool LOCATIONS = false;
layout(constant_id = CONSTANT_POINTS) const bool POINTS = false;
layout(constant_id = CONSTANT_OCCLUDERS) const bool OCCLUDERS = false;  // POINTS on surfaces, seen by a light: which triangle lies before theirs

// Two vectors each, floats as bits:
// a location: (pixel x, y as signed integers, place in it x, y from 0 to 1), (its Jacobian: change of x and y a column, change
//   a row of the output; OCCLUDERS: least depth of what lies before it, ID of the surface's triangle, 0, 0)
layout(set = SET_DATA, binding = BINDING_LOCATIONS) uniform utextureBuffer locations;
// a cell: (x, y of its middle from its tile's centre, half its width and height), (its location or, of POINTS, where in
//   `location_order` its locations begin, how many it has, 0, 0)
layout(set = SET_DATA, binding = BINDING_LOCATION_CELLS) uniform utextureBuffer location_cells;
// One vector: tile, first cell, cells, number of the first cell within its tile
layout(set = SET_DATA, binding = BINDING_LOCATION_GROUPS) uniform utextureBuffer location_groups;
layout(std430, set = SET_DATA, binding = BINDING_TILE_LOADS) readonly buffer TileLoads { uvec4 tile_loads[]; };     // cells, samples, first cell, 0

// Locations of POINTS tile by tile, those of a cell one after the other.
layout(set = SET_DATA, binding = BINDING_LOCATION_ORDER) uniform utextureBuffer location_order;

// Set in the location of that record of POINTS that stands for all that it sees: its leaf, or its only one.
#define POINT_VALUE 0x80000000u
#define POINT_LOCATION 0x7fffffffu

uint location_at(uint place) { return texelFetch(location_order, int(place)).x; }

// OCCLUDERS have no extent: textures are read at their finest level.
mat2 location_jacobian(uint location) {
    vec4 j = uintBitsToFloat(texelFetch(locations, int(2u * location + 1u)));
    return OCCLUDERS ? mat2(0.0) : mat2(j.xy, j.zw);
}

#endif
