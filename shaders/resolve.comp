// resolve: computes the colour of each superpixel from its shaded fragments. A team takes an entry of a work list, and a
// member a cell of it.
// The colours of fragments are tone-mapped one by one, then averaged in linear light; alpha is coverage.
// Reads: tile_lists, tiles, masks, headers, fragments, shaded. Writes: color and, if asked for, display, marks and spreads.
// DRAWN, a variant: samples that see no triangle show what the host has drawn in its image, not the background.
// LOCATIONS: cells are locations, and colours and spreads are stored by the index of a location.
// FILTERED, a variant, also of DRAWN: the spread of each superpixel is stored for `pixel_filter`.
// LAYERED: a header lists the leaves of lists of layers, of which `composite` has computed the colours. With BY_LINES this is so only
// of the cells that `sample_lines` left.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
#include "include/color.glsl"
#include "include/layer_list.glsl"
#include "include/work.glsl"
#include "include/seen_beside.glsl"
#ifdef DRAWN
#include "include/behind.glsl"
#endif
#ifdef FILTERED
#include "include/spread.glsl"
layout(std430, set = SET_DATA, binding = BINDING_SPREADS_OUT) writeonly buffer SpreadsOut { uvec4 spreads_out[]; };
#endif
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = RESOLVE_CONSTANT_BLOCK) const uint BLOCK = 256u;
layout(constant_id = RESOLVE_CONSTANT_LAYERED) const bool LAYERED = false;
layout(constant_id = RESOLVE_CONSTANT_LIST) const uint LIST = 0u;
layout(constant_id = RESOLVE_CONSTANT_DISPLAY_CODES) const bool DISPLAY_CODES = false;
layout(constant_id = RESOLVE_CONSTANT_BY_LINES) const bool BY_LINES = false;   // only cells that `sample_lines` left, which are marked, have more than one block
layout(constant_id = RESOLVE_CONSTANT_GROWS) const bool GROWS = false;       // neighbours are marked for `grow`

void write(uvec2 pixel, vec4 c) {
    if (LOCATIONS) {
        color[pixel.x] = c;
        return;
    }
    // With the device's own multisampling all pixels of a tile are cells, and some lie outside of the image.
    if (any(greaterThanEqual(pixel, frame.size))) return;
    uint at = pixel.y * frame.size.x + pixel.x;
    color[at] = c;
    if (DISPLAY_CODES) display_out[at] = display_code(c);
    if (GROWS) mark_contrasting_neighbours(pixel, display_code(c));
}

#ifdef FILTERED
// Sums over the fragments of a cell: of their samples' spread, weighted by their number, and the same times their colours.
struct Spread {
    float samples[8];
    vec4 light[8];
};

void add_spread(inout Spread s, uint fragment, float weight, vec4 c) {
    float own[8];
    unpack_spread(texelFetch(fragments, int(frame.fragment_capacity + fragment)), own);
    [[unroll]] for (uint i = 0u; i < 8u; i++) {
        float weighted = weight * own[i];
        s.samples[i] += weighted;
        s.light[i] += weighted * c;
    }
}

// Stores the spread of a pixel of this `mean`. The samples' own spreads should add up to that of the cell, which is 0. What is missing
// is the spread of the background, if samples see it, and otherwise an error of rounding, which shows the mean.
void write_spread_of(uvec2 pixel, Spread s, vec4 mean, vec4 missing, float share) {
    if (!LOCATIONS && any(greaterThanEqual(pixel, frame.size))) return;
    uint at = SPREAD_VECTORS * (LOCATIONS ? pixel.x : pixel.y * frame.size.x + pixel.x);
    vec4 each = share / max(mean, vec4(1e-30));
    [[unroll]] for (uint v = 0u; v < SPREAD_VECTORS; v++) {
        vec4 low = (s.light[2u * v] - s.samples[2u * v] * missing) * each;
        vec4 high = (s.light[2u * v + 1u] - s.samples[2u * v + 1u] * missing) * each;
        spreads_out[at + v] = uvec4(packSnorm2x16(low.rg), packSnorm2x16(low.ba), packSnorm2x16(high.rg), packSnorm2x16(high.ba));
    }
}
#endif

void main() {
    uint number = team_number();
    if (number >= counters[COUNTER_PLAIN_TILES + LIST]) return;
    uint lane = member();
    uint entry = tile_lists[first_entry(LIST) + number], item = entry_item(entry);
    uvec4 location_group = LOCATIONS ? texelFetch(location_groups, int(item)) : uvec4(0u);
    uint tile = LOCATIONS ? location_group.x : item;
    uint word = masks[tile];
    uint first_header = tiles[tile].z + location_group.w * ((frame.sample_count + BLOCK - 1u) / BLOCK);
    uvec2 corner = split(tile, frame.tiles.x) * uvec2(8u, 4u);
    uint blocks = (frame.sample_count + BLOCK - 1u) / BLOCK;
    float share = 1.0 / float(frame.sample_count);

    // The cell of this invocation.
    uint first = entry_part(entry) * CELLS_OF_ENTRY, cell = first + lane;
    uint bit = LOCATIONS ? lane : bit_of_cell(word, cell);
    bool mine = cell < (LOCATIONS ? location_group.z : bitCount(word));
    vec4 sum = vec4(0.0);
    float covered = 0.0;
    bool on_lines = BY_LINES && (marks[item] >> bit & 1u) == 0u, layered = LAYERED && !on_lines;
    uint filled = on_lines ? 1u : blocks;
    uint block = 0u;
    bool left_over = false;
#ifdef FILTERED
    Spread spread;
    [[unroll]] for (uint i = 0u; i < 8u; i++) {
        spread.samples[i] = 0.0;
        spread.light[i] = vec4(0.0);
    }
#endif
    do {
        uvec2 h = mine ? headers[min(first_header + cell * blocks + block, frame.fragment_capacity - 1u)] : uvec2(0u);
        left_over = left_over || h.y == LEFT_BLOCK;
        h.y = left_over ? 0u : h.y;
        for (uint r = 0u; r < h.y; r++) {
            uint at = h.x + r;
            uvec4 fragment = texelFetch(fragments, int(at));
            bool seen = layered ? farther(at) != ~0u : fragment.y != 0u;
            float weight = seen ? uintBitsToFloat(layered ? fragment.z : fragment.w) : 0.0;
            vec4 own = texelFetch(shaded, int(at)), c = layered ? own : to_output(vec4(own.rgb, 1.0));
            sum += seen ? weight * c : vec4(0.0);
            covered += weight;
#ifdef FILTERED
            add_spread(spread, at, weight, seen ? c : vec4(0.0));
#endif
        }
    } while (++block < filled);
    uvec2 place = LOCATIONS && mine ? uvec2(texelFetch(location_cells, int(2u * (location_group.y + cell) + 1u)).x, 0u) : corner + uvec2(bit & 7u, bit >> 3);
    float uncovered = float(frame.sample_count) - covered;
    vec4 background = frame.background;
#ifdef DRAWN
    // Sums of areas are rounded: a cell that is covered may seem to have a little background.
    if (mine && uncovered > 1e-3) background = behind(place);
#endif
    sum = (sum + background * uncovered) * share;
    if (mine && !left_over) write(place, sum);
#ifdef FILTERED
    if (mine && !left_over) write_spread_of(place, spread, sum, uncovered > 1e-3 ? background : sum, share);
#endif
}
