// append: what append.glsl gives. Invocations append different numbers of entries, in different numbers of trips.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Given { uint given[]; };       // one for each invocation
// The length of the list, then for each of its places how often it was given away.
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
#include "append.glsl"

void main() {
    uint v = given[gl_GlobalInvocationID.x], last = v % 5u, trip = 0u;
    do {
        uint count = trip <= last ? v >> 3u * trip & 7u : 0u, at = append(0u, count);
        for (uint i = 0u; i < count; i++) atomicAdd(counters[1u + at + i], 1u);
    } while (subgroupAny(++trip <= last));
}
