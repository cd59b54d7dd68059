// sample: the nearest triangle of every sub-sample of every superpixel of a list of tiles.
// Reads: tiles, masks, tile_lists, candidates (or, UNLISTED, every triangle), locations.
// Writes: records, headers. No colour is known here.
//
// A subgroup takes LANES cells of a tile. First an invocation holds a cell and the tile's candidates pass by:
// a conservative test against the cell's square keeps a short list, and the nearest triangle that covers the whole
// square hides what lies behind it. Then, cell by cell, an invocation holds ROWS samples, with their depth and ID in
// registers, and the short list passes by. A list that outgrows its room is replaced by all candidates of the tile.
// Ties in depth go to the smaller ID, so that the order of candidates does not matter.
//
// Coverage. A triangle that loses none of the samples that it covers is taken to be seen whole, and weighs the exact
// area of its part of the cell; what is left is shared by the others in proportion to their samples. Small areas are
// left to samples: to trust those that happen to be met would lose those that are not. With many samples
// to take, a first run PROBEs each cell with few: where at most one surface is left to share, that is exact, and only
// the REST takes all samples.
//
// Record: pixel (x | y << 16), triangle ID, location relative to the pixel's centre (2 x 16 bits, 2^-16 pixels), and
//   merged: weight as a float, in samples; one record a visible triangle and block, at the centroid of its samples there
//           (BY_PART: and an eighth of the block; PER_SAMPLE: one a sample, at its location);
//   CHAINED: index of the next nearer BLEND layer of the sample, or ~0; the first records of a block are its
//           samples' opaque surfaces (ID 0: background).
// Where cells are SITES, the first word of a record is its site; POINTS make a record a sample, of location 0.
// Header of a cell's block: first record, number of records (CHAINED: of samples).
//
// Loops are do-while with guarded bodies: on lavapipe a branch skips nothing and other loops run once too often.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
#include "include/sites.glsl"
layout(local_size_x_id = 0) in;
layout(constant_id = 2) const bool PER_SAMPLE = false;
layout(constant_id = 3) const bool HAS_MASK = false;
layout(constant_id = 4) const uint LIST = 0u;           // which of the tile lists
layout(constant_id = 5) const uint RUN = 0u;
layout(constant_id = 6) const bool BY_PART = false;     // records for each part of a block, to shade at
layout(constant_id = 7) const bool EXACT_AREAS = false;
layout(constant_id = 8) const uint HEADER_SAMPLES = 0u; // samples that a header stands for
layout(constant_id = 9) const bool APART = false;       // a subgroup takes one block of one cell, not all of several
const uint WHOLE = 0u, PROBE = 1u, REST = 2u;           // RUN: all samples at once; few; all, in the cells that are left

#include "include/lanes.glsl"
#include "include/area.glsl"
#include "include/alpha.glsl"

const uint BLOCK = ROWS * LANES;
const float CELL_REACH = 0.5 + 1.0 / 64.0;              // half a cell, and some rounding
const uint KEPT = 96u;                                  // room for candidates of a cell
const uint PROBES = 64u;                                // samples of a PROBE, in one block; they follow the others
const float FEWEST = 6.0;                               // samples that an area to be trusted is worth
const float AGREEMENT = 0.1;                            // of areas and samples, in cells
// Mesa's CPU driver ends all loops of an invocation after 65,535 trips in all; what takes more is reported instead.
const uint MOST_TRIPS = 50000u, LONGEST_LIST = 40000u;
const float OUTSIDE = 1.1754944e-38;                    // the least E of a sample off the owning side

shared uint kept[32 * KEPT];                            // by invocation, then entry

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
    uvec4 last = texelFetch(candidates, o + 3);
    vec4 q0 = uintBitsToFloat(texelFetch(candidates, o)), q1 = uintBitsToFloat(texelFetch(candidates, o + 1));
    vec4 q2 = uintBitsToFloat(texelFetch(candidates, o + 2)), q3 = uintBitsToFloat(last);
    k.a = vec3(q0.x, q0.w, q1.z); k.b = vec3(q0.y, q1.x, q1.w); k.c = vec3(q0.z, q1.y, q2.x);
    k.depth = q2.yzw; k.near = q3.x; k.far = q3.y; k.id = last.z;
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

