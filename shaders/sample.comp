// sample: finds the nearest triangle of every sub-sample of the superpixels in a work list. No colours are read or computed.
// Reads: tiles, masks, tile_lists, candidates (or, UNLISTED, what `scatter` has found), offsets.
// Writes: records, headers; PROBE: also marks, and lists of the cells that are left to REST.
//
// A subgroup takes up to LANES cells of a tile. In the first loop an invocation holds a cell, and all candidates of the tile are
// tested against it. The tests are conservative: `setup` has tested the candidate's bounding box and edges, and here its edges
// are tested against the cell's square. Candidates that pass make the cell's short list, unless they lie behind a triangle that
// covers the whole square. Then the subgroup takes the cells one after the other, in blocks of samples: an invocation holds ROWS
// samples, with their depths and IDs in registers, and the short list is tested against these. If a short list outgrows its
// room, all candidates of the tile are tested instead. If depths are equal, the smaller ID wins, so that the order of candidates
// does not matter. For samples of UNLISTED tiles, `scatter` has already found what they see.
//
// Coverage. A triangle that owns all samples that it covers is taken to be wholly visible, and its weight is the exact
// area of its part of the cell. What is left of the cell is shared by the other surfaces in proportion to their samples.
// Small triangles are weighted by samples: with exact areas for those that samples meet, those that samples miss would be lost.
// If cells have many samples, a first run (PROBE) takes few of them. If at most one surface is left to share the rest, the
// result is exact. Only other cells get all samples, in a second run (REST), as do cells with HIGH_FREQUENCY triangles, which
// are shaded at the samples.
//
// Record: pixel (x | y << 16), triangle ID, place in the pixel (include/place.glsl), and
//   merged: weight as a float, in samples; one record for each visible triangle of a block, at the centroid of its samples
//           (BY_PART: for each of its parts there; PER_SAMPLE: for each sample, at its position);
//   LAYERED: index of the record of the surface behind it, or ~0 for background; a leaf has ID 0, its weight instead of a
//           place, and the index of its samples' nearest surface (include/layers.glsl).
// Links lead to records with smaller indices. If cells are LOCATIONS, the first word of a record is its location. POINTS make a
// record of each location that sees something; LAYERED: of the others, too.
// OCCLUDERS start with the triangle and depth of their surface. They record another triangle that is nearer, or background.
// Header of a cell's block: first record, number of records (LAYERED: of leaves).
//
// Loops are do-while with guarded bodies: DO_WHILE of workarounds.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/work.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = SAMPLE_CONSTANT_PER_SAMPLE) const bool PER_SAMPLE = false;
layout(constant_id = SAMPLE_CONSTANT_HAS_MASK) const bool HAS_MASK = false;
layout(constant_id = SAMPLE_CONSTANT_LIST) const uint LIST = 0u;           // which of the tile lists
layout(constant_id = SAMPLE_CONSTANT_RUN) const uint RUN = 0u;
layout(constant_id = SAMPLE_CONSTANT_BY_PART) const bool BY_PART = false;     // triangles may have a record for each part
#ifdef UNLISTED
const bool EXACT_AREAS = false;
#else
layout(constant_id = SAMPLE_CONSTANT_EXACT_AREAS) const bool EXACT_AREAS = false; // only if a block has all samples of a cell
#endif
layout(constant_id = SAMPLE_CONSTANT_PART) const uint PART = 8u;           // samples of a part
layout(constant_id = SAMPLE_CONSTANT_APART) const bool APART = false;       // a subgroup takes one block of one cell, not some of several
layout(constant_id = SAMPLE_CONSTANT_LONG) const bool LONG = false;         // APART: lists are long for the device's loops

const float ROUNDING = 1.0 / 64.0;                      // of positions and edge functions in a tile, in pixels
const uint BLOCKS_AT_ONCE = APART ? 1u : 4u, CELLS_AT_ONCE = APART ? 1u : LANES;
#ifndef UNLISTED
const uint ROOM = LONG && LANES < 32u ? 3072u : 1024u;  // words of `kept`: small subgroups take more trips if it is too small
const uint KEPT = APART ? ROOM : 2u * ROOM / LANES;     // room for candidates in the short list of a cell

// The short lists, cell by cell: numbers of candidates, two in a word, since 16 bits can count the tile's list; APART: one.
shared uint kept[ROOM];
#endif

#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/block.glsl"
#ifdef LAYERED
#include "include/layers.glsl"
#else
#include "include/surfaces.glsl"
#endif

