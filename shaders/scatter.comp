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
// A triangle is tested against the rectangle around a run of samples before it is tested at each of them.
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
layout(push_constant) uniform Push {
    uint step_;             // one of SCATTER_
    uint every;             // 1: tries every triangle in the tiles that have lost pairs
} push;

const float ROUNDING = 1.0 / 64.0;                      // as in sample.comp
const uint RUNS = 32u;                                  // runs of neighbouring samples in a cell

shared vec4 rectangles[RUNS];                           // the rectangle around the offsets of a run: middle, half of the sides

struct Cell {
    uint first_owner;
    vec2 at, half_side;     // as in block.glsl
    mat2 pixel;
    uint location;
    uint samples;
};

uint run_length() { return (frame.sample_count + RUNS - 1u) / RUNS; }

void enclose_runs() {
    uint run = gl_LocalInvocationID.x, length_ = run_length();
    if (!POINTS && run < RUNS) {
        vec2 low = vec2(1.0), high = vec2(-1.0);
        uint i = 0u;
        do {
            vec2 offset = texelFetch(pattern_offsets, int(min(run * length_ + i, frame.sample_count - 1u))).xy;
            low = min(low, offset);
            high = max(high, offset);
        } while (++i < length_);
        rectangles[run] = vec4(0.5 * (low + high), 0.5 * (high - low) + ROUNDING);
    }
    barrier();
}

Cell pixel_cell(uint first, uint number, uint bit) {
    return Cell(owner_of(first, number, 0u), vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5), vec2(0.5 + ROUNDING), mat2(1.0), 0u, frame.sample_count);
}

Cell located_cell(uint first, uint number, uint first_cell) {
    int at = int(2u * (first_cell + number));
    vec4 square = uintBitsToFloat(texelFetch(location_cells, at));
    uvec2 held = texelFetch(location_cells, at + 1).xy;
    // The Jacobians of POINTS are those of their own locations, not of the cell.
    mat2 pixel = POINTS ? mat2(1.0) : location_jacobian(held.x);
    return Cell(owner_of(first, number, 0u), square.xy, square.zw, pixel, held.x, POINTS ? held.y : frame.sample_count);
}

// The runs of a cell's samples that a triangle may touch, a bit each.
uint runs_touched(Candidate t, Cell cell) {
    if (LOCATIONS && !test_rectangle(t, cell.at, cell.half_side, HAS_MASK).touches) return 0u;
    if (POINTS) return ~0u >> (32u - cell.samples);
    uint runs = 0u, run = 0u, length_ = run_length();
    do {
        vec4 r = rectangles[run];
        vec2 half_side = abs(cell.pixel[0]) * r.z + abs(cell.pixel[1]) * r.w + (LOCATIONS ? ROUNDING * cell.half_side : vec2(0.0));
        bool touches = run * length_ < cell.samples && test_rectangle(t, cell.at + cell.pixel * r.xy, half_side, HAS_MASK).touches;
        runs |= touches ? 1u << run : 0u;
    } while (++run < RUNS);
    return runs;
}

bool passes_alpha(Candidate t, vec2 center, Cell cell, vec2 p, mat2 pixel) {
    if (!HAS_MASK || t.id <= frame.first_mask) return true;
    return alpha_passes(alpha_test(t.id - 1u, center, POINTS ? p : cell.at, frame.sample_footprint * pixel), p);
}