// What `covers` and `area_in_cell` need of one of two candidates.
Candidate choose(bool first, Candidate a, Candidate b) {
    Candidate r = b;
    r.a = mix(b.a, a.a, bvec3(first));
    r.b = mix(b.b, a.b, bvec3(first));
    r.c = mix(b.c, a.c, bvec3(first));
    r.id = first ? a.id : b.id;
    return r;
}

// Least value of each edge function inside: the owning side of an edge includes E = 0.
vec3 thresholds(Candidate k) {
    return vec3(
        k.a.x > 0.0 || (k.a.x == 0.0 && k.b.x > 0.0) ? 0.0 : OUTSIDE,
        k.a.y > 0.0 || (k.a.y == 0.0 && k.b.y > 0.0) ? 0.0 : OUTSIDE,
        k.a.z > 0.0 || (k.a.z == 0.0 && k.b.z > 0.0) ? 0.0 : OUTSIDE);
}

bool inside(Candidate k, vec3 least, vec2 p) {
    precise float e0 = k.a.x * p.x + k.b.x * p.y + k.c.x;
    precise float e1 = k.a.y * p.x + k.b.y * p.y + k.c.y;
    precise float e2 = k.a.z * p.x + k.b.z * p.y + k.c.z;
    return e0 >= least.x && e1 >= least.y && e2 >= least.z;
}

bool covers(Candidate k, vec3 least, vec2 p, out float depth) {
    precise float d = k.depth.x * p.x + k.depth.y * p.y + k.depth.z;
    depth = clamp(d, k.far, k.near);
    return inside(k, least, p) && depth <= 1.0;
}

// A candidate against a cell's square.
struct CellTest {
    bool touches;
    float near;     // its nearest depth there
    float hides;    // where it covers the whole square with an opaque surface: its farthest depth there, otherwise 0
};

// `half_side` is that of a cell of SITES.
CellTest test_cell(Candidate k, vec2 at, vec2 half_side) {
    vec3 e = k.a * at.x + k.b * at.y + k.c;
    vec3 reach = SITES ? half_side.x * abs(k.a) + half_side.y * abs(k.b) : CELL_REACH * (abs(k.a) + abs(k.b));
    float middle = k.depth.x * at.x + k.depth.y * at.y + k.depth.z;
    float span = SITES ? dot(half_side, abs(k.depth.xy)) : CELL_REACH * (abs(k.depth.x) + abs(k.depth.y));
    float slope = span + abs(middle) * 1e-6;
    CellTest r;
    r.touches = min(e.x + reach.x, min(e.y + reach.y, e.z + reach.z)) >= 0.0;
    r.near = min(middle + slope, k.near);
    bool spans = k.id <= (HAS_MASK ? frame.first_mask : frame.first_blend) && k.near <= 1.0
        && min(e.x - reach.x, min(e.y - reach.y, e.z - reach.z)) > 0.0;
    r.hides = spans ? max(middle - slope, k.far) : 0.0;
    return r;
}

// Position of a sample from the tile's centre, and what its record belongs to.
#define PLACE(g) (SITES ? place[g] : at + offset[g])
#define OWNER(g) (POINTS ? packed_pixel + uint(g) * LANES + lane : packed_pixel)

// Index of entry `i` of a cell's candidates.
uint kept_or_all(bool complete, uint member, uint i, uint entries) {
    uint clamped = min(i, max(entries, 1u) - 1u);
    return complete ? kept[member * KEPT + min(clamped, KEPT - 1u)] : clamped;
}

uint pack_location(vec2 offset) {
    ivec2 q = clamp(ivec2(round(offset * 65536.0)), ivec2(-32768), ivec2(32767));
    return uint(q.x & 0xffff) | uint(q.y) << 16;
}

// What a block of samples sees of one triangle.
struct Surface {
    uint id;        // ~0: no other triangle
    float samples;
    vec2 sum;       // of their locations
    float lost;     // samples that the triangle covers and another one takes
};

Surface surface_after(uint id[ROWS], vec2 offset[ROWS], uint seen) {
    Surface r;
    uint current = ~0u;
    [[unroll]] for (int g = 0; g < ROWS; g++) current = min(current, id[g] > seen ? id[g] : ~0u);
    r.id = lanes_min(current);
    r.samples = 0.0;
    r.lost = 0.0;
    r.sum = vec2(0.0);
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        bool same = id[g] == r.id;
        r.samples += same ? 1.0 : 0.0;
        r.sum += same ? offset[g] : vec2(0.0);
    }
    return r;
}

