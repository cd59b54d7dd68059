// sample_lines: what sample.comp finds, for cells of opaque triangles, by samples on straight lines: a cell has LINES of
// them, rows or columns, with BITS samples each, and an invocation holds some words of 32 of these.
// Reads: tiles, masks, tile_lists, candidates. Writes: records, headers; marks and lists the cells that it leaves to
// sample.comp: those that many candidates touch, that see more than SLOTS triangles, or one that crosses the near plane.
//
// A triangle covers a run of bits on a line, between the crossings of its edges. Candidates come by their nearest depth in
// the cell, the nearest first. Each bit has one owner, a slot, whose number is held as SLOT_BITS words of bits. A triangle takes
// what it covers and nobody owns; what is owned is compared, one owner at a time: where two planes cross in the cell, the line
// where they do is an edge, too. What is owned by triangles that are nearer than all that is to come is settled: it is lost
// to what comes without a comparison. A cell is done when all bits are owned and what is to come lies behind all owners.
//
// The crossing of an edge with a line is the same number for both triangles that share the edge: it divides coefficients
// that differ in sign alone.
//
// Invocations of a subgroup agree on everything but their words, so that loops end for all of them at once. Loops have one
// body for all kinds of trips: on lavapipe no branch skips anything.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/work.glsl"
layout(local_size_x_id = 0) in;
layout(constant_id = 3) const bool HAS_MASK = false;    // as in sample.comp, like those that follow
layout(constant_id = 4) const uint LIST = 0u;
layout(constant_id = 6) const bool BY_PART = false;
layout(constant_id = 8) const uint PART = 4u;
layout(constant_id = 10) const uint HEADER = 64u;       // samples that a header of sample.comp stands for

const float ROUNDING = 1.0 / 64.0;                      // as in sample.comp
const uint LINES = 16u, BITS = 64u, ALL_BITS = LINES * BITS;
const uint HALVES = BITS / 32u;                         // words of a line
// Words of an invocation: of one line after the other.
const uint LINE_WORDS = WORDS < HALVES ? WORDS : HALVES;    // of them, those of one line
const uint OWN_LINES = WORDS / LINE_WORDS;
const uint SLOT_BITS = 4u, SLOTS = (1u << SLOT_BITS) - 1u;
const uint HELD = (SLOTS + LANES - 1u) / LANES;         // slots that an invocation keeps what is known of
const uint MORE_RECORDS = 16u;                          // of a cell than samples: src/passes/sample.rs has the same number
const uint INDEX = 1023u;           // bits of a candidate's number in a key; the depth has those above

#include "include/candidate.glsl"
#include "include/place.glsl"
#include "include/records.glsl"
#include "include/variation.glsl"

shared uint touched[32u * LANES];   // candidates that touch a cell, a bit each, by blocks of 32 and cells

// A candidate's place in the order: its nearest depth in the cell, rounded down, and its number; its ID. 0 where there is none.
struct Key {
    uint depth, id;
};

// The order of candidates: the nearer one first and, of those whose keys have the same depth, the smaller ID, since their
// order in the list differs from run to run.
bool comes_before(Key k, Key other) { return (k.depth ^ other.depth) <= INDEX ? k.id < other.id : k.depth > other.depth; }

// Puts what comes first into the one, and what comes later into the other.
void keep_before(inout Key one, inout Key other) {
    bool stays = comes_before(one, other);
    Key first = Key(stays ? one.depth : other.depth, stays ? one.id : other.id);
    other = Key(stays ? other.depth : one.depth, stays ? other.id : one.id);
    one = first;
}

// Batcher's bitonic sorting of the keys of a subgroup, one an invocation, from runs of half of `from` that are sorted upwards and
// downwards in turns, to runs of `to`; in the end from the last one to the first one if `reversed`.
void sort_keys(inout Key k, uint from, uint to, bool reversed) {
    uint lane = gl_SubgroupInvocationID;
    [[unroll]] for (uint size = from; size <= to; size *= 2u) {
        [[unroll]] for (uint step = size / 2u; step > 0u; step /= 2u) {
            Key other = Key(subgroupShuffleXor(k.depth, step), subgroupShuffleXor(k.id, step));
            bool upper = (lane & step) != 0u, turned = size == LANES ? reversed : (lane & size) != 0u;
            bool keeps = comes_before(k, other) != (upper != turned);
            k.depth = keeps ? k.depth : other.depth;
            k.id = keeps ? k.id : other.id;
        }
    }
}

