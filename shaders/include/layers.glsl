// LAYERED fragments of the samples of a block: the opaque surfaces that they see, then the BLEND layers in front of these, in
// exact order of depth.
//
// Samples that see the same surfaces, from the farthest one on, share the fragments of these. Fragments form a tree: the fragment of
// a surface is a node that links to the surface behind it, and is shaded at the centroid of the samples that share it. Samples
// that share a node are split by the triangle that they see next in front. A leaf says how many samples end at which node.
// Samples do not share fragments if each is shaded by itself (EACH), nor in front of SHARED_LAYERS layers, so that loops end in
// time.
#ifndef LAYERS_GLSL
#define LAYERS_GLSL
#include "surfaces.glsl"

const bool EACH = PER_SAMPLE || POINTS;
const uint SHARED_LAYERS = 256u;

// The number of a sample's part, where parts are merged in pairs.
uint layered_part(uint g) { return part_number(g) >> 1; }

uint node[ROWS];            // node of the nearest surface so far; ~0: background
float next_depth[ROWS];     // the next surface in front of that; ID 0: none
uint next_id[ROWS];

// Samples with the same node and the same next surface. BY_PART: if that surface is HIGH_FREQUENCY, also in the same pair of
// parts.
struct Group {
    uint node, next_id;
    uint rows;
    float samples;
    vec2 sum;               // sum of their offsets
};

// The group of the first sample of those that are `left`, a bit a row.
Group first_group(uint left) {
    uvec3 key = uvec3(0u);
    uint first = ~0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        bool some = first == ~0u && (left >> g & 1u) != 0u;
        key = some ? uvec3(node[g], next_id[g], layered_part(g)) : key;
        first = some ? sample_of(g) : first;
    }
    key = of_member(key, team_min(first) % TEAM);
    bool by_part = BY_PART && key.y != 0u && high_frequency_triangle(key.y);
    Group r = Group(key.x, key.y, 0u, 0.0, vec2(0.0));
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        bool same = (left >> g & 1u) != 0u && node[g] == key.x && next_id[g] == key.y && (!by_part || layered_part(g) == key.z);
        r.rows |= same ? 1u << g : 0u;
        r.sum += same ? offset[g] : vec2(0.0);
    }
    r.samples = team_add(float(bitCount(r.rows)));
    r.sum = vec2(team_add(r.sum.x), team_add(r.sum.y));
    return r;
}

// Makes nodes of the samples' next surfaces, one for `each` sample or shared ones, and moves the samples there. Returns
// whether there was room for the nodes.
bool add_nodes(uint cell_id, uint samples, bool each) {
    uint lane = member(), left = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) left |= sample_of(g) < samples && next_id[g] != 0u ? 1u << g : 0u;
    bool fits = true;
    if (each) {
        uint mine = uint(bitCount(left)), before = team_before(mine);
        uint slot = allocate_fragments(team_add(mine), fits) + before;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) {
            bool moves = (left >> g & 1u) != 0u;
            if (moves && fits) fragments_out[slot] = uvec4(POINTS ? location_at(cell_id + sample_of(g)) : cell_id, next_id[g], POINTS ? 0u : place_of(offset[g], 1.0), node[g]);
            node[g] = moves ? slot : node[g];
            slot += moves ? 1u : 0u;
        }
        return fits;
    }
    do {
        uint count = 0u, before = left;
        uvec4 held;             // fragment of one group: member n holds that of group n
        uint number[ROWS];
        do {
            Group s = first_group(left);
            bool mine = lane == count;
            held = mine ? uvec4(cell_id, s.next_id, place_of(s.sum, s.samples), s.node) : held;
            [[unroll]] for (uint g = 0u; g < ROWS; g++) number[g] = (s.rows >> g & 1u) != 0u ? count : number[g];
            left &= ~s.rows;
            count += s.samples > 0.0 ? 1u : 0u;
        } while (count < TEAM && team_any(left != 0u));
        trips += count + 2u;
        bool room;
        uint base = allocate_fragments(count, room);
        if (room && lane < count) fragments_out[base + lane] = held;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) node[g] = ((before & ~left) >> g & 1u) != 0u ? base + number[g] : node[g];
        fits = fits && room;
    } while (team_any(left != 0u));
    return fits;
}

