// A block: a run of ROWS x TEAM samples of a cell, which a team tests at once. A member holds ROWS of them, and
// what each one sees, in registers.
//
// Patterns order samples so that neighbours in the list are neighbours in the cell. The samples of a block thus lie close
// together, and a candidate is tested against the block's rectangle before its samples.
#ifndef BLOCK_GLSL
#define BLOCK_GLSL
#include "owners.glsl"
#include "place.glsl"
#include "fragments.glsl"

const uint BLOCK = ROWS * TEAM;                        // samples of a block

// The cell that the team works on.
struct Cell {
    uint first;             // first candidate of its tile
    vec2 center;            // centre of its tile
    uint member;            // member that holds the cell's short list
    bool complete;          // whether the short list has room for all candidates of the cell
    uint entries;           // number of candidates to try: of the short list if that is complete, or else of the tile
    float hidden;           // depth: a surface at this depth covers the whole cell, and hides what lies farther
    uint bit;               // the cell's bit in words of its tile
    vec2 at, half_side;     // its middle relative to the tile's centre, and half its sides
    mat2 pixel;             // its axes, which offsets of samples are multiplied by; unused with POINTS
    uint id;                // what its fragments name it by: the pixel (x | y << 16), or `location`
    uint location;          // index of its location; POINTS: place in the order where the block's locations begin
    uint samples;           // number of its samples in the block
};

vec2 offset[ROWS];          // offsets of the samples from a cell's middle, the same in every cell
vec2 place[ROWS];           // LOCATIONS: positions of the samples relative to the tile's centre
vec2 block_middle, block_reach;      // the rectangle around the offsets: middle, half of the sides
float depth[ROWS];          // depth of the nearest surface so far, larger is nearer; 0 for none
uint id[ROWS];

// For LAYERED samples: a bit for each batch of TEAM candidates, set if BLEND triangles of the batch may show. Batches from
// the 32nd on share a bit.
uint blend_batches;

uint trips;                 // trips of this invocation's loops so far: MOST_TRIPS of workarounds.glsl

uint sample_of(uint g) { return g * TEAM + member(); }

vec2 position_of(Cell cell, uint g) {
    return LOCATIONS ? place[g] : cell.at + offset[g];
}

uint location_of(Cell cell, uint g) {
    if (!POINTS) return cell.location;
    return location_at(cell.location + min(sample_of(g), max(cell.samples, 1u) - 1u));
}

// The Jacobian at a sample. POINTS: that of the sample's own location.
mat2 pixel_of(Cell cell, uint g) {
    return POINTS ? location_jacobian(location_of(cell, g)) : cell.pixel;
}

// Loads the pattern's offsets from number `first` on, up to `last` at most, and computes the rectangle around them.
void load_offsets(uint first, uint last) {
    [[unroll]] for (uint g = 0u; g < ROWS; g++)
        offset[g] = POINTS ? vec2(0.0) : texelFetch(pattern_offsets, int(min(first + sample_of(g), last))).xy;
    vec2 low = vec2(1.0), high = vec2(-1.0);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        low = min(low, offset[g]);
        high = max(high, offset[g]);
    }
    low = vec2(team_min(low.x), team_min(low.y));
    high = vec2(team_max(high.x), team_max(high.y));
    block_middle = 0.5 * (low + high);
    block_reach = 0.5 * (high - low) + ROUNDING;
}

// The rectangle around a cell's samples that are in the block.
void rectangle_of_block(Cell cell, out vec2 middle, out vec2 half_side) {
    middle = cell.at + cell.pixel * block_middle;
    half_side = abs(cell.pixel[0]) * block_reach.x + abs(cell.pixel[1]) * block_reach.y + (LOCATIONS ? ROUNDING * cell.half_side : vec2(0.0));
}

// Moves the samples to a cell, and resets what they have seen.
void begin_cell(Cell cell) {
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        depth[g] = 0.0;
        id[g] = 0u;
        if (LOCATIONS)
            place[g] = POINTS ? place_in_tile(texelFetch(locations, int(2u * location_of(cell, g)))) : cell.at + cell.pixel * offset[g];
    }
}

// Resets what rows beyond the cell's last sample have seen.
void end_cell(Cell cell) {
    [[unroll]] for (uint g = 0u; g < ROWS; g++) id[g] = sample_of(g) < cell.samples ? id[g] : 0u;
}

// Whether a candidate may touch the pixel with this bit of its tile. Locations have no such bits, and are tested later.
bool may_touch(Candidate k, uint bit) {
    return LOCATIONS || (k.pixels >> bit & 1u) != 0u;
}

// The tile's candidate that entry `i` of a cell's short list names.
uint kept_candidate(Cell cell, uint i) {
    uint first = ROOM * team_in_workgroup(), at = cell.member * KEPT + min(i, KEPT - 1u);
    return APART ? kept[first + at] : kept[first + at / 2u] >> 16u * (at & 1u) & 0xffffu;
}

// Candidate number `i` of a cell.
Candidate entry_of(Cell cell, uint i) {
    uint clamped = min(i, max(cell.entries, 1u) - 1u);
    uint index = cell.complete ? kept_candidate(cell, clamped) : clamped;
    return load_candidate(cell.first, index, cell.center);
}