// Shows a triangle to sample `s` of a cell.
void show_to(Candidate t, vec3 least, vec2 center, Cell cell, uint s) {
    uint location = POINTS ? location_at(cell.location + s) : cell.location;
    vec2 p = POINTS ? place_in_tile(texelFetch(locations, int(2u * location))) : cell.pixel * texelFetch(pattern_offsets, int(s)).xy + cell.at;
    if (!LOCATIONS) p = cell.at + texelFetch(pattern_offsets, int(s)).xy;
    mat2 pixel = POINTS ? location_jacobian(location) : cell.pixel;
    float d;
    bool there = covers(t, least, p, d) && d > 0.0;
    if (!there) return;
    uint o = cell.first_owner + s, depth = floatBitsToUint(d);
    uvec4 owner = candidates_out[o];
    if (push.step_ <= SCATTER_IDS) {
        bool of_depths = push.step_ == SCATTER_DEPTHS;
        bool wins = of_depths ? depth > owner.x : depth == owner.x && ~t.id > owner.y;
        if (!wins || !passes_alpha(t, center, cell, p, pixel)) return;
        if (of_depths) atomicMax(candidates_out[o].x, depth);
        else atomicMax(candidates_out[o].y, ~t.id);
    } else if (depth > owner.x) {
        if (push.step_ == SCATTER_COUNT) {
            atomicAdd(candidates_out[o].w, 1u);
        } else if (owner.w != 0u && owner.w != NO_ROOM_FOR_LAYERS) {
            uint slot = atomicAdd(candidates_out[o].z, 1u);
            candidates_out[slot] = uvec4(depth, t.id, o, 0u);
        }
    }
}

// Shows triangle `t` to cells `from` to before `to` of a tile.
void show(uint t, uint tile, uint from, uint to) {
    bool blend = t >= frame.first_blend, layers = push.step_ >= SCATTER_COUNT;
    if (blend != layers || from >= to) return;
    uint first = tiles[tile].y, word = LOCATIONS ? 0u : masks[tile], first_cell = LOCATIONS ? tile_loads[tile].z : 0u;
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    vec2 center = tile_center(tile_at);
    Triangle k = triangle_at(t);
    Setup s = setup_triangle(k.v0, k.v1, k.v2, center, single_sided(k.word));
    Footprint f = footprint_of(k.v0, k.v1, k.v2);
    if (!k.exists || !s.valid || f.outside) return;
    Candidate c = Candidate(s.a, s.b, s.c, s.depth, s.near, s.far, t + 1u, ~0u);
    vec3 least = thresholds(c);
    uint left = 0u;
    if (!LOCATIONS) {
        uint before = (1u << bit_of_cell(word, from)) - 1u, after = to < bitCount(word) ? ~((1u << bit_of_cell(word, to)) - 1u) : 0u;
        left = word & pixels_touched(s) & footprint_mask(f, tile_at) & ~before & ~after;
    }
    uint number = from;
    // Cells without room for their owners are skipped here, and counted by `sample`.
    while (LOCATIONS ? number < to : left != 0u) {
        uint bit = uint(findLSB(left));
        if (!LOCATIONS) number = uint(bitCount(word & ((1u << bit) - 1u)));
        Cell cell = LOCATIONS ? located_cell(first, number, first_cell) : pixel_cell(first, number, bit);
        left &= left - 1u;
        number++;
        uint runs = cell.first_owner + frame.sample_count <= owners_room() ? runs_touched(c, cell) : 0u;
        uint length_ = POINTS ? 1u : run_length();
        while (runs != 0u) {
            uint begin = uint(findLSB(runs)) * length_, i = begin;
            runs &= runs - 1u;
            do {
                show_to(c, least, center, cell, i);
            } while (++i < min(begin + length_, cell.samples));
        }
    }
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
    enclose_runs();
    uint some = cells_of_scatter(), from = gl_WorkGroupID.z * some;
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
        to = min(min(from + some, group.z) + group.w, cells_of_tile(tile));
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
    while (wanted != 0u) {
        uint t = first + uint(findLSB(wanted)) * 64u;
        wanted &= wanted - 1u;
        if (!every) {
            uvec2 pair = texelFetch(pairs, int(t)).xy;
            t = pair.x;
            tile = pair_tile(pair);
            to = min(from + some, cells_of_tile(tile));
        }
        show(t, tile, from, to);
    }
}
