// Records of the surfaces that the samples of a block see: one for each triangle, or (BY_PART) for each triangle and part of the
// block, or one for each sample.
#ifndef SURFACES_GLSL
#define SURFACES_GLSL
#include "fragments.glsl"
#include "variation.glsl"
#include "fragment_spread.glsl"

// What a block of samples sees of one triangle.
struct Surface {
    uint id;                // ~0: no other triangle
    float samples;          // number of samples that see it
    vec2 sum;               // sum of their offsets
    uint parts;             // BY_PART: a bit for each part that sees it
    uvec4 spread;           // with a pixel filter: the spread of these samples
};

// A block has at most 32 parts: runs of PART neighbouring samples (src/engine/passes/sample.rs chooses this length).
const uint PARTS_A_ROW = TEAM > PART ? TEAM / PART : 1u, ROWS_A_PART = PART > TEAM ? PART / TEAM : 1u;
const uint PART_LANES = PART < TEAM ? PART : TEAM, PART_ROWS = ROWS_A_PART < ROWS ? ROWS / ROWS_A_PART : 1u;

// The part that a sample of row `g` belongs to.
uint part_number(uint g) {
    return PARTS_A_ROW > 1u ? g * PARTS_A_ROW + member() / PART_LANES : g / ROWS_A_PART;
}

// The spread of the samples in `rows`, a bit each. `samples` is the number of these samples in the whole team. Sums are of integers, so
// that teams of each size get the same.
uvec4 spread_of_rows(uint rows, float samples) {
    const float UNIT = 32767.0;
    int sums[8];
    [[unroll]] for (uint i = 0u; i < 8u; i++) sums[i] = 0;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        float own[8];
        spread_of(2.0 * offset[g], bent(offset[g]), own);
        [[unroll]] for (uint i = 0u; i < 8u; i++) sums[i] += (rows >> g & 1u) != 0u ? int(round(UNIT * own[i])) : 0;
    }
    float spread[8], each = 1.0 / (UNIT * max(samples, 1.0));
    [[unroll]] for (uint i = 0u; i < 8u; i++) spread[i] = float(int(team_add(uint(sums[i])))) * each;
    return pack_spread(spread);
}

// What the block sees of the triangle with the least ID above `seen`.
Surface surface_after(uint seen) {
    Surface r = Surface(~0u, 0.0, vec2(0.0), 0u, uvec4(0u));
    uint rows = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) r.id = min(r.id, id[g] > seen ? id[g] : ~0u);
    r.id = team_min(r.id);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        bool same = id[g] == r.id;
        r.samples += same ? 1.0 : 0.0;
        r.sum += same ? offset[g] : vec2(0.0);
        rows |= same ? 1u << g : 0u;
        if (BY_PART) r.parts |= same ? 1u << part_number(g) : 0u;
    }
    r.samples = team_add(r.samples);
    r.sum = vec2(team_add(r.sum.x), team_add(r.sum.y));
    if (BY_PART) r.parts = team_or(r.parts);
    if (SPREAD != SPREAD_NONE) r.spread = spread_of_rows(rows, r.samples);
    return r;
}

// Number of parts that a member holds.
const uint PARTS_HELD = PART_ROWS > PART_LANES ? PART_ROWS / PART_LANES : 1u;

// A step of summing rows over members: each member keeps half of its rows and gives the other half to another one. A
// member with a single row shares it.
void sum_rows(inout vec3 sums[ROWS], uint stage) {
    uint step = PART_LANES >> (stage + 1u), rows = PART_ROWS >> (stage + 1u);
    bool upper = (member() & step) != 0u;
    [[unroll]] for (uint r = 0u; r < ROWS; r++) {
        if (step != 0u && r < max(rows, 1u)) {
            uint other = min(r + rows, ROWS - 1u);
            vec3 keep = rows > 0u && upper ? sums[other] : sums[r], give = rows > 0u && !upper ? sums[other] : sums[r];
            sums[r] = keep + of_partner(give, step);
        }
    }
}

// What each part sees of a triangle: the sum of the offsets of its samples, and their number. Rows are summed over the
// members of a part, and at the same time distributed among them: each step halves the rows that a member holds. In
// the end it holds PARTS_HELD of them. If several members share a row, only the first one holds it.
void parts_of(uint wanted, out vec3 sums[ROWS]) {
    uint lane = member();
    [[unroll]] for (uint r = 0u; r < ROWS; r++) sums[r] = vec3(0.0);
    [[unroll]] for (uint g = 0u; g < ROWS; g++)
        sums[g / ROWS_A_PART] += id[g] == wanted ? vec3(offset[g], 1.0) : vec3(0.0);
    // Written out: UNROLLED of workarounds.glsl.
    sum_rows(sums, 0u);
    sum_rows(sums, 1u);
    sum_rows(sums, 2u);
    const uint SHARING = PART_LANES > PART_ROWS ? PART_LANES / PART_ROWS : 1u;
    if (lane % SHARING != 0u) sums[0] = vec3(0.0);
}