// Keeps the first keys of those in order and those in reversed order, in order.
void merge_keys(inout Key k, Key reversed) {
    bool stays = comes_before(k, reversed);
    k.depth = stays ? k.depth : reversed.depth;
    k.id = stays ? k.id : reversed.id;
    sort_keys(k, LANES, LANES, false);
}

// The range of a candidate's depths in the square of side 1 around `at`.
vec2 depth_range(Candidate k, vec2 at) {
    float depth = k.depth.x * at.x + k.depth.y * at.y + k.depth.z;
    float slope = (0.5 + ROUNDING) * (abs(k.depth.x) + abs(k.depth.y)) + abs(depth) * 1e-6;
    return vec2(max(depth - slope, k.far), min(depth + slope, k.near));
}

// Where the line E = 0 of a linear function crosses a sample line at v, in bits: x v + y, less the sample line's phase. E is
// along.x u + along.y v + c, at u along sample lines and v across them from the cell's centre. Lines that are nearly parallel
// to sample lines are turned a little, so that the crossing is a number.
vec2 crossing(vec2 along, float c) {
    float across = abs(along.y) * (1.0 / 1048576.0);
    bool rises = along.x > 0.0 || (along.x == 0.0 && along.y > 0.0);
    float slope = (rises ? 1.0 : -1.0) * max(abs(along.x), max(across, 1e-30));
    precise float by_line = -along.y / slope, start = -c / slope;
    return vec2(by_line * float(BITS), (start + 0.5) * float(BITS));
}

// Where it crosses the line at v.
float crossing_at(vec2 where, float v) {
    precise float x = where.x * v + where.y;
    return x;
}

vec3 edges_at(Candidate k, vec2 at) {
    precise vec3 e = k.a * at.x + k.b * at.y + k.c;
    return e;
}

// What no candidate that comes after one of this key is nearer than: a key's depth is less than a 2^-13th above what its
// bits say.
float nearest_after(uint key) { return uintBitsToFloat(key | INDEX) * 1.000002; }

// Whether E is positive beyond the crossing.
bool positive_beyond(vec2 along) { return along.x > 0.0 || (along.x == 0.0 && along.y > 0.0); }

vec2 choose(uint i, vec2 a, vec2 b, vec2 c) { return i == 0u ? a : i == 1u ? b : c; }

// Bits of a word from number `from` on, which may lie outside of it.
uint bits_from(int from) { return from > 31 ? 0u : ~0u << max(from, 0); }

