// scatter: finds what the samples of tiles without a list of candidates see. Triangles are taken in any order and number. Each
// one updates, by atomic operations, the owners of the samples that it covers: a sample's owner is its vector in
// include/owners.glsl. In each step an invocation takes
//   CLEAR    an owner: resets it
//   DEPTHS   triangles: find the depth of the nearest opaque or alpha-tested surface of each sample
//   IDS      triangles: find the smallest ID of the surfaces at that depth
//   COUNT    triangles: count the BLEND layers before that surface
//   PLACE    an owner: decides where its layers begin
//   LAYERS   triangles: store the layers
//   ORDER    a layer: finds its place in the order of depth
// Reads: pairs or, for tiles with pairs that were not kept (`every`), all triangles; tiles, masks, tile_lists, offsets.
// Writes: candidates, as include/owners.glsl describes.
// A team shows triangles to samples: each member holds a triangle and some samples of a block, and the members' triangles are shown
// one after the other, with their IDs and planes shuffled, to all samples of the cells that they may touch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/work.glsl"
#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/owners.glsl"
#include "include/pairs.glsl"
#include "include/touches.glsl"
layout(local_size_x = 64) in;
layout(constant_id = SCATTER_CONSTANT_HAS_MASK) const bool HAS_MASK = false;
layout(constant_id = SCATTER_CONSTANT_HAS_BLEND) const bool HAS_BLEND = false;
layout(constant_id = SCATTER_CONSTANT_ROWS) const uint ROWS = 8u;      // samples of a block that a member holds
layout(push_constant) uniform Push {
    uint step_;             // one of SCATTER_
    uint every;             // 1: tries every triangle in the tiles that have lost pairs
} push;

const float ROUNDING = 1.0 / 64.0;                      // as in sample.comp
const uint BLOCK = ROWS * TEAM;

struct Cell {
    uint first_owner;
    vec2 at;                // as in block.glsl
    mat2 pixel;
    uint location;
    uint samples;
};

vec2 offset[ROWS];          // offsets of this member's samples of the block from the middle of a pixel
vec2 block_middle, block_reach;     // the rectangle around all offsets of the block: middle, half of the sides

uint sample_of(uint block, uint row) { return (block * ROWS + row) * TEAM + member(); }

void load_offsets(uint block) {
    vec2 low = vec2(1.0), high = vec2(-1.0);
    [[unroll]] for (uint row = 0u; row < ROWS; row++) {
        offset[row] = POINTS ? vec2(0.0) : texelFetch(pattern_offsets, int(min(sample_of(block, row), frame.sample_count - 1u))).xy;
        low = min(low, offset[row]);
        high = max(high, offset[row]);
    }
    low = vec2(team_min(low.x), team_min(low.y));
    high = vec2(team_max(high.x), team_max(high.y));
    block_middle = 0.5 * (low + high);
    block_reach = 0.5 * (high - low) + ROUNDING;
}

uint location_of(Cell cell, uint s) { return POINTS ? location_at(cell.location + min(s, max(cell.samples, 1u) - 1u)) : cell.location; }

bool passes_alpha(Candidate t, vec2 center, Cell cell, vec2 p, mat2 pixel) {
    if (!HAS_MASK || t.id <= frame.first_mask) return true;
    return alpha_passes(alpha_test(t.id - 1u, center, POINTS ? p : cell.at, frame.sample_footprint * pixel), p);
}

// Updates the owner of sample `s` at `p`, which a triangle covers at depth `d`.
void update(Candidate t, vec2 center, Cell cell, uint s, vec2 p, float d) {
    uint o = cell.first_owner + s, depth = floatBitsToUint(d);
    bool of_depths = push.step_ == SCATTER_DEPTHS;
    if (!HAS_BLEND || push.step_ <= SCATTER_IDS) {
        mat2 pixel = POINTS ? location_jacobian(location_of(cell, s)) : cell.pixel;
        if (passes_alpha(t, center, cell, p, pixel)) atomicMax(candidates_out[o][of_depths ? 0 : 1], of_depths ? depth : ~t.id);
    } else if (push.step_ == SCATTER_COUNT) {
        atomicAdd(candidates_out[o].w, 1u);
    } else {
        uint count = candidates_out[o].w;
        if (count == 0u || count == NO_ROOM_FOR_LAYERS) return;
        uint slot = atomicAdd(candidates_out[o].z, 1u);
        candidates_out[slot] = uvec4(depth, t.id, o, 0u);
    }
}

