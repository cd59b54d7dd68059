// Reductions over the LANES invocations of a workgroup that is one subgroup. CPU devices have small subgroups; on them a
// shuffle is almost free, and a built-in reduction is a loop. Devices with large subgroups reduce in hardware.
#ifndef LANES_GLSL
#define LANES_GLSL
#include "interface.glsl"

layout(constant_id = CONSTANT_LANES) const uint LANES = 8u;          // 4, 8, 16 or 32: invocations of a subgroup that are used
const bool BY_SHUFFLE = LANES <= 8u;

layout(constant_id = CONSTANT_UNSURE) const bool UNSURE = false;     // the device can't be asked for the size of subgroups

// Whether the device runs a workgroup of `invocations` in subgroups of another size than the pipeline was made for. If so, a
// counter is set, and the host discards the frame.
bool in_other_subgroups(uint invocations) {
    if (!UNSURE) return false;
    bool others = gl_NumSubgroups * LANES != invocations || gl_SubgroupInvocationID >= LANES;
    if (others) counters[COUNTER_SUBGROUPS] = 1u;
    return others;
}

float lanes_add(float v) {
    if (!BY_SHUFFLE) return subgroupAdd(v);
    v += subgroupShuffleXor(v, 1u);
    v += subgroupShuffleXor(v, 2u);
    return LANES < 8u ? v : v + subgroupShuffleXor(v, 4u);
}

int lanes_add(int v) {
    if (!BY_SHUFFLE) return subgroupAdd(v);
    v += subgroupShuffleXor(v, 1u);
    v += subgroupShuffleXor(v, 2u);
    return LANES < 8u ? v : v + subgroupShuffleXor(v, 4u);
}

uint lanes_min(uint v) {
    if (!BY_SHUFFLE) return subgroupMin(v);
    v = min(v, subgroupShuffleXor(v, 1u));
    v = min(v, subgroupShuffleXor(v, 2u));
    return LANES < 8u ? v : min(v, subgroupShuffleXor(v, 4u));
}

float lanes_min(float v) {
    if (!BY_SHUFFLE) return subgroupMin(v);
    v = min(v, subgroupShuffleXor(v, 1u));
    v = min(v, subgroupShuffleXor(v, 2u));
    return LANES < 8u ? v : min(v, subgroupShuffleXor(v, 4u));
}

float lanes_max(float v) {
    if (!BY_SHUFFLE) return subgroupMax(v);
    v = max(v, subgroupShuffleXor(v, 1u));
    v = max(v, subgroupShuffleXor(v, 2u));
    return LANES < 8u ? v : max(v, subgroupShuffleXor(v, 4u));
}

uint lanes_or(uint v) {
    if (!BY_SHUFFLE) return subgroupOr(v);
    v |= subgroupShuffleXor(v, 1u);
    v |= subgroupShuffleXor(v, 2u);
    return LANES < 8u ? v : v | subgroupShuffleXor(v, 4u);
}

uint lanes_add(uint v) {
    return uint(lanes_add(int(v)));
}

// The sum over the invocations before this one.
uint lanes_before(uint v) {
    if (!BY_SHUFFLE) return subgroupExclusiveAdd(v);
    uint lane = gl_SubgroupInvocationID, sum = v;
    [[unroll]] for (uint log = 0u; log < 3u; log++) {
        uint step = 1u << log, below = subgroupShuffle(sum, max(lane, step) - step);
        sum += lane >= step && step < LANES ? below : 0u;
    }
    return sum - v;
}

#endif
