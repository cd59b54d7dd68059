// sample: finds the nearest triangle of every sub-sample of the superpixels in a work list. No colours are read or computed.
// Reads: tiles, masks, tile_lists, candidates (or, UNLISTED, what `scatter` has found), offsets. Writes: records, headers.
//
// A team takes up to TEAM cells of a tile. In the first loop a member holds a cell, and all candidates of the tile are
// tested against it. The tests are conservative: `setup` has tested the candidate's bounding box and edges, and here its edges
// are tested against the cell's square. Candidates that pass make the cell's short list, unless they lie behind a triangle that
// covers the whole square. Then the team takes the cells one after the other, in blocks of samples: a member holds ROWS
// samples, with their depths and IDs in registers, and the short list is tested against these. If a short list outgrows its
// room, all candidates of the tile are tested instead. If depths are equal, the smaller ID wins, so that the order of candidates
// does not matter. For samples of UNLISTED tiles, `scatter` has already found what they see.
//
// Record: pixel (x | y << 16), triangle ID, place in the pixel (include/place.glsl), and
//   merged: weight as a float, in samples; one record for each visible triangle of a block, at the centroid of its samples
//           (BY_PART: for each of its parts there; PER_SAMPLE: for each sample, at its position);
//   LAYERED: index of the record of the surface behind it, or ~0 for background; a leaf has ID 0, its weight instead of a
//           place, and the index of its samples' nearest surface (include/layers.glsl).
// Links lead to records with smaller indices. If cells are LOCATIONS, the first word of a record is its location. POINTS make a
// record of each location that sees something; LAYERED: of the others, too.
// Header of a cell's block: first record, number of records (LAYERED: of leaves).
//
// Loops are do-while with guarded bodies: DO_WHILE of workarounds.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/work.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = SAMPLE_CONSTANT_PER_SAMPLE) const bool PER_SAMPLE = false;
layout(constant_id = SAMPLE_CONSTANT_HAS_MASK) const bool HAS_MASK = false;
layout(constant_id = SAMPLE_CONSTANT_LIST) const uint LIST = 0u;           // which of the tile lists
layout(constant_id = SAMPLE_CONSTANT_LEFT_CELLS) const bool LEFT_CELLS = false;   // takes the cells that `sample_lines` left, not all
layout(constant_id = SAMPLE_CONSTANT_BY_PART) const bool BY_PART = false;     // triangles may have a record for each part
layout(constant_id = SAMPLE_CONSTANT_PART) const uint PART = 8u;           // samples of a part
layout(constant_id = SAMPLE_CONSTANT_APART) const bool APART = false;       // a team takes one block of one cell, not some of several
layout(constant_id = SAMPLE_CONSTANT_LONG) const bool LONG = false;         // APART: lists are long for the device's loops

const float ROUNDING = 1.0 / 64.0;                      // of positions and edge functions in a tile, in pixels
const uint BLOCKS_AT_ONCE = APART ? 1u : 4u, CELLS_AT_ONCE = APART ? 1u : TEAM;
#ifndef UNLISTED
const uint ROOM = TEAMS > 1u ? 1024u / TEAMS : LONG ? 3072u : 1024u;   // words of `kept` for a team, which takes more trips if it is too small
const uint KEPT = APART ? ROOM : 2u * ROOM / TEAM;     // room for candidates in the short list of a cell

// The short lists, cell by cell: numbers of candidates, two in a word, since 16 bits can count the tile's list; APART: one.
shared uint kept[ROOM * TEAMS];
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
    uint headers_a_cell = (frame.sample_count + BLOCK - 1u) / BLOCK;
    // Several teams share an entry of the work list. `work.y` is the entry. `share.x` and `share.y` say which blocks and which cells
    // of it this team takes.
    uint spans = (headers_a_cell + BLOCKS_AT_ONCE - 1u) / BLOCKS_AT_ONCE;
    uvec2 work = split(team_number(), spans * (TEAM / CELLS_AT_ONCE));
    bool exists = work.y < counters[LEFT_CELLS ? COUNTER_PLAIN_LEFT + LIST : COUNTER_PLAIN_TILES + LIST];
    if (TEAMS == 1u && !exists) return;
    uvec2 share = split(work.x, spans);
    uint lane = member();
    // The work item: a tile or a group. It has a word of marks for its pixels or cells.
    uint entry = exists ? tile_lists[first_entry(LEFT_CELLS ? LIST + LEFT : LIST) + work.y] : 0u, item = entry_item(entry);
    uvec4 location_group = LOCATIONS ? texelFetch(location_groups, int(item)) : uvec4(0u);
    uint tile = LOCATIONS ? location_group.x : item;
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    uint cells_word = LOCATIONS ? ~0u >> (32u - location_group.z) : masks[tile];
    uint word = LEFT_CELLS ? cells_word & marks[item] : cells_word;
    uint cells = bitCount(word);
    uint first_cell = entry_part(entry) * CELLS_OF_ENTRY + share.y * CELLS_AT_ONCE;
    uint first_block = share.x * BLOCKS_AT_ONCE;
    exists = exists && first_cell < cells;
    if (TEAMS == 1u && !exists) return;
    uint group = exists ? min(cells - first_cell, CELLS_AT_ONCE) : 0u;
    uint blocks = min(headers_a_cell, first_block + BLOCKS_AT_ONCE);

    Cell cell;
    cell.center = tile_center(tile_at);
    cell.first = header.y;

    // The cell of each member, and what it keeps of the tile's candidates.
    uint my_bit = bit_of_cell(word, min(first_cell + lane, max(cells, 1u) - 1u));
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
    uint cell_bit = of_member(my_bit, 0u);
    vec2 cell_at = vec2(of_member(my_at.x, 0u), of_member(my_at.y, 0u));
    vec2 cell_half = vec2(of_member(my_half.x, 0u), of_member(my_half.y, 0u));
    trips = 0u;
