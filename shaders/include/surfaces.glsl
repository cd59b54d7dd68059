// Records of the surfaces that the samples of a block see: one for each triangle, or (BY_PART) for each triangle and part of the
// block, or one for each sample.
#ifndef SURFACES_GLSL
#define SURFACES_GLSL
#include "area.glsl"
#include "records.glsl"
#include "variation.glsl"

// What a block of samples sees of one triangle.
struct Surface {
    uint id;                // ~0: no other triangle
    float samples;          // number of samples that see it
    vec2 sum;               // sum of their offsets
    uint parts;             // BY_PART: a bit for each part that sees it
};

// Number of surfaces that invocations hold, one each. It is the same for all subgroups of 8 or more, so that images of all these
// devices agree.
const uint HELD = LANES < 8u ? LANES : 8u;

// A block has at most 32 parts: runs of PART neighbouring samples (src/engine/passes/sample.rs chooses this length).
const uint PARTS_A_ROW = LANES > PART ? LANES / PART : 1u, ROWS_A_PART = PART > LANES ? PART / LANES : 1u;
const uint PART_LANES = PART < LANES ? PART : LANES, PART_ROWS = ROWS_A_PART < uint(ROWS) ? uint(ROWS) / ROWS_A_PART : 1u;

// The part that a sample of row `g` belongs to.
uint part_number(int g) {
    return PARTS_A_ROW > 1u ? uint(g) * PARTS_A_ROW + gl_SubgroupInvocationID / PART_LANES : uint(g) / ROWS_A_PART;
}

// What the block sees of the triangle with the least ID above `seen`.
Surface surface_after(uint seen) {
    Surface r = Surface(~0u, 0.0, vec2(0.0), 0u);
    [[unroll]] for (int g = 0; g < ROWS; g++) r.id = min(r.id, id[g] > seen ? id[g] : ~0u);
    r.id = lanes_min(r.id);
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        bool same = id[g] == r.id;
        r.samples += same ? 1.0 : 0.0;
        r.sum += same ? offset[g] : vec2(0.0);
        if (BY_PART) r.parts |= same ? 1u << part_number(g) : 0u;
    }
    r.samples = lanes_add(r.samples);
    r.sum = vec2(lanes_add(r.sum.x), lanes_add(r.sum.y));
    if (BY_PART) r.parts = lanes_or(r.parts);
    return r;
}

// Number of parts that an invocation holds.
const uint PARTS_HELD = PART_ROWS > PART_LANES ? PART_ROWS / PART_LANES : 1u;

// A step of summing rows over invocations: each invocation keeps half of its rows and gives the other half to another one. An
// invocation with a single row shares it.
void sum_rows(inout vec3 sums[ROWS], uint stage) {
    uint step = PART_LANES >> (stage + 1u), rows = PART_ROWS >> (stage + 1u);
    bool upper = (gl_SubgroupInvocationID & step) != 0u;
    [[unroll]] for (uint r = 0u; r < ROWS; r++) {
        if (step != 0u && r < max(rows, 1u)) {
            uint other = min(r + rows, ROWS - 1u);
            vec3 keep = rows > 0u && upper ? sums[other] : sums[r], give = rows > 0u && !upper ? sums[other] : sums[r];
            sums[r] = keep + vec3(subgroupShuffleXor(give.x, step), subgroupShuffleXor(give.y, step), subgroupShuffleXor(give.z, step));
        }
    }
}

// What each part sees of a triangle: the sum of the offsets of its samples, and their number. Rows are summed over the
// invocations of a part, and at the same time distributed among them: each step halves the rows that an invocation holds. In
// the end it holds PARTS_HELD of them. If several invocations share a row, only the first one holds it.
void parts_of(uint wanted, out vec3 sums[ROWS]) {
    uint lane = gl_SubgroupInvocationID;
    [[unroll]] for (int r = 0; r < ROWS; r++) sums[r] = vec3(0.0);
    [[unroll]] for (int g = 0; g < ROWS; g++)
        sums[uint(g) / ROWS_A_PART] += id[g] == wanted ? vec3(offset[g], 1.0) : vec3(0.0);
    // Written out: UNROLLED of workarounds.glsl.
    sum_rows(sums, 0u);
    sum_rows(sums, 1u);
    sum_rows(sums, 2u);
    sum_rows(sums, 3u);
    sum_rows(sums, 4u);
    const uint SHARING = PART_LANES > PART_ROWS ? PART_LANES / PART_ROWS : 1u;
    if (lane % SHARING != 0u) sums[0] = vec3(0.0);
}

