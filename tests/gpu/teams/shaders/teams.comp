// teams: what the operations of team.glsl give. Teams with odd numbers take another branch than those with even numbers, and each
// team has its own number of trips, so that the teams of a subgroup part.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_control_flow_attributes : require
#include "team.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(std430, set = 0, binding = 0) readonly buffer Given { uint given[]; };       // one for each invocation
layout(std430, set = 0, binding = 1) writeonly buffer Found { uint found[]; };      // RESULTS for each invocation

const uint RESULTS = 16u;

// Writes the results for a value of each member. tests/gpu/teams.rs computes the same.
void operate(uint invocation, uint v) {
    float f = float(v >> 12);           // sums of these are exact
    uint ballot = team_ballot((v & 4u) != 0u);
    uint results[RESULTS] = uint[RESULTS](
        team_add(v), team_min(v), team_max(v), team_or(v), uint(team_any((v & 7u) == 1u)), ballot, bits_before(ballot), team_before(v),
        of_member(v, v % TEAM), of_partner(v, 1u), of_partner(v, TEAM - 1u),
        floatBitsToUint(team_add(f)), floatBitsToUint(team_min(f)), floatBitsToUint(team_max(f)),
        floatBitsToUint(of_member(f, v % TEAM)), floatBitsToUint(of_partner(f, TEAM / 2u)));
    [[unroll]] for (uint r = 0u; r < RESULTS; r++) found[RESULTS * invocation + r] = results[r];
}

void main() {
    uint team = team_number(), invocation = team * TEAM + member(), v = given[invocation], trip = 0u;
    do {
        v = v * 1664525u + 1013904223u;
        if ((team & 1u) == 0u) operate(invocation, v); else operate(invocation, ~v);
    } while (trip++ < team % 5u);
}
