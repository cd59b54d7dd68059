// Sorting of a cell's candidates, the nearest first. A subgroup sorts keys together, a key in each invocation.
#ifndef ORDER_GLSL
#define ORDER_GLSL

const uint INDEX = 1023u;           // bits of a key that hold a candidate's number; those above hold its depth

struct Key {
    uint depth;             // its nearest depth in the cell, and its number in the low bits; 0 for none
    uint id;
};

// The nearer candidate comes first. If the bits of depth are equal, the smaller ID comes first, since the order of lists differs
// from run to run.
bool comes_before(Key k, Key other) { return (k.depth ^ other.depth) <= INDEX ? k.id < other.id : k.depth > other.depth; }

// An upper bound for the depths of the candidate with this key and of all later ones. It is needed since a key lacks the lowest
// bits of a depth.
float nearest_from(uint depth) { return uintBitsToFloat(depth | INDEX) * 1.000002; }

// Merges runs of `size` keys, the first half of which is in order and the second half in reversed order. Every second run
// becomes reversed; a run of all keys becomes `reversed` if so asked.
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

// Bitonic sorting (Batcher, "Sorting networks and their applications", 1968). Runs of half of `from` keys are already sorted, in
// order and in reversed order by turns. Afterwards all keys are in order, or `reversed`.
void sort_keys(inout Key k, uint from, bool reversed) {
    // Written out for UNROLLED.
    if (from <= 2u) merge_runs(k, 2u, reversed);
    if (from <= 4u && LANES >= 4u) merge_runs(k, 4u, reversed);
    if (from <= 8u && LANES >= 8u) merge_runs(k, 8u, reversed);
    if (from <= 16u && LANES >= 16u) merge_runs(k, 16u, reversed);
    if (from <= 32u && LANES >= 32u) merge_runs(k, 32u, reversed);
}

// Merges keys that are in order with `others` that are in reversed order. Afterwards `first` has the keys that come first, and
// `others` the rest, both in order.
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
