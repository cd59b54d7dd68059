// CHAINED records of the samples of a block: each one's opaque surface, then its BLEND layers to the front.
#ifndef LAYERS_GLSL
#define LAYERS_GLSL

// Returns the first record and their number.
uvec2 record_layers(Cell cell, uint owner) {
    uint base = 0u;
    if (subgroupElect()) base = atomicAdd(counters[COUNTER_RECORDS], cell.samples);
    base = subgroupBroadcastFirst(base);
    uint lost = base + cell.samples > frame.record_capacity ? 1u : 0u;
    uint node[ROWS];
    bool live[ROWS];
    [[unroll]] for (int g = 0; g < ROWS; g++) {
        live[g] = sample_of(g) < cell.samples;
        node[g] = base + sample_of(g);
    }
    uint batches = max((cell.entries + LANES - 1u) / LANES, 1u);
    uint first_record = POINTS ? POINT_FIRST : 0u;
    // Layers from the farthest to the nearest: each round finds the next one in front.
    bool more;
    do {
        float next_depth[ROWS];
        uint next_id[ROWS];
        [[unroll]] for (int g = 0; g < ROWS; g++) { next_depth[g] = 3.4e38; next_id[g] = 0u; }
        uint batch = 0u;
        do {
            uint entry = batch * LANES + gl_SubgroupInvocationID;
            Candidate k = entry_of(cell, entry);
            RectangleTest test = test_rectangle(k, cell.at, cell.half_side, HAS_MASK);
            bool touches = entry < cell.entries && test.touches && k.id > frame.first_blend && test.near >= cell.hidden;
            uint pending = subgroupBallot(touches).x;
            trips += 2u + uint(bitCount(pending));
            do {
                bool some = pending != 0u;
                Candidate t = shuffle_candidate(k, some ? uint(findLSB(pending)) : 0u);
                pending &= pending - 1u;
                vec3 least = some ? thresholds(t) : vec3(3.4e38);
                [[unroll]] for (int g = 0; g < ROWS; g++) {
                    float d;
                    bool there = covers(t, least, position_of(cell, g), d) && d > 0.0;
                    bool in_front = id[g] == 0u ? d > depth[g] : d > depth[g] || (d == depth[g] && t.id < id[g]);
                    bool nearest = d < next_depth[g] || (d == next_depth[g] && t.id > next_id[g]);
                    bool next = there && in_front && nearest;
                    next_depth[g] = next ? d : next_depth[g];
                    next_id[g] = next ? t.id : next_id[g];
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
                records_out[node[g]] = uvec4((POINTS ? owner + sample_of(g) : owner) | first_record, id[g], pack_location(offset[g]), extends ? slot : ~0u);
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
    return uvec2(base, cell.samples);
}

#endif
