// distribute: sorts the sample locations of a list by the tiles that they lie in, and makes cells and groups of cells of them. It
// is a counting sort in four STEPs. An invocation takes
//   NUMBER   a location: finds its rank among the locations of its pixel
//   LAY_OUT  a tile: decides where its locations, cells and groups begin
//   ARRANGE  a location: moves it to its place in the order, tile by tile, and in a tile pixel by pixel along a Morton curve. The
//            first location of a cell stores the cell's tile
//   ENCLOSE  a cell: finds its locations and the rectangle around them. The first cell of a group stores the group
// Reads: the list. Writes: what `include/locations.glsl` describes, masks, counters. The order of the locations of a pixel
// varies from run to run; what they see does not depend on it.
// Locations that are not finite, or lie outside of the region of the plane, are left out and counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/finite.glsl"
#include "include/place_in_tile.glsl"
#include "include/tile_locations.glsl"
layout(local_size_x = 64) in;
layout(constant_id = DISTRIBUTE_CONSTANT_STEP) const uint STEP = 0u;
layout(constant_id = DISTRIBUTE_CONSTANT_POINTS) const bool POINTS = false;      // locations are sampled once each, and several share a cell

layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_LOADS) buffer Loads { uint loads[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_RANKS) buffer Ranks { uint ranks[]; };           // of a location in its pixel; ~0: left out
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_ORDER_OUT) writeonly buffer OrderOut { uint order_out[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_CELLS_OUT) buffer CellsOut { uvec4 cells_out[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_GROUPS_OUT) writeonly buffer GroupsOut { uvec4 groups_out[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_TILE_LOADS) writeonly buffer TileLoads { uvec4 tile_loads[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_MASKS) writeonly buffer Masks { uint masks[]; };
layout(std430, set = SET_OWN, binding = DISTRIBUTE_BINDING_COUNTERS) buffer Counters { uint counters[]; };
// BOUND_TWICE of workarounds.glsl.
layout(set = SET_OWN, binding = DISTRIBUTE_BINDING_LOCATIONS) uniform utextureBuffer locations;
layout(set = SET_OWN, binding = DISTRIBUTE_BINDING_ORDER) uniform utextureBuffer order;
layout(push_constant) uniform Push {
    uvec2 tiles;            // of the region
    uint count;             // locations
    uint in_cell;           // most locations of a cell
    uint in_group;          // most cells of a group
    uint samples;           // samples of a cell that is one location
} push;

// What is added to half of a cell's sides, in pixels, for the rounding of edge functions; a factor for the rounding of samples.
const float SLACK = 1.0 / 64.0, ROUNDING = 1.0 + 1.0 / 1048576.0;
// The farthest that a sample may lie from its location's pixel, in pixels.
const float FARTHEST = 1048576.0;

// How far the samples of a location may lie from it, along x and y.
vec2 half_extent(uint location) {
    if (POINTS) return vec2(0.0);
    vec4 j = abs(uintBitsToFloat(texelFetch(locations, int(2u * location + 1u))));
    return 0.5 * (j.xy + j.zw);
}

// The width of a location's cell, in pixels: the larger singular value of its Jacobian.
float width_of(uint location) {
    vec4 j = uintBitsToFloat(texelFetch(locations, int(2u * location + 1u)));
    float both = dot(j, j), area = j.x * j.w - j.y * j.z;
    return sqrt(0.5 * (both + sqrt(max(both * both - 4.0 * area * area, 0.0)))) * ROUNDING;
}

// The number of a pixel in its tile, row by row.
uint bit_of(ivec2 pixel) { return uint(pixel.x & 7) | uint(pixel.y & 3) << 3; }

uint tile_of(ivec2 pixel) { return uint(pixel.y >> 2) * push.tiles.x + uint(pixel.x >> 3); }

void number(uint i) {
    uvec4 at = texelFetch(locations, int(2u * i));
    ivec2 pixel = ivec2(at.xy);
    vec2 within = uintBitsToFloat(at.zw), extent = half_extent(i);
    // NaN fails these comparisons.
    bool valid = all(greaterThanEqual(within, vec2(0.0))) && all(lessThanEqual(within, vec2(1.0)))
        && is_finite(extent.x) && is_finite(extent.y) && max(extent.x, extent.y) <= FARTHEST;
    valid = valid && all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(uvec2(pixel) >> uvec2(3u, 2u), push.tiles));
    ranks[i] = ~0u;
    if (valid) ranks[i] = atomicAdd(loads[tile_of(pixel) * LOAD_WORDS + bit_of(pixel)], 1u);
    uint left_out = subgroupAdd(valid ? 0u : 1u);
    if (subgroupElect() && left_out != 0u) atomicAdd(counters[COUNTER_LEFT_OUT], left_out);
    if (POINTS) {
        if (i == 0u) counters[COUNTER_REACH] = floatBitsToUint(0.5);
        return;
    }
    vec2 reach = abs(within - 0.5) + extent;
    float farthest = subgroupMax(valid ? max(reach.x, reach.y) * ROUNDING : 0.5);
    float widest = subgroupMax(valid ? width_of(i) : 0.0);
    if (subgroupElect()) {
        atomicMax(counters[COUNTER_REACH], floatBitsToUint(farthest));
        atomicMax(counters[COUNTER_WIDEST], floatBitsToUint(widest));
    }
}

void lay_out(uint tile) {
    uint base = tile * LOAD_WORDS, count = 0u, mask = 0u;
    [[unroll]] for (uint place = 0u; place < 32u; place++) {
        uint more = loads[base + bit_at(place)];
        count += more;
        mask |= more != 0u ? 1u << bit_at(place) : 0u;
    }
    uint cells = (count + push.in_cell - 1u) / push.in_cell, groups = (cells + push.in_group - 1u) / push.in_group;
    masks[tile] = mask;
    tile_loads[tile] = uvec4(0u);
    if (count == 0u) return;
    // A tile's locations begin with a new cell, so cells have as many places as they have room for, also if some stay empty.
    uint first_cell = atomicAdd(counters[COUNTER_CELLS], cells), first = first_cell * push.in_cell, next = first;
    tile_loads[tile] = uvec4(cells, POINTS ? count : cells * push.samples, first_cell, 0u);
    atomicMax(counters[COUNTER_MOST_CELLS], cells);
    [[unroll]] for (uint place = 0u; place < 32u; place++) {
        uint more = loads[base + bit_at(place)];
        loads[base + bit_at(place)] = next;
        next += more;
    }
    loads[base + LOAD_FIRST] = first;
    loads[base + LOAD_COUNT] = count;
    loads[base + LOAD_FIRST_GROUP] = atomicAdd(counters[COUNTER_GROUPS], groups);
    atomicAdd(counters[COUNTER_PLACED], count);
    atomicAdd(counters[COUNTER_TILES], 1u);
    if (!POINTS) atomicAdd(counters[COUNTER_SUPERPIXELS], cells);
}

void arrange(uint i) {
    uint rank = ranks[i];
    if (rank == ~0u) return;
    ivec2 pixel = ivec2(texelFetch(locations, int(2u * i)).xy);
    uint tile = tile_of(pixel), place = loads[tile * LOAD_WORDS + bit_of(pixel)] + rank, cell = place / push.in_cell;
    if (POINTS) order_out[place] = i;
    if (cell * push.in_cell == place) cells_out[2u * cell + 1u] = uvec4(POINTS ? place : i, tile, 0u, 0u);
}

void enclose(uint cell) {
    if (cell >= counters[COUNTER_CELLS]) return;
    uvec2 held = cells_out[2u * cell + 1u].xy;
    uint tile = held.y, base = tile * LOAD_WORDS, first_cell = loads[base + LOAD_FIRST] / push.in_cell, number = cell - first_cell;
    uint count = loads[base + LOAD_COUNT], cells = (count + push.in_cell - 1u) / push.in_cell;
    held.y = min(push.in_cell, count - number * push.in_cell);
    vec2 low = vec2(3.4e38), high = vec2(-3.4e38), at;
    uint member = 0u;
    do {
        uint location = POINTS ? texelFetch(order, int(held.x + min(member, held.y - 1u))).x : held.x;
        at = place_in_tile(texelFetch(locations, int(2u * location)));
        vec2 extent = half_extent(location);
        low = min(low, at - extent);
        high = max(high, at + extent);
    } while (++member < push.in_cell);
    // The middle of a cell with one location is that location, to the bit.
    vec2 middle = held.y == 1u ? at : 0.5 * (low + high);
    vec2 half_side = max(high - middle, middle - low) * ROUNDING + SLACK;
    cells_out[2u * cell] = floatBitsToUint(vec4(middle, half_side));
    cells_out[2u * cell + 1u] = uvec4(held, 0u, 0u);
    uint group = number / push.in_group;
    if (group * push.in_group == number)
        groups_out[loads[base + LOAD_FIRST_GROUP] + group] = uvec4(tile, cell, min(push.in_group, cells - number), number);
}

void main() {
    uint i = invocation_number();
    uint tile_count = push.tiles.x * push.tiles.y;
    if (STEP == DISTRIBUTE_NUMBER && i < push.count) number(i);
    if (STEP == DISTRIBUTE_LAY_OUT && i < tile_count) lay_out(i);
    if (STEP == DISTRIBUTE_ARRANGE && i < push.count) arrange(i);
    if (STEP == DISTRIBUTE_ENCLOSE) enclose(i);
}
