// sample: the nearest triangle of every sub-sample of every superpixel of a list of tiles.
// Reads: tiles, masks, tile_lists, candidates (or, UNLISTED, every triangle), locations.
// Writes: records, headers. No colour is known here.
//
// A subgroup takes a tile, cell by cell. First an invocation holds a candidate: a conservative test against
// the cell's square, and the depth behind which nothing shows because a triangle covers the whole square.
// Then an invocation holds ROWS samples, with their depth and ID in registers, and the survivors pass by.
// Ties in depth go to the smaller ID, so that the order of candidates does not matter.
//
// Record: pixel (x | y << 16), triangle ID, location relative to the pixel's centre (2 x 16 bits, 2^-16 pixels), and
//   merged: number of covered samples; one record a visible triangle a block, in order of ID, at their centroid
//           (PER_SAMPLE: one a sample, at its location, number 1);
//   CHAINED: index of the next nearer BLEND layer of the sample, or ~0; the first records of a block are its
//           samples' opaque surfaces (ID 0: background).
// Header of a cell's block: first record, number of records (CHAINED: of samples).
//
// Loops are do-while with guarded bodies: on lavapipe a branch skips nothing and other loops run once too often.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint LANES = 8u;          // subgroup size
layout(constant_id = 2) const bool PER_SAMPLE = false;
layout(constant_id = 3) const bool HAS_MASK = false;
layout(constant_id = 4) const uint LIST = 0u;           // which of the tile lists

#include "include/alpha.glsl"

const uint BLOCK = ROWS * LANES;
const float CELL_REACH = 0.5 + 1.0 / 64.0;              // half a cell, and some rounding
const float OUTSIDE = 1.1754944e-38;                    // the least E of a sample off the owning side

struct Candidate { vec3 a, b, c, depth; float near, far; uint id; };

Candidate load_candidate(uint first, uint index, vec2 center) {
    Candidate k;
#ifdef UNLISTED
    uvec4 indices = texelFetch(triangles, int(index));
    vec4 v0 = texelFetch(clip, int(indices.x)), v1 = texelFetch(clip, int(indices.y)), v2 = texelFetch(clip, int(indices.z));
    Setup s = setup_triangle(v0, v1, v2, center, (indices.w >> 31) == 0u);
    bool usable = s.valid && !footprint_of(v0, v1, v2).outside;
    k.a = s.a; k.b = s.b; k.c = usable ? s.c : vec3(-3.4e38);
    k.depth = s.depth; k.near = s.near; k.far = s.far; k.id = index + 1u;
#else
    int o = int(first + index) * 4;
    vec4 q0 = texelFetch(candidates, o), q1 = texelFetch(candidates, o + 1), q2 = texelFetch(candidates, o + 2), q3 = texelFetch(candidates, o + 3);
    k.a = vec3(q0.x, q0.w, q1.z); k.b = vec3(q0.y, q1.x, q1.w); k.c = vec3(q0.z, q1.y, q2.x);
    k.depth = q2.yzw; k.near = q3.x; k.far = q3.y; k.id = floatBitsToUint(q3.z);
#endif
    return k;
}

Candidate shuffle_candidate(Candidate k, uint lane) {
    Candidate r;
    r.a = vec3(subgroupShuffle(k.a.x, lane), subgroupShuffle(k.a.y, lane), subgroupShuffle(k.a.z, lane));
    r.b = vec3(subgroupShuffle(k.b.x, lane), subgroupShuffle(k.b.y, lane), subgroupShuffle(k.b.z, lane));
    r.c = vec3(subgroupShuffle(k.c.x, lane), subgroupShuffle(k.c.y, lane), subgroupShuffle(k.c.z, lane));
    r.depth = vec3(subgroupShuffle(k.depth.x, lane), subgroupShuffle(k.depth.y, lane), subgroupShuffle(k.depth.z, lane));
    r.near = subgroupShuffle(k.near, lane);
    r.far = subgroupShuffle(k.far, lane);
    r.id = subgroupShuffle(k.id, lane);
    return r;
}

