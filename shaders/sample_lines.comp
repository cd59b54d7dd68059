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
const uint CELLS = 8u;                                  // whose candidates are listed at once
const uint KEPT = 96u;                                  // candidates of a cell
const uint MORE_RECORDS = 16u;                          // of a cell than samples: src/passes/sample.rs has the same number
const uint INDEX = 1023u;           // bits of a candidate's number in a key; the depth has those above

#include "include/candidate.glsl"
#include "include/place.glsl"
#include "include/records.glsl"
#include "include/variation.glsl"

shared uint kept[CELLS * KEPT];     // keys of candidates, by cell
shared uint sorted[KEPT];           // candidates of the cell at hand, the nearest first

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

    uint group = 0u;
    do {
        uint grouped = min(cells - group, CELLS);
        // Candidates of the cells of a group, as keys.
        uint my_count = 0u;             // of the cell of this invocation's number in the group
        uint chunk = 0u;
        do {
            int o = int(first + min(chunk + lane, max(listed, 1u) - 1u)) * 4;
            uvec4 last = texelFetch(candidates, o + 3);
            vec4 plane = uintBitsToFloat(texelFetch(candidates, o + 2));
            uint touches = chunk + lane < listed ? last.w : 0u;
            float highest = plane.w + (0.5 + ROUNDING) * (abs(plane.y) + abs(plane.z)), near = max(uintBitsToFloat(last.x), 1e-30);
            uint c = 0u;
            do {
                uint bit = subgroupShuffle(my_bit, group + c), kept_before = subgroupShuffle(my_count, c);
                vec2 at = vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5);
                float depth = min(max(plane.y * at.x + plane.z * at.y + highest, 1e-30), near);
                bool keeps = (touches >> bit & 1u) != 0u;
                uvec4 keeping = subgroupBallot(keeps);
                uint place = kept_before + subgroupBallotExclusiveBitCount(keeping);
                if (keeps && place < KEPT) kept[c * KEPT + place] = floatBitsToUint(depth) & ~INDEX | (chunk + lane);
                my_count += lane == c ? subgroupBallotBitCount(keeping) : 0u;
            } while (++c < grouped);
            chunk += LANES;
        } while (chunk < listed);
        subgroupBarrier();

        uint c = 0u;
        do {
            uint bit = subgroupShuffle(my_bit, group + c), entries = subgroupShuffle(my_count, c);
            vec2 at = vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5);
            bool failed = !listable || entries > KEPT;
            entries = failed ? 0u : entries;

            // Their order: the nearer one first and, of those whose keys have the same depth, the smaller ID, since their
            // order in the list differs from run to run.
            uint mine = 0u;
            do {
                uint my_key = kept[c * KEPT + min(mine + lane, KEPT - 1u)];
                uint my_id = texelFetch(candidates, int(first + min(my_key & INDEX, max(listed, 1u) - 1u)) * 4 + 3).z;
                uint rank = 0u, others = 0u;
                do {
                    uint key = kept[c * KEPT + min(others + lane, KEPT - 1u)];
                    uint id = texelFetch(candidates, int(first + min(key & INDEX, max(listed, 1u) - 1u)) * 4 + 3).z;
                    [[unroll]] for (uint j = 0u; j < LANES; j++) {
                        uint its_key = subgroupShuffle(key, j), its_id = subgroupShuffle(id, j);
                        bool before = (its_key ^ my_key) <= INDEX ? its_id < my_id : its_key > my_key;
                        rank += before && others + j < entries ? 1u : 0u;
                    }
                    others += LANES;
                } while (others < entries);
                if (mine + lane < entries) sorted[rank] = my_key;
                mine += LANES;
            } while (mine < entries);
            subgroupBarrier();

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
            bool columns = false, done = entries == 0u;
            uint batch = 0u;
            do {
                // Candidates of a batch, one an invocation.
                uint key = sorted[min(batch + lane, KEPT - 1u)];
                float beyond = nearest_after(sorted[min(batch + LANES, KEPT - 1u)]), nearest = nearest_after(key);
                Candidate k = load_candidate(first, min(key & INDEX, max(listed, 1u) - 1u), center);
                bool exists = batch + lane < entries;
                vec3 edges = edges_at(k, at);
                vec3 plane = vec3(k.depth.xy, k.depth.x * at.x + k.depth.y * at.y + k.depth.z);
                vec2 range = depth_range(k, at);
                if (batch == 0u) {
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
                    columns = lanes_add(sum.x) > lanes_add(sum.y);
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

                uint j = 0u, last_of_batch = min(entries - min(batch, entries), LANES);
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
                batch += LANES;
            } while (!done && batch < entries);

            // What each slot has: its number of bits and their middle, and records.
            uint slot_count[HELD], slot_place[HELD], slot_parts[HELD], slot_records[HELD];
            [[unroll]] for (uint h = 0u; h < HELD; h++) {
                slot_count[h] = 0u;
                slot_place[h] = 0u;
                slot_parts[h] = PARTS_ONE;
                slot_records[h] = 0u;
                if (BY_PART) {
                    Variation around = variation_of(group + c);
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
            uint cell = first_cell + group + c;
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
                uint step = 0u;
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
                    // Lines of this invocation that are in one part, and words that are left of them.
                    uint own_lines = min(part_lines, OWN_LINES), own_words = WORDS / own_lines;
                    uint r = step % own_words, at_bit = step / own_words * field;
                    uint first_word = r % LINE_WORDS + r / LINE_WORDS * own_lines * LINE_WORDS;
                    uvec2 sums = uvec2(0u);     // bits, and above them sums of groups of four; sums of lines
                    [[unroll]] for (uint n = 0u; n < OWN_LINES; n++) {
                        uint bits = 0u, w = first_word + n * LINE_WORDS;
                        [[unroll]] for (uint q = 0u; q < WORDS; q++) {
                            uint of_slot = ~0u;
                            [[unroll]] for (uint b = 0u; b < SLOT_BITS; b++)
                                of_slot &= (s + 1u >> b & 1u) != 0u ? owner[b * WORDS + q] : ~owner[b * WORDS + q];
                            bits = w == q && n < own_lines ? of_slot : bits;
                        }
                        bits = bits >> at_bit & (field == 32u ? ~0u : (1u << field) - 1u);
                        uvec2 of_bits = sums_of_bits(bits);
                        sums += uvec2(of_bits.x | of_bits.y << 12, of_bits.x * line_of(min(w, WORDS - 1u)));
                    }
                    [[unroll]] for (uint span = OWN_LINES; span < LINES; span *= 2u) {
                        uint apart = span * HALVES / WORDS;
                        uvec2 other = uvec2(subgroupShuffleXor(sums.x, apart), subgroupShuffleXor(sums.y, apart));
                        sums = part_lines <= span ? sums : (lane & apart) != 0u ? uvec2(0u) : sums + other;
                    }
                    uint bits_in = sums.x & 0xfffu, fours = (sums.x >> 12) + bits_in * (half_of(r % LINE_WORDS) * 8u + at_bit / 4u);
                    uint place = place_of_bits(bits_in, fours, sums.y, columns, part_is_wide(frame.sample_count, parts));
                    bool writes = several != 0u && bits_in != 0u;
                    uvec4 writing = subgroupBallot(writes);
                    if (writes)
                        records_out[at_record + subgroupBallotExclusiveBitCount(writing)] = uvec4(cell_id, id, place, floatBitsToUint(float(bits_in) * weight));
                    at_record += subgroupBallotBitCount(writing);
                    step++;
                    bool last_step = step >= own_words * (32u / field);
                    several &= last_step ? several - 1u : ~0u;
                    step = last_step ? 0u : step;
                } while (several != 0u);
            }
        } while (++c < grouped);
        subgroupBarrier();
        group += CELLS;
    } while (group < cells);

    if (left != 0u && subgroupElect()) {
        atomicAdd(counters[COUNTER_RESAMPLED], uint(bitCount(left)));
        leave_cells(LIST, tile, left);
    }
}