// Shows a triangle to the samples of a cell that are in the block.
void show_to_cell(Candidate t, vec2 center, Cell cell, uint block) {
    vec3 least = thresholds(t);
    vec2 place[ROWS];
    float depth[ROWS];
    uint wins = 0u;             // a bit for each row
    [[unroll]] for (uint row = 0u; row < ROWS; row++) {
        uint s = sample_of(block, row);
        bool exists = s < cell.samples;
        if (POINTS) place[row] = place_in_tile(texelFetch(locations, int(2u * location_of(cell, s))));
        else place[row] = cell.at + (LOCATIONS ? cell.pixel * offset[row] : offset[row]);
        bool there = covers(t, least, place[row], depth[row]) && depth[row] > 0.0 && exists;
        uint seen = candidates_out[exists ? cell.first_owner + s : 0u].x, own = floatBitsToUint(depth[row]);
        wins |= there && (push.step_ == SCATTER_IDS ? own == seen : own > seen) ? 1u << row : 0u;
    }
    do {
        uint row = wins != 0u ? uint(findLSB(wins)) : 0u;
        vec2 p = place[0];
        float d = depth[0];
        [[unroll]] for (uint other = 1u; other < ROWS; other++) {
            p = row == other ? place[other] : p;
            d = row == other ? depth[other] : d;
        }
        if (wins != 0u) update(t, center, cell, sample_of(block, row), p, d);
        wins &= wins - 1u;
    } while (team_or(wins) != 0u);
}

Cell pixel_cell(uint first, uint number, uint bit) {
    return Cell(owner_of(first, number, 0u), vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5), mat2(1.0), 0u, frame.sample_count);
}

Cell located_cell(uint first, uint number, uint first_cell) {
    int at = int(2u * (first_cell + number));
    vec4 square = uintBitsToFloat(texelFetch(location_cells, at));
    uvec2 held = texelFetch(location_cells, at + 1).xy;
    // The Jacobians of POINTS are those of their own locations, not of the cell.
    mat2 pixel = POINTS ? mat2(1.0) : location_jacobian(held.x);
    return Cell(owner_of(first, number, 0u), square.xy, pixel, held.x, POINTS ? held.y : frame.sample_count);
}

// Which of `count` cells of locations, at most 32 from number `first` on, a triangle may touch, a bit each.
uint cells_touched(Candidate t, uint first, uint count) {
    uint touched = 0u;
    [[unroll]] for (uint part = 0u; part < 32u; part += TEAM) {
        uint number = min(part + member(), max(count, 1u) - 1u);
        vec4 square = uintBitsToFloat(texelFetch(location_cells, int(2u * (first + number))));
        touched |= team_ballot(part + member() < count && test_rectangle(t, square.xy, square.zw, HAS_MASK).touches) << part;
    }
    return touched;
}

// Shows a triangle to cells of a tile: `cells` has a bit for each pixel; of locations it is their number, from number `from` on.
void show_to_tile(Candidate t, uint tile, uint cells, uint from, uint block) {
    uint first = tiles[tile].y, word = LOCATIONS ? 0u : masks[tile], first_cell = LOCATIONS ? tile_loads[tile].z : 0u, passed = 0u;
    vec2 center = tile_center(ivec2(split(tile, frame.tiles.x)));
    do {
        uint touched = LOCATIONS ? cells_touched(t, first_cell + from + passed, cells - min(cells, passed)) : cells;
        do {
            bool some = touched != 0u;
            uint bit = some ? uint(findLSB(touched)) : 0u, number = LOCATIONS ? from + passed + bit : uint(bitCount(word & ((1u << bit) - 1u)));
            Cell cell = LOCATIONS ? located_cell(first, number, first_cell) : pixel_cell(first, number, bit);
            // Cells without room for their owners are skipped here, and counted by `sample`.
            cell.samples = some && cell.first_owner + frame.sample_count <= owners_room() ? cell.samples : 0u;
            show_to_cell(t, center, cell, block);
            touched &= touched - 1u;
        } while (touched != 0u);
        passed += 32u;
    } while (LOCATIONS && passed < cells);
}

// Shows triangle `t` of each member to cells `from` to before `to` of the member's tile; to none if there are no such cells.
void show(uint t, uint tile, uint from, uint to) {
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    Triangle k = triangle_at(t);
    Setup s = setup_triangle(k.v0, k.v1, k.v2, tile_center(tile_at), single_sided(k.word));
    Footprint f = footprint_of(k.v0, k.v1, k.v2);
    Candidate held = Candidate(s.a, s.b, s.c, s.depth, s.near, s.far, t + 1u, ~0u);
    bool shows = from < to && (t >= frame.first_blend) == (push.step_ >= SCATTER_COUNT) && k.exists && s.valid && !f.outside;
    uint cells = 0u;
    if (LOCATIONS) {
        cells = shows ? to - from : 0u;
    } else {
        uint word = masks[tile], before = (1u << bit_of_cell(word, from)) - 1u;
        uint after = to < bitCount(word) ? ~((1u << bit_of_cell(word, to)) - 1u) : 0u;
        cells = shows ? word & footprint_mask(f, tile_at) & ~before & ~after : 0u;
    }
    uint block = 0u;
    do {
        load_offsets(block);
        uint left = LOCATIONS ? cells : cells & pixels_touched(s, block_middle, block_reach), busy = team_ballot(left != 0u);
        do {
            uint of = busy != 0u ? uint(findLSB(busy)) : 0u;
            show_to_tile(shuffle_candidate(held, of), of_member(tile, of), of_member(left, of), from, block);
            busy &= busy - 1u;
        } while (busy != 0u);
        block++;
    } while (block * BLOCK < frame.sample_count);
}

