// sample_masks: finds the same as sample.comp, for cells of at most 64 samples with opaque or alpha-tested triangles. An
// invocation takes a cell. The samples that see a triangle are a mask, with a bit for each sample.
// Reads: tiles, masks, tile_lists, candidates. Writes: records, headers. Cells that see more than SLOTS triangles, or one that
// crosses the near plane, and those of tiles with more than INDEX candidates, are marked and listed for sample.comp.
//
// Candidates are taken in the order of their nearest depth in the cell, the nearest first. If the ranges of depth that two
// triangles have in the cell do not overlap, the nearer triangle takes the samples that both cover. Otherwise depths are
// compared at each of these samples, in a trip of the loop of its own. A cell is done when all its samples are covered and all
// remaining candidates lie behind what it sees.
//
// Loops end when all invocations agree, and have one body for both kinds of trips: see DO_WHILE of workarounds.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/work.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = SAMPLE_CONSTANT_HAS_MASK) const bool HAS_MASK = false;    // this and the following ones: as in sample.comp
layout(constant_id = SAMPLE_CONSTANT_LIST) const uint LIST = 0u;
layout(constant_id = SAMPLE_CONSTANT_BY_PART) const bool BY_PART = false;
layout(constant_id = SAMPLE_CONSTANT_EXACT_AREAS) const bool EXACT_AREAS = false;
layout(constant_id = SAMPLE_CONSTANT_PART) const uint PART = 4u;

const float ROUNDING = 1.0 / 64.0;  // as in sample.comp
const int SLOTS = 6;                // most triangles that a cell sees
const int AHEAD = 8;                // candidates that are sorted at once
const uint INDEX = 1023u;           // bits of a key that hold a candidate's number; those above hold its depth

#include "include/alpha.glsl"
#include "include/area.glsl"
#include "include/candidate.glsl"
#include "include/mask.glsl"
#include "include/place.glsl"
#include "include/records.glsl"
#include "include/variation.glsl"

bool any_lane(bool condition) { return lanes_or(condition ? 1u : 0u) != 0u; }

// The range of a candidate's depths in the square of side 1 around `at`.
vec2 depth_range(Candidate k, vec2 at) {
    float depth = k.depth.x * at.x + k.depth.y * at.y + k.depth.z;
    float slope = (0.5 + ROUNDING) * (abs(k.depth.x) + abs(k.depth.y)) + abs(depth) * 1e-6;
    return vec2(max(depth - slope, k.far), min(depth + slope, k.near));
}

// The order of candidates: the nearer one comes first. If keys have the same depth, the smaller ID comes first, since the order
// of the list differs from run to run.
bool comes_before(int key, uint id, int other, uint other_id) {
    return uint(key ^ other) <= INDEX ? id < other_id : key > other;
}

// Those of `samples`, in the cell around `at`, at which a triangle passes its alpha test.
uvec2 alpha_mask(uint triangle, uvec2 samples, vec2 center, vec2 at) {
    AlphaTest test = alpha_test(triangle, center, at, mat2(frame.sample_footprint));
    uvec2 passed = uvec2(0u);
    do {
        bool lower = samples.x != 0u;
        uint half_ = lower ? samples.x : samples.y, n = half_ == 0u ? 0u : uint(findLSB(half_)), bit = half_ & (0u - half_);
        vec2 offset = texelFetch(pattern_offsets, int(n + (lower ? 0u : 32u))).xy;
        uint passes = alpha_passes(test, at + offset) ? bit : 0u;
        passed |= uvec2(lower ? passes : 0u, lower ? 0u : passes);
        samples &= ~uvec2(lower ? bit : 0u, lower ? 0u : bit);
    } while (any_lane((samples.x | samples.y) != 0u));
    return passed;
}

