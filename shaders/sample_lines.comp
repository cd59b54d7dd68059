// sample_lines: finds the same as sample.comp, for cells with opaque or alpha-tested triangles whose samples lie on straight
// lines (include/lines.glsl). A team takes the cells of an entry of a work list one after the other, or one of them (APART); a
// member holds some words of 32 samples. A cell is a pixel, or a parallelogram around a location, whose sides are the columns of
// the location's Jacobian. Lines run along these sides.
// Reads: tiles, masks, tile_lists, candidates. Writes: fragments, headers. Some cells are marked and listed for sample.comp: those that
// a BLEND candidate or more than MOST_TOUCHING candidates touch, that see more than SLOTS triangles or one that crosses the near
// plane, or that take too many trips of loops. Other cells of the tile have no part in this, since a picture must not depend on how
// cells are grouped.
//
// On a line, a triangle covers a run of samples between the crossings of its edges. Candidates are taken in the order of their
// nearest depth in the cell, the nearest first. Each sample has at most one owner: the slot of the triangle that it sees, whose
// number is stored in bit planes. A candidate takes the samples that it covers and that have no owner. Samples with an owner are
// compared, one owner at a time: the line in which the depth planes of the two triangles intersect is treated like an edge. If
// an owner is nearer than all remaining candidates, its samples are settled: candidates lose them without a comparison. A cell
// is done when all samples have owners and all remaining candidates lie behind these.
//
// For a common edge, two triangles compute the same crossings to the bit, so that each sample is on one side of it.
//
// Members of a team differ only in their own samples. Loops end for all of them at once, and have one body for all kinds
// of trips, since lavapipe executes both sides of a branch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/work.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = SAMPLE_CONSTANT_HAS_MASK) const bool HAS_MASK = false;    // this and the following three: as in sample.comp
layout(constant_id = SAMPLE_CONSTANT_LIST) const uint LIST = 0u;
layout(constant_id = SAMPLE_CONSTANT_BY_PART) const bool BY_PART = false;
layout(constant_id = SAMPLE_CONSTANT_PART) const uint PART = 4u;
layout(constant_id = SAMPLE_CONSTANT_APART) const bool APART = false;       // a team takes one cell, not those of an entry
layout(constant_id = SAMPLE_LINES_CONSTANT_HEADER) const uint HEADER = 64u;       // samples of a block of sample.comp

const bool LEFT_CELLS = false, HAS_BLEND = LIST == TILE_LIST_BLENDED;
const uint SLOT_BITS = 5u, SLOTS = (1u << SLOT_BITS) - 1u;  // slots are numbered from 1 on; 0 is no owner
const uint CELLS_AT_ONCE = APART ? 1u : TEAM;           // cells that a team takes
const uint HELD = (SLOTS + TEAM - 1u) / TEAM;           // slots whose data a member holds
const uint MOST_TOUCHING = 64u;             // candidates that touch a cell; with more, it mostly sees more than SLOTS triangles

#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/taken.glsl"
#include "include/place.glsl"
#include "include/fragments.glsl"
#include "include/variation.glsl"
#include "include/lines.glsl"
#include "include/order.glsl"
#include "include/fragment_spread.glsl"
#include "include/line_spread.glsl"

// The candidates that touch each cell: words with a bit for each of 32 candidates of the tile's list, without words that are 0, and the
// number of the first of these candidates.
shared uint touched[MOST_TOUCHING * CELLS_AT_ONCE * TEAMS], touched_from[MOST_TOUCHING * CELLS_AT_ONCE * TEAMS];

uint trips = 0u;                    // trips of this team's loops so far: MOST_TRIPS of workarounds.glsl
uint my_words = 0u;                 // words of the cell that this member holds
float lines[OWN_LINES], phases[OWN_LINES];      // positions of this member's lines across them, and of their first samples

// Sets of this member's samples in the current cell. The owners have WORDS words for each bit of a slot's number.
uint owner[SLOT_BITS * WORDS];
uint settled[WORDS];                // samples whose owner is nearer than all remaining candidates
uint shown[WORDS];                  // samples of the current candidate
uint open_[WORDS];                  // those of it that are still to be compared

// The samples in a word of this member that a slot owns.
uint owned_by(uint slot, uint own) {
    uint bits = ~0u;
    [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) bits &= (slot >> b & 1u) != 0u ? owner[b * WORDS + own] : ~owner[b * WORDS + own];
    return bits;
}

uint owned(uint own) {
    uint bits = 0u;
    [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) bits |= owner[b * WORDS + own];
    return bits;
}

// The data of a slot. Member (s - 1) % TEAM holds that of slot s, in place (s - 1) / TEAM of `slots`.
struct Slot {
    vec4 plane;             // slope of its depth along and across lines, depth in the cell's middle, farthest depth in the cell
    uint id;
    uint parts;             // parts in which it is shaded, see variation.glsl
    uint fragments;           // number of fragments that it makes
    uint count;             // number of its samples
    uint place;             // place in the middle of its samples
};