// Makes the leaves; returns the first one and their number. Samples that see only background have a leaf only with EACH.
uvec2 add_leaves(uint cell_id, uint samples, bool complete) {
    uint lane = member();
    bool fits;
    if (EACH) {
        uint base = allocate_fragments(complete ? samples : 0u, fits);
        fits = fits && complete;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) {
            uint s = sample_of(g);
            if (fits && s < samples) {
                fragments_out[base + s] = uvec4(POINTS ? location_at(cell_id + s) | POINT_VALUE : cell_id, 0u, floatBitsToUint(1.0), node[g]);
                if (SPREAD != SPREAD_NONE) write_spread(base + s, spread_of_place(place_of(offset[g], 1.0)));
            }
        }
        return uvec2(base, fits ? samples : 0u);
    }
    uint left = 0u, beyond = 0u, count = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        next_id[g] = 0u;
        left |= sample_of(g) < samples && node[g] != ~0u ? 1u << g : 0u;
    }
    uvec4 held, held_spread;
    do {
        Group s = first_group(left);
        held = lane == count ? uvec4(cell_id, 0u, floatBitsToUint(s.samples), s.node) : held;
        if (SPREAD != SPREAD_NONE) {
            uvec4 spread = spread_of_rows(s.rows, s.samples);
            held_spread = lane == count ? spread : held_spread;
        }
        left &= ~s.rows;
        count += s.samples > 0.0 ? 1u : 0u;
        beyond = count <= TEAM ? left : beyond;
    } while (team_any(left != 0u));
    uint base = allocate_fragments(complete ? count : 0u, fits);
    fits = fits && complete;
    if (fits && lane < count) {
        fragments_out[base + lane] = held;
        if (SPREAD != SPREAD_NONE) write_spread(base + lane, held_spread);
    }
    // Members hold TEAM leaves. Others are written one by one.
    uint stored = TEAM;
    do {
        Group s = first_group(beyond);
        uvec4 spread = uvec4(0u);
        if (SPREAD != SPREAD_NONE) spread = spread_of_rows(s.rows, s.samples);
        if (fits && stored < count && member() == 0u) {
            fragments_out[base + stored] = uvec4(cell_id, 0u, floatBitsToUint(s.samples), s.node);
            if (SPREAD != SPREAD_NONE) write_spread(base + stored, spread);
        }
        beyond &= ~s.rows;
    } while (++stored < count);
    trips += 2u * count;
    return uvec2(base, fits ? count : 0u);
}

// Finds each sample's next BLEND layer in UNLISTED tiles: number `layer` of its layers, from the farthest one on. Returns whether
// there may be more.
bool find_scattered(uint layer) {
    uint most = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        next_id[g] = layer < layers[g] ? texelFetch(candidates, int(first_layer[g] + layer)).w : 0u;
        most = max(most, layers[g]);
    }
    trips++;
    return team_any(layer + 1u < most);
}

// Finds each sample's next BLEND layer in front of the surfaces so far, and moves its depth and ID there. Returns whether there
// may be more.
bool find_layers(Cell cell) {
    bool more = false;          // whether a sample has several layers in front
    float behind = 3.4e38;      // what lies farther than this depth is hidden from all samples
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        next_depth[g] = 3.4e38;
        next_id[g] = 0u;
        behind = min(behind, depth[g]);
    }
    behind = max(team_min(behind), cell.hidden);
    vec2 middle = cell.at, half_side = cell.half_side;
    if (!POINTS) rectangle_of_block(cell, middle, half_side);
    uint batches = (cell.entries + TEAM - 1u) / TEAM, left = blend_batches;
    uint batch = left != 0u ? uint(findLSB(left)) : 0u;
    do {
        uint entry = batch * TEAM + member();
        Candidate k = entry_of(cell, entry);
        RectangleTest test = test_rectangle(k, middle, half_side, HAS_MASK);
        bool touches = left != 0u && entry < cell.entries && may_touch(k, cell.bit) && test.touches && k.id > frame.first_blend && test.near >= behind;
        uint pending = team_ballot(touches);
        trips += 2u + uint(bitCount(pending));
        do {
            bool some = pending != 0u;
            Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
            pending &= pending - 1u;
            vec3 least = some ? thresholds(t) : vec3(3.4e38);
            [[unroll]] for (uint g = 0u; g < ROWS; g++) {
                float d;
                bool there = covers(t, least, position_of(cell, g), d) && d > 0.0;
                bool in_front = there && (d > depth[g] || (id[g] != 0u && d == depth[g] && t.id < id[g]));
                bool nearest = d < next_depth[g] || (d == next_depth[g] && t.id > next_id[g]);
                more = more || in_front && next_id[g] != 0u;
                next_depth[g] = in_front && nearest ? d : next_depth[g];
                next_id[g] = in_front && nearest ? t.id : next_id[g];
            }
        } while (pending != 0u);
        // The last bit stands for all batches from the 32nd on.
        left &= batch < 31u ? left - 1u : batch + 1u < batches ? ~0u : 0u;
        batch = batch < 31u && left != 0u ? uint(findLSB(left)) : batch + 1u;
    } while (left != 0u && trips <= MOST_TRIPS);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        depth[g] = next_id[g] != 0u ? next_depth[g] : depth[g];
        id[g] = next_id[g] != 0u ? next_id[g] : id[g];
    }
    return left != 0u || team_any(more);
}

// Makes all fragments of a cell's block; returns the first leaf and their number.
uvec2 record_layers(Cell cell) {
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        node[g] = ~0u;
        next_id[g] = id[g];
    }
    bool fits = add_nodes(cell.id, cell.samples, EACH);
    bool more;
    uint layer = 0u;
    do {
        if (UNLISTED) more = find_scattered(layer); else more = find_layers(cell);
        fits = add_nodes(cell.id, cell.samples, EACH || layer >= SHARED_LAYERS) && fits;
        layer++;
    } while (more && trips <= MOST_TRIPS);
    if (more) leave_block(COUNTER_STALLED);
    return add_leaves(cell.id, cell.samples, fits);
}

#endif