// Parts of a block: at most eight runs of neighbouring samples, which patterns keep compact. An invocation holds one.
struct Part { uint samples; vec2 sum; };

const uint PART = BLOCK > 64u ? BLOCK / 8u : 8u;        // samples of a part
const uint PARTS_A_ROW = LANES > PART ? LANES / PART : 1u, ROWS_A_PART = PART > LANES ? PART / LANES : 1u;
const uint PART_LANES = PART < LANES ? PART : LANES;

Part part_of(uint id[ROWS], vec2 offset[ROWS], uint wanted, uint lane) {
    Part r = Part(0u, vec2(0.0));
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        bool same = id[g] == wanted;
        uint first = lane % PARTS_A_ROW * PART;
        uint seen = bitfieldExtract(subgroupBallot(same).x, int(first), int(PART_LANES));
        vec2 sum = same ? offset[g] : vec2(0.0);
        if (PARTS_A_ROW == 1u) {
            sum = vec2(lanes_add(sum.x), lanes_add(sum.y));
        } else {
            sum += vec2(subgroupShuffleXor(sum.x, 1u), subgroupShuffleXor(sum.y, 1u));
            sum += vec2(subgroupShuffleXor(sum.x, 2u), subgroupShuffleXor(sum.y, 2u));
            sum += vec2(subgroupShuffleXor(sum.x, 4u), subgroupShuffleXor(sum.y, 4u));
            sum = vec2(subgroupShuffle(sum.x, first), subgroupShuffle(sum.y, first));
        }
        bool mine = lane / PARTS_A_ROW == uint(g) / ROWS_A_PART;
        r.samples += mine ? uint(bitCount(seen)) : 0u;
        r.sum += mine ? sum : vec2(0.0);
    }
    return r;
}

// Whether a triangle's light may change within a pixel.
bool glossy(uint id) {
    return (texelFetch(triangles, int(max(id, 1u) - 1u)).w >> 30 & 1u) != 0u;
}

// Number of parts in which a triangle is seen.
uint parts_of(uint id[ROWS], uint wanted) {
    uint n = 0u, rows = 0u;
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        uint seen = subgroupBallot(id[g] == wanted).x;
        [[unroll]] for (uint k = 0u; k < PARTS_A_ROW; k++) {
            uint part = bitfieldExtract(seen, int(k * PART), int(PART_LANES));
            bool counted = ROWS_A_PART > 1u && uint(g) % ROWS_A_PART != 0u && rows != 0u;
            n += part != 0u && !counted ? 1u : 0u;
            rows = (uint(g) + 1u) % ROWS_A_PART == 0u ? 0u : rows | part;
        }
    }
    return n;
}

