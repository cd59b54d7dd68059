// sample_lines: finds the same as sample.comp, for cells with opaque or alpha-tested triangles whose samples lie on straight
// lines (include/lines.glsl). A team takes the cells of an entry of a work list one after the other, or one of them (APART);
// a member holds some words of 32 samples. A cell is a pixel, or a parallelogram around a location, whose sides are the columns of the
// location's Jacobian. Lines run along these sides.
// Reads: tiles, masks, tile_lists, candidates. Writes: records, headers. Cells that more than MOST_TOUCHING candidates touch,
// that see more than SLOTS triangles or one that crosses the near plane, or that take too many trips of loops, are marked and listed for
// sample.comp. No cell is so because of other
// cells of its tile, since a picture must not depend on how cells are grouped.
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

const float ROUNDING = 1.0 / 64.0;                      // as in sample.comp
const uint SLOT_BITS = 5u, SLOTS = (1u << SLOT_BITS) - 1u;  // slots are numbered from 1 on; 0 is no owner
const uint CELLS_AT_ONCE = APART ? 1u : TEAM;           // cells that a team takes
const uint HELD = (SLOTS + TEAM - 1u) / TEAM;           // slots whose data a member holds

#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/place.glsl"
#include "include/records.glsl"
#include "include/variation.glsl"
#include "include/lines.glsl"
#include "include/order.glsl"

const uint MOST_TOUCHING = 64u;             // candidates that touch a cell; with more, it mostly sees more than SLOTS triangles

// The candidates that touch each cell: words with a bit for each of 32 candidates of the tile's list, without words that are 0, and the
// number of the first of these candidates.
shared uint touched[MOST_TOUCHING * CELLS_AT_ONCE * TEAMS], touched_from[MOST_TOUCHING * CELLS_AT_ONCE * TEAMS];

uint trips;                         // trips of this team's loops so far: MOST_TRIPS of workarounds.glsl
uint owner[SLOT_BITS * WORDS];      // owners of this member's samples: WORDS words for each bit of a slot's number

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

// The data of a slot. Member (s - 1) % TEAM holds that of slot s.
struct Slot {
    vec4 plane;             // slope of its depth along and across lines, depth in the cell's middle, farthest depth in the cell
    uint id;
    uint parts;             // parts in which it is shaded, see variation.glsl
    uint records;           // number of records that it makes
    uint count;             // number of its samples
    uint place;             // place in the middle of its samples
};

// A cell: its middle relative to the tile's centre, and its axes.
struct Square {
    vec2 at;
    mat2 axes;
};

vec2 slope_in(Square cell, vec2 slope) { return LOCATIONS ? slope * cell.axes : slope; }

// Converts a depth plane (slopes, depth) to a cell's coordinates, in which the cell is the square of side 1 around (0, 0).
vec3 plane_in(Square cell, vec3 plane) { return vec3(slope_in(cell, plane.xy), dot(plane.xy, cell.at) + plane.z); }