// Sums over the bits of a word: their number, and of the number of each one's group of four.
uvec2 sums_of_bits(uint bits) {
    uint pairs = bits - (bits >> 1 & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + (pairs >> 2 & 0x33333333u);
    uint upper = fours >> 4 & 0x0f0f0f0fu, bytes = (fours & 0x0f0f0f0fu) + upper;
    return uvec2(bytes * 0x01010101u >> 24, (bytes * 0x00010203u >> 23 & ~1u) + (upper * 0x01010101u >> 24));
}

// The line and the half of it that word number `r` of an invocation is.
uint line_of(uint r) { return (gl_SubgroupInvocationID * WORDS + r) / HALVES; }
uint half_of(uint r) { return (gl_SubgroupInvocationID * WORDS + r) % HALVES; }

float line_at(uint line) { return (float(line) + 0.5) * (1.0 / float(LINES)) - 0.5; }

// A place in the cell from sums over its bits: their number, of groups of four bits along the line, and of lines.
uint place_of_bits(uint count, uint fours, uint lines, bool columns, bool wide) {
    float each = 1.0 / float(max(count, 1u));
    float u = (float(fours) * each + 0.5) * (4.0 / float(BITS)) - 0.5;
    float v = (float(lines) * each + 0.5) * (1.0 / float(LINES)) - 0.5;
    return pack_place(columns ? vec2(v, u) : vec2(u, v), float(max(count, 1u)) * (1.0 / float(ALL_BITS)), wide);
}

void main() {
    if (in_other_subgroups(LANES)) return;
    uint number = workgroup_number();
    if (number >= counters[COUNTER_PLAIN_TILES + LIST]) return;
    uint lane = gl_SubgroupInvocationID;
    uint entry = tile_lists[first_entry(LIST) + number], tile = entry_item(entry);
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    vec2 center = tile_center(tile_at);
    uint first = header.y, count = header.w >> TILE_COUNT_SHIFT;
    uint word = masks[tile];
    uint first_cell = entry_part(entry) * LANES, cells = min(uint(bitCount(word)) - first_cell, LANES);
    uint my_bit = bit_of_cell(word, first_cell + min(lane, cells - 1u));
    if (BY_PART) my_variation = variation_around(uvec2(tile_at) * uvec2(8u, 4u) + uvec2(my_bit & 7u, my_bit >> 3));
    uint headers_a_cell = (frame.sample_count + HEADER - 1u) / HEADER;
    bool listable = count <= INDEX;
    uint listed = listable ? count : 0u;
    uint left = 0u;                     // cells that sample.comp takes

    // Of the lines of an invocation: where they are, and where on them the first bit is.
    float lines[OWN_LINES], phases[OWN_LINES];
    [[unroll]] for (uint l = 0u; l < OWN_LINES; l++) {
        uint line = line_of(l * LINE_WORDS);
        lines[l] = line_at(line);
        phases[l] = float(bitfieldReverse(line) >> 28) * (1.0 / 16.0) + 1.0 / 32.0;
    }

    // Which candidates touch the cell of each invocation: a bit each, in words of 32.
    uint block = 0u;
    do {
        uint touching = 0u;
        [[unroll]] for (uint part = 0u; part < 32u; part += LANES) {
            uint own = block * 32u + part + lane;
            uint touches = own < listed ? texelFetch(candidates, int(first + own) * 4 + 3).w : 0u;
            [[unroll]] for (uint j = 0u; j < LANES; j++) touching |= (subgroupShuffle(touches, j) >> my_bit & 1u) << (part + j);
        }
        touched[block * LANES + lane] = touching;
    } while (++block * 32u < listed);
    subgroupBarrier();
    uint blocks = (listed + 31u) / 32u;

    uint c = 0u;
    do {
            uint bit = subgroupShuffle(my_bit, c);
            vec2 at = vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5);
            bool failed = !listable;

            uint owner[SLOT_BITS * WORDS], settled[WORDS], shown[WORDS], open_[WORDS];
            [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) owner[b * WORDS + r] = 0u;
                settled[r] = 0u;
                shown[r] = 0u;
                open_[r] = 0u;
            }
            // What invocations know of slots: number s + 1 is kept by invocation s % LANES.
            vec4 slot_plane[HELD];      // along, across, in the middle; farthest depth
            uint slot_id[HELD];
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                slot_plane[h] = vec4(0.0);
                slot_id[h] = ~0u;
            }
            uint used = 0u, settling = 0u;      // slots; those that are settled or looked at
            float deepest = 3.4e38;
            bool columns = false, directed = false, done = failed, more;
            Key limit = Key(~0u, 0u);           // this one and those before it have passed by
            do {
            // The next candidates in their order, one an invocation, and those after them.
            Key nearer = Key(0u, ~0u), farther_ = Key(0u, ~0u);
            uint passed = 0u;                   // blocks
            do {
                uint my_word = passed + lane < blocks ? touched[(passed + lane) * LANES + c] : 0u;
                uint in_word = uint(bitCount(my_word)), before = lanes_before(in_word), all = lanes_add(in_word), entry_ = 0u;
                do {
                    // Bit number entry_ + lane of the words of all invocations.
                    uint wanted = entry_ + lane, of = 0u;
                    [[unroll]] for (uint j = 1u; j < LANES; j++) of += subgroupShuffle(before, j) <= wanted ? 1u : 0u;
                    uint index = (passed + of) * 32u + bit_of_cell(subgroupShuffle(my_word, of), wanted - subgroupShuffle(before, of));
                    int o = int(first + min(index, max(listed, 1u) - 1u)) * 4;
                    uvec4 last = texelFetch(candidates, o + 3);
                    vec4 plane = uintBitsToFloat(texelFetch(candidates, o + 2));
                    float highest = plane.w + (0.5 + ROUNDING) * (abs(plane.y) + abs(plane.z));
                    float depth = min(max(plane.y * at.x + plane.z * at.y + highest, 1e-30), max(uintBitsToFloat(last.x), 1e-30));
                    Key key = Key(floatBitsToUint(depth) & ~INDEX | (index & INDEX), last.z);
                    key.depth = wanted < all && comes_before(limit, key) ? key.depth : 0u;
                    sort_keys(key, 2u, LANES, true);
                    merge_keys(farther_, key);
                    key = farther_;
                    farther_ = Key(subgroupShuffle(farther_.depth, LANES - 1u - lane), subgroupShuffle(farther_.id, LANES - 1u - lane));
                    keep_before(nearer, farther_);
                    sort_keys(nearer, LANES, LANES, false);
                    sort_keys(farther_, LANES, LANES, false);
                    entry_ += LANES;
                } while (entry_ < all);
                passed += LANES;
            } while (passed < blocks);
            limit = Key(subgroupShuffle(farther_.depth, LANES - 1u), subgroupShuffle(farther_.id, LANES - 1u));
            more = limit.depth != 0u;
            uint batch = 0u;
            do {
                // Candidates of a batch, one an invocation.
                uint key = batch == 0u ? nearer.depth : farther_.depth;
                float beyond = nearest_after(batch == 0u ? subgroupShuffle(farther_.depth, 0u) : limit.depth), nearest = nearest_after(key);
                Candidate k = load_candidate(first, min(key & INDEX, max(listed, 1u) - 1u), center);
                bool exists = key != 0u;
                vec3 edges = edges_at(k, at);
                vec3 plane = vec3(k.depth.xy, k.depth.x * at.x + k.depth.y * at.y + k.depth.z);
                vec2 range = depth_range(k, at);
                if (true) {
                    // Rows or columns: what the edges cross more often, as far as they lie in the cell.
                    vec2 sum = vec2(0.0);
                    [[unroll]] for (int e = 0; e < 3; e++) {
                        vec2 n = vec2(k.a[e], k.b[e]);
                        float inverse = inversesqrt(max(dot(n, n), 1e-37));
                        n *= inverse;
                        vec2 p = -edges[e] * inverse * n, d = vec2(-n.y, n.x);
                        vec2 side = 0.5 / max(abs(d), vec2(1e-20)), middle = p * d / max(d * d, vec2(1e-30));
                        float from = max(-side.x - middle.x, -side.y - middle.y), to = min(side.x - middle.x, side.y - middle.y);
                        [[unroll]] for (int o = 1; o < 3; o++) {
                            int other = (e + o) % 3;
                            float slope = k.a[other] * d.x + k.b[other] * d.y, value = k.a[other] * p.x + k.b[other] * p.y + edges[other];
                            float root = -value / (abs(slope) < 1e-30 ? 1e-30 : slope);
                            from = slope > 0.0 ? max(from, root) : from;
                            to = slope > 0.0 ? to : min(to, root);
                        }
                        sum += exists && lane < 8u ? max(to - from, 0.0) * abs(d) : vec2(0.0);
                    }
                    columns = directed ? columns : lanes_add(sum.x) > lanes_add(sum.y);
                    directed = true;
                }
                vec2 along[3], cross_[3];
                bool rises[3];
                [[unroll]] for (int e = 0; e < 3; e++) {
                    along[e] = columns ? vec2(k.b[e], k.a[e]) : vec2(k.a[e], k.b[e]);
                    cross_[e] = crossing(along[e], edges[e]);
                    rises[e] = positive_beyond(along[e]);
                }
                plane = columns ? plane.yxz : plane;
                // One edge that a run begins at, one that it ends at, and another one of either kind.
                uint begin = rises[0] ? 0u : rises[1] ? 1u : 2u, end = !rises[0] ? 0u : !rises[1] ? 1u : 2u, third = 3u - begin - end;
                bool third_begins = third == 0u ? rises[0] : third == 1u ? rises[1] : rises[2];
                bool usable = begin != end && (rises[0] || rises[1] || rises[2]) && !(rises[0] && rises[1] && rises[2]);
                vec2 begins = choose(begin, cross_[0], cross_[1], cross_[2]), ends = choose(end, cross_[0], cross_[1], cross_[2]);
                vec2 third_at = choose(min(third, 2u), cross_[0], cross_[1], cross_[2]);
                usable = usable && range.y <= 1.0 && range.x > 0.0;
                usable = usable && !(HAS_MASK && k.id > frame.first_mask);
                uint kind = (third_begins ? 1u : 0u) | (usable ? 0u : 2u);

                uint j = 0u, last_of_batch = lanes_add(exists ? 1u : 0u);
                bool comparing = false;         // some bits of the candidate at hand are owned
                uint id = 0u;
                vec4 own = vec4(0.0);           // its plane and farthest depth
                float near = 0.0;
                do {
                    bool takes = !comparing;
                    uint from = min(j, LANES - 1u);
                    vec2 t_begins = vec2(subgroupShuffle(begins.x, from), subgroupShuffle(begins.y, from));
                    vec2 t_ends = vec2(subgroupShuffle(ends.x, from), subgroupShuffle(ends.y, from));
                    vec2 t_third = vec2(subgroupShuffle(third_at.x, from), subgroupShuffle(third_at.y, from));
                    uint t_kind = subgroupShuffle(kind, from), t_id = subgroupShuffle(k.id, from);
                    vec4 t_own = vec4(subgroupShuffle(plane.x, from), subgroupShuffle(plane.y, from), subgroupShuffle(plane.z, from), subgroupShuffle(range.x, from));
                    float t_near = subgroupShuffle(nearest, from);
                    id = takes ? t_id : id;
                    own = takes ? t_own : own;
                    near = takes ? t_near : near;
                    failed = failed || (takes && j < last_of_batch && (t_kind & 2u) != 0u);

                    // The slot to compare with: the first one that owns an open bit; or, of a new candidate, one to settle.
                    uint word_ = 0u, bits_[SLOT_BITS];
                    [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) bits_[b] = 0u;
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        bool some = open_[r] != 0u;
                        word_ = some ? open_[r] : word_;
                        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) bits_[b] = some ? owner[b * WORDS + r] : bits_[b];
                    }
                    uint lowest = word_ & (0u - word_), slot = 0u;
                    [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) slot |= (bits_[b] & lowest) != 0u ? 1u << b : 0u;
                    slot = lanes_min(lowest != 0u ? slot : ~0u);
                    slot = takes ? min(settling, SLOTS - 1u) + 1u : min(slot, SLOTS);
                    uint keeper = (slot - 1u) % LANES, level = (slot - 1u) / LANES;
                    vec4 its = vec4(0.0);
                    uint its_id = 0u;
                    [[unroll]] for (uint h = 0u; h < HELD; h++) {
                        vec4 kept_plane = vec4(subgroupShuffle(slot_plane[h].x, keeper), subgroupShuffle(slot_plane[h].y, keeper), subgroupShuffle(slot_plane[h].z, keeper), subgroupShuffle(slot_plane[h].w, keeper));
                        uint kept_id = subgroupShuffle(slot_id[h], keeper);
                        its = level == h ? kept_plane : its;
                        its_id = level == h ? kept_id : its_id;
                    }
                    bool behind = near < its.w;         // the candidate and all that follow lie behind the slot

                    // The edge where both planes cross: the one of the smaller ID wins what is as near.
                    bool before = id < its_id;
                    vec3 d = before ? own.xyz - its.xyz : its.xyz - own.xyz;
                    bool level_ = 0.5 * (abs(d.x) + abs(d.y)) + abs(d.z) <= 4e-7 * abs(own.z);
                    vec2 where = crossing(d.xy, d.z);
                    bool wins_beyond = positive_beyond(d.xy) == before;
                    const vec2 EARLY = vec2(0.0, -1e9), LATE = vec2(0.0, 1e9);
                    bool loses_all = behind || (level_ && !before), wins_all = level_ && before && !behind;
                    vec2 low = wins_beyond ? where : EARLY, high = wins_beyond ? LATE : where;
                    low = loses_all ? LATE : wins_all ? EARLY : low;
                    high = loses_all || wins_all ? LATE : high;
                    low = takes ? t_begins : low;
                    high = takes ? t_ends : high;
                    vec2 another = takes ? t_third : EARLY;
                    bool another_begins = !takes || (t_kind & 1u) != 0u;

                    uint rest = 0u, uncovered = 0u, some_open = 0u;
                    bool settles = behind && (takes ? settling < used : true);
                    bool valid = !takes || j < last_of_batch;
                    [[unroll]] for (uint l = 0u; l < OWN_LINES; l++) {
                        float x0 = crossing_at(low, lines[l]), x1 = crossing_at(high, lines[l]), x2 = crossing_at(another, lines[l]);
                        float start = (another_begins ? max(x0, x2) : x0) - phases[l], stop = (another_begins ? x1 : min(x1, x2)) - phases[l];
                        int first_bit = int(ceil(clamp(start, 0.0, float(BITS)))), last_bit = int(ceil(clamp(stop, 0.0, float(BITS))));
                        [[unroll]] for (uint h = 0u; h < LINE_WORDS; h++) {
                            uint r = l * LINE_WORDS + h;
                            int word_first = int(half_of(r)) * 32;
                            uint holds = bits_from(first_bit - word_first) & ~bits_from(last_bit - word_first);
                            uint of_slot = ~0u, covered = 0u;
                            [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++) {
                                of_slot &= (slot >> b & 1u) != 0u ? owner[b * WORDS + r] : ~owner[b * WORDS + r];
                                covered |= owner[b * WORDS + r];
                            }
                            settled[r] |= settles ? of_slot : 0u;
                            shown[r] = takes ? (valid ? holds & ~settled[r] : 0u) : shown[r] & ~(of_slot & ~holds);
                            open_[r] = takes ? shown[r] & covered : open_[r] & ~of_slot;
                            some_open |= open_[r];
                            rest |= shown[r];
                            uncovered |= ~(covered | shown[r]);
                        }
                    }
                    settling += takes && settles ? 1u : 0u;
                    comparing = lanes_or(some_open) != 0u;
                    bool shows = !comparing && lanes_or(rest) != 0u;
                    failed = failed || (shows && used == SLOTS);
                    uint slot_after = used + 1u;
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        uint taken = shows ? shown[r] : 0u;
                        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
                            owner[b * WORDS + r] = (slot_after >> b & 1u) != 0u ? owner[b * WORDS + r] | taken : owner[b * WORDS + r] & ~taken;
                    }
                    [[unroll]] for (uint h = 0u; h < HELD; h++) {
                        bool here = shows && used == h * LANES + lane;
                        slot_plane[h] = here ? own : slot_plane[h];
                        slot_id[h] = here ? id : slot_id[h];
                    }
                    used += shows ? 1u : 0u;
                    deepest = shows ? min(deepest, own.w) : deepest;
                    j += comparing ? 0u : 1u;
                    float next = j < LANES ? subgroupShuffle(nearest, min(j, LANES - 1u)) : beyond;
                    done = done || failed || (!comparing && next < deepest && lanes_or(uncovered) == 0u);
                    comparing = comparing && !done;
                } while (comparing || (!done && j < last_of_batch));
                done = done || last_of_batch < LANES;
                batch++;
            } while (!done && batch < 2u);
            } while (!done && more);

            // What each slot has: its number of bits and their middle, and records.
            uint slot_count[HELD], slot_place[HELD], slot_parts[HELD], slot_records[HELD];
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                slot_count[h] = 0u;
                slot_place[h] = 0u;
                slot_parts[h] = PARTS_ONE;
                slot_records[h] = 0u;
                if (BY_PART) {
                    Variation around = variation_of(c);
                    bool some = h * LANES + lane < used;
                    uint of = some ? slot_id[h] : 1u;
                    slot_parts[h] = some && high_frequency_triangle(of) ? parts_around(around, of) : PARTS_ONE;
                }
            }
            uint slot = 0u;
            do {
                uint keeper = slot % LANES, level = slot / LANES, parts = PARTS_ONE;
                if (BY_PART) {
                    [[unroll]] for (uint h = 0u; h < HELD; h++) {
                        uint its = subgroupShuffle(slot_parts[h], keeper);
                        parts = level == h ? its : parts;
                    }
                }
                // The grid of parts, along sample lines and across them.
                uint log_parts = uint(findMSB(max(frame.sample_count / part_length(parts), 1u)));
                uint log_along = (columns ? log_parts + 1u : log_parts) >> 1, log_across = log_parts - log_along;
                uint field = BITS >> log_along, part_lines = LINES >> log_across;
                uint fields = field == 32u ? 1u : field == 16u ? 0x00010001u : field == 8u ? 0x01010101u : 0x11111111u;
                uvec3 sum = uvec3(0u);
                uint present[WORDS];
                [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                    uint bits = ~0u;
                    [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
                        bits &= (slot + 1u >> b & 1u) != 0u ? owner[b * WORDS + r] : ~owner[b * WORDS + r];
                    uvec2 s = sums_of_bits(bits);
                    sum += uvec3(s.x, s.y + s.x * half_of(r) * 8u, s.x * line_of(r));
                    if (BY_PART) {
                        bits |= bits >> 1;
                        bits |= bits >> 2;
                        bits |= field > 4u ? bits >> 4 : 0u;
                        bits |= field > 8u ? bits >> 8 : 0u;
                        bits |= field > 16u ? bits >> 16 : 0u;
                        present[r] = bits & fields;
                    }
                }
                uint records_ = 0u;
                if (BY_PART) {
                    // Lines of a part are merged: those of this invocation, then those of others.
                    [[unroll]] for (uint span = 1u; span < OWN_LINES; span *= 2u) {
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                            bool second = (r / LINE_WORDS & span) != 0u;
                            if (!second && part_lines > span) {
                                present[r] |= present[r + span * LINE_WORDS];
                                present[r + span * LINE_WORDS] = 0u;
                            }
                        }
                    }
                    [[unroll]] for (uint span = OWN_LINES; span < LINES; span *= 2u) {
                        uint step = span * HALVES / WORDS;
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                            uint other = subgroupShuffleXor(present[r], step);
                            present[r] = part_lines <= span ? present[r] : (lane & step) != 0u ? 0u : present[r] | other;
                        }
                    }
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) records_ += uint(bitCount(present[r]));
                }
                sum = uvec3(lanes_add(sum.x), lanes_add(sum.y), lanes_add(sum.z));
                records_ = BY_PART ? lanes_add(records_) : 0u;
                records_ = parts == PARTS_ONE ? min(sum.x, 1u) : records_;
                uint place = place_of_bits(sum.x, sum.y, sum.z, columns, false);
                [[unroll]] for (uint h = 0u; h < HELD; h++) {
                    bool here = slot == h * LANES + lane && slot < used;
                    slot_count[h] = here ? sum.x : slot_count[h];
                    slot_place[h] = here ? place : slot_place[h];
                    slot_records[h] = here ? records_ : slot_records[h];
                }
            } while (++slot < used);
            uint all = 0u;
            [[unroll]] for (uint h = 0u; h < HELD; h++) all += slot_records[h];
            all = lanes_add(all);
            if (BY_PART) {
                // Where parts would be more than there is room for, each triangle is shaded once.
                bool too_many = all > frame.sample_count + MORE_RECORDS;
                all = 0u;
                [[unroll]] for (uint h = 0u; h < HELD; h++) {
                    slot_parts[h] = too_many ? PARTS_ONE : slot_parts[h];
                    slot_records[h] = too_many ? min(slot_count[h], 1u) : slot_records[h];
                    all += slot_records[h];
                }
                all = lanes_add(all);
            }
            all = failed ? 0u : all;
            bool fits;
            uint base = allocate_records(all, fits);
            fits = fits && !failed;
            uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(bit & 7u, bit >> 3);
            uint cell_id = pixel.x | pixel.y << 16, at_record = base;
            uint cell = first_cell + c;
            if (subgroupElect() && !failed) headers[min(header.z + cell * headers_a_cell, frame.record_capacity - 1u)] = uvec2(base, fits ? all : 0u);
            left |= failed ? 1u << bit : 0u;
            float weight = float(frame.sample_count) * (1.0 / float(ALL_BITS));
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                bool single = slot_count[h] != 0u && slot_parts[h] == PARTS_ONE;
                uvec4 singles = subgroupBallot(single);
                if (fits && single)
                    records_out[at_record + subgroupBallotExclusiveBitCount(singles)] = uvec4(cell_id, slot_id[h], slot_place[h], floatBitsToUint(float(slot_count[h]) * weight));
                at_record += subgroupBallotBitCount(singles);
            }
            if (BY_PART) {
                // Slots that are shaded in parts: of each the fields of a word, and of each field the words of an invocation.
                uint several = 0u;
                [[unroll]] for (uint h = 0u; h < HELD; h++)
                    several |= subgroupBallot(slot_count[h] != 0u && slot_parts[h] != PARTS_ONE).x << (h * LANES);
                several = fits ? several : 0u;
                do {
                    uint s = several != 0u ? uint(findLSB(several)) : 0u, keeper = s % LANES, level = s / LANES;
                    uint parts = PARTS_FOURS, id = 0u;
                    [[unroll]] for (uint h = 0u; h < HELD; h++) {
                        uint its_parts = subgroupShuffle(slot_parts[h], keeper), its_id = subgroupShuffle(slot_id[h], keeper);
                        parts = level == h ? its_parts : parts;
                        id = level == h ? its_id : id;
                    }
                    uint log_parts = uint(findMSB(max(frame.sample_count / part_length(parts), 1u)));
                    uint log_along = (columns ? log_parts + 1u : log_parts) >> 1, log_across = log_parts - log_along;
                    uint field = BITS >> log_along, part_lines = LINES >> log_across;
                    uint fields = field == 32u ? 1u : field == 16u ? 0x00010001u : field == 8u ? 0x01010101u : 0x11111111u;
                    bool wide = part_is_wide(frame.sample_count, parts);
                    // Fields that have some bits, of lines of a part merged: the invocations that share a part agree on them.
                    uint of_slot[WORDS], pending[WORDS];
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                        uint bits = several != 0u ? ~0u : 0u;
                        [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
                            bits &= (s + 1u >> b & 1u) != 0u ? owner[b * WORDS + r] : ~owner[b * WORDS + r];
                        of_slot[r] = bits;
                        bits |= bits >> 1;
                        bits |= bits >> 2;
                        bits |= field > 4u ? bits >> 4 : 0u;
                        bits |= field > 8u ? bits >> 8 : 0u;
                        bits |= field > 16u ? bits >> 16 : 0u;
                        pending[r] = bits & fields;
                    }
                    [[unroll]] for (uint span = 1u; span < OWN_LINES; span *= 2u) {
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                            bool second = (r / LINE_WORDS & span) != 0u;
                            if (!second && part_lines > span) {
                                pending[r] |= pending[r + span * LINE_WORDS];
                                pending[r + span * LINE_WORDS] = 0u;
                            }
                        }
                    }
                    uint sharing = 0u, own_records = 0u;        // bits of the number of an invocation that those that share parts differ in
                    [[unroll]] for (uint span = OWN_LINES; span < LINES; span *= 2u) {
                        uint apart = span * HALVES / WORDS;
                        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
                            uint other = subgroupShuffleXor(pending[r], apart);
                            pending[r] |= part_lines <= span ? 0u : other;
                        }
                        sharing |= part_lines <= span ? 0u : apart;
                    }
                    [[unroll]] for (uint r = 0u; r < WORDS; r++) own_records += uint(bitCount(pending[r]));
                    bool writes = (lane & sharing) == 0u;
                    own_records = writes ? own_records : 0u;
                    uint at_own = at_record + lanes_before(own_records);
                    at_record += lanes_add(own_records);
                    bool some;
                    do {
                        // The first field that is left.
                        uint r = WORDS - 1u, fields_left = pending[WORDS - 1u];
                        [[unroll]] for (uint q = WORDS - 1u; q-- > 0u;) {
                            r = pending[q] != 0u ? q : r;
                            fields_left = pending[q] != 0u ? pending[q] : fields_left;
                        }
                        some = fields_left != 0u;
                        uint at_bit = some ? uint(findLSB(fields_left)) : 0u;
                        uint others_left = 0u;
                        uvec2 sums = uvec2(0u);     // bits, and above them sums of groups of four; sums of lines
                        uint window = field == 32u ? ~0u : (1u << field) - 1u;
                        [[unroll]] for (uint q = 0u; q < WORDS; q++) {
                            pending[q] = r == q ? pending[q] & (pending[q] - 1u) : pending[q];
                            others_left |= pending[q];
                        }
                        [[unroll]] for (uint n = 0u; n < OWN_LINES; n++) {
                            uint w = r + n * LINE_WORDS, bits = 0u;
                            [[unroll]] for (uint q = 0u; q < WORDS; q++) bits = w == q ? of_slot[q] : bits;
                            uvec2 of_bits = sums_of_bits(n < part_lines ? bits >> at_bit & window : 0u);
                            sums += uvec2(of_bits.x | of_bits.y << 12, of_bits.x * line_of(w));
                        }
                        [[unroll]] for (uint span = OWN_LINES; span < LINES; span *= 2u) {
                            uint apart = span * HALVES / WORDS;
                            uvec2 other = uvec2(subgroupShuffleXor(sums.x, apart), subgroupShuffleXor(sums.y, apart));
                            sums += part_lines <= span ? uvec2(0u) : other;
                        }
                        uint bits_in = sums.x & 0xfffu, fours = (sums.x >> 12) + bits_in * (half_of(r) * 8u + at_bit / 4u);
                        uint place = place_of_bits(bits_in, fours, sums.y, columns, wide);
                        if (writes && some) records_out[at_own] = uvec4(cell_id, id, place, floatBitsToUint(float(bits_in) * weight));
                        at_own++;
                        some = others_left != 0u;
                    } while (lanes_or(some ? 1u : 0u) != 0u);
                    several &= several - 1u;
                } while (several != 0u);
            }
    } while (++c < cells);

    if (left != 0u && subgroupElect()) {
        atomicAdd(counters[COUNTER_RESAMPLED], uint(bitCount(left)));
        leave_cells(LIST, tile, left);
    }
}
