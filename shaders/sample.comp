// sample: finds the nearest triangle of every sub-sample of the superpixels in a work list. No colours are read or computed.
// Reads: tiles, masks, tile_lists, candidates (or, UNLISTED, what `scatter` has found), offsets. Writes: fragments, headers.
//
// A team takes up to TEAM cells of a tile. In the first loop a member holds a cell, and all candidates of the tile are
// tested against it. The tests are conservative: `setup` has tested the candidate's bounding box and edges, and here its edges
// are tested against the cell's square. Candidates that pass make the cell's short list, unless they lie behind a triangle that
// covers the whole square. Then the team takes the cells one after the other, in blocks of samples: a member holds ROWS
// samples, with their depths and IDs in registers, and the short list is tested against these. If a short list outgrows its
// room, all candidates of the tile are tested instead. If depths are equal, the smaller ID wins, so that the order of candidates
// does not matter. For samples of UNLISTED tiles, `scatter` has already found what they see.
//
// Fragment: pixel (x | y << 16), triangle ID, place in the pixel (include/place.glsl), and
//   merged: weight as a float, in samples; one fragment for each visible triangle of a block, at the centroid of its samples
//           (BY_PART: for each of its parts there; PER_SAMPLE: for each sample, at its position);
//   LAYERED: index of the fragment of the surface behind it, or ~0 for background; a leaf has ID 0, its weight instead of a
//           place, and the index of its samples' nearest surface (include/layers.glsl).
// Links lead to fragments with smaller indices. If cells are LOCATIONS, the first word of a fragment is its location. POINTS make a
// fragment of each location that sees something; LAYERED: of the others, too.
// Header of a cell's block: first fragment, number of fragments (LAYERED: of leaves).
//
// LAYERED and UNLISTED are macros: if one module had the code for all, drivers would take longer to read it at each start.
// Loops are do-while with guarded bodies: DO_WHILE of workarounds.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/work.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = SAMPLE_CONSTANT_ROWS) const uint ROWS = 8u;            // samples of a block that a member holds
layout(constant_id = SAMPLE_CONSTANT_PER_SAMPLE) const bool PER_SAMPLE = false;
layout(constant_id = SAMPLE_CONSTANT_HAS_MASK) const bool HAS_MASK = false;
layout(constant_id = SAMPLE_CONSTANT_LIST) const uint LIST = 0u;           // which of the tile lists
layout(constant_id = SAMPLE_CONSTANT_LEFT_CELLS) const bool LEFT_CELLS = false;   // takes the cells that `sample_lines` left, not all
layout(constant_id = SAMPLE_CONSTANT_BY_PART) const bool BY_PART = false;     // triangles may have a fragment for each part
layout(constant_id = SAMPLE_CONSTANT_PART) const uint PART = 8u;           // samples of a part
layout(constant_id = SAMPLE_CONSTANT_APART) const bool APART = false;       // a team takes one block of one cell, not some of several
layout(constant_id = SAMPLE_CONSTANT_LONG) const bool LONG = false;         // APART: lists are long for the device's loops

const uint BLOCKS_AT_ONCE = APART ? 1u : 4u, CELLS_AT_ONCE = APART ? 1u : TEAM;
// Words of `kept` for a team, which takes more trips if it is too small, and room for candidates in the short list of a cell.
const uint ROOM = UNLISTED ? 1u : TEAMS > 1u ? 1024u / TEAMS : LONG ? 3072u : 1024u, KEPT = APART ? ROOM : 2u * ROOM / TEAM;

// The short lists, cell by cell: numbers of candidates, two in a word, since 16 bits can count the tile's list; APART: one.
shared uint kept[ROOM * TEAMS];

#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/taken.glsl"
#include "include/block.glsl"
#include "include/layers.glsl"

uint my_count, my_last;     // number of candidates in the short list of this member's cell, and the list's last word
float my_hidden;            // depth: what lies farther is hidden in the whole cell

// Tests a chunk of TEAM candidates, of which this member holds one, against the team's only cell.
void keep_apart(Candidate k, uint chunk, uint candidates_) {
    uint bit = of_member(my_bit, 0u);
    vec2 at = vec2(of_member(my_at.x, 0u), of_member(my_at.y, 0u)), half_side = vec2(of_member(my_half.x, 0u), of_member(my_half.y, 0u));
    RectangleTest test = test_rectangle(k, at, half_side, HAS_MASK);
    bool may = member() < candidates_ && may_touch(k, bit);
    my_hidden = max(my_hidden, team_max(may ? test.hides : 0.0));
    bool keeps = may && test.touches && test.near >= my_hidden;
    uint keeping = team_ballot(keeps);
    if (keeps) kept[ROOM * team_in_workgroup() + min(my_count + bits_before(keeping), KEPT - 1u)] = chunk * TEAM + member();
    my_count += uint(bitCount(keeping));
}

// Tests such a chunk against the cells of all members.
void keep_together(Candidate k, uint chunk, uint candidates_) {
    uint j = 0u;
    do {
        [[unroll]] for (uint u = 0u; u < 4u; u++) {
            Candidate t = shuffle_candidate(k, j + u);
            RectangleTest test = test_rectangle(t, my_at, my_half, HAS_MASK);
            bool may = j + u < candidates_ && may_touch(t, my_bit);
            my_hidden = max(my_hidden, may ? test.hides : 0.0);
            if (test.touches && test.near >= my_hidden && may) {
                uint entry = min(my_count, KEPT - 1u), candidate = chunk * TEAM + j + u;
                my_last = (entry & 1u) == 0u ? candidate : my_last & 0xffffu | candidate << 16;
                kept[ROOM * team_in_workgroup() + (member() * KEPT + entry) / 2u] = my_last;
                my_count++;
            }
        }
        j += 4u;
    } while (j < candidates_);
}