Slot slots[HELD];
uint used;                          // slots in use

// The cell that the team works on.
struct Cell {
    uint holder;            // member that holds it
    uint words;             // words of candidates that touch it
    uint first, last;       // candidates of its tile: place of the first one, number of the last one
    vec2 center;            // centre of its tile
    vec2 at;                // its middle relative to this centre
    mat2 axes;
    uint id;                // what its fragments name it by: the pixel (x | y << 16), or the location
    bool columns;           // whether lines are columns
};

vec2 slope_in(Cell cell, vec2 slope) { return LOCATIONS ? slope * cell.axes : slope; }

// Converts a depth plane (slopes, depth) to a cell's coordinates, in which the cell is the square of side 1 around (0, 0).
vec3 plane_in(Cell cell, vec3 plane) { return vec3(slope_in(cell, plane.xy), dot(plane.xy, cell.at) + plane.z); }

Candidate candidate_in(Cell cell, Candidate k) {
    precise vec3 c = k.a * cell.at.x + k.b * cell.at.y + k.c;
    k.c = c;
    if (LOCATIONS) {
        precise vec3 a = k.a * cell.axes[0].x + k.b * cell.axes[0].y, b = k.a * cell.axes[1].x + k.b * cell.axes[1].y;
        k.a = a;
        k.b = b;
    }
    k.depth = plane_in(cell, k.depth);
    return k;
}

// The range of a candidate's depths in the cell. The candidate is in the cell's coordinates.
vec2 depth_range(Candidate k) {
    float slope = (0.5 + ROUNDING) * (abs(k.depth.x) + abs(k.depth.y)) + abs(k.depth.z) * 1e-6;
    return vec2(max(k.depth.z - slope, k.far), min(k.depth.z + slope, k.near));
}

// The extents of a candidate's edges within the cell, along x and along y, summed over the edges. The candidate is in the cell's
// coordinates.
vec2 reach_of_edges(Candidate k) {
    vec2 sum = vec2(0.0);
    [[unroll]] for (int i = 0; i < 3; i++) {
        vec2 n = vec2(k.a[i], k.b[i]);
        float inverse = inversesqrt(max(dot(n, n), 1e-37));
        n *= inverse;
        vec2 p = -k.c[i] * inverse * n, d = vec2(-n.y, n.x);
        vec2 per = 1.0 / max(abs(d), vec2(1e-15)), middle = p * per * sign(d);
        float from = max(-0.5 * per.x - middle.x, -0.5 * per.y - middle.y), to = min(0.5 * per.x - middle.x, 0.5 * per.y - middle.y);
        [[unroll]] for (int o = 1; o < 3; o++) {
            int j = (i + o) % 3;
            float slope = k.a[j] * d.x + k.b[j] * d.y, value = k.a[j] * p.x + k.b[j] * p.y + k.c[j];
            float root = -value / (abs(slope) < 1e-30 ? 1e-30 : slope);
            from = slope > 0.0 ? max(from, root) : from;
            to = slope > 0.0 ? to : min(to, root);
        }
        sum += max(to - from, 0.0) * abs(d);
    }
    return sum;
}

// The crossings of a triangle's edges with the lines of a cell: an edge at which runs of samples begin, one at which they end,
// and the third one, of either kind.
struct Crossings {
    vec2 begin, end, third;
    bool third_begins;
    bool usable;
};

vec2 choose(uint i, vec2 a, vec2 b, vec2 c) { return i == 0u ? a : i == 1u ? b : c; }

Crossings crossings_of(Candidate k, bool columns) {
    vec2 at[3];
    bvec3 rises;
    [[unroll]] for (int i = 0; i < 3; i++) {
        vec2 along = columns ? vec2(k.b[i], k.a[i]) : vec2(k.a[i], k.b[i]);
        at[i] = crossing(along, k.c[i]);
        rises[i] = rises_along(along);
    }
    uint begin = rises.x ? 0u : rises.y ? 1u : 2u, end = !rises.x ? 0u : !rises.y ? 1u : 2u, third = 3u - begin - end;
    Crossings r;
    r.begin = choose(begin, at[0], at[1], at[2]);
    r.end = choose(end, at[0], at[1], at[2]);
    r.third = choose(third, at[0], at[1], at[2]);
    r.third_begins = third == 0u ? rises.x : third == 1u ? rises.y : rises.z;
    r.usable = any(rises) && !all(rises);
    return r;
}

