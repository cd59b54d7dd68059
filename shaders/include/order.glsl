// The order in which candidates come to a cell: the nearest first. A subgroup sorts them, a key an invocation.
#ifndef ORDER_GLSL
#define ORDER_GLSL

const uint INDEX = 1023u;           // bits of a candidate's number in a key; the depth has those above

struct Key {
    uint depth;             // its nearest depth in the cell, and its number in the low bits; 0 for none
    uint id;
};

// What is nearer comes first and, of what has the same bits of depth, the smaller ID, since the order of lists differs from run
// to run.
bool comes_before(Key k, Key other) { return (k.depth ^ other.depth) <= INDEX ? k.id < other.id : k.depth > other.depth; }

// What no candidate from this key on is nearer than: a depth is less than a 2^-13th above what its bits say.
float nearest_from(uint depth) { return uintBitsToFloat(depth | INDEX) * 1.000002; }

// Puts runs of `size` keys in order, of which the first half is in order and the second one in reversed order: each second run in
// reversed order, and a run of all keys in order or `reversed`.
void merge_runs(inout Key k, uint size, bool reversed) {
    uint lane = gl_SubgroupInvocationID;
    [[unroll]] for (uint log = 0u; log < 5u; log++) {
        uint step = size >> (log + 1u);
        if (step > 0u) {
            Key other = Key(subgroupShuffleXor(k.depth, step), subgroupShuffleXor(k.id, step));
            bool upper = (lane & step) != 0u, turned = size == LANES ? reversed : (lane & size) != 0u;
            bool keeps = comes_before(k, other) != (upper != turned);
            k.depth = keeps ? k.depth : other.depth;
            k.id = keeps ? k.id : other.id;
        }
    }
}

// Batcher's bitonic sorting ("Sorting networks and their applications", 1968), from runs of half of `from` that are in order
// and in reversed order in turns; of all keys, in order or `reversed`.
void sort_keys(inout Key k, uint from, bool reversed) {
    // Written out for UNROLLED.
    if (from <= 2u) merge_runs(k, 2u, reversed);
    if (from <= 4u && LANES >= 4u) merge_runs(k, 4u, reversed);
    if (from <= 8u && LANES >= 8u) merge_runs(k, 8u, reversed);
    if (from <= 16u && LANES >= 16u) merge_runs(k, 16u, reversed);
    if (from <= 32u && LANES >= 32u) merge_runs(k, 32u, reversed);
}

// Of keys in order and others in reversed order, those that come first, and the others, both in order.
void merge_keys(inout Key first, inout Key others) {
    bool stays = comes_before(first, others);
    Key a = Key(stays ? first.depth : others.depth, stays ? first.id : others.id);
    others = Key(stays ? others.depth : first.depth, stays ? others.id : first.id);
    first = a;
    sort_keys(first, LANES, false);
    sort_keys(others, LANES, false);
}

Key reversed_keys(Key k) {
    uint other = LANES - 1u - gl_SubgroupInvocationID;
    return Key(subgroupShuffle(k.depth, other), subgroupShuffle(k.id, other));
}

#endif