void main() {
    uint tile_count = frame.tiles.x * frame.tiles.y;
    uint samples = RUN == PROBE ? PROBES : frame.sample_count;
    uint first_sample = RUN == PROBE ? frame.sample_count : 0u;
    uint blocks = (samples + BLOCK - 1u) / BLOCK;
    uint headers_a_cell = (frame.sample_count + HEADER_SAMPLES - 1u) / HEADER_SAMPLES;
    // (part of an owner, owner): a tile, or a group of sites. A part is (block, cell) where these are APART.
    uint cells_an_owner = SITES ? LANES : 32u;
    uvec2 work = split(gl_WorkGroupID.x + gl_WorkGroupID.y * 32768u,
        APART ? cells_an_owner * headers_a_cell : cells_an_owner / LANES);
    if (work.y >= counters[COUNTER_PLAIN_TILES + LIST]) return;
    uvec2 part = split(work.x, headers_a_cell);
    uint lane = gl_SubgroupInvocationID;
    // What marks are kept for: a tile's pixels, or a group's cells.
    uint owner = tile_lists[LIST * (SITES ? frame.group_count : tile_count) + work.y];
    uvec4 site_group = SITES ? texelFetch(site_groups, int(owner)) : uvec4(0u);
    uint tile = SITES ? site_group.x : owner;
    uvec4 header = tiles[tile];
    ivec2 tile_at = ivec2(split(tile, frame.tiles.x));
    vec2 center = tile_center(tile_at);
    uint cells_word = SITES ? ~0u >> (32u - site_group.z) : masks[tile];
    uint word = RUN == REST ? cells_word & marks[owner] : cells_word;
#ifdef UNLISTED
    uint count = frame.triangle_count, first = 0u;
#else
    uint count = header.w >> TILE_COUNT_SHIFT, first = header.y;
#endif
    uint chunks = max((count + LANES - 1u) / LANES, 1u);
    uint cells = bitCount(word);
    uint first_cell = APART ? part.y : work.x * LANES;
    uint first_block = APART ? part.x : 0u;
    if (first_cell >= cells || first_block >= blocks) return;
    uint group = min(cells - first_cell, APART ? 1u : LANES);
    blocks = APART ? first_block + 1u : blocks;
    bool manageable = count <= LONGEST_LIST;
    if (!manageable && subgroupElect()) atomicAdd(counters[COUNTER_UNFINISHED], group);
    chunks = manageable ? chunks : 1u;
    count = manageable ? count : 0u;

    // The cell of each invocation, and what it keeps of the tile's candidates.
    uint rest = word, my_bit = 0u, bit_ = 0u;
    do {
        my_bit = bit_ == first_cell + lane ? uint(findLSB(rest)) : my_bit;
        rest &= rest - 1u;
    } while (++bit_ < first_cell + group);
    vec2 my_at = vec2(my_bit & 7u, my_bit >> 3) - vec2(3.5, 1.5), my_half = vec2(CELL_REACH);
    uvec2 my_sites = uvec2(0u);     // the first one, and how many
    if (SITES) {
        int cell = int(2u * (site_group.y + my_bit));
        vec4 square = uintBitsToFloat(texelFetch(site_cells, cell));
        my_at = square.xy;
        my_half = square.zw;
        my_sites = texelFetch(site_cells, cell + 1).xy;
    }
    float my_hidden = 0.0;      // nothing farther than this shows in the cell
    uint my_count = 0u;
    uint chunk = 0u;
    do {
        Candidate k = load_candidate(first, min(chunk * LANES + lane, max(count, 1u) - 1u), center);
        uint chunk_count = min(count - min(count, chunk * LANES), LANES);
        uint j = 0u;
        do {
            [[unroll]] for (uint u = 0u; u < 4u; u++) {
                CellTest test = test_cell(shuffle_candidate(k, j + u), my_at, my_half);
                bool exists = j + u < chunk_count;
                my_hidden = max(my_hidden, exists ? test.hides : 0.0);
                if (test.touches && test.near >= my_hidden && exists) {
                    kept[lane * KEPT + min(my_count, KEPT - 1u)] = chunk * LANES + j + u;
                    my_count++;
                }
            }
            j += 4u;
        } while (j < chunk_count);
    } while (++chunk < chunks);
    subgroupBarrier();

    uint trips = 4u * chunks, block = first_block;
    do {
        vec2 offset[ROWS];
        [[unroll]] for (int g = 0; g < ROWS; g++)
            offset[g] = POINTS ? vec2(0.0) : texelFetch(locations, int(first_sample + min(block * BLOCK + uint(g) * LANES + lane, samples - 1u))).xy;
        uint block_samples = min(samples - block * BLOCK, BLOCK);

        uint member = 0u;
        do {
            uint bit = subgroupShuffle(my_bit, member);
            uint cell = uint(bitCount(cells_word & ((1u << bit) - 1u)));
            vec2 in_tile = vec2(bit & 7u, bit >> 3);
            vec2 at = in_tile - vec2(3.5, 1.5);
            uvec2 pixel = uvec2(tile_at) * uvec2(8u, 4u) + uvec2(in_tile);
            vec2 half_side = vec2(CELL_REACH);
            uint site = 0u;             // POINTS: the block's first one
            mat2 output_pixel = mat2(1.0);
            vec2 place[ROWS];           // of samples of SITES, from the tile's centre
            if (SITES) {
                at = vec2(subgroupShuffle(my_at.x, member), subgroupShuffle(my_at.y, member));
                half_side = vec2(subgroupShuffle(my_half.x, member), subgroupShuffle(my_half.y, member));
                site = subgroupShuffle(my_sites.x, member);
                if (POINTS) {
                    uint points = subgroupShuffle(my_sites.y, member);
                    block_samples = min(points - min(points, block * BLOCK), BLOCK);
                    [[unroll]] for (int g = 0; g < ROWS; g++)
                        place[g] = uintBitsToFloat(texelFetch(sites, int(2u * (site + min(block * BLOCK + uint(g) * LANES + lane, points - 1u)))).xy);
                    site += block * BLOCK;
                } else {
                    output_pixel = site_jacobian(site);
                    [[unroll]] for (int g = 0; g < ROWS; g++) place[g] = at + output_pixel * offset[g];
                }
            }
            float hidden = subgroupShuffle(my_hidden, member);
            uint listed = subgroupShuffle(my_count, member);
            bool complete = listed <= KEPT;
            bool out_of_trips = trips > MOST_TRIPS;
            if (out_of_trips && subgroupElect()) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
            uint entries_ = out_of_trips ? 0u : complete ? listed : count;
            uint batches = max((entries_ + LANES - 1u) / LANES, 1u);

            float depth[ROWS];
            uint id[ROWS];
            [[unroll]] for (int g = 0; g < ROWS; g++) { depth[g] = 0.0; id[g] = 0u; }

            Candidate nearby;           // an invocation holds one that may show
            nearby.id = 0u;
            uint nearby_count = 0u;
            uint batch = 0u;
            do {
                Candidate k = load_candidate(first, kept_or_all(complete, member, batch * LANES + lane, entries_), center);
                CellTest test = test_cell(k, at, half_side);
                bool blend = k.id > frame.first_blend;
                bool mask_ = HAS_MASK && k.id > frame.first_mask && !blend;
                bool touches = batch * LANES + lane < entries_ && test.touches && !blend && test.near >= hidden;

                trips += 3u + uint(bitCount(subgroupBallot(touches).x));
                uint pending = subgroupBallot(touches && !mask_).x;
                do {
                    bool some = pending != 0u;
                    Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                    pending &= pending - 1u;
                    vec3 least = some ? thresholds(t) : vec3(3.4e38);
                    if (EXACT_AREAS) {
                        nearby = choose(some && nearby_count == lane, t, nearby);
                        nearby_count += some ? 1u : 0u;
                    }
                    [[unroll]] for (int g = 0; g < ROWS; g++) {
                        float d;
                        bool there = covers(t, least, PLACE(g), d);
                        bool wins = there && (d > depth[g] || (d == depth[g] && t.id < id[g]));
                        depth[g] = wins ? d : depth[g];
                        id[g] = wins ? t.id : id[g];
                    }
                } while (pending != 0u);

                if (HAS_MASK) {
                    pending = subgroupBallot(touches && mask_).x;
                    do {
                        bool some = pending != 0u;
                        Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                        pending &= pending - 1u;
                        vec3 least = some ? thresholds(t) : vec3(3.4e38);
                        AlphaTest alpha = alpha_test(t.id - 1u, center, at, output_pixel);
                        [[unroll]] for (int g = 0; g < ROWS; g++) {
                            float d;
                            bool there = covers(t, least, PLACE(g), d);
                            bool wins = there && (d > depth[g] || (d == depth[g] && t.id < id[g]));
                            if (POINTS) alpha = alpha_test(t.id - 1u, center, place[g], site_jacobian(site + min(uint(g) * LANES + lane, max(block_samples, 1u) - 1u)));
                            wins = wins && alpha_passes(alpha, PLACE(g));
                            depth[g] = wins ? d : depth[g];
                            id[g] = wins ? t.id : id[g];
                        }
                    } while (pending != 0u);
                }
            } while (++batch < batches);

            uint header_index = header.z + (site_group.w + cell) * headers_a_cell + block;
            uint packed_pixel = SITES ? site : pixel.x | pixel.y << 16;

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
            uint first_record = POINTS ? POINT_FIRST : 0u;
            // Layers from the farthest to the nearest: each round finds the next one in front.
            bool more;
            do {
                float next_depth[ROWS];
                uint next_id[ROWS];
                [[unroll]] for (int g = 0; g < ROWS; g++) { next_depth[g] = 3.4e38; next_id[g] = 0u; }
                batch = 0u;
                do {
                    Candidate k = load_candidate(first, kept_or_all(complete, member, batch * LANES + lane, entries_), center);
                    CellTest test = test_cell(k, at, half_side);
                    bool touches = batch * LANES + lane < entries_ && test.touches && k.id > frame.first_blend && test.near >= hidden;
                    uint pending = subgroupBallot(touches).x;
                    trips += 2u + uint(bitCount(pending));
                    do {
                        bool some = pending != 0u;
                        Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                        pending &= pending - 1u;
                        vec3 least = some ? thresholds(t) : vec3(3.4e38);
                        [[unroll]] for (int g = 0; g < ROWS; g++) {
                            float d;
                            bool there = covers(t, least, PLACE(g), d) && d > 0.0;
                            bool in_front = id[g] == 0u ? d > depth[g] : d > depth[g] || (d == depth[g] && t.id < id[g]);
                            bool nearest = d < next_depth[g] || (d == next_depth[g] && t.id > next_id[g]);
                            bool wins = there && in_front && nearest;
                            next_depth[g] = wins ? d : next_depth[g];
                            next_id[g] = wins ? t.id : next_id[g];
                        }
                    } while (pending != 0u);
                } while (++batch < batches);

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
                        records_out[node[g]] = uvec4(OWNER(g) | first_record, id[g], pack_location(offset[g]), extends ? slot : ~0u);
                    node[g] = extends ? slot : node[g];
                    slot += extends ? 1u : 0u;
                    depth[g] = extends ? next_depth[g] : depth[g];
                    id[g] = extends ? next_id[g] : id[g];
                    live[g] = extends;
                    more = more || extends;
                }
                more = subgroupAny(more);
                first_record = 0u;
                lost += more && trips > MOST_TRIPS ? 1u : 0u;
            } while (more && trips <= MOST_TRIPS);
            if (subgroupElect() && lost != 0u) atomicAdd(counters[COUNTER_UNFINISHED], 1u);
#else
            [[unroll]] for (int g = 0; g < ROWS; g++)
                id[g] = uint(g) * LANES + lane < block_samples ? id[g] : 0u;
            uint surfaces = 0u, used = 0u;
            bool settled = true;        // the cell needs no more samples
            // An invocation holds a surface.
            uvec4 held = uvec4(0u);
            float held_samples = 0.0;
            int held_area = 0;
            bool held_whole = false;
            if (PER_SAMPLE) {
                used = block_samples;
            } else {
                uint seen = 0u;
                bool some;
                do {
                    Surface s = surface_after(id, offset, seen);
                    some = s.id != ~0u;
                    bool whole = false;
                    int area = 0;
                    if (EXACT_AREAS) {
                        uint holder = subgroupBallot(nearby.id == s.id).x;
                        Candidate t = shuffle_candidate(nearby, holder != 0u ? uint(findLSB(holder)) : 0u);
                        vec3 least = thresholds(t);
                        [[unroll]] for (int g = 0; g < ROWS; g++) {
                            bool lost = inside(t, least, PLACE(g)) && id[g] != s.id && uint(g) * LANES + lane < block_samples;
                            s.lost += lost ? 1.0 : 0.0;
                        }
                        float both = lanes_add(s.samples + 4096.0 * s.lost);
                        s.samples = both - 4096.0 * floor(both * (1.0 / 4096.0));
                        // In the coordinates of offsets, in which the cell is a square.
                        vec3 a = SITES ? t.a * output_pixel[0].x + t.b * output_pixel[0].y : t.a;
                        vec3 b = SITES ? t.a * output_pixel[1].x + t.b * output_pixel[1].y : t.b;
                        area = area_in_cell(a, b, t.a * at.x + t.b * at.y + t.c, lane);
                        whole = holder != 0u && both < 4096.0 && float(area) * float(block_samples) >= FEWEST * AREA_UNIT;
                    } else {
                        s.samples = lanes_add(s.samples);
                    }
                    s.sum = vec2(lanes_add(s.sum.x), lanes_add(s.sum.y));
                    bool mine = some && surfaces == lane;
                    held = mine ? uvec4(packed_pixel, s.id, pack_location(s.sum / s.samples), 0u) : held;
                    held_samples = mine ? s.samples : held_samples;
                    held_whole = mine ? whole : held_whole;
                    held_area = mine ? area : held_area;
                    if (BY_PART && some) {
                        bool parted = surfaces < LANES && glossy(s.id);
                        used += parted ? parts_of(id, s.id) : 1u;
                    }
                    surfaces += some ? 1u : 0u;
                    seen = s.id;
                } while (some);
                if (!BY_PART) used = surfaces;
            }
            float weight = held_samples;
            if (EXACT_AREAS) {
                // Beyond the invocations' room to hold triangles, all go by samples.
                bool known = surfaces <= LANES && nearby_count <= LANES;
                bool shares = held_samples > 0.0 && !held_whole;
                float whole_area = float(lanes_add(held_whole ? held_area : 0)) * (1.0 / AREA_UNIT);
                float whole_samples = lanes_add(held_whole ? held_samples : 0.0);
                float sharing = lanes_add(shares ? 1.0 : 0.0);
                float left = float(block_samples) - whole_samples;
                float background = left - lanes_add(shares ? held_samples : 0.0);
                sharing += background > 0.0 ? 1.0 : 0.0;
                float mend = left > 0.0 && whole_area <= 1.0 ? 1.0 : 1.0 / max(whole_area, 1e-6);
                float share = max(1.0 - whole_area, 0.0) / max(left, 1.0);
                float cell_weight = float(frame.sample_count);
                bool agrees = abs(whole_area - whole_samples / float(block_samples)) <= AGREEMENT;
                bool exact = known && agrees;
                weight = exact ? cell_weight * (held_whole ? float(held_area) * (1.0 / AREA_UNIT) * mend : held_samples * share)
                    : cell_weight / float(block_samples) * held_samples;
                settled = RUN != PROBE || (exact && sharing <= 1.0);
            }
            held.w = floatBitsToUint(weight);
            used = settled ? used : 0u;
            uint base = 0u;
            if (subgroupElect() && used != 0u) base = atomicAdd(counters[COUNTER_RECORDS], used);
            base = subgroupBroadcastFirst(base);
            bool fits = base + used <= frame.record_capacity && settled;
            if (subgroupElect() && !fits) {
                atomicAdd(counters[settled ? COUNTER_UNFINISHED : COUNTER_RESAMPLED], 1u);
                if (!settled) atomicOr(marks[owner], 1u << bit);
            }
            if (PER_SAMPLE) {
                [[unroll]] for (int g = 0; g < ROWS; g++) {
                    uint s = uint(g) * LANES + lane;
                    if (fits && s < block_samples)
                        records_out[base + s] = POINTS ? uvec4(OWNER(g) | POINT_FIRST, id[g], 0u, ~0u) : uvec4(packed_pixel, id[g], pack_location(offset[g]), floatBitsToUint(1.0));
                }
            } else {
                // Surfaces of one record: all at once, and those beyond the invocations' room one by one.
                bool several = BY_PART && lane < surfaces && glossy(held.y);
                bool single = lane < surfaces && !several;
                uvec4 singles = subgroupBallot(single);
                if (fits && single) records_out[base + subgroupBallotExclusiveBitCount(singles)] = held;
                uint slot = base + subgroupBallotBitCount(singles);
                uint seen = subgroupMax(held.y), stored = min(surfaces, LANES);
                while (stored < surfaces) {
                    Surface s = surface_after(id, offset, seen);
                    s.samples = lanes_add(s.samples);
                    s.sum = vec2(lanes_add(s.sum.x), lanes_add(s.sum.y));
                    if (fits && subgroupElect() && stored < surfaces)
                        records_out[slot] = uvec4(packed_pixel, s.id, pack_location(s.sum / s.samples), floatBitsToUint(s.samples));
                    slot += stored < surfaces ? 1u : 0u;
                    seen = s.id;
                    stored++;
                }
                if (BY_PART) {
                    float each = weight / max(held_samples, 1.0);
                    uint pending = subgroupBallot(several).x;
                    do {
                        uint holder = pending != 0u ? uint(findLSB(pending)) : 0u;
                        uint current = pending != 0u ? subgroupShuffle(held.y, holder) : ~0u;
                        Part part = part_of(id, offset, current, lane);
                        bool some = part.samples != 0u;
                        uint present = subgroupBallot(some).x;
                        float n = float(part.samples);
                        float value = n * subgroupShuffle(each, holder);
                        if (fits && some)
                            records_out[slot + uint(bitCount(present & ((1u << lane) - 1u)))] =
                                uvec4(packed_pixel, current, pack_location(part.sum / n), floatBitsToUint(value));
                        slot += uint(bitCount(present));
                        pending &= pending - 1u;
                    } while (pending != 0u);
                }
            }
            used = fits ? used : 0u;
            if (subgroupElect()) headers[min(header_index, frame.record_capacity - 1u)] = uvec2(base, used);
#endif
        } while (++member < group);
    } while (++block < blocks);
}