// Least value of each edge function inside: the owning side of an edge includes E = 0.
vec3 thresholds(Candidate k) {
    return vec3(
        k.a.x > 0.0 || (k.a.x == 0.0 && k.b.x > 0.0) ? 0.0 : OUTSIDE,
        k.a.y > 0.0 || (k.a.y == 0.0 && k.b.y > 0.0) ? 0.0 : OUTSIDE,
        k.a.z > 0.0 || (k.a.z == 0.0 && k.b.z > 0.0) ? 0.0 : OUTSIDE);
}

bool covers(Candidate k, vec3 least, vec2 p, out float depth) {
    precise float e0 = k.a.x * p.x + k.b.x * p.y + k.c.x;
    precise float e1 = k.a.y * p.x + k.b.y * p.y + k.c.y;
    precise float e2 = k.a.z * p.x + k.b.z * p.y + k.c.z;
    precise float d = k.depth.x * p.x + k.depth.y * p.y + k.depth.z;
    depth = clamp(d, k.far, k.near);
    return e0 >= least.x && e1 >= least.y && e2 >= least.z && depth <= 1.0;
}

uint pack_location(vec2 offset) {
    ivec2 q = clamp(ivec2(round(offset * 65536.0)), ivec2(-32768), ivec2(32767));
    return uint(q.x & 0xffff) | uint(q.y) << 16;
}