AlphaTest of_member(AlphaTest t, uint lane) {
    AlphaTest r;
    r.weight = of_member(t.weight, lane);
    r.u = of_member(t.u, lane);
    r.v = of_member(t.v, lane);
    r.opacity = of_member(t.opacity, lane);
    r.first = of_member(t.first, lane);
    r.size_low = of_member(t.size_low, lane);
    r.size_high = of_member(t.size_high, lane);
    r.level_blend = of_member(t.level_blend, lane);
    uint flags = of_member(t.flags | (t.nearest ? 1u << 31 : 0u), lane);
    r.nearest = flags >> 31 != 0u;
    r.flags = flags & 0x7fffffffu;
    r.cutoff = of_member(t.cutoff, lane);
    return r;
}

// Removes from `bits` the samples of a cell at which a triangle fails its alpha test. Words have more bits than the cell has
// samples by `frame.sample_count`, so alpha is read once for a run of several bits.
void test_alpha(AlphaTest test, Cell cell, inout uint bits[WORDS]) {
    uint run = ALL_BITS / min(uint(1u << findMSB(frame.sample_count)), ALL_BITS);
    run = min(run, 32u);
    uint window = run == 32u ? ~0u : (1u << run) - 1u, pending[WORDS];
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        pending[r] = bits[r];
        bits[r] = 0u;
    }
    uint left;
    do {
        uint own = 0u, word = pending[0];
        [[unroll]] for (uint r = 1u; r < WORDS; r++) {
            own = word == 0u ? r : own;
            word = word == 0u ? pending[r] : word;
        }
        uint first = word == 0u ? 0u : uint(findLSB(word)) & ~(run - 1u), tested = word & window << first, line = line_of(own);
        // Alpha is read at a bit of the run that differs from line to line or, if the triangle does not cover that one, at the
        // first bit that it covers.
        uint wanted = first + (line * 5u + run / 2u & run - 1u);
        uint read = (tested >> wanted & 1u) != 0u || tested == 0u ? wanted : uint(findLSB(tested));
        float u = (float(half_of(own) * 32u + read) + line_phase(line)) * (1.0 / float(BITS)) - 0.5, v = line_at(line);
        vec2 offset = cell.columns ? vec2(v, u) : vec2(u, v);
        uint passed = alpha_passes(test, cell.at + (LOCATIONS ? cell.axes * offset : offset)) ? tested : 0u;
        left = 0u;
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bits[r] |= own == r ? passed : 0u;
            pending[r] &= own == r ? ~tested : ~0u;
            left |= pending[r];
        }
        trips++;
    } while (team_or(left) != 0u);
}

// Finds the candidates that touch the cell of each member: of LOCATIONS here, of pixels in `setup`. Returns a bit for each member whose
// cell is left to sample.comp.
uint find_touching(Taken taken, uint count) {
    uint first = MOST_TOUCHING * CELLS_AT_ONCE * team_in_workgroup() + member(), from = 0u, found = 0u;
    bool blended = false;
    do {
        uint touching = 0u, blend = 0u;
        [[unroll]] for (uint part = 0u; part < 32u; part += TEAM) {
            uint candidate = from + part + member();
            bool exists = candidate < count;
            if (LOCATIONS) {
                Candidate k = load_candidate(taken.tile.y, min(candidate, max(count, 1u) - 1u), taken.center);
                uint j = 0u;
                do {
                    bool touches = exists && test_rectangle(k, of_member(my_at, j), of_member(my_half, j), HAS_MASK).touches;
                    uint together = team_ballot(touches);
                    touching |= member() == j ? together << part : 0u;
                } while (++j < taken.cells);
                if (HAS_BLEND) blend |= team_ballot(exists && k.id > frame.first_blend) << part;
                trips += taken.cells;
            } else {
                uvec2 last = exists ? texelFetch(candidates, last_of_candidate(taken.tile.y, candidate, false)).zw : uvec2(0u);
                if (APART) {
                    touching |= (last.y >> my_bit & 1u) << (part + member());
                } else {
                    [[unroll]] for (uint j = 0u; j < TEAM; j++) touching |= (of_member(last.y, j) >> my_bit & 1u) << (part + j);
                }
                if (HAS_BLEND) blend |= team_ballot(last.x > frame.first_blend) << part;
            }
        }
        if (APART && !LOCATIONS) touching = team_or(touching);
        uint at = first + min(my_words, MOST_TOUCHING - 1u) * CELLS_AT_ONCE;
        if (member() < CELLS_AT_ONCE && touching != 0u) {
            touched[at] = touching;
            touched_from[at] = from;
        }
        my_words += touching != 0u ? 1u : 0u;
        found += uint(bitCount(touching));
        blended = blended || (touching & blend) != 0u;
        trips++;
        from += 32u;
    } while (from < count);
    team_barrier();
    bool listable = count < 1u << KEY_NUMBER_BITS && frame.triangle_count < 1u << KEY_ID_BITS;
    return team_ballot(member() < taken.cells && (!listable || blended || found > MOST_TOUCHING));
}