// The place at which some samples of a cell are shaded together.
uint place_of_part(vec2 sum_of_offsets, float samples, bool wide) {
    return place_of_samples(sum_of_offsets, samples, float(frame.sample_count), wide);
}

uint place_of(vec2 sum_of_offsets, float samples) {
    return place_of_part(sum_of_offsets, samples, false);
}

uint layers[ROWS];          // UNLISTED: number of BLEND layers before what each sample sees, and the place where they begin
uint first_layer[ROWS];

// Loads what `scatter` has found that the samples see, from owner number `first` on.
void see_owners(Cell cell, uint first) {
    uint last = max(cell.samples, 1u) - 1u;
    bool fits = first + last < owners_room(), lacks = false;
    if (!fits) leave_block(COUNTER_UNFINISHED);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        bool exists = fits && sample_of(g) < cell.samples;
        uvec4 owner = texelFetch(candidates, int(exists ? first + sample_of(g) : 0u));
        lacks = lacks || exists && owner.w == NO_ROOM_FOR_LAYERS;
        exists = exists && owner.w != NO_ROOM_FOR_LAYERS;
        id[g] = exists && owner.y != 0u ? ~owner.y : 0u;
        layers[g] = exists ? owner.w : 0u;
        first_layer[g] = owner.z - owner.w;
    }
    left_over = left_over || team_any(lacks);
}

// Whether triangle `by` at depth `d` is seen in place of what row `g` has seen so far.
bool wins(float d, uint by, uint g) {
    return d > depth[g] || (d == depth[g] && by < id[g]);
}

void show_opaque(Cell cell, Candidate t, bool some) {
    vec3 least = some ? thresholds(t) : vec3(3.4e38);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        vec2 p = position_of(cell, g);
        float d = depth_at(t, p);
        bool there = inside(t, least, p);
        bool seen = there && d <= 1.0 && wins(d, t.id, g);
        depth[g] = seen ? d : depth[g];
        id[g] = seen ? t.id : id[g];
    }
}

// Shows an alpha-tested triangle to the samples. The alpha test is expensive: rows in which no sample may see the triangle are
// left out.
void show_masked(Cell cell, Candidate t, bool some) {
    vec3 least = some ? thresholds(t) : vec3(3.4e38);
    AlphaTest alpha = alpha_test(t.id - 1u, cell.center, cell.at, frame.sample_footprint * cell.pixel);
    uint rows = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        float d;
        bool seen = covers(t, least, position_of(cell, g), d) && wins(d, t.id, g);
        rows |= team_any(seen) ? 1u << g : 0u;
    }
    do {
        uint row = rows == 0u ? ROWS : uint(findLSB(rows));
        rows &= rows - 1u;
        vec2 p = vec2(0.0);
        float depth_there = 0.0;
        uint id_there = 0u;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) {
            p = row == g ? position_of(cell, g) : p;
            depth_there = row == g ? depth[g] : depth_there;
            id_there = row == g ? id[g] : id_there;
        }
        float d;
        bool there = covers(t, least, p, d) && row < ROWS;
        if (POINTS) alpha = alpha_test(t.id - 1u, cell.center, p, frame.sample_footprint * pixel_of(cell, row));
        bool seen = there && (d > depth_there || (d == depth_there && t.id < id_there)) && alpha_passes(alpha, p);
        [[unroll]] for (uint g = 0u; g < ROWS; g++) {
            depth[g] = seen && row == g ? d : depth[g];
            id[g] = seen && row == g ? t.id : id[g];
        }
    } while (rows != 0u);
}

// Shows the cell's opaque and alpha-tested candidates to the samples.
void show_candidates(Cell cell) {
    vec2 middle = cell.at, half_side = cell.half_side;
    if (!POINTS) rectangle_of_block(cell, middle, half_side);
    uint batches = max((cell.entries + TEAM - 1u) / TEAM, 1u), batch = 0u;
    float hidden = cell.hidden;
    blend_batches = 0u;
    do {
        uint entry = batch * TEAM + member();
        Candidate k = entry_of(cell, entry);
        RectangleTest test = test_rectangle(k, middle, half_side, HAS_MASK);
        bool exists = entry < cell.entries && may_touch(k, cell.bit);
        hidden = max(hidden, team_max(exists ? test.hides : 0.0));
        bool blend = k.id > frame.first_blend;
        bool masked = HAS_MASK && k.id > frame.first_mask && !blend;
        bool shows = exists && test.touches && test.near >= hidden, touches = shows && !blend;
        blend_batches |= team_any(shows && blend) ? 1u << min(batch, 31u) : 0u;
        trips += 3u + uint(bitCount(team_ballot(touches)));
        uint pending = team_ballot(touches && !masked);
        do {
            bool some = pending != 0u;
            show_opaque(cell, shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u), some);
            pending &= pending - 1u;
        } while (pending != 0u);
        if (HAS_MASK) {
            pending = team_ballot(touches && masked);
            trips += uint(bitCount(pending)) * ROWS;
            do {
                bool some = pending != 0u;
                // Loaded, not shuffled: this loop then keeps no second candidate in registers.
                show_masked(cell, entry_of(cell, batch * TEAM + (some ? uint(findLSB(pending)) : 0u)), some);
                pending &= pending - 1u;
            } while (pending != 0u);
        }
    } while (++batch < batches && trips <= MOST_TRIPS);
    if (batch < batches) leave_block(COUNTER_STALLED);
}

#endif
