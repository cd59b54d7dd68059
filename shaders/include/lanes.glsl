// Reductions over a subgroup of LANES invocations. Small subgroups are those of CPU devices, where a shuffle is
// almost free and a built-in reduction is a loop; large ones have it in hardware.

layout(constant_id = 1) const uint LANES = 8u;          // subgroup size
const bool BY_SHUFFLE = LANES <= 8u;

float lanes_add(float v) {
    if (!BY_SHUFFLE) return subgroupAdd(v);
    v += subgroupShuffleXor(v, 1u);
    v += subgroupShuffleXor(v, 2u);
    return v + subgroupShuffleXor(v, 4u);
}

int lanes_add(int v) {
    if (!BY_SHUFFLE) return subgroupAdd(v);
    v += subgroupShuffleXor(v, 1u);
    v += subgroupShuffleXor(v, 2u);
    return v + subgroupShuffleXor(v, 4u);
}

uint lanes_min(uint v) {
    if (!BY_SHUFFLE) return subgroupMin(v);
    v = min(v, subgroupShuffleXor(v, 1u));
    v = min(v, subgroupShuffleXor(v, 2u));
    return min(v, subgroupShuffleXor(v, 4u));
}

float lanes_min(float v) {
    if (!BY_SHUFFLE) return subgroupMin(v);
    v = min(v, subgroupShuffleXor(v, 1u));
    v = min(v, subgroupShuffleXor(v, 2u));
    return min(v, subgroupShuffleXor(v, 4u));
}

float lanes_max(float v) {
    if (!BY_SHUFFLE) return subgroupMax(v);
    v = max(v, subgroupShuffleXor(v, 1u));
    v = max(v, subgroupShuffleXor(v, 2u));
    return max(v, subgroupShuffleXor(v, 4u));
}

uint lanes_or(uint v) {
    if (!BY_SHUFFLE) return subgroupOr(v);
    v |= subgroupShuffleXor(v, 1u);
    v |= subgroupShuffleXor(v, 2u);
    return v | subgroupShuffleXor(v, 4u);
}

uint lanes_add(uint v) {
    return uint(lanes_add(int(v)));
}