Cell cell_of(Taken taken, uint count, uint holder) {
    Cell cell;
    cell.holder = holder;
    cell.words = of_member(my_words, holder);
    cell.first = taken.tile.y;
    cell.last = max(count, 1u) - 1u;
    cell.center = taken.center;
    cell.at = of_member(my_at, holder);
    uvec2 pixel = pixel_of_cell(taken, of_member(my_bit, holder));
    cell.id = LOCATIONS ? of_member(my_locations.x, holder) : pixel.x | pixel.y << 16;
    cell.axes = LOCATIONS ? location_jacobian(cell.id) : mat2(1.0);
    cell.columns = false;
    return cell;
}

// Finds the 2 x TEAM candidates that come after `limit`: the first TEAM of them in `nearer`, one in each member, the others in
// `farther`.
void find_next(Cell cell, Key limit, out Key nearer, out Key farther) {
    uint first = MOST_TOUCHING * CELLS_AT_ONCE * team_in_workgroup() + cell.holder, word = 0u;
    nearer = Key(0u, ~0u);
    farther = Key(0u, ~0u);
    do {
        uint at = first + min(word + member(), MOST_TOUCHING - 1u) * CELLS_AT_ONCE;
        uint mine = word + member() < cell.words ? touched[at] : 0u, from = touched_from[at];
        uint own = uint(bitCount(mine)), before = team_before(own), all = team_add(own), read = 0u;
        do {
            uint wanted = read + member(), of = 0u;
            [[unroll]] for (uint j = 1u; j < TEAM; j++) of += of_member(before, j) <= wanted ? 1u : 0u;
            uint candidate = min(of_member(from, of) + bit_of_cell(of_member(mine, of), wanted - of_member(before, of)), cell.last);
            int o = int(cell.first + candidate) * 4;
            uvec4 last = texelFetch(candidates, o + 3);
            vec3 plane = plane_in(cell, uintBitsToFloat(texelFetch(candidates, o + 2)).yzw);
            float depth = plane.z + (0.5 + ROUNDING) * (abs(plane.x) + abs(plane.y));
            depth = min(max(depth, 1e-30), max(uintBitsToFloat(last.x), 1e-30));
            Key key = make_key(depth, last.z, candidate);
            key.depth = wanted < all && comes_before(limit, key) ? key.depth : 0u;
            sort_keys(key, 2u, true);
            merge_keys(farther, key);
            farther = reversed_keys(farther);
            merge_keys(nearer, farther);
            trips++;
            read += TEAM;
        } while (read < all);
        word += TEAM;
    } while (word < cell.words);
}

// Whether lines are columns or rows: whichever the edges of the first eight candidates cross more often. `k` is this member's
// candidate, and `later` that of the next TEAM.
bool crosses_columns(Cell cell, Candidate k, bool exists, Key later) {
    vec2 reach = exists && member() < 8u ? reach_of_edges(k) : vec2(0.0);
    reach = vec2(team_add(reach.x), team_add(reach.y));
    if (TEAM < 8u) {
        Candidate other = candidate_in(cell, load_candidate(cell.first, min(number_in(later), cell.last), cell.center));
        vec2 more_reach = later.depth != 0u ? reach_of_edges(other) : vec2(0.0);
        reach += vec2(team_add(more_reach.x), team_add(more_reach.y));
    }
    return reach.x > reach.y;
}

// Kinds of candidates.
const uint THIRD_BEGINS = 1u, UNUSABLE = 2u, TESTED = 4u;   // runs of samples begin at the third edge; it crosses the near plane; its alpha is tested

// A batch of TEAM candidates in order, of which this member holds one.
struct Batch {
    uint entries;           // number of candidates
    float nearest, after;   // nearest depth of this member's candidate and of the batch after this
    uint id, kind;
    vec4 plane;             // as that of a slot
    Crossings crossings;
    AlphaTest alpha;
};

Batch batch_of(Cell cell, Key key, Candidate k, float after) {
    Batch b;
    bool exists = key.depth != 0u, tested = HAS_MASK && exists && k.id > frame.first_mask;
    vec2 range = depth_range(k);
    b.entries = team_add(exists ? 1u : 0u);
    b.nearest = nearest_from(key);
    b.after = after;
    b.id = k.id;
    b.crossings = crossings_of(k, cell.columns);
    bool usable = b.crossings.usable && range.y <= 1.0 && range.x > 0.0;
    b.kind = (b.crossings.third_begins ? THIRD_BEGINS : 0u) | (usable ? 0u : UNUSABLE) | (tested ? TESTED : 0u);
    b.plane = vec4(cell.columns ? k.depth.yx : k.depth.xy, k.depth.z, range.x);
    if (HAS_MASK) b.alpha = alpha_test(tested ? k.id - 1u : 0u, cell.center, cell.at, frame.sample_footprint * cell.axes);
    return b;
}

// What is known of the cell's samples together, and the current candidate.
struct State {
    uint settling;          // slots that are settled, the first ones
    float deepest;          // the farthest depth of all slots in the cell
    bool full;              // all samples have owners
    bool failed;            // the cell is left to sample.comp
    bool done;
    bool comparing;         // samples of the current candidate are still to be compared
    uint id;
    vec4 plane;
    float near, next;       // nearest depths of the current candidate and of the next one
};