// The number of the part that a member holds in its place `held`, after these steps.
uint held_part(uint held) {
    uint row = held;
    [[unroll]] for (uint stage = 0u; stage < 3u; stage++) {
        uint step = PART_LANES >> (stage + 1u), rows = PART_ROWS >> (stage + 1u);
        row += step != 0u && (member() & step) != 0u ? rows : 0u;
    }
    return row * PARTS_A_ROW + member() / PART_LANES;
}

// Merges pairs of neighbouring parts of `length` samples. The neighbour is held by another member or, if a part takes a row
// or more, by this one.
void merge_neighbours(inout vec3 parts[ROWS], uint length) {
    if (length < TEAM) {
        bool keeps = (member() & length) == 0u;
        [[unroll]] for (uint r = 0u; r < ROWS; r++) {
            if (r < PARTS_HELD) {
                vec3 other = of_partner(parts[r], length);
                parts[r] = keeps ? parts[r] + other : vec3(0.0);
            }
        }
    } else {
        [[unroll]] for (uint r = 0u; r < ROWS; r++) {
            uint other = r + length / TEAM;
            if ((r & length / TEAM) == 0u && other < PARTS_HELD) {
                parts[r] += parts[min(other, ROWS - 1u)];
                parts[min(other, ROWS - 1u)] = vec3(0.0);
            }
        }
    }
}

// Merges parts in pairs or in fours, or not at all, as `merged` (one of PARTS_) says.
void merge_parts(inout vec3 parts[ROWS], uint merged) {
    vec3 pairs[ROWS], fours[ROWS];
    [[unroll]] for (uint r = 0u; r < ROWS; r++) pairs[r] = parts[r];
    merge_neighbours(pairs, PART);
    [[unroll]] for (uint r = 0u; r < ROWS; r++) fours[r] = pairs[r];
    merge_neighbours(fours, 2u * PART);
    [[unroll]] for (uint r = 0u; r < ROWS; r++) parts[r] = merged == PARTS_FOURS ? fours[r] : merged == PARTS_PAIRS ? pairs[r] : parts[r];
}

// The same for a set of parts, a bit each: the parts that are left after merging.
uint merge_bits(uint bits, uint merged) {
    uint pairs = (bits | bits >> 1) & 0x55555555u, fours = (pairs | pairs >> 2) & 0x11111111u;
    return merged == PARTS_FOURS ? fours : merged == PARTS_PAIRS ? pairs : bits;
}

// Surfaces of a block of which the team holds what it sees of them, and those that a member holds: numbers member() and, with teams
// of 4, member() + 4. Teams of each size hold as many, so that they make the same fragments.
const uint HELD = 8u, OWN_SURFACES = HELD / TEAM;

struct HeldSurface {
    uint id;                // 0: none
    uint place;
    float samples;
    uint parts;
    uvec4 spread;
};

// Finds the surfaces of a block, by ascending ID. Returns their number, which may exceed HELD.
uint find_surfaces(out HeldSurface held[OWN_SURFACES]) {
    [[unroll]] for (uint h = 0u; h < OWN_SURFACES; h++) held[h] = HeldSurface(0u, 0u, 0.0, 0u, uvec4(0u));
    float left = 0.0;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) left += id[g] != 0u ? 1.0 : 0.0;
    left = team_add(left);
    uint seen = 0u, count = 0u;
    do {
        Surface s = surface_after(seen);
        bool some = s.id != ~0u;
        [[unroll]] for (uint h = 0u; h < OWN_SURFACES; h++) {
            bool mine = some && count == h * TEAM + member();
            held[h].id = mine ? s.id : held[h].id;
            held[h].place = mine ? place_of(s.sum, s.samples) : held[h].place;
            held[h].samples = mine ? s.samples : held[h].samples;
            held[h].parts = mine ? s.parts : held[h].parts;
            if (SPREAD != SPREAD_NONE) held[h].spread = mine ? s.spread : held[h].spread;
        }
        count += some ? 1u : 0u;
        left -= s.samples;
        seen = s.id;
    } while (left > 0.0);
    return count;
}

// Makes a fragment for each point that sees something; returns the first fragment and their number.
uvec2 record_points(Cell cell) {
    uint made = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) made += uint(bitCount(team_ballot(id[g] != 0u)));
    bool fits;
    uint base = allocate_fragments(made, fits), slot = base;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        uint seeing = team_ballot(id[g] != 0u);
        if (fits && id[g] != 0u) fragments_out[slot + bits_before(seeing)] = uvec4(location_of(cell, g) | POINT_VALUE, id[g], 0u, ~0u);
        slot += uint(bitCount(seeing));
    }
    return uvec2(base, fits ? made : 0u);
}