#ifndef UNLISTED
    float my_hidden = 0.0;          // depth: what lies farther is hidden in the whole cell
    uint first_kept = ROOM * team_in_workgroup(), count = exists ? header.w >> TILE_COUNT_SHIFT : 0u;
    uint my_count = 0u, my_last = 0u;   // number of candidates in the cell's short list, and the list's last word
    uint chunks = max((count + TEAM - 1u) / TEAM, 1u), chunk = 0u;
    do {
        Candidate k = load_candidate(cell.first, min(chunk * TEAM + lane, max(count, 1u) - 1u), cell.center);
        uint chunk_count = min(count - min(count, chunk * TEAM), TEAM);
        if (APART) {
            // There is only one cell, so each member tests a candidate.
            RectangleTest test = test_rectangle(k, cell_at, cell_half, HAS_MASK);
            bool may = lane < chunk_count && may_touch(k, cell_bit);
            my_hidden = max(my_hidden, team_max(may ? test.hides : 0.0));
            bool keeps = may && test.touches && test.near >= my_hidden;
            uint keeping = team_ballot(keeps);
            if (keeps) kept[first_kept + min(my_count + bits_before(keeping), KEPT - 1u)] = chunk * TEAM + lane;
            my_count += uint(bitCount(keeping));
        } else {
            uint j = 0u;
            do {
                [[unroll]] for (uint u = 0u; u < 4u; u++) {
                    Candidate t = shuffle_candidate(k, j + u);
                    RectangleTest test = test_rectangle(t, my_at, my_half, HAS_MASK);
                    bool may = j + u < chunk_count && may_touch(t, my_bit);
                    my_hidden = max(my_hidden, may ? test.hides : 0.0);
                    if (test.touches && test.near >= my_hidden && may) {
                        uint entry = min(my_count, KEPT - 1u), candidate = chunk * TEAM + j + u;
                        my_last = (entry & 1u) == 0u ? candidate : my_last & 0xffffu | candidate << 16;
                        kept[first_kept + (lane * KEPT + entry) / 2u] = my_last;
                        my_count++;
                    }
                }
                j += 4u;
            } while (j < chunk_count);
        }
    } while (++chunk < chunks);
    team_barrier();

    trips = (APART ? 1u : 4u) * chunks;
#endif
    if (!exists) return;
    uint block = first_block;
    do {
        load_offsets(block * BLOCK, frame.sample_count - 1u);
        cell.samples = min(frame.sample_count - block * BLOCK, BLOCK);
        uvec2 my_header = uvec2(0u);    // header of this member's cell
        cell.member = 0u;
        do {
            uint bit = of_member(my_bit, cell.member);
            vec2 in_tile = vec2(bit & 7u, bit >> 3);
            uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(in_tile);
            uint cell_id = pixel.x | pixel.y << 16;
            cell.at = in_tile - vec2(3.5, 1.5);
            cell.half_side = vec2(0.5 + ROUNDING);
            cell.bit = bit;
            cell.pixel = mat2(1.0);
            if (LOCATIONS) {
                cell.at = vec2(of_member(my_at.x, cell.member), of_member(my_at.y, cell.member));
                cell.half_side = vec2(of_member(my_half.x, cell.member), of_member(my_half.y, cell.member));
                cell.location = of_member(my_locations.x, cell.member);
                if (!POINTS) cell.pixel = location_jacobian(cell.location);
            }
            if (POINTS) {
                uint points = of_member(my_locations.y, cell.member);
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
            cell.hidden = of_member(my_hidden, cell.member);
            uint listed = of_member(my_count, cell.member);
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
            if (POINTS) {
                records_made = record_points(cell);
            } else if (PER_SAMPLE) {
                records_made = record_samples(cell, cell_id);
            } else {
                records_made = record_surfaces(cell, cell_id);
            }
#endif
            my_header = lane == cell.member ? left_over ? uvec2(0u, LEFT_BLOCK) : records_made : my_header;
        } while (++cell.member < group);
        uint number = location_group.w + uint(bitCount(cells_word & ((1u << my_bit) - 1u)));
        if (lane < group) headers[min(header.z + number * headers_a_cell + block, frame.record_capacity - 1u)] = my_header;
    } while (++block < blocks);
}