// The slot to compare the current candidate with: the least one that owns an open sample. With a new candidate, instead the next slot
// that may be settled.
uint rival_of(State s) {
    uint rival = ~0u;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        uint lowest = open_[r] & (0u - open_[r]), slot = 0u;
        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) slot |= (owner[b * WORDS + r] & lowest) != 0u ? 1u << b : 0u;
        rival = lowest != 0u ? min(rival, slot) : rival;
    }
    return min(s.comparing ? team_min(rival) : s.settling + 1u, SLOTS);
}

// The plane and the ID of a slot.
vec4 plane_of_slot(uint slot, out uint id) {
    uint keeper = (slot - 1u) % TEAM, level = (slot - 1u) / TEAM;
    vec4 plane = slots[0].plane;
    id = slots[0].id;
    [[unroll]] for (uint h = 1u; h < HELD; h++) {
        plane = level == h ? slots[h].plane : plane;
        id = level == h ? slots[h].id : id;
    }
    id = of_member(id, keeper);
    return of_member(plane, keeper);
}

// Compares the current candidate with a slot that is not `behind`: sets where on each line the candidate wins, from `low` to `high`.
// The line where both planes intersect is treated like an edge. If depths are equal, or planes differ only by rounding, the smaller
// ID wins.
void compare(State s, vec4 other, uint other_id, bool behind, out vec2 low, out vec2 high) {
    bool smaller = s.id < other_id;
    vec3 difference = smaller ? s.plane.xyz - other.xyz : other.xyz - s.plane.xyz;
    bool alike = 0.5 * (abs(difference.x) + abs(difference.y)) + abs(difference.z) <= 4e-7 * abs(s.plane.z);
    vec2 where = crossing(difference.xy, difference.z);
    bool wins_beyond = rises_along(difference.xy) == smaller;
    bool loses_all = behind || (alike && !smaller), wins_all = alike && smaller;
    low = loses_all ? BEYOND_ALL : wins_all ? BEFORE_ALL : wins_beyond ? where : BEFORE_ALL;
    high = loses_all || wins_all || wins_beyond ? BEYOND_ALL : where;
}

// Removes the samples of the current candidate at which it fails its alpha test.
void test_shown(Cell cell, AlphaTest alpha, bool tests) {
    uint passing[WORDS];
    [[unroll]] for (uint r = 0u; r < WORDS; r++) passing[r] = tests ? shown[r] : 0u;
    test_alpha(alpha, cell, passing);
    [[unroll]] for (uint r = 0u; r < WORDS; r++) shown[r] = tests ? passing[r] : shown[r];
}

// Makes the current candidate the owner of the samples that it shows, in the next slot, if `shows`.
void own_shown(State s, bool shows) {
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        uint taken = shows ? shown[r] : 0u;
        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
            owner[b * WORDS + r] = (used + 1u >> b & 1u) != 0u ? owner[b * WORDS + r] | taken : owner[b * WORDS + r] & ~taken;
    }
    [[unroll]] for (uint h = 0u; h < HELD; h++) {
        bool here = shows && used == h * TEAM + member();
        slots[h].plane = here ? s.plane : slots[h].plane;
        slots[h].id = here ? s.id : slots[h].id;
    }
    used += shows ? 1u : 0u;
}

