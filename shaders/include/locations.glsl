// Sample locations of the caller's own, in the place of pixels. They come sorted by tile. A cell is one location
// that is sampled by the pattern, moved by its Jacobian, or (POINTS) a few locations of a tile that are sampled once each,
// where they are. A group is as many cells of a tile as a subgroup takes.
#ifndef LOCATIONS_GLSL
#define LOCATIONS_GLSL

layout(constant_id = 20) const bool LOCATIONS = false;
layout(constant_id = 21) const bool POINTS = false;
layout(constant_id = 22) const bool OCCLUDERS = false;  // POINTS on surfaces, seen by a light: which triangle lies before theirs

// Two vectors each, floats as bits:
// a location: (x, y from its tile's centre, tile, word), (its Jacobian: change of x and y a column, change a row of the output);
//   word: OCCLUDERS: ID of the surface's triangle, and, in place of the Jacobian, (least depth of what lies before it, 0, 0, 0)
layout(set = 0, binding = 42) uniform utextureBuffer locations;
// a cell: (x, y of its middle from its tile's centre, half its width and height), (first location, locations, 0, 0)
layout(set = 0, binding = 43) uniform utextureBuffer location_cells;
// One vector: tile, first cell, cells, number of the first cell within its tile
layout(set = 0, binding = 44) uniform utextureBuffer location_groups;
layout(std430, set = 0, binding = 45) readonly buffer TileLoads { uvec2 tile_loads[]; };     // cells, samples

// Set in the location of that record of POINTS that stands for all that it sees: its leaf, or its only one.
#define POINT_VALUE 0x80000000u
#define POINT_LOCATION 0x7fffffffu

// OCCLUDERS have no extent: textures are read at their finest level.
mat2 location_jacobian(uint location) {
    vec4 j = uintBitsToFloat(texelFetch(locations, int(2u * location + 1u)));
    return OCCLUDERS ? mat2(0.0) : mat2(j.xy, j.zw);
}

#endif