// Makes a fragment for each sample; returns the first fragment and their number.
uvec2 record_samples(Cell cell) {
    bool fits;
    uint base = allocate_fragments(cell.samples, fits);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        uint s = sample_of(g);
        if (fits && s < cell.samples) {
            uint place = place_of(offset[g], 1.0);
            fragments_out[base + s] = uvec4(cell.id, id[g], place, floatBitsToUint(1.0));
            if (SPREAD != SPREAD_NONE) write_spread(base + s, spread_of_place(place));
        }
    }
    return uvec2(base, fits ? cell.samples : 0u);
}

// Makes a fragment for each surface or part of one; returns the first fragment and their number.
uvec2 record_surfaces(Cell cell) {
    HeldSurface held[OWN_SURFACES];
    uint count = find_surfaces(held), own = 0u, singles = 0u, several = 0u, greatest = 0u, shaded_in[OWN_SURFACES];
    Variation around;
    if (BY_PART && !LOCATIONS) around = variation_of(cell.member);
    [[unroll]] for (uint h = 0u; h < OWN_SURFACES; h++) {
        bool by_part = BY_PART && held[h].id != 0u && high_frequency_triangle(held[h].id);
        shaded_in[h] = BY_PART && !LOCATIONS ? parts_around(around, held[h].id) : PARTS_ALL;
        by_part = by_part && shaded_in[h] != PARTS_ONE;
        uint bit = held[h].id != 0u ? 1u << (h * TEAM + member()) : 0u;
        several |= by_part ? bit : 0u;
        singles |= by_part ? 0u : bit;
        own += by_part ? uint(bitCount(merge_bits(held[h].parts, shaded_in[h]))) : 0u;
        greatest = max(greatest, held[h].id);
    }
    trips += 2u * count;
    singles = team_or(singles);
    uint single_count = uint(bitCount(singles)), beyond = count - min(count, HELD), used = single_count + beyond + team_add(own);
    bool fits;
    uint base = allocate_fragments(used, fits);

    // Surfaces with one fragment: those that members hold are written at once, the others one by one.
    [[unroll]] for (uint h = 0u; h < OWN_SURFACES; h++) {
        uint bit = 1u << (h * TEAM + member()), before = uint(bitCount(singles & (bit - 1u)));
        if (fits && (singles & bit) != 0u) {
            fragments_out[base + before] = uvec4(cell.id, held[h].id, held[h].place, floatBitsToUint(held[h].samples));
            if (SPREAD != SPREAD_NONE) write_spread(base + before, held[h].spread);
        }
    }
    uint slot = base + single_count;
    uint seen = team_max(greatest), stored = 0u;
    do {
        Surface s = surface_after(seen);
        if (fits && stored < beyond && member() == 0u) {
            fragments_out[slot] = uvec4(cell.id, s.id, place_of(s.sum, s.samples), floatBitsToUint(s.samples));
            if (SPREAD != SPREAD_NONE) write_spread(slot, s.spread);
        }
        slot += stored < beyond ? 1u : 0u;
        seen = s.id;
    } while (++stored < beyond);
    if (BY_PART) {
        uint pending = team_or(several);
        do {
            uint holder = pending != 0u ? uint(findLSB(pending)) : 0u, current = 0u, merged = 0u, present = 0u;
            [[unroll]] for (uint h = 0u; h < OWN_SURFACES; h++) {
                uvec3 its = of_member(uvec3(held[h].id, shaded_in[h], held[h].parts), holder % TEAM);
                current = holder / TEAM == h ? its.x : current;
                merged = holder / TEAM == h ? its.y : merged;
                present = holder / TEAM == h ? its.z : present;
            }
            current = pending != 0u ? current : ~0u;
            present = pending != 0u ? merge_bits(present, merged) : 0u;
            vec3 parts[ROWS];
            parts_of(current, parts);
            merge_parts(parts, merged);
            bool wide = part_is_wide(frame.sample_count, merged);
            [[unroll]] for (uint h = 0u; h < ROWS; h++) {
                vec3 part = h < PARTS_HELD ? parts[h] : vec3(0.0);
                uint before = uint(bitCount(present & ((1u << held_part(h)) - 1u)));
                if (fits && part.z != 0.0) {
                    uint place = place_of_part(part.xy, part.z, wide);
                    fragments_out[slot + before] = uvec4(cell.id, current, place, floatBitsToUint(part.z));
                    if (SPREAD != SPREAD_NONE) write_spread(slot + before, spread_of_place(place));
                }
            }
            slot += uint(bitCount(present));
            pending &= pending - 1u;
        } while (pending != 0u);
    }
    return uvec2(base, fits ? used : 0u);
}

#endif
