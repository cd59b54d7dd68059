// composite: computes the colour of each list of layers, and stores it as that of the list's leaf. An invocation takes a record,
// and does nothing if this is no leaf.
// Reads: records, shaded. Writes: shaded.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/composite.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = invocation_number();
    if (i >= min(counters[COUNTER_RECORDS], frame.record_capacity) || texelFetch(records, int(i)).y != 0u) return;
    uint nearest = farther(i);
    if (nearest != ~0u) shaded_out[i] = composite(nearest);
}