// A trip: takes candidate `j` of a batch and finds its samples or, if one is being compared, removes those that it loses to a slot.
// When no comparison is left, the candidate becomes the owner of its remaining samples.
void make_trip(Cell cell, Batch b, uint j, inout State s) {
    bool takes = !s.comparing;
    uint from = min(j, TEAM - 1u);
    vec4 its_plane = of_member(b.plane, from);
    uint its_kind = of_member(b.kind, from), its_id = of_member(b.id, from);
    // The first candidate of a batch may lie behind all owners, since what ended the last batch was only a bound.
    bool valid = takes && j < b.entries && !(s.full && s.next < s.deepest);
    s.id = takes ? its_id : s.id;
    s.plane = takes ? its_plane : s.plane;
    s.near = takes ? s.next : s.near;
    trips++;
    s.failed = s.failed || (valid && (its_kind & UNUSABLE) != 0u) || trips > MOST_TRIPS;

    uint rival = rival_of(s), other_id;
    vec4 other = plane_of_slot(rival, other_id);
    bool behind = s.near < other.w;         // the candidate and all later ones lie behind this slot
    vec2 low, high;
    compare(s, other, other_id, behind, low, high);
    low = takes ? of_member(b.crossings.begin, from) : low;
    high = takes ? of_member(b.crossings.end, from) : high;
    vec2 third = takes ? of_member(b.crossings.third, from) : BEFORE_ALL;
    bool third_begins = !takes || (its_kind & THIRD_BEGINS) != 0u, settles = behind && (!takes || s.settling < used);
    [[unroll]] for (uint l = 0u; l < OWN_LINES; l++) {
        float x0 = crossing_at(low, lines[l]), x1 = crossing_at(high, lines[l]), x2 = crossing_at(third, lines[l]);
        float begins = (third_begins ? max(x0, x2) : x0) - phases[l], ends = (third_begins ? x1 : min(x1, x2)) - phases[l];
        int first_bit = int(ceil(clamp(begins, 0.0, float(BITS)))), end_bit = int(ceil(clamp(ends, 0.0, float(BITS))));
        [[unroll]] for (uint h = 0u; h < LINE_WORDS; h++) {
            uint r = l * LINE_WORDS + h;
            int before = int(half_of(r)) * 32;
            uint holds = bits_from(first_bit - before) & ~bits_from(end_bit - before), of_rival = owned_by(rival, r);
            settled[r] |= settles ? of_rival : 0u;
            shown[r] = takes ? (valid ? holds & ~settled[r] : 0u) : shown[r] & ~(of_rival & ~holds);
            open_[r] &= ~of_rival;
        }
    }
    s.settling += takes && settles ? 1u : 0u;
    if (HAS_MASK) test_shown(cell, of_member(b.alpha, from), valid && (its_kind & TESTED) != 0u);

    uint some = 0u, some_open = 0u, some_free = 0u;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        uint by_some = owned(r);
        open_[r] = takes ? shown[r] & by_some : open_[r];
        some |= shown[r];
        some_open |= open_[r];
        some_free |= ~(by_some | shown[r]);
    }
    uint sets = team_or((some != 0u ? 1u : 0u) | (some_open != 0u ? 2u : 0u) | (some_free != 0u ? 4u : 0u));
    s.comparing = (sets & 2u) != 0u;
    s.full = (sets & 4u) == 0u;
    bool shows = !s.comparing && (sets & 1u) != 0u;
    s.failed = s.failed || (shows && used == SLOTS);
    own_shown(s, shows);
    s.deepest = shows ? min(s.deepest, s.plane.w) : s.deepest;
}

// Finds the owners of a cell's samples. Returns whether the cell is left to sample.comp.
bool find_owners(inout Cell cell) {
    used = 0u;
    [[unroll]] for (uint b = 0u; b < SLOT_BITS * WORDS; b++) owner[b] = 0u;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        settled[r] = 0u;
        shown[r] = 0u;
        open_[r] = 0u;
    }
    [[unroll]] for (uint h = 0u; h < HELD; h++) slots[h] = Slot(vec4(0.0), 0u, PARTS_ONE, 0u, 0u, 0u);
    State s = State(0u, 3.4e38, false, false, false, false, 0u, vec4(0.0), 0.0, 0.0);
    Key limit = Key(~0u, 0u);       // candidates up to this key are done
    bool directed = false;
    do {
        Key nearer, farther;
        find_next(cell, limit, nearer, farther);
        limit = key_of_member(farther, TEAM - 1u);
        uint batch = 0u;
        do {
            Key key = Key(batch == 0u ? nearer.depth : farther.depth, batch == 0u ? nearer.id : farther.id);
            float after = nearest_from(batch == 0u ? key_of_member(farther, 0u) : limit);
            Candidate k = candidate_in(cell, load_candidate(cell.first, min(number_in(key), cell.last), cell.center));
            if (!directed) {
                cell.columns = crosses_columns(cell, k, key.depth != 0u, farther);
                directed = true;
            }
            Batch b = batch_of(cell, key, k, after);
            uint j = 0u;
            s.comparing = false;
            s.next = of_member(b.nearest, 0u);
            do {
                make_trip(cell, b, j, s);
                j += s.comparing ? 0u : 1u;
                s.next = j < TEAM ? of_member(b.nearest, min(j, TEAM - 1u)) : b.after;
                s.done = s.done || s.failed || (!s.comparing && s.next < s.deepest && s.full);
            } while (!s.done && (s.comparing || j < b.entries));
            s.done = s.done || b.entries < TEAM;
            batch++;
        } while (!s.done && batch < 2u);
    } while (!s.done && limit.depth != 0u);
    return s.failed;
}

