// merge: merges visibility samples of a superpixel that see the same triangle and that the same lights reach, so that they are
// shaded together at their centroid. BY_PART: if the triangle is HIGH_FREQUENCY, only samples of the same part of the superpixel,
// as `sample` does it without shadows.
// A team takes an entry of a work list, and its cells one after the other. A member holds ROWS samples of a block. There are no
// BLEND triangles, so that a place has one shadow word.
// Reads: tile_lists, ids, display, tiles, masks, headers, fragments, shadow_words. Writes: headers, fragments, words.
// Twin: twins/src/merge.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/work.glsl"
#include "include/place.glsl"
#include "include/shadows.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = MERGE_CONSTANT_ROWS) const uint ROWS = 8u;
layout(constant_id = MERGE_CONSTANT_LIST) const uint LIST = 0u;
layout(constant_id = MERGE_CONSTANT_BY_PART) const bool BY_PART = false;
layout(constant_id = MERGE_CONSTANT_PART) const uint PART = 8u;             // samples of a part
const bool LEFT_CELLS = false;
#define CELLS_AT_ONCE CELLS_OF_ENTRY
#include "include/taken.glsl"
#include "include/variation.glsl"
layout(std430, set = SET_BESIDE_FRAME, binding = MERGE_BINDING_WORDS) writeonly buffer ShadowWords { uint words[]; };

const uint BLOCK = ROWS * TEAM;

// The parts in which a triangle is shaded.
uint parts_of_triangle(Variation around, uint id) {
    if (!BY_PART || !high_frequency_triangle(id)) return PARTS_ONE;
    return LOCATIONS ? PARTS_ALL : parts_around(around, id);
}

// Merges `count` fragments from `first` on, by ascending triangle, shadow word and part. Returns how many there are then. Those
// behind them see nothing. All members have read what they merge before the first fragment is written, since what that says depends
// on all of it.
uint merge_block(uint first, uint count, Variation around) {
    uint id[ROWS], word[ROWS];
    uvec2 offset[ROWS];         // in units of 2^-12 of the cell's sides, from its corner
    uint left = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        uint s = g * TEAM + member(), at = first + (s < count ? s : 0u);
        uvec2 fragment = texelFetch(fragments, int(at)).yz;
        id[g] = fragment.x;
        word[g] = shadows_at(place_of_fragment(at));
        offset[g] = uvec2(place_location(fragment.y) * 4096.0 + 2048.0);
        left |= s < count && id[g] != 0u ? 1u << g : 0u;
    }
    uint cell = texelFetch(fragments, int(first)).x, made = 0u, remaining = team_add(uint(bitCount(left)));
    do {
        uvec3 least = uvec3(~0u, ~0u, 0u);
        [[unroll]] for (uint g = 0u; g < ROWS; g++) least.x = min(least.x, (left >> g & 1u) != 0u ? id[g] : ~0u);
        least.x = team_min(least.x);
        [[unroll]] for (uint g = 0u; g < ROWS; g++) least.y = min(least.y, (left >> g & 1u) != 0u && id[g] == least.x ? word[g] : ~0u);
        least.y = team_min(least.y);
        bool some = remaining != 0u;
        uint parts = parts_of_triangle(around, some ? least.x : 0u), alike = 0u;
        uint log = uint(findMSB(parts == PARTS_ONE ? BLOCK : part_length(parts)));
        [[unroll]] for (uint g = 0u; g < ROWS; g++)
            alike |= (left >> g & 1u) != 0u && id[g] == least.x && word[g] == least.y ? 1u << g : 0u;
        if (BY_PART) {
            least.z = ~0u;
            [[unroll]] for (uint g = 0u; g < ROWS; g++) least.z = min(least.z, (alike >> g & 1u) != 0u ? (g * TEAM + member()) >> log : ~0u);
            least.z = team_min(least.z);
            [[unroll]] for (uint g = 0u; g < ROWS; g++) alike &= (g * TEAM + member()) >> log == least.z ? ~0u : ~(1u << g);
        }
        uvec2 sums = uvec2(0u);     // of their offsets; above x, their number
        [[unroll]] for (uint g = 0u; g < ROWS; g++) sums += (alike >> g & 1u) != 0u ? offset[g] + uvec2(1u << 20, 0u) : uvec2(0u);
        left &= ~alike;
        sums = team_add(sums);
        uint samples = sums.x >> 20;
        if (some && member() == 0u) {
            bool wide = parts != PARTS_ONE && part_is_wide(frame.sample_count, parts);
            vec2 sum = vec2(sums & 0xfffffu) * (1.0 / 4096.0) - 0.5 * float(samples);
            uint place = place_of_samples(sum, float(samples), float(frame.sample_count), wide);
            fragments_out[first + made] = uvec4(cell, least.x, place, floatBitsToUint(float(samples)));
            words[place_of_fragment(first + made)] = least.y;
        }
        made += some ? 1u : 0u;
        remaining -= samples;
    } while (remaining != 0u);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        uint s = g * TEAM + member();
        if (s >= made && s < count) fragments_out[first + s].y = 0u;
    }
    return made;
}

void main() {
    Taken taken = take_cells(team_number(), 0u);
    if (!taken.exists) return;
    if (BY_PART && !LOCATIONS) my_variation = variation_around(pixel_of_cell(taken, my_bit));
    uint blocks = (frame.sample_count + BLOCK - 1u) / BLOCK, holder = 0u;
    do {
        Variation around;
        if (BY_PART && !LOCATIONS) around = variation_of(holder);
        uint first_header = taken.tile.z + number_of_cell(taken, of_member(my_bit, holder)) * blocks, block = 0u;
        do {
            uint at = min(first_header + block, frame.fragment_capacity - 1u);
            uvec2 h = headers[at];
            h.y = h.y == LEFT_BLOCK ? 0u : h.y;
            uint made = merge_block(h.x, h.y, around);
            if (h.y != 0u && member() == 0u) headers[at] = uvec2(h.x, made);
        } while (++block < blocks);
    } while (++holder < taken.cells);
}