Candidate candidate_in(Square cell, Candidate k) {
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
void test_alpha(AlphaTest test, Square cell, bool columns, inout uint bits[WORDS]) {
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
        vec2 offset = columns ? vec2(v, u) : vec2(u, v);
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

void main() {
    // Several teams share an entry of the work list. `work.y` is the entry, `work.x` is this team's share of it.
    uvec2 work = split(team_number(), CELLS_OF_ENTRY / CELLS_AT_ONCE);
    bool busy = work.y < counters[COUNTER_PLAIN_TILES + LIST];
    if (TEAMS == 1u && !busy) return;
    uint lane = member();
    uint entry = busy ? tile_lists[first_entry(LIST) + work.y] : 0u, item = entry_item(entry);
    uvec4 location_group = LOCATIONS ? texelFetch(location_groups, int(item)) : uvec4(0u);
    uint tile = LOCATIONS ? location_group.x : item;
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    vec2 center = tile_center(tile_at);
    uint first = header.y, count = header.w >> TILE_COUNT_SHIFT;
    uint word = LOCATIONS ? ~0u >> (32u - location_group.z) : masks[tile];
    uint first_cell = entry_part(entry) * CELLS_OF_ENTRY + work.x * CELLS_AT_ONCE;
    busy = busy && first_cell < uint(bitCount(word));
    if (TEAMS == 1u && !busy) return;
    uint cells = busy ? min(uint(bitCount(word)) - first_cell, CELLS_AT_ONCE) : 1u;
    uint my_bit = bit_of_cell(word, first_cell + min(lane, cells - 1u)), my_location = 0u;
    vec2 my_at = vec2(my_bit & 7u, my_bit >> 3) - vec2(3.5, 1.5), my_half = vec2(0.0);
    if (LOCATIONS) {
        int square = int(2u * (location_group.y + my_bit));
        vec4 sides = uintBitsToFloat(texelFetch(location_cells, square));
        my_at = sides.xy;
        my_half = sides.zw;
        my_location = texelFetch(location_cells, square + 1).x;
    }
    if (BY_PART && !LOCATIONS) my_variation = variation_around(uvec2(tile_at) * uvec2(8u, 4u) + uvec2(my_bit & 7u, my_bit >> 3));
    uint headers_a_cell = (frame.sample_count + HEADER - 1u) / HEADER;
    bool listable = count < 1u << KEY_NUMBER_BITS && frame.triangle_count < 1u << KEY_ID_BITS;
    count = listable && busy ? count : 0u;
    uint last_candidate = max(count, 1u) - 1u;

    // Finds the candidates that touch the cell of each member. For pixels, `setup` has stored them.
    uint first_touched = MOST_TOUCHING * CELLS_AT_ONCE * team_in_workgroup(), from = 0u, my_count = 0u, my_words = 0u;
    trips = 0u;
    do {
        uint touching = 0u;
        [[unroll]] for (uint part = 0u; part < 32u; part += TEAM) {
            uint candidate = from + part + lane;
            if (LOCATIONS) {
                Candidate k = load_candidate(first, min(candidate, last_candidate), center);
                uint j = 0u;
                do {
                    bool touches = candidate < count && test_rectangle(k, of_member(my_at, j), of_member(my_half, j), HAS_MASK).touches;
                    uint together = team_ballot(touches);
                    touching |= lane == j ? together << part : 0u;
                } while (++j < cells);
                trips += cells;
            } else {
                uint touches = candidate < count ? texelFetch(candidates, int(first + candidate) * 4 + 3).w : 0u;
                if (APART) {
                    touching |= (touches >> my_bit & 1u) << (part + lane);
                } else {
                    [[unroll]] for (uint j = 0u; j < TEAM; j++) touching |= (of_member(touches, j) >> my_bit & 1u) << (part + j);
                }
            }
        }
        if (APART && !LOCATIONS) touching = team_or(touching);
        uint at = first_touched + min(my_words, MOST_TOUCHING - 1u) * CELLS_AT_ONCE + lane;
        if (lane < CELLS_AT_ONCE) {
            touched[at] = touching;
            touched_from[at] = from;
        }
        my_words += touching != 0u ? 1u : 0u;
        my_count += uint(bitCount(touching));
        trips++;
        from += 32u;
    } while (from < count);
    team_barrier();
    if (!busy) return;

    float lines[OWN_LINES], phases[OWN_LINES];
    [[unroll]] for (uint l = 0u; l < OWN_LINES; l++) {
        lines[l] = line_at(line_of(l * LINE_WORDS));
        phases[l] = line_phase(line_of(l * LINE_WORDS));
    }

    uint left = 0u;                     // cells that are left to sample.comp
    uint cell = 0u;
    do {
        uint bit = of_member(my_bit, cell), location = of_member(my_location, cell);
        Square square = Square(of_member(my_at, cell), LOCATIONS ? location_jacobian(location) : mat2(1.0));
        uint words = of_member(my_words, cell);
        // Sets of samples: settled ones; those of the current candidate; those of it that are still to be compared.
        uint settled[WORDS], shown[WORDS], open_[WORDS];
        [[unroll]] for (uint b = 0u; b < SLOT_BITS * WORDS; b++) owner[b] = 0u;
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            settled[r] = 0u;
            shown[r] = 0u;
            open_[r] = 0u;
        }
        Slot slots[HELD];
        [[unroll]] for (uint h = 0u; h < HELD; h++) slots[h] = Slot(vec4(0.0), 0u, PARTS_ONE, 0u, 0u, 0u);
        uint used = 0u, settling = 0u;  // slots in use; slots that are settled, the first ones
        float deepest = 3.4e38;         // the farthest depth of all slots in the cell
        bool full = false;              // all samples have owners
        bool failed = !listable || of_member(my_count, cell) > MOST_TOUCHING, done = failed, directed = false, columns = false, more;
        Key limit = Key(~0u, 0u);       // candidates up to this key are done
        do {
            // Finds the next 2 x TEAM candidates in order: the first TEAM of them in `nearer`, one in each member, the others in
            // `farther`.
            Key nearer = Key(0u, ~0u), farther = Key(0u, ~0u);
            uint word_ = 0u;
            do {
                uint at = first_touched + min(word_ + lane, MOST_TOUCHING - 1u) * CELLS_AT_ONCE + cell;
                uint mine = word_ + lane < words ? touched[at] : 0u, mine_from = touched_from[at];
                uint own = uint(bitCount(mine)), before = team_before(own), all = team_add(own), read = 0u;
                do {
                    uint wanted = read + lane, of = 0u;
                    [[unroll]] for (uint j = 1u; j < TEAM; j++) of += of_member(before, j) <= wanted ? 1u : 0u;
                    uint candidate = min(of_member(mine_from, of) + bit_of_cell(of_member(mine, of), wanted - of_member(before, of)), last_candidate);
                    int o = int(first + candidate) * 4;
                    uvec4 last = texelFetch(candidates, o + 3);
                    vec3 plane = plane_in(square, uintBitsToFloat(texelFetch(candidates, o + 2)).yzw);
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
                word_ += TEAM;
            } while (word_ < words);
            limit = key_of_member(farther, TEAM - 1u);
            more = limit.depth != 0u;
            uint batch = 0u;
            do {
                Key key = Key(batch == 0u ? nearer.depth : farther.depth, batch == 0u ? nearer.id : farther.id);
                float nearest = nearest_from(key), after = nearest_from(batch == 0u ? key_of_member(farther, 0u) : limit);
                Candidate k = candidate_in(square, load_candidate(first, min(number_in(key), last_candidate), center));
                bool exists = key.depth != 0u;
                vec2 range = depth_range(k);
                if (!directed) {
                    // Lines are columns or rows: whichever the edges of the first eight candidates cross more often.
                    vec2 reach = exists && lane < 8u ? reach_of_edges(k) : vec2(0.0);
                    reach = vec2(team_add(reach.x), team_add(reach.y));
                    if (TEAM < 8u) {
                        Candidate later = candidate_in(square, load_candidate(first, min(number_in(farther), last_candidate), center));
                        vec2 more_reach = farther.depth != 0u ? reach_of_edges(later) : vec2(0.0);
                        reach += vec2(team_add(more_reach.x), team_add(more_reach.y));
                    }
                    columns = reach.x > reach.y;
                    directed = true;
                }
                Crossings c = crossings_of(k, columns);
                bool tested = HAS_MASK && exists && k.id > frame.first_mask;
                bool usable = c.usable && range.y <= 1.0 && range.x > 0.0;
                uint kind = (c.third_begins ? 1u : 0u) | (usable ? 0u : 2u) | (tested ? 4u : 0u);
                vec4 plane = vec4(columns ? k.depth.yx : k.depth.xy, k.depth.z, range.x);
                AlphaTest alpha;
                if (HAS_MASK) alpha = alpha_test(tested ? k.id - 1u : 0u, center, square.at, frame.sample_footprint * square.axes);

                uint j = 0u, entries = team_add(exists ? 1u : 0u), id = 0u;
                bool comparing = false;
                vec4 own = vec4(0.0);   // plane of the current candidate
                float near = 0.0, next = of_member(nearest, 0u);     // nearest depths of the current candidate, and of the next one
                do {
                    bool takes = !comparing;
                    uint from = min(j, TEAM - 1u);
                    vec4 its_plane = of_member(plane, from);
                    uint its_kind = of_member(kind, from), its_id = of_member(k.id, from);
                    // The first candidate of a batch may lie behind all owners, since what ended the last batch was only a bound.
                    bool valid = takes && j < entries && !(full && next < deepest);
                    id = takes ? its_id : id;
                    own = takes ? its_plane : own;
                    near = takes ? next : near;
                    trips++;
                    failed = failed || (valid && (its_kind & 2u) != 0u) || trips > MOST_TRIPS;

                    // The slot to compare with: the least one that owns an open sample. With a new candidate, instead the next
                    // slot that may be settled.
                    uint rival = ~0u;
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        uint lowest = open_[r] & (0u - open_[r]), slot = 0u;
                        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) slot |= (owner[b * WORDS + r] & lowest) != 0u ? 1u << b : 0u;
                        rival = lowest != 0u ? min(rival, slot) : rival;
                    }
                    rival = min(takes ? settling + 1u : team_min(rival), SLOTS);
                    uint keeper = (rival - 1u) % TEAM, level = (rival - 1u) / TEAM, other_id = 0u;
                    vec4 other = slots[0].plane;
                    other_id = slots[0].id;
                    [[unroll]] for (uint h = 1u; h < HELD; h++) {
                        other = level == h ? slots[h].plane : other;
                        other_id = level == h ? slots[h].id : other_id;
                    }
                    other = of_member(other, keeper);
                    other_id = of_member(other_id, keeper);
                    bool behind = near < other.w;       // the candidate and all later ones lie behind this slot

                    // The line where both planes intersect is treated like an edge. If depths are equal, or planes differ only by
                    // rounding, the smaller ID wins.
                    bool smaller = id < other_id;
                    vec3 difference = smaller ? own.xyz - other.xyz : other.xyz - own.xyz;
                    bool alike = 0.5 * (abs(difference.x) + abs(difference.y)) + abs(difference.z) <= 4e-7 * abs(own.z);
                    vec2 where = crossing(difference.xy, difference.z);
                    bool wins_beyond = rises_along(difference.xy) == smaller;
                    bool loses_all = behind || (alike && !smaller), wins_all = alike && smaller;
                    vec2 low = loses_all ? BEYOND_ALL : wins_all ? BEFORE_ALL : wins_beyond ? where : BEFORE_ALL;
                    vec2 high = loses_all || wins_all || wins_beyond ? BEYOND_ALL : where;
                    low = takes ? of_member(c.begin, from) : low;
                    high = takes ? of_member(c.end, from) : high;
                    vec2 third = takes ? of_member(c.third, from) : BEFORE_ALL;
                    bool third_begins = !takes || (its_kind & 1u) != 0u;

                    // Finds the samples of a new candidate, or removes those that the current one loses to the slot.
                    bool settles = behind && (!takes || settling < used);
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
                    settling += takes && settles ? 1u : 0u;
                    if (HAS_MASK) {
                        uint passing[WORDS];
                        bool tests = valid && (its_kind & 4u) != 0u;
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) passing[r] = tests ? shown[r] : 0u;
                        test_alpha(of_member(alpha, from), square, columns, passing);
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) shown[r] = tests ? passing[r] : shown[r];
                    }
                    uint some = 0u, some_open = 0u, some_free = 0u;
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        uint by_some = owned(r);
                        open_[r] = takes ? shown[r] & by_some : open_[r];
                        some |= shown[r];
                        some_open |= open_[r];
                        some_free |= ~(by_some | shown[r]);
                    }
                    uint state = team_or((some != 0u ? 1u : 0u) | (some_open != 0u ? 2u : 0u) | (some_free != 0u ? 4u : 0u));
                    comparing = (state & 2u) != 0u;
                    full = (state & 4u) == 0u;
                    bool shows = !comparing && (state & 1u) != 0u;
                    failed = failed || (shows && used == SLOTS);

                    // When no comparison is left, the candidate becomes the owner of its remaining samples.
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        uint taken = shows ? shown[r] : 0u;
                        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
                            owner[b * WORDS + r] = (used + 1u >> b & 1u) != 0u ? owner[b * WORDS + r] | taken : owner[b * WORDS + r] & ~taken;
                    }
                    [[unroll]] for (uint h = 0u; h < HELD; h++) {
                        bool here = shows && used == h * TEAM + lane;
                        slots[h].plane = here ? own : slots[h].plane;
                        slots[h].id = here ? id : slots[h].id;
                    }
                    used += shows ? 1u : 0u;
                    deepest = shows ? min(deepest, own.w) : deepest;
                    j += comparing ? 0u : 1u;
                    next = j < TEAM ? of_member(nearest, min(j, TEAM - 1u)) : after;
                    done = done || failed || (!comparing && next < deepest && full);
                } while (!done && (comparing || j < entries));
                done = done || entries < TEAM;
                batch++;
            } while (!done && batch < 2u);
        } while (!done && more);

        // Counts the records that each slot makes.
        uint all = 0u;
        if (BY_PART) {
            Variation around;
            if (!LOCATIONS) around = variation_of(cell);
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                bool some = h * TEAM + lane < used && high_frequency_triangle(slots[h].id);
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
            uint records_ = min(count_of(sums), 1u);
            if (BY_PART && parts != PARTS_ONE) {
                Grid grid = grid_of(parts, columns);
                uint found[WORDS], rest[WORDS], own = 0u, some = 0u;
                find_parts(bits, grid, found);
                find_rest(bits, grid, found, rest);
                [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                    own += uint(bitCount(found[r]));
                    some |= rest[r];
                }
                own = team_add(((lane & sharing_lanes(grid)) == 0u ? own : 0u) | (some != 0u ? 0x10000u : 0u));
                records_ = (own & 0xffffu) + min(own >> 16, 1u);
            }
            uint place = place_of_bits(sums, columns, false);
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                bool here = slot == h * TEAM + lane && slot < used;
                slots[h].count = here ? count_of(sums) : slots[h].count;
                slots[h].place = here ? place : slots[h].place;
                slots[h].records = here ? records_ : slots[h].records;
            }
        } while (++slot < used);
        uint single_records = 0u, several = 0u;
        [[unroll]] for (uint h = 0u; h < HELD; h++) all += slots[h].records;
        all = team_add(all);
        // If there is no room for the records of all parts, each triangle is shaded once.
        bool too_many = all > frame.sample_count + MORE_RECORDS;
        [[unroll]] for (uint h = 0u; h < HELD; h++) {
            bool single = too_many || slots[h].parts == PARTS_ONE, some = slots[h].count != 0u;
            single_records |= single && some ? 1u << (h * TEAM + lane) : 0u;
            several |= !single && some ? 1u << (h * TEAM + lane) : 0u;
            slots[h].parts = single ? PARTS_ONE : slots[h].parts;
        }
        single_records = team_or(single_records);
        uint singles = uint(bitCount(single_records));
        all = failed ? 0u : too_many ? singles : all;
        bool fits;
        uint base = allocate_records(all, fits);
        fits = fits && !failed;
        uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(bit & 7u, bit >> 3);
        uint cell_id = LOCATIONS ? location : pixel.x | pixel.y << 16;
        if (!failed && lane == 0u) headers[min(header.z + (location_group.w + first_cell + cell) * headers_a_cell, frame.record_capacity - 1u)] = uvec2(base, fits ? all : LEFT_BLOCK);
        left |= failed ? 1u << bit : 0u;
        float weight = float(frame.sample_count) * (1.0 / float(ALL_BITS));
        [[unroll]] for (uint h = 0u; h < HELD; h++) {
            bool single = slots[h].parts == PARTS_ONE && slots[h].count != 0u;
            uint before = uint(bitCount(single_records & ((1u << (h * TEAM + lane)) - 1u)));
            if (fits && single) records_out[base + before] = uvec4(cell_id, slots[h].id, slots[h].place, floatBitsToUint(float(slots[h].count) * weight));
        }
        if (BY_PART) {
            several = fits ? team_or(several) : 0u;
            uint at_record = base + singles;
            do {
                bool exists = several != 0u;
                uint s = exists ? uint(findLSB(several)) : 0u, parts = slots[0].parts, id = slots[0].id;
                several &= several - 1u;
                [[unroll]] for (uint h = 1u; h < HELD; h++) {
                    parts = s / TEAM == h ? slots[h].parts : parts;
                    id = s / TEAM == h ? slots[h].id : id;
                }
                parts = of_member(parts, s % TEAM);
                parts = exists ? parts : PARTS_FOURS;
                id = of_member(id, s % TEAM);
                Grid grid = grid_of(parts, columns);
                bool wide = part_is_wide(max(frame.sample_count, 4u * part_length(parts)), parts);
                uint bits[WORDS], pending[WORDS], rest[WORDS], own = 0u;
                [[unroll]] for (uint r = 0u; r < WORDS; r++) bits[r] = exists ? owned_by(s + 1u, r) : 0u;
                find_parts(bits, grid, pending);
                find_rest(bits, grid, pending, rest);

                // One record for the samples that are in no part, in the middle of these.
                uvec2 sums = uvec2(0u);
                [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                    sums += sums_of_word(r, rest[r]);
                    own += uint(bitCount(pending[r]));
                }
                sums = team_add(sums);
                bool writes = (lane & sharing_lanes(grid)) == 0u;
                own = writes ? own : 0u;
                if (lane == 0u && sums.x != 0u) records_out[at_record] = uvec4(cell_id, id, place_of_bits(sums, columns, wide), floatBitsToUint(float(count_of(sums)) * weight));
                at_record += sums.x != 0u ? 1u : 0u;
                uint at_own = at_record + team_before(own), step = 0u, steps;
                at_record += team_add(own);
                steps = team_max(own);
                do {
                    // The first part that has no record yet.
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
                    if (writes && fields != 0u) records_out[at_own + step] = uvec4(cell_id, id, place_of_bits(sums, columns, wide), floatBitsToUint(float(count_of(sums)) * weight));
                } while (++step < steps);
            } while (several != 0u);
        }
    } while (++cell < cells);

    if (left != 0u && member() == 0u) {
        atomicAdd(counters[COUNTER_RESAMPLED], uint(bitCount(left)));
        leave_cells(LIST, item, left);
    }
}