// Counts the fragments that each slot makes. Returns their number.
uint count_fragments(Cell cell) {
    if (BY_PART) {
        Variation around;
        if (!LOCATIONS) around = variation_of(cell.holder);
        [[unroll]] for (uint h = 0u; h < HELD; h++) {
            bool some = h * TEAM + member() < used && high_frequency_triangle(slots[h].id);
            slots[h].parts = !some ? PARTS_ONE : LOCATIONS ? PARTS_ALL : parts_around(around, slots[h].id);
        }
    }
    uint slot = 0u;
    do {
        uint parts = slots[0].parts, bits[WORDS];
        [[unroll]] for (uint h = 1u; h < HELD; h++) parts = slot / TEAM == h ? slots[h].parts : parts;
        parts = of_member(parts, slot % TEAM);
        uvec2 sums = uvec2(0u);
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bits[r] = owned_by(slot + 1u, r);
            sums += sums_of_word(r, bits[r]);
        }
        sums = team_add(sums);
        uint fragments_ = min(count_of(sums), 1u);
        if (BY_PART && parts != PARTS_ONE) {
            Grid grid = grid_of(parts, cell.columns);
            uint found[WORDS], rest[WORDS], own = 0u, some = 0u;
            find_parts(bits, grid, found);
            find_rest(bits, grid, found, rest);
            [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                own += uint(bitCount(found[r]));
                some |= rest[r];
            }
            own = team_add(((member() & sharing_lanes(grid)) == 0u ? own : 0u) | (some != 0u ? 0x10000u : 0u));
            fragments_ = (own & 0xffffu) + min(own >> 16, 1u);
        }
        uint place = place_of_bits(sums, cell.columns, false);
        [[unroll]] for (uint h = 0u; h < HELD; h++) {
            bool here = slot == h * TEAM + member() && slot < used;
            slots[h].count = here ? count_of(sums) : slots[h].count;
            slots[h].place = here ? place : slots[h].place;
            slots[h].fragments = here ? fragments_ : slots[h].fragments;
        }
    } while (++slot < used);
    uint all = 0u;
    [[unroll]] for (uint h = 0u; h < HELD; h++) all += slots[h].fragments;
    return team_add(all);
}

uint weight_of(uint samples) {
    float weight = float(frame.sample_count) * (1.0 / float(ALL_BITS));
    return floatBitsToUint(float(samples) * weight);
}

// Writes the fragments of the triangles that are shaded in one part: a bit each in `singles`, from fragment `base` on.
void write_singles(Cell cell, uint singles, uint base) {
    [[unroll]] for (uint h = 0u; h < HELD; h++) {
        uint bit = 1u << (h * TEAM + member()), before = uint(bitCount(singles & (bit - 1u)));
        if ((singles & bit) != 0u) {
            fragments_out[base + before] = uvec4(cell.id, slots[h].id, slots[h].place, weight_of(slots[h].count));
        }
    }
    if (SPREAD != SPREAD_NONE) {
        uint pending = singles, at = base;
        do {
            bool exists = pending != 0u;
            uint slot = exists ? uint(findLSB(pending)) : 0u, count = slots[0].count, bits[WORDS];
            [[unroll]] for (uint h = 1u; h < HELD; h++) count = slot / TEAM == h ? slots[h].count : count;
            [[unroll]] for (uint r = 0u; r < WORDS; r++) bits[r] = owned_by(slot + 1u, r);
            write_spread_of_bits(exists, at, bits, of_member(count, slot % TEAM), cell.columns);
            pending &= pending - 1u;
            at++;
        } while (pending != 0u);
    }
}

// Writes the fragments of a slot that is shaded in several parts: one for each part and one for the samples that are in no part, from
// fragment `base` on. Returns their number.
uint write_parts(Cell cell, bool exists, uint slot, uint base) {
    uint parts = slots[0].parts, id = slots[0].id;
    [[unroll]] for (uint h = 1u; h < HELD; h++) {
        parts = slot / TEAM == h ? slots[h].parts : parts;
        id = slot / TEAM == h ? slots[h].id : id;
    }
    parts = of_member(parts, slot % TEAM);
    parts = exists ? parts : PARTS_FOURS;
    id = of_member(id, slot % TEAM);
    Grid grid = grid_of(parts, cell.columns);
    bool wide = part_is_wide(max(frame.sample_count, 4u * part_length(parts)), parts);
    uint bits[WORDS], pending[WORDS], rest[WORDS], own = 0u;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) bits[r] = exists ? owned_by(slot + 1u, r) : 0u;
    find_parts(bits, grid, pending);
    find_rest(bits, grid, pending, rest);

    uvec2 sums = uvec2(0u);
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        sums += sums_of_word(r, rest[r]);
        own += uint(bitCount(pending[r]));
    }
    sums = team_add(sums);
    bool writes = (member() & sharing_lanes(grid)) == 0u;
    own = writes ? own : 0u;
    if (SPREAD != SPREAD_NONE) write_spread_of_bits(sums.x != 0u, base, rest, count_of(sums), cell.columns);
    if (member() == 0u && sums.x != 0u) {
        fragments_out[base] = uvec4(cell.id, id, place_of_bits(sums, cell.columns, wide), weight_of(count_of(sums)));
    }
    uint of_rest = sums.x != 0u ? 1u : 0u, at = base + of_rest + team_before(own), all = of_rest + team_add(own);
    uint steps = team_max(own), step = 0u;
    do {
        // The first part that has no fragment yet.
        uint r = WORDS - 1u, fields = pending[WORDS - 1u];
        [[unroll]] for (uint i = 1u; i < WORDS; i++) {
            uint q = WORDS - 1u - i;
            r = pending[q] != 0u ? q : r;
            fields = pending[q] != 0u ? pending[q] : fields;
        }
        uint at_bit = fields != 0u ? uint(findLSB(fields)) : 0u;
        [[unroll]] for (uint q = 0u; q < WORDS; q++) pending[q] = r == q ? pending[q] & (pending[q] - 1u) : pending[q];
        sums = uvec2(0u);
        [[unroll]] for (uint n = 0u; n < OWN_LINES; n++) {
            uint w = r + n * LINE_WORDS, of_word = 0u;
            [[unroll]] for (uint q = 0u; q < WORDS; q++) of_word = w == q ? bits[q] : of_word;
            sums += sums_of_word(w, n < grid.lines ? of_word & field_bits(grid) << at_bit : 0u);
        }
        [[unroll]] for (uint log = 0u; log < LOG_LINES; log++) {
            uint span = 1u << log, apart = span * HALVES / WORDS;
            if (span >= OWN_LINES && span < LINES) {
                uvec2 others = of_partner(sums, apart);
                sums += grid.lines > span ? others : uvec2(0u);
            }
        }
        if (writes && fields != 0u) {
            uint place = place_of_bits(sums, cell.columns, wide);
            fragments_out[at + step] = uvec4(cell.id, id, place, weight_of(count_of(sums)));
            if (SPREAD != SPREAD_NONE) write_spread(at + step, spread_of_place(place));
        }
    } while (++step < steps);
    return all;
}