void main() {
    uint tile_count = frame.tiles.x * frame.tiles.y;
    uint entry = gl_WorkGroupID.x + gl_WorkGroupID.y * 32768u;
    uint entries = counters[COUNTER_PLAIN_TILES + LIST];
    if (entry >= entries) return;
    uint lane = gl_SubgroupInvocationID;
    uint tile = tile_lists[LIST * tile_count + entry];
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(tile % frame.tiles.x, tile / frame.tiles.x);
    vec2 center = tile_center(tile_at);
    uint word = masks[tile];
#ifdef UNLISTED
    uint count = frame.triangle_count, first = 0u;
#else
    uint count = header.w >> TILE_COUNT_SHIFT, first = header.y;
#endif
    uint chunks = max((count + LANES - 1u) / LANES, 1u);
    uint cells = bitCount(word);
    uint blocks = (frame.sample_count + BLOCK - 1u) / BLOCK;

    uint block = 0u;
    do {
        vec2 offset[ROWS];
        [[unroll]] for (int g = 0; g < ROWS; g++)
            offset[g] = texelFetch(locations, int(min(block * BLOCK + uint(g) * LANES + lane, frame.sample_count - 1u))).xy;
        uint block_samples = min(frame.sample_count - block * BLOCK, BLOCK);

        uint rest = word, cell = 0u;
        do {
            uint bit = uint(findLSB(rest));
            rest &= rest - 1u;
            vec2 in_tile = vec2(bit & 7u, bit >> 3);
            vec2 at = in_tile - vec2(3.5, 1.5);
            uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(in_tile);

            float depth[ROWS];
            uint id[ROWS];
            [[unroll]] for (int g = 0; g < ROWS; g++) { depth[g] = 0.0; id[g] = 0u; }
            float hidden = 0.0;     // nothing farther than this shows in the cell
            uint passed = 0u;

            uint chunk = 0u;
            do {
                uint index = chunk * LANES + lane;
                bool exists = index < count;
                Candidate k = load_candidate(first, min(index, max(count, 1u) - 1u), center);
                vec3 e = k.a * at.x + k.b * at.y + k.c;
                vec3 reach = CELL_REACH * (abs(k.a) + abs(k.b));
                float middle = k.depth.x * at.x + k.depth.y * at.y + k.depth.z;
                float slope = CELL_REACH * (abs(k.depth.x) + abs(k.depth.y)) + abs(middle) * 1e-6;
                bool touches = exists && min(e.x + reach.x, min(e.y + reach.y, e.z + reach.z)) >= 0.0;
                bool blend = k.id > frame.first_blend;
                bool mask_ = HAS_MASK && k.id > frame.first_mask && !blend;
                bool spans = touches && !blend && !mask_ && k.near <= 1.0
                    && min(e.x - reach.x, min(e.y - reach.y, e.z - reach.z)) > 0.0;
                hidden = max(hidden, subgroupMax(spans ? max(middle - slope, k.far) : 0.0));
                touches = touches && !blend && min(middle + slope, k.near) >= hidden;

                uint pending = subgroupBallot(touches && !mask_).x;
                passed += uint(bitCount(pending));
                do {
                    bool some = pending != 0u;
                    Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                    pending &= pending - 1u;
                    vec3 least = some ? thresholds(t) : vec3(3.4e38);
                    [[unroll]] for (int g = 0; g < ROWS; g++) {
                        float d;
                        bool inside = covers(t, least, at + offset[g], d);
                        bool wins = inside && (d > depth[g] || (d == depth[g] && t.id < id[g]));
                        depth[g] = wins ? d : depth[g];
                        id[g] = wins ? t.id : id[g];
                    }
                } while (pending != 0u);

                if (HAS_MASK) {
                    pending = subgroupBallot(touches && mask_).x;
                    passed += uint(bitCount(pending));
                    do {
                        bool some = pending != 0u;
                        Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                        pending &= pending - 1u;
                        vec3 least = some ? thresholds(t) : vec3(3.4e38);
                        float cutoff = alpha_cutoff(t.id - 1u);
                        [[unroll]] for (int g = 0; g < ROWS; g++) {
                            float d;
                            bool inside = covers(t, least, at + offset[g], d);
                            bool wins = inside && (d > depth[g] || (d == depth[g] && t.id < id[g]));
                            wins = wins && alpha_at(t.id - 1u, center + at + offset[g]) >= cutoff;
                            depth[g] = wins ? d : depth[g];
                            id[g] = wins ? t.id : id[g];
                        }
                    } while (pending != 0u);
                }
            } while (++chunk < chunks);

            uint header_index = header.z + cell * blocks + block;
            uint packed_pixel = pixel.x | pixel.y << 16;

#ifdef CHAINED
            uint base = 0u;
            if (subgroupElect()) base = atomicAdd(counters[COUNTER_RECORDS], block_samples);
            base = subgroupBroadcastFirst(base);
            if (subgroupElect()) headers[min(header_index, frame.record_capacity - 1u)] = uvec2(base, block_samples);
            uint lost = base + block_samples > frame.record_capacity ? 1u : 0u;
            uint node[ROWS];
            bool live[ROWS];
            [[unroll]] for (int g = 0; g < ROWS; g++) {
                uint s = uint(g) * LANES + lane;
                live[g] = s < block_samples;
                node[g] = base + s;
            }
            // Layers from the farthest to the nearest: each round finds the next one in front.
            bool more;
            do {
                float next_depth[ROWS];
                uint next_id[ROWS];
                [[unroll]] for (int g = 0; g < ROWS; g++) { next_depth[g] = 3.4e38; next_id[g] = 0u; }
                chunk = 0u;
                do {
                    uint index = chunk * LANES + lane;
                    bool exists = index < count;
                    Candidate k = load_candidate(first, min(index, max(count, 1u) - 1u), center);
                    vec3 e = k.a * at.x + k.b * at.y + k.c;
                    vec3 reach = CELL_REACH * (abs(k.a) + abs(k.b));
                    bool touches = exists && k.id > frame.first_blend && min(e.x + reach.x, min(e.y + reach.y, e.z + reach.z)) >= 0.0;
                    uint pending = subgroupBallot(touches).x;
                    do {
                        bool some = pending != 0u;
                        Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                        pending &= pending - 1u;
                        vec3 least = some ? thresholds(t) : vec3(3.4e38);
                        [[unroll]] for (int g = 0; g < ROWS; g++) {
                            float d;
                            bool inside = covers(t, least, at + offset[g], d) && d > 0.0;
                            bool in_front = id[g] == 0u ? d > depth[g] : d > depth[g] || (d == depth[g] && t.id < id[g]);
                            bool nearest = d < next_depth[g] || (d == next_depth[g] && t.id > next_id[g]);
                            bool wins = inside && in_front && nearest;
                            next_depth[g] = wins ? d : next_depth[g];
                            next_id[g] = wins ? t.id : next_id[g];
                        }
                    } while (pending != 0u);
                } while (++chunk < chunks);

                uint found = 0u;
                [[unroll]] for (int g = 0; g < ROWS; g++) found += live[g] && next_id[g] != 0u ? 1u : 0u;
                uint before = subgroupExclusiveAdd(found), total = subgroupAdd(found);
                uint layer = 0u;
                if (subgroupElect() && total != 0u) layer = atomicAdd(counters[COUNTER_RECORDS], total);
                layer = subgroupBroadcastFirst(layer);
                bool full = layer + total > frame.record_capacity;
                lost += full && total != 0u ? 1u : 0u;
                uint slot = layer + before;
                more = false;
                [[unroll]] for (int g = 0; g < ROWS; g++) {
                    bool extends = live[g] && next_id[g] != 0u && !full;
                    if (live[g] && node[g] < frame.record_capacity)
                        imageStore(records_out, int(node[g]), uvec4(packed_pixel, id[g], pack_location(offset[g]), extends ? slot : ~0u));
                    node[g] = extends ? slot : node[g];
                    slot += extends ? 1u : 0u;
                    depth[g] = extends ? next_depth[g] : depth[g];
                    id[g] = extends ? next_id[g] : id[g];
                    live[g] = extends;
                    more = more || extends;
                }
                more = subgroupAny(more);
            } while (more);
            if (subgroupElect() && lost != 0u) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
#else
            // A sample sees at most one triangle, a triangle makes at most one record.
            uint wanted = PER_SAMPLE ? block_samples : min(passed, block_samples);
            uint base = 0u;
            if (subgroupElect()) base = atomicAdd(counters[COUNTER_RECORDS], wanted);
            base = subgroupBroadcastFirst(base);
            bool fits = base + wanted <= frame.record_capacity;
            if (subgroupElect() && !fits) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
            [[unroll]] for (int g = 0; g < ROWS; g++)
                id[g] = uint(g) * LANES + lane < block_samples ? id[g] : 0u;
            uint used = 0u;
            if (PER_SAMPLE) {
                [[unroll]] for (int g = 0; g < ROWS; g++) {
                    uint s = uint(g) * LANES + lane;
                    if (fits && s < block_samples)
                        imageStore(records_out, int(base + s), uvec4(packed_pixel, id[g], pack_location(offset[g]), 1u));
                }
                used = fits ? block_samples : 0u;
            } else {
                uint current = ~0u;
                [[unroll]] for (int g = 0; g < ROWS; g++) current = min(current, id[g] - 1u);
                current = subgroupMin(current);
                uvec4 held = uvec4(0u);
                do {
                    bool some = current != ~0u;
                    uint seen = current + 1u;
                    float n = 0.0;
                    vec2 sum = vec2(0.0);
                    [[unroll]] for (int g = 0; g < ROWS; g++) {
                        bool same = id[g] == seen;
                        n += same ? 1.0 : 0.0;
                        sum += same ? offset[g] : vec2(0.0);
                    }
                    n = subgroupAdd(n);
                    sum = vec2(subgroupAdd(sum.x), subgroupAdd(sum.y));
                    uvec4 record = uvec4(packed_pixel, seen, pack_location(sum / n), uint(n));
                    held = some && used % LANES == lane ? record : held;
                    used += some ? 1u : 0u;
                    bool flush = some && used % LANES == 0u;
                    if (flush && fits) imageStore(records_out, int(base + used - LANES + lane), held);
                    current = ~0u;
                    [[unroll]] for (int g = 0; g < ROWS; g++) current = min(current, id[g] > seen ? id[g] - 1u : ~0u);
                    current = some ? subgroupMin(current) : ~0u;
                } while (current != ~0u);
                uint kept = used - used % LANES;
                if (fits && lane < used - kept) imageStore(records_out, int(base + kept + lane), held);
                // Slots reserved for candidates that show nowhere are empty.
                uint empty = used + lane;
                while (empty < wanted) {
                    if (fits) imageStore(records_out, int(base + empty), uvec4(packed_pixel, 0u, 0u, 0u));
                    empty += LANES;
                }
                used = fits ? used : 0u;
            }
            if (subgroupElect()) headers[min(header_index, frame.record_capacity - 1u)] = uvec2(base, used);
#endif
        } while (++cell < cells);
    } while (++block < blocks);
}