void main() {
    if (in_other_subgroups(LANES)) return;
    uint samples = RUN == RUN_PROBE ? PROBE_SAMPLES : frame.sample_count;
    uint first_sample = RUN == RUN_PROBE ? frame.sample_count : 0u;
    uint blocks = (samples + BLOCK - 1u) / BLOCK, headers_a_cell = (frame.sample_count + BLOCK - 1u) / BLOCK;
    // Several subgroups share an entry of the work list. `work.y` is the entry. `share.x` and `share.y` say which blocks and
    // which cells of it this subgroup takes.
    uint spans = (blocks + BLOCKS_AT_ONCE - 1u) / BLOCKS_AT_ONCE;
    uvec2 work = split(workgroup_number(), spans * (LANES / CELLS_AT_ONCE));
    if (work.y >= counters[RUN == RUN_REST ? COUNTER_PLAIN_LEFT + LIST : COUNTER_PLAIN_TILES + LIST]) return;
    uvec2 share = split(work.x, spans);
    uint lane = gl_SubgroupInvocationID;
    // The work item: a tile or a group. It has a word of marks for its pixels or cells.
    uint entry = tile_lists[first_entry(RUN == RUN_REST ? LIST + LEFT : LIST) + work.y], item = entry_item(entry);
    uvec4 location_group = LOCATIONS ? texelFetch(location_groups, int(item)) : uvec4(0u);
    uint tile = LOCATIONS ? location_group.x : item;
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    uint cells_word = LOCATIONS ? ~0u >> (32u - location_group.z) : masks[tile];
    uint word = RUN == RUN_REST ? cells_word & marks[item] : cells_word;
    uint cells = bitCount(word);
    uint first_cell = entry_part(entry) * LANES + share.y * CELLS_AT_ONCE;
    uint first_block = share.x * BLOCKS_AT_ONCE;
    if (first_cell >= cells) return;
    uint group = min(cells - first_cell, CELLS_AT_ONCE);
    blocks = min(blocks, first_block + BLOCKS_AT_ONCE);

    Cell cell;
    cell.center = tile_center(tile_at);
    cell.first = header.y;

    // The cell of each invocation, and what it keeps of the tile's candidates.
    uint my_bit = bit_of_cell(word, min(first_cell + lane, cells - 1u));
    vec2 my_at = vec2(my_bit & 7u, my_bit >> 3) - vec2(3.5, 1.5), my_half = vec2(0.5 + ROUNDING);
    uvec2 my_locations = uvec2(0u);     // the cell's first location, and how many it has
    if (LOCATIONS) {
        int at = int(2u * (location_group.y + my_bit));
        vec4 square = uintBitsToFloat(texelFetch(location_cells, at));
        my_at = square.xy;
        my_half = square.zw;
        my_locations = texelFetch(location_cells, at + 1).xy;
    }
#ifndef LAYERED
    if (BY_PART && !LOCATIONS) my_variation = variation_around(uvec2(tile_at) * uvec2(8u, 4u) + uvec2(my_bit & 7u, my_bit >> 3));
#endif
    uint cell_bit = subgroupShuffle(my_bit, 0u);
    vec2 cell_at = vec2(subgroupShuffle(my_at.x, 0u), subgroupShuffle(my_at.y, 0u));
    vec2 cell_half = vec2(subgroupShuffle(my_half.x, 0u), subgroupShuffle(my_half.y, 0u));
    trips = 0u;
#ifndef UNLISTED
    float my_hidden = 0.0;          // depth: what lies farther is hidden in the whole cell
    uint count = header.w >> TILE_COUNT_SHIFT;
    uint my_count = 0u, my_last = 0u;   // number of candidates in the cell's short list, and the list's last word
    uint chunks = max((count + LANES - 1u) / LANES, 1u), chunk = 0u;
    do {
        Candidate k = load_candidate(cell.first, min(chunk * LANES + lane, max(count, 1u) - 1u), cell.center);
        uint chunk_count = min(count - min(count, chunk * LANES), LANES);
        if (APART) {
            // There is only one cell, so each invocation tests a candidate.
            RectangleTest test = test_rectangle(k, cell_at, cell_half, HAS_MASK);
            bool exists = lane < chunk_count && may_touch(k, cell_bit);
            my_hidden = max(my_hidden, lanes_max(exists ? test.hides : 0.0));
            bool keeps = exists && test.touches && test.near >= my_hidden;
            uvec4 keeping = subgroupBallot(keeps);
            if (keeps) kept[min(my_count + subgroupBallotExclusiveBitCount(keeping), KEPT - 1u)] = chunk * LANES + lane;
            my_count += subgroupBallotBitCount(keeping);
        } else {
            uint j = 0u;
            do {
                [[unroll]] for (uint u = 0u; u < 4u; u++) {
                    Candidate t = shuffle_candidate(k, j + u);
                    RectangleTest test = test_rectangle(t, my_at, my_half, HAS_MASK);
                    bool exists = j + u < chunk_count && may_touch(t, my_bit);
                    my_hidden = max(my_hidden, exists ? test.hides : 0.0);
                    if (test.touches && test.near >= my_hidden && exists) {
                        uint entry = min(my_count, KEPT - 1u), candidate = chunk * LANES + j + u;
                        my_last = (entry & 1u) == 0u ? candidate : my_last & 0xffffu | candidate << 16;
                        kept[(lane * KEPT + entry) / 2u] = my_last;
                        my_count++;
                    }
                }
                j += 4u;
            } while (j < chunk_count);
        }
    } while (++chunk < chunks);
    subgroupBarrier();

    trips = (APART ? 1u : 4u) * chunks;
#endif
    uint unsettled = 0u, block = first_block;
    do {
        load_offsets(first_sample + block * BLOCK, first_sample + samples - 1u);
        cell.samples = min(samples - block * BLOCK, BLOCK);
        uvec2 my_header = uvec2(0u);    // header of this invocation's cell
        cell.member = 0u;
        do {
            uint bit = subgroupShuffle(my_bit, cell.member);
            vec2 in_tile = vec2(bit & 7u, bit >> 3);
            uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(in_tile);
            uint cell_id = pixel.x | pixel.y << 16;
            cell.at = in_tile - vec2(3.5, 1.5);
            cell.half_side = vec2(0.5 + ROUNDING);
            cell.bit = bit;
            cell.pixel = mat2(1.0);
            if (LOCATIONS) {
                cell.at = vec2(subgroupShuffle(my_at.x, cell.member), subgroupShuffle(my_at.y, cell.member));
                cell.half_side = vec2(subgroupShuffle(my_half.x, cell.member), subgroupShuffle(my_half.y, cell.member));
                cell.location = subgroupShuffle(my_locations.x, cell.member);
                if (!POINTS) cell.pixel = location_jacobian(cell.location);
            }
            if (POINTS) {
                uint points = subgroupShuffle(my_locations.y, cell.member);
                uint passed = min(points, block * BLOCK);
                cell.samples = min(points - passed, BLOCK);
                cell.location += cell.samples == 0u ? 0u : passed;
            }
            if (LOCATIONS) cell_id = cell.location;
            uint number = location_group.w + uint(bitCount(cells_word & ((1u << bit) - 1u)));
            left_over = false;
#ifdef UNLISTED
            see_owners(cell, owner_of(cell.first, number, block * BLOCK));
#else
            cell.hidden = subgroupShuffle(my_hidden, cell.member);
            uint listed = subgroupShuffle(my_count, cell.member);
            cell.complete = listed <= KEPT;
            bool out_of_trips = trips > MOST_TRIPS;
            if (out_of_trips) leave_block(COUNTER_STALLED);
            cell.entries = out_of_trips ? 0u : cell.complete ? listed : count;

            begin_cell(cell);
            show_candidates(cell);
#endif
            uvec2 records_made;
#ifdef LAYERED
            records_made = record_layers(cell, cell_id);
#else
            end_cell(cell);
            if (POINTS && !OCCLUDERS) {
                records_made = record_points(cell);
            } else if (PER_SAMPLE) {
                records_made = record_samples(cell, cell_id);
            } else {
                bool settled;
                records_made = record_surfaces(cell, cell_id, settled);
                unsettled |= settled ? 0u : 1u << bit;
            }
#endif
            my_header = lane == cell.member ? left_over ? uvec2(0u, LEFT_BLOCK) : records_made : my_header;
        } while (++cell.member < group);
        uint number = location_group.w + uint(bitCount(cells_word & ((1u << my_bit) - 1u)));
        if (lane < group) headers[min(header.z + number * headers_a_cell + block, frame.record_capacity - 1u)] = my_header;
    } while (++block < blocks);

    if (RUN == RUN_PROBE && unsettled != 0u && subgroupElect()) {
        atomicAdd(counters[COUNTER_RESAMPLED], uint(bitCount(unsettled)));
        leave_cells(LIST, item, unsettled);
    }
}