// Merges pairs of neighbouring parts of `length` samples. The neighbour is held by another invocation or, if a part takes a row
// or more, by this one.
void merge_neighbours(inout vec3 parts[ROWS], uint length) {
    if (length < LANES) {
        bool keeps = (gl_SubgroupInvocationID & length) == 0u;
        [[unroll]] for (uint r = 0u; r < ROWS; r++) {
            if (r < PARTS_HELD) {
                vec3 other = vec3(subgroupShuffleXor(parts[r].x, length), subgroupShuffleXor(parts[r].y, length), subgroupShuffleXor(parts[r].z, length));
                parts[r] = keeps ? parts[r] + other : vec3(0.0);
            }
        }
    } else {
        [[unroll]] for (uint r = 0u; r < ROWS; r++) {
            uint other = r + length / LANES;
            if ((r & length / LANES) == 0u && other < PARTS_HELD) {
                parts[r] += parts[min(other, ROWS - 1u)];
                parts[min(other, ROWS - 1u)] = vec3(0.0);
            }
        }
    }
}

// Merges parts in pairs or in fours, or not at all, as `merged` (one of PARTS_) says.
void merge_parts(inout vec3 parts[ROWS], uint merged) {
    vec3 pairs[ROWS] = parts;
    merge_neighbours(pairs, PART);
    vec3 fours[ROWS] = pairs;
    merge_neighbours(fours, 2u * PART);
    [[unroll]] for (uint r = 0u; r < ROWS; r++) parts[r] = merged == PARTS_FOURS ? fours[r] : merged == PARTS_PAIRS ? pairs[r] : parts[r];
}

// The same for a set of parts, a bit each: the parts that are left after merging.
uint merge_bits(uint bits, uint merged) {
    uint pairs = (bits | bits >> 1) & 0x55555555u, fours = (pairs | pairs >> 2) & 0x11111111u;
    return merged == PARTS_FOURS ? fours : merged == PARTS_PAIRS ? pairs : bits;
}

// The surfaces of a block, by ascending ID. All members but the first are those of the surface that this invocation holds.
struct Surfaces {
    uint count;             // number of surfaces, which may exceed HELD
    uint id;
    uint place;
    float samples;
    uint parts;
    int area;
    bool whole;             // nothing hides a sample that it covers, so that its exact area is used
    bool small;             // the same, but its area is too small to be used
};

Surfaces surfaces_of(Cell cell) {
    uint lane = gl_SubgroupInvocationID;
    Surfaces r = Surfaces(0u, 0u, 0u, 0.0, 0u, 0, false, false);
    float left = 0.0;
    [[unroll]] for (int g = 0; g < ROWS; g++) left += id[g] != 0u ? 1.0 : 0.0;
    left = lanes_add(left);
    uint seen = 0u;
    do {
        Surface s = surface_after(seen);
        bool some = s.id != ~0u, mine = some && r.count == lane && lane < HELD;
        r.id = mine ? s.id : r.id;
        r.place = mine ? place_of(s.sum, s.samples) : r.place;
        r.samples = mine ? s.samples : r.samples;
        r.parts = mine ? s.parts : r.parts;
        if (EXACT_AREAS) {
            uint holders = subgroupBallot(nearby.id == s.id).x;
            uint holder = holders != 0u ? uint(findLSB(holders)) : 0u;
            Candidate t = shuffle_candidate(nearby, holder);
            // Edge functions of the samples' offsets, in whose coordinates the cell is a square.
            vec3 a = LOCATIONS ? t.a * cell.pixel[0].x + t.b * cell.pixel[0].y : t.a;
            vec3 b = LOCATIONS ? t.a * cell.pixel[1].x + t.b * cell.pixel[1].y : t.b;
            int area = area_in_cell(a, b, t.a * cell.at.x + t.b * cell.at.y + t.c, lane);
            bool whole = holders != 0u && subgroupShuffle(nearby_covered, holder) == s.samples;
            bool trusted = float(area) * float(cell.samples) >= FEWEST * AREA_UNIT;
            r.area = mine ? area : r.area;
            r.whole = mine ? whole && trusted : r.whole;
            r.small = mine ? whole && !trusted : r.small;
        }
        r.count += some ? 1u : 0u;
        left -= s.samples;
        seen = s.id;
    } while (left > 0.0);
    return r;
}

// The weight of the surface that an invocation holds, in samples of the pattern. `settled`: the cell needs no more samples.
float weigh(Surfaces s, uint samples, out bool settled) {
    settled = true;
    if (!EXACT_AREAS) return s.samples;
    // If there are more triangles than invocations can hold, all weights are numbers of samples.
    bool known = s.count <= HELD && nearby_count <= HELD;
    bool small = lanes_or(s.small ? 1u : 0u) != 0u;
    bool shares = s.samples > 0.0 && !s.whole;
    float whole_area = float(lanes_add(s.whole ? s.area : 0)) * (1.0 / AREA_UNIT);
    float whole_samples = lanes_add(s.whole ? s.samples : 0.0);
    float sharing = lanes_add(shares ? 1.0 : 0.0);
    float left = float(samples) - whole_samples;
    float background = left - lanes_add(shares ? s.samples : 0.0);
    sharing += background > 0.0 ? 1.0 : 0.0;
    float mend = left > 0.0 && whole_area <= 1.0 ? 1.0 : 1.0 / max(whole_area, 1e-6);
    float share = max(1.0 - whole_area, 0.0) / max(left, 1.0);
    bool agrees = abs(whole_area - whole_samples / float(samples)) <= AGREEMENT;
    bool exact = known && agrees && !(small && sharing > 1.0);
    settled = RUN != RUN_PROBE || (exact && sharing <= 1.0);
    float cell_weight = float(frame.sample_count);
    return exact ? cell_weight * (s.whole ? float(s.area) * (1.0 / AREA_UNIT) * mend : s.samples * share)
        : cell_weight / float(samples) * s.samples;
}