// Makes the fragments of what a cell's samples see, unless it has `failed`. Returns the cell's header.
uvec2 record_cell(Cell cell, bool failed) {
    uint all = count_fragments(cell), singles = 0u, several = 0u;
    // If there is no room for the fragments of all parts, each triangle is shaded once.
    bool too_many = all > frame.sample_count + MORE_FRAGMENTS;
    [[unroll]] for (uint h = 0u; h < HELD; h++) {
        bool single = too_many || slots[h].parts == PARTS_ONE, some = slots[h].count != 0u;
        singles |= single && some ? 1u << (h * TEAM + member()) : 0u;
        several |= !single && some ? 1u << (h * TEAM + member()) : 0u;
    }
    singles = team_or(singles);
    uint single_fragments = uint(bitCount(singles));
    all = failed ? 0u : too_many ? single_fragments : all;
    bool fits;
    uint base = allocate_fragments(all, fits);
    fits = fits && !failed;
    write_singles(cell, fits ? singles : 0u, base);
    if (BY_PART) {
        several = fits ? team_or(several) : 0u;
        uint at = base + single_fragments;
        do {
            at += write_parts(cell, several != 0u, several != 0u ? uint(findLSB(several)) : 0u, at);
            several &= several - 1u;
        } while (several != 0u);
    }
    return uvec2(base, fits ? all : LEFT_BLOCK);
}

void main() {
    // Several teams share an entry of the work list. `work.y` is the entry, `work.x` is this team's share of it.
    uvec2 work = split(team_number(), CELLS_OF_ENTRY / CELLS_AT_ONCE);
    Taken taken = take_cells(work.y, work.x);
    if (TEAMS == 1u && !taken.exists) return;
    if (BY_PART && !LOCATIONS) my_variation = variation_around(pixel_of_cell(taken, my_bit));
    uint count = taken.exists ? taken.tile.w >> TILE_COUNT_SHIFT : 0u, left = find_touching(taken, count);
    if (!taken.exists) return;
    [[unroll]] for (uint l = 0u; l < OWN_LINES; l++) {
        lines[l] = line_at(line_of(l * LINE_WORDS));
        phases[l] = line_phase(line_of(l * LINE_WORDS));
    }
    uint headers_a_cell = (frame.sample_count + HEADER - 1u) / HEADER, pending = (1u << taken.cells) - 1u & ~left;
    do {
        bool exists = pending != 0u;
        Cell cell = cell_of(taken, count, exists ? uint(findLSB(pending)) : 0u);
        bool failed = find_owners(cell) || !exists;
        uvec2 header = record_cell(cell, failed);
        uint at = taken.tile.z + number_of_cell(taken, of_member(my_bit, cell.holder)) * headers_a_cell;
        if (!failed && member() == 0u) headers[min(at, frame.fragment_capacity - 1u)] = header;
        left |= failed ? 1u << cell.holder : 0u;
        pending &= pending - 1u;
    } while (pending != 0u);
    uint left_cells = team_or((left >> member() & 1u) != 0u ? 1u << my_bit : 0u);
    if (left_cells != 0u && member() == 0u) {
        atomicAdd(counters[COUNTER_RESAMPLED], uint(bitCount(left_cells)));
        leave_cells(LIST, taken.item, left_cells);
    }
}
