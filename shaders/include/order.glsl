// Sorting of a cell's candidates, the nearest first. A team sorts keys together, a key in each member.
#ifndef ORDER_GLSL
#define ORDER_GLSL

// A candidate's key holds the number by which the tile's list knows it: the low bits of the number in the low bits of the depth, the
// others in those of the ID.
const uint LOW = 1023u, KEY_NUMBER_BITS = 16u, KEY_ID_BITS = 26u;

struct Key {
    uint depth;             // the candidate's nearest depth in the cell; 0 for none
    uint id;
};

Key make_key(float depth, uint id, uint number) {
    return Key(floatBitsToUint(depth) & ~LOW | number & LOW, id << (32u - KEY_ID_BITS) | number >> 10);
}

uint number_in(Key k) { return k.depth & LOW | (k.id & (1u << (32u - KEY_ID_BITS)) - 1u) << 10; }

// The nearer candidate comes first. If the bits of depth are equal, the smaller ID comes first, since the order of lists differs
// from run to run.
bool comes_before(Key k, Key other) { return (k.depth ^ other.depth) <= LOW ? k.id < other.id : k.depth > other.depth; }

// An upper bound for the depths of the candidate with this key and of all later ones. It is needed since a key lacks the lowest
// bits of a depth.
float nearest_from(Key k) { return uintBitsToFloat(k.depth | LOW) * 1.000002; }

// Merges runs of `size` keys, the first half of which is in order and the second half in reversed order. Every second run
// becomes reversed; a run of all keys becomes `reversed` if so asked.
void merge_runs(inout Key k, uint size, bool reversed) {
    uint lane = member();
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) {
        uint step = size >> (log + 1u);
        if (step > 0u) {
            Key other = Key(of_partner(k.depth, step), of_partner(k.id, step));
            bool upper = (lane & step) != 0u, turned = size == TEAM ? reversed : (lane & size) != 0u;
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
    if (from <= 4u) merge_runs(k, 4u, reversed);
    if (from <= 8u && TEAM >= 8u) merge_runs(k, 8u, reversed);
    if (from <= 16u && TEAM >= 16u) merge_runs(k, 16u, reversed);
    if (from <= 32u && TEAM >= 32u) merge_runs(k, 32u, reversed);
}

// Merges keys that are in order with `others` that are in reversed order. Afterwards `first` has the keys that come first, and
// `others` the rest, both in order.
void merge_keys(inout Key first, inout Key others) {
    bool stays = comes_before(first, others);
    Key a = Key(stays ? first.depth : others.depth, stays ? first.id : others.id);
    others = Key(stays ? others.depth : first.depth, stays ? others.id : first.id);
    first = a;
    sort_keys(first, TEAM, false);
    sort_keys(others, TEAM, false);
}

Key key_of_member(Key k, uint m) { return Key(of_member(k.depth, m), of_member(k.id, m)); }

Key reversed_keys(Key k) { return key_of_member(k, TEAM - 1u - member()); }

#endif