// Makes a record for each point that sees something; returns the first record and their number.
uvec2 record_points(Cell cell) {
    uint made = 0u;
    [[unroll]] for (int g = 0; g < ROWS; g++) made += subgroupBallotBitCount(subgroupBallot(id[g] != 0u));
    bool fits;
    uint base = allocate_records(made, fits), slot = base;
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        uvec4 seeing = subgroupBallot(id[g] != 0u);
        if (fits && id[g] != 0u)
            records_out[slot + subgroupBallotExclusiveBitCount(seeing)] = uvec4(location_of(cell, g) | POINT_VALUE, id[g], 0u, ~0u);
        slot += subgroupBallotBitCount(seeing);
    }
    return uvec2(base, fits ? made : 0u);
}

// Makes a record for each sample; returns the first record and their number.
uvec2 record_samples(Cell cell, uint cell_id) {
    bool fits;
    uint base = allocate_records(cell.samples, fits);
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        uint s = sample_of(g);
        if (fits && s < cell.samples)
            records_out[base + s] = POINTS ? uvec4(location_at(cell_id + s) | POINT_VALUE, id[g], 0u, ~0u)
                : uvec4(cell_id, id[g], place_of(offset[g], 1.0), floatBitsToUint(1.0));
    }
    return uvec2(base, fits ? cell.samples : 0u);
}

// Makes a record for each surface or part of one; returns the first record and their number. `settled`: the cell needs no more
// samples.
uvec2 record_surfaces(Cell cell, uint cell_id, out bool settled) {
    uint lane = gl_SubgroupInvocationID;
    Surfaces held = surfaces_of(cell);
    float weight = weigh(held, cell.samples, settled);
    bool holds = lane < min(held.count, HELD);
    uint shaded_in = PARTS_ALL;
    bool several = BY_PART && holds && high_frequency_triangle(held.id);
    if (BY_PART && !LOCATIONS) {
        shaded_in = parts_around(variation_of(cell.member), held.id);
        several = several && shaded_in != PARTS_ONE;
    }
    held.parts = merge_bits(held.parts, shaded_in);
    bool single = holds && !several;
    // A surface that is shaded in several places needs all samples, to choose the places from.
    settled = settled && (RUN != RUN_PROBE || !subgroupAny(several));
    trips += 2u * held.count;
    uint beyond = held.count - min(held.count, HELD);
    uint used = beyond + lanes_add(several ? uint(bitCount(held.parts)) : single ? 1u : 0u);
    bool fits;
    uint base = allocate_records(settled ? used : 0u, fits);
    fits = fits && settled;

    // Surfaces with one record: those that invocations hold are written at once, the others one by one.
    uvec4 singles = subgroupBallot(single);
    if (fits && single)
        records_out[base + subgroupBallotExclusiveBitCount(singles)] = uvec4(cell_id, held.id, held.place, floatBitsToUint(weight));
    uint slot = base + subgroupBallotBitCount(singles);
    uint seen = subgroupMax(held.id), stored = 0u;
    do {
        Surface s = surface_after(seen);
        if (fits && stored < beyond && subgroupElect())
            records_out[slot] = uvec4(cell_id, s.id, place_of(s.sum, s.samples), floatBitsToUint(s.samples));
        slot += stored < beyond ? 1u : 0u;
        seen = s.id;
    } while (++stored < beyond);
    if (BY_PART && RUN != RUN_PROBE) {
        float each = weight / max(held.samples, 1.0);
        uint pending = subgroupBallot(several).x;
        do {
            uint holder = pending != 0u ? uint(findLSB(pending)) : 0u;
            uint current = pending != 0u ? subgroupShuffle(held.id, holder) : ~0u;
            float weight_each = subgroupShuffle(each, holder);
            vec3 parts[ROWS];
            parts_of(current, parts);
            uint merged = subgroupShuffle(shaded_in, holder);
            merge_parts(parts, merged);
            bool wide = part_is_wide(frame.sample_count, merged);
            [[unroll]] for (uint h = 0u; h < ROWS; h++) {
                vec3 part = h < PARTS_HELD ? parts[h] : vec3(0.0);
                uint present = subgroupBallot(part.z != 0.0).x;
                if (fits && part.z != 0.0)
                    records_out[slot + uint(bitCount(present & ((1u << lane) - 1u)))] =
                        uvec4(cell_id, current, place_of_part(part.xy, part.z, wide), floatBitsToUint(part.z * weight_each));
                slot += uint(bitCount(present));
            }
            pending &= pending - 1u;
        } while (pending != 0u);
    }
    return uvec2(base, fits ? used : 0u);
}

#endif