// Makes the short lists of the cells that the team takes, from the `count` candidates of their tile.
void keep_candidates(Taken taken, uint count) {
    my_count = 0u;
    my_last = 0u;
    my_hidden = 0.0;
    uint chunks = max((count + TEAM - 1u) / TEAM, 1u), chunk = 0u;
    do {
        Candidate k = load_candidate(taken.tile.y, min(chunk * TEAM + member(), max(count, 1u) - 1u), taken.center);
        uint candidates_ = count - min(count, chunk * TEAM);
        if (APART) keep_apart(k, chunk, min(candidates_, TEAM)); else keep_together(k, chunk, min(candidates_, TEAM));
    } while (++chunk < chunks);
    team_barrier();
    trips = (APART ? 1u : 4u) * chunks;
}

// The cell that a member holds, with the samples of a block.
Cell cell_of(Taken taken, uint holder, uint block) {
    Cell cell;
    cell.first = taken.tile.y;
    cell.center = taken.center;
    cell.member = holder;
    cell.bit = of_member(my_bit, holder);
    uvec2 pixel = pixel_of_cell(taken, cell.bit);
    cell.id = pixel.x | pixel.y << 16;
    cell.at = vec2(cell.bit & 7u, cell.bit >> 3) - vec2(3.5, 1.5);
    cell.half_side = vec2(0.5 + ROUNDING);
    cell.pixel = mat2(1.0);
    cell.samples = min(frame.sample_count - block * BLOCK, BLOCK);
    if (LOCATIONS) {
        cell.at = vec2(of_member(my_at.x, holder), of_member(my_at.y, holder));
        cell.half_side = vec2(of_member(my_half.x, holder), of_member(my_half.y, holder));
        cell.location = of_member(my_locations.x, holder);
        if (!POINTS) cell.pixel = location_jacobian(cell.location);
    }
    if (POINTS) {
        uint points = of_member(my_locations.y, holder), passed = min(points, block * BLOCK);
        cell.samples = min(points - passed, BLOCK);
        cell.location += cell.samples == 0u ? 0u : passed;
    }
    if (LOCATIONS) cell.id = cell.location;
    return cell;
}

// Finds what the samples of a cell see, from the `count` candidates of its tile.
void see_candidates(inout Cell cell, uint count) {
    cell.hidden = of_member(my_hidden, cell.member);
    uint listed = of_member(my_count, cell.member);
    cell.complete = listed <= KEPT;
    bool out_of_trips = trips > MOST_TRIPS;
    if (out_of_trips) leave_block(COUNTER_STALLED);
    cell.entries = out_of_trips ? 0u : cell.complete ? listed : count;
    begin_cell(cell);
    show_candidates(cell);
}

// Makes the fragments of what the samples of a cell have seen. Returns the first fragment and their number.
uvec2 record_cell(Cell cell) {
    uvec2 made;
    if (LAYERED) {
        made = record_layers(cell);
    } else {
        end_cell(cell);
        if (POINTS) made = record_points(cell);
        else if (PER_SAMPLE) made = record_samples(cell);
        else made = record_surfaces(cell);
    }
    return made;
}

void main() {
    // Several teams share an entry of the work list. `work.y` is the entry. `share.x` and `share.y` say which blocks and which cells
    // of it this team takes.
    uint headers_a_cell = (frame.sample_count + BLOCK - 1u) / BLOCK, spans = (headers_a_cell + BLOCKS_AT_ONCE - 1u) / BLOCKS_AT_ONCE;
    uvec2 work = split(team_number(), spans * (TEAM / CELLS_AT_ONCE)), share = split(work.x, spans);
    Taken taken = take_cells(work.y, share.y);
    if (TEAMS == 1u && !taken.exists) return;
    if (BY_PART && !LAYERED && !LOCATIONS) my_variation = variation_around(pixel_of_cell(taken, my_bit));
    uint count = taken.exists ? taken.tile.w >> TILE_COUNT_SHIFT : 0u;
    trips = 0u;
    if (!UNLISTED) keep_candidates(taken, count);
    if (!taken.exists) return;

    uint block = share.x * BLOCKS_AT_ONCE, blocks = min(headers_a_cell, block + BLOCKS_AT_ONCE);
    do {
        load_offsets(block * BLOCK, frame.sample_count - 1u);
        uvec2 my_header = uvec2(0u);    // header of this member's cell
        uint holder = 0u;
        do {
            Cell cell = cell_of(taken, holder, block);
            left_over = false;
            if (UNLISTED) see_owners(cell, owner_of(taken.tile.y, number_of_cell(taken, cell.bit), block * BLOCK));
            else see_candidates(cell, count);
            uvec2 fragments_made = record_cell(cell);
            my_header = member() == holder ? left_over ? uvec2(0u, LEFT_BLOCK) : fragments_made : my_header;
        } while (++holder < taken.cells);
        uint at = taken.tile.z + number_of_cell(taken, my_bit) * headers_a_cell + block;
        if (member() < taken.cells) headers[min(at, frame.fragment_capacity - 1u)] = my_header;
    } while (++block < blocks);
}