uint cells_of_tile(uint tile) { return LOCATIONS ? tile_loads[tile].x : uint(bitCount(masks[tile])); }

// Makes room for the layers of owner `i`, and stores where they begin.
void place(uint i) {
    uint count = candidates_out[i].w;
    if (count == 0u) return;
    bool few = count <= MOST_TRIPS, fits = few && counters[COUNTER_LAYERS] < owners_room();
    uint first = fits ? atomicAdd(counters[COUNTER_LAYERS], count) : 0u;
    fits = fits && first + count <= owners_room();
    candidates_out[i].z = first;
    if (fits) return;
    candidates_out[i].w = NO_ROOM_FOR_LAYERS;
    atomicAdd(counters[few ? COUNTER_UNFINISHED : COUNTER_STALLED], 1u);
}

// Stores the ID of layer `i` at its place in the order of its owner's layers: the farthest first. If depths are equal, the
// greater ID comes first.
void order(uint i) {
    uvec4 own = candidates_out[i], owner = candidates_out[min(own.z, owners_room() - 1u)];
    uint count = owner.w, first = owner.z - count, before = 0u, j = 0u;
    // If there was no room for the owner's layers, this vector is a remnant of another round: then no `i` is in the range.
    if (own.z >= counters[COUNTER_OWNERS] || i < first || i >= owner.z) return;
    while (j < count) {
        uvec2 other = candidates_out[first + j].xy;
        before += other.x < own.x || (other.x == own.x && other.y > own.y) ? 1u : 0u;
        j++;
    }
    candidates_out[first + before].w = own.y;
}

void main() {
    uint i = invocation_number(), owners = min(counters[COUNTER_OWNERS], owners_room());
    if (push.step_ == SCATTER_CLEAR) {
        if (i < owners) candidates_out[i] = uvec4(0u);
        return;
    }
    if (push.step_ == SCATTER_PLACE) {
        if (i < owners) place(i);
        return;
    }
    if (push.step_ == SCATTER_ORDER) {
        i += owners;
        if (i < min(counters[COUNTER_LAYERS], owners_room())) order(i);
        return;
    }
    uint some_cells = cells_of_scatter(), from = gl_WorkGroupID.z * some_cells;
    uint number = workgroup_number(), tile = 0u, to = 0u;
    bool every = push.every != 0u;
    if (every) {
        uvec2 work = split(number, scatter_groups_of(frame.triangle_count));
        if (work.y >= counters[COUNTER_UNLISTED_TILES]) return;
        number = work.x;
        uint entry = tile_lists[first_entry(TILE_LIST_UNLISTED) + work.y], item = entry_item(entry);
        uvec4 group = LOCATIONS ? texelFetch(location_groups, int(item)) : uvec4(item, 0u, CELLS_OF_ENTRY, entry_part(entry) * CELLS_OF_ENTRY);
        tile = group.x;
        if ((tiles[tile].w & TILE_OVERFLOW) == 0u) return;
        to = min(min(from + some_cells, group.z) + group.w, cells_of_tile(tile));
        from += group.w;
    }
    uint count = every ? frame.triangle_count : min(counters[COUNTER_PAIRS], frame.pair_capacity);
    uint first = number * 64u * pairs_of_scatter() + gl_LocalInvocationID.x, wanted = 0u, k = 0u;
    do {
        uint at = min(first + k * 64u, max(count, 1u) - 1u);
        uint its = every ? tile : pair_tile(texelFetch(pairs, int(at)).xy);
        bool unlisted = in_round(its) && (tiles[its].w & (TILE_LISTED | (every ? 0u : TILE_OVERFLOW))) == 0u;
        wanted |= first + k * 64u < count && unlisted ? 1u << k : 0u;
    } while (++k < pairs_of_scatter());
    do {
        bool some = wanted != 0u;
        uint t = min(first + (some ? uint(findLSB(wanted)) : 0u) * 64u, max(count, 1u) - 1u);
        wanted &= wanted - 1u;
        if (!every) {
            uvec2 pair = texelFetch(pairs, int(t)).xy;
            t = pair.x;
            tile = pair_tile(pair);
            to = min(from + some_cells, cells_of_tile(tile));
        }
        show(t, tile, from, some ? to : from);
    } while (team_any(wanted != 0u));
}