// What a cell sees of a triangle.
struct Seen {
    uvec2 mask;
    uint id;
    uint index;             // number of the candidate in the tile's list
    float far;              // its farthest depth in the cell
    int area;               // its exact area; 0 if its weight is its number of samples
    uint parts;             // PARTS_ONE if it makes one record
};

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
    uint word = masks[tile], cells = bitCount(word);
    uint cell = min(entry_part(entry) * LANES + lane, cells - 1u), bit = bit_of_cell(word, cell);
    bool exists = entry_part(entry) * LANES + lane < cells;
    vec2 at = vec2(bit & 7u, bit >> 3) - vec2(3.5, 1.5);
    uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(bit & 7u, bit >> 3);
    if (BY_PART) my_variation = variation_around(pixel);
    load_offsets();

    Seen seen[SLOTS];
    [[unroll]] for (int s = 0; s < SLOTS; s++) seen[s] = Seen(uvec2(0u), ~0u, 0u, 3.4e38, 0, PARTS_ONE);
    uint used = 0u;                     // slots in use
    uint wholes = 0u;                   // a bit for each slot: the triangle owns all samples that it covers
    uvec2 all = all_samples(), covered = uvec2(0u);
    float deepest = 3.4e38;             // the farthest depth of all slots in the cell
    bool failed = count > INDEX, done = !exists || failed;
    count = failed ? 0u : count;

    int limit = 0x7fffffff;             // candidates up to this key, with `last_id`, are done, in the order of comes_before
    uint last_id = 0u;
    bool more;                          // candidates are left behind the AHEAD ones
    do {
        int keys[AHEAD + 1], least = 0;
        uint of_keys[AHEAD];    // the keys' triangle IDs
        [[unroll]] for (int a = 0; a <= AHEAD; a++) keys[a] = 0;
        [[unroll]] for (int a = 0; a < AHEAD; a++) of_keys[a] = 0u;
        uint batch = 0u;
        do {
            int o = int(first + min(batch + lane, max(count, 1u) - 1u)) * 4;
            uvec4 last = texelFetch(candidates, o + 3);
            vec4 plane = uintBitsToFloat(texelFetch(candidates, o + 2));
            uint touches = batch + lane < count ? last.w : 0u;
            float highest = plane.w + (0.5 + ROUNDING) * (abs(plane.y) + abs(plane.z)), near = max(uintBitsToFloat(last.x), 1e-30);
            uint j = 0u;
            do {
                [[unroll]] for (uint u = 0u; u < 4u; u++) {
                    float depth = subgroupShuffle(plane.y, j + u) * at.x + subgroupShuffle(plane.z, j + u) * at.y + subgroupShuffle(highest, j + u);
                    int key = floatBitsToInt(min(max(depth, 1e-30), subgroupShuffle(near, j + u))) & ~int(INDEX) | int(batch + j + u);
                    uint of = subgroupShuffle(last.z, j + u);
                    bool comes = comes_before(limit, last_id, key, of);
                    key = (subgroupShuffle(touches, j + u) >> bit & 1u) != 0u && comes ? key : 0;
                    [[unroll]] for (int a = 0; a < AHEAD; a++) {
                        bool before = comes_before(key, of, keys[a], of_keys[a]);
                        int later = before ? keys[a] : key;
                        uint later_id = before ? of_keys[a] : of;
                        keys[a] = before ? key : keys[a];
                        of_keys[a] = before ? of : of_keys[a];
                        key = later;
                        of = later_id;
                    }
                    least |= key;
                }
                j += 4u;
            } while (j < LANES);
            batch += LANES;
        } while (batch < count);
        limit = keys[AHEAD - 1];
        last_id = of_keys[AHEAD - 1];
        bool others = least != 0;

        // The current candidate: the samples that it covers and that no nearer triangle owns, and the slots with which it is
        // still to be compared.
        uvec2 mask = uvec2(0u), taken = uvec2(0u);
        uint id = 0u, index = 0u, rivals = 0u;
        bool masked = false;                // it is alpha-tested, so that its area is not that of its triangle
        vec3 plane = vec3(0.0);
        vec2 bounds = vec2(0.0), range = vec2(0.0);
        do {
            bool compares = rivals != 0u, takes = !compares && !done && keys[0] != 0;
            uint slot = compares ? uint(findLSB(rivals)) : ~0u, fetched = uint(keys[0]) & INDEX;
            rivals &= rivals - 1u;
            [[unroll]] for (int a = 0; a < AHEAD; a++) keys[a] = compares ? keys[a] : keys[a + 1];
            uvec2 shared_ = uvec2(0u);
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                fetched = slot == uint(s) ? seen[s].index : fetched;
                shared_ |= slot == uint(s) ? seen[s].mask : uvec2(0u);
            }
            Candidate k = load_candidate(first, min(fetched, max(count, 1u) - 1u), center);

            // If depths are equal, the smaller ID wins: its depth comes first in the comparison.
            bool before = id < k.id;
            Comparison test;
            test.a = compares ? vec3(before ? plane.x : k.depth.x, before ? k.depth.x : plane.x, 0.0) : k.a;
            test.b = compares ? vec3(before ? plane.y : k.depth.y, before ? k.depth.y : plane.y, 0.0) : k.b;
            test.c = compares ? vec3(before ? plane.z : k.depth.z, before ? k.depth.z : plane.z, 0.0) : k.c;
            test.least = compares ? vec3(-3.4e38) : thresholds(k);
            test.depths = compares;
            vec2 low = before ? vec2(bounds.x, k.far) : vec2(k.far, bounds.x), high = before ? vec2(bounds.y, k.near) : vec2(k.near, bounds.y);
            test.low = compares ? low : vec2(-3.4e38);
            test.high = compares ? high : vec2(3.4e38);
            uvec2 holds = mask_of(test, at);
            holds = (compares && !before ? ~holds : holds) & all;

            // The trip either takes a new candidate, or moves samples between the current candidate and a slot.
            shared_ &= mask;
            uvec2 won = shared_ & holds;
            vec2 its_range = depth_range(k, at);
            plane = takes ? k.depth : plane;
            bounds = takes ? vec2(k.far, k.near) : bounds;
            range = takes ? its_range : range;
            id = takes ? k.id : id;
            index = takes ? fetched : index;
            taken = takes ? holds : taken;
            uvec2 shown = takes ? holds : uvec2(0u);
            if (HAS_MASK) {
                // Alpha is tested only at samples at which no nearer triangle hides the candidate.
                bool tested = takes && k.id > frame.first_mask;
                uvec2 open_ = tested ? shown : uvec2(0u);
                [[unroll]] for (int s = 0; s < SLOTS; s++) open_ &= range.y < seen[s].far ? ~seen[s].mask : uvec2(~0u);
                open_ = alpha_mask(tested ? k.id - 1u : 0u, open_, center, at);
                shown = tested ? open_ : shown;
                masked = takes ? tested : masked;
            }
            mask = compares ? mask & ~(shared_ & ~holds) : shown;
            wholes &= won != uvec2(0u) ? ~(1u << slot) : ~0u;
            failed = failed || (takes && holds != uvec2(0u) && !(its_range.y <= 1.0 && its_range.x > 0.0));
            uvec2 hidden = uvec2(0u);
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                bool behind = range.y < seen[s].far;
                seen[s].mask &= slot == uint(s) ? ~won : uvec2(~0u);
                uvec2 both = mask & seen[s].mask;
                hidden |= behind ? both : uvec2(0u);
                rivals |= takes && !behind && both != uvec2(0u) ? 1u << s : 0u;
            }
            mask &= ~hidden;
            bool shows = rivals == 0u && mask != uvec2(0u);
            failed = failed || (shows && used == uint(SLOTS));
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                bool here = shows && used == uint(s);
                seen[s].mask = here ? mask : seen[s].mask;
                seen[s].id = here ? id : seen[s].id;
                seen[s].index = here ? index : seen[s].index;
                seen[s].far = here ? range.x : seen[s].far;
            }
            wholes |= shows && !masked && taken == mask ? 1u << used : 0u;
            used += shows ? 1u : 0u;
            covered |= shows ? mask : uvec2(0u);
            deepest = shows ? min(deepest, range.x) : deepest;
            // An upper bound for the depths of remaining candidates, as in order.glsl.
            int next = keys[0] != 0 ? keys[0] : others ? limit : 0;
            bool behind = intBitsToFloat(next | int(INDEX)) * 1.000002 < deepest;
            done = done || failed || (rivals == 0u && behind && covered == all);
            rivals = failed ? 0u : rivals;
        } while (any_lane(rivals != 0u || (!done && keys[0] != 0)));
        more = !done && others;
    } while (any_lane(more));

    // Wholly visible triangles are weighted by their exact areas. The others share what is left, in proportion to their samples.
    uint slot = 0u, singles = 0u, records_made = 0u, several = 0u;
    if (EXACT_AREAS || BY_PART) {
        do {
            uvec2 mask = uvec2(0u);
            uint index = 0u, id = 0u;
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                bool here = slot == uint(s);
                mask = here ? seen[s].mask : mask;
                index = here ? seen[s].index : index;
                id = here ? seen[s].id : id;
            }
            bool some = mask != uvec2(0u);
            int area = 0;
            if (EXACT_AREAS) {
                Candidate k = load_candidate(first, min(index, max(count, 1u) - 1u), center);
                area = area_in_own_cell(k.a, k.b, k.a * at.x + k.b * at.y + k.c);
                bool trusted = some && (wholes >> slot & 1u) != 0u && float(area) * float(frame.sample_count) >= FEWEST * AREA_UNIT;
                area = trusted ? area : 0;
            }
            uint parts = PARTS_ONE;
            if (BY_PART) parts = some && high_frequency_triangle(id) ? parts_around(my_variation, id) : PARTS_ONE;
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                seen[s].area = slot == uint(s) ? area : seen[s].area;
                seen[s].parts = slot == uint(s) ? parts : seen[s].parts;
            }
            slot++;
        } while (any_lane(slot < used));
    }
    float share = 1.0, mend = 1.0;
    bool exact = false;
    float samples = float(frame.sample_count);
    if (EXACT_AREAS) {
        int whole_units = 0;
        uint whole_samples = 0u, sharing = covered != all ? 1u : 0u;
        bool small = false;             // a triangle is wholly visible, but its area is too small to be used
        [[unroll]] for (int s = 0; s < SLOTS; s++) {
            bool shares = seen[s].mask != uvec2(0u) && seen[s].area == 0;
            whole_units += seen[s].area;
            whole_samples += seen[s].area != 0 ? samples_of(seen[s].mask) : 0u;
            sharing += shares ? 1u : 0u;
            small = small || (shares && (wholes >> s & 1u) != 0u);
        }
        float whole_area = float(whole_units) * (1.0 / AREA_UNIT), left = samples - float(whole_samples);
        mend = left > 0.0 && whole_area <= 1.0 ? 1.0 : 1.0 / max(whole_area, 1e-6);
        share = max(1.0 - whole_area, 0.0) / max(left, 1.0);
        exact = abs(whole_area - float(whole_samples) / samples) <= AGREEMENT && !(small && sharing > 1u);
    }

    bool writes = exists && !failed;
    [[unroll]] for (int s = 0; s < SLOTS; s++) {
        uvec2 mask = writes ? seen[s].mask : uvec2(0u);
        bool single = seen[s].parts == PARTS_ONE;
        seen[s].id = mask != uvec2(0u) ? seen[s].id : ~0u;
        singles += single && mask != uvec2(0u) ? 1u : 0u;
        records_made += single ? min(samples_of(mask), 1u) : samples_of(runs_of(mask, part_length(seen[s].parts)));
        several |= single || mask == uvec2(0u) ? 0u : 1u << s;
    }
    bool fits;
    uint base = allocate_records(lanes_add(records_made), fits), mine = base + subgroupExclusiveAdd(records_made);
    if (writes) headers[min(header.z + cell, frame.record_capacity - 1u)] = uvec2(mine, fits ? records_made : 0u);
    uint cell_id = pixel.x | pixel.y << 16, at_record = mine, seen_id = 0u;
    do {
        // By ascending ID, so that records do not depend on the order of candidates.
        Seen t = Seen(uvec2(0u), ~0u, 0u, 0.0, 0, 0u);
        [[unroll]] for (int s = 0; s < SLOTS; s++) {
            bool least = seen[s].parts == PARTS_ONE && seen[s].id < t.id && seen[s].id > seen_id;
            t.id = least ? seen[s].id : t.id;
            t.mask = least ? seen[s].mask : t.mask;
            t.area = least ? seen[s].area : t.area;
        }
        seen_id = t.id;
        float of = float(samples_of(t.mask));
        float weight = EXACT_AREAS && exact ? samples * (t.area != 0 ? float(t.area) * (1.0 / AREA_UNIT) * mend : of * share) : of;
        if (fits && t.id != ~0u)
            records_out[at_record] = uvec4(cell_id, t.id, place_of_samples(sum_of_offsets(t.mask), of, samples, false), floatBitsToUint(weight));
        at_record += t.id != ~0u ? 1u : 0u;
        singles -= min(singles, 1u);
    } while (any_lane(singles != 0u));

    if (BY_PART) {
        uvec2 rest = uvec2(0u);     // samples of the current triangle that are not recorded yet
        uint id = 0u, parts = PARTS_ALL;
        float each = 0.0;
        do {
            bool next = rest == uvec2(0u);
            Seen t = Seen(uvec2(0u), ~0u, 0u, 0.0, 0, 0u);
            [[unroll]] for (int s = 0; s < SLOTS; s++) {
                bool least = (several >> s & 1u) != 0u && seen[s].id < t.id;
                t.id = least ? seen[s].id : t.id;
                t.index = least ? uint(s) : t.index;
                t.mask = least ? seen[s].mask : t.mask;
                t.area = least ? seen[s].area : t.area;
                t.parts = least ? seen[s].parts : t.parts;
            }
            several &= next && t.id != ~0u ? ~(1u << t.index) : ~0u;
            id = next ? t.id : id;
            rest = next ? t.mask : rest;
            parts = next ? t.parts : parts;
            float weight = EXACT_AREAS && exact ? samples * (t.area != 0 ? float(t.area) * (1.0 / AREA_UNIT) * mend / max(float(samples_of(t.mask)), 1.0) : share) : 1.0;
            each = next ? weight : each;
            // The samples of the first run that has samples left.
            bool upper = rest.x == 0u;
            uint length = part_length(parts);
            uint half_ = upper ? rest.y : rest.x, from = (half_ == 0u ? 0u : uint(findLSB(half_))) & ~(length - 1u);
            uint bits = half_ >> from & ((1u << length) - 1u);
            rest.x = upper ? 0u : rest.x & ~(bits << from);
            rest.y = upper ? rest.y & ~(bits << from) : rest.y;
            float of = float(bitCount(bits));
            vec2 sum = sum_of_run(from + (upper ? 32u : 0u), bits);
            if (fits && bits != 0u)
                records_out[at_record] = uvec4(cell_id, id, place_of_samples(sum, of, samples, part_is_wide(frame.sample_count, parts)), floatBitsToUint(of * each));
            at_record += bits != 0u ? 1u : 0u;
        } while (any_lane(rest != uvec2(0u) || several != 0u));
    }

    uint left = lanes_or(exists && failed ? 1u << bit : 0u);
    if (left != 0u && subgroupElect()) leave_cells(LIST, tile, left);
}
