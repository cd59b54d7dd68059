// A team: TEAM neighbouring invocations of a subgroup that work together, on a cell or on a stretch of a list. A workgroup has
// TEAMS of them, and a subgroup as many as fit: one of CPU devices, four of subgroups of 32.
//
// Teams of a subgroup take different branches and trips of loops. So they exchange data by shuffles among their own members alone,
// which read no invocation that took another way: no ballot, election, broadcast or reduction of the subgroup. A branch with a
// shuffle in it is taken by all members or by none. Other branches, within which members part, end in the same statement.
#ifndef TEAM_GLSL
#define TEAM_GLSL
#include "interface.glsl"
#include "workgroup.glsl"

layout(constant_id = CONSTANT_TEAM) const uint TEAM = 8u;            // 4 to 32, a power of two
layout(constant_id = CONSTANT_TEAMS) const uint TEAMS = 1u;          // teams of a workgroup

const uint LOG_TEAM = 5u;                                               // binary logarithm of the largest team

// The number of this invocation in its team.
uint member() { return TEAMS == 1u ? gl_SubgroupInvocationID : gl_SubgroupInvocationID & (TEAM - 1u); }

uint team_in_workgroup() {
    return TEAMS == 1u ? 0u : gl_SubgroupID * (gl_SubgroupSize / TEAM) + gl_SubgroupInvocationID / TEAM;
}

// The number of this team in the dispatch.
uint team_number() { return workgroup_number() * TEAMS + team_in_workgroup(); }

// Workgroups of a number of teams.
uint workgroups_of(uint teams) { return (teams + TEAMS - 1u) / TEAMS; }

// The value of another member.
uint invocation_of(uint member_) { return TEAMS == 1u ? member_ : (gl_SubgroupInvocationID & ~(TEAM - 1u)) | member_; }
uint of_member(uint v, uint m) { return subgroupShuffle(v, invocation_of(m)); }
float of_member(float v, uint m) { return subgroupShuffle(v, invocation_of(m)); }
vec2 of_member(vec2 v, uint m) { return vec2(of_member(v.x, m), of_member(v.y, m)); }
vec3 of_member(vec3 v, uint m) { return vec3(of_member(v.xy, m), of_member(v.z, m)); }
vec4 of_member(vec4 v, uint m) { return vec4(of_member(v.xy, m), of_member(v.zw, m)); }
uvec2 of_member(uvec2 v, uint m) { return uvec2(of_member(v.x, m), of_member(v.y, m)); }
uvec3 of_member(uvec3 v, uint m) { return uvec3(of_member(v.xy, m), of_member(v.z, m)); }
uvec4 of_member(uvec4 v, uint m) { return uvec4(of_member(v.xy, m), of_member(v.zw, m)); }

// The value of the member whose number differs in the bits of `mask`, which is less than TEAM.
uint of_partner(uint v, uint mask) { return subgroupShuffleXor(v, mask); }
float of_partner(float v, uint mask) { return subgroupShuffleXor(v, mask); }
vec3 of_partner(vec3 v, uint mask) { return vec3(of_partner(v.x, mask), of_partner(v.y, mask), of_partner(v.z, mask)); }
uvec4 of_partner(uvec4 v, uint mask) { return uvec4(of_partner(v.x, mask), of_partner(v.y, mask), of_partner(v.z, mask), of_partner(v.w, mask)); }
uvec2 of_partner(uvec2 v, uint mask) { return uvec2(of_partner(v.x, mask), of_partner(v.y, mask)); }

// Sums and the like over all members.
uint team_add(uint v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v += of_partner(v, 1u << log);
    return v;
}

float team_add(float v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v += of_partner(v, 1u << log);
    return v;
}

uvec2 team_add(uvec2 v) { return uvec2(team_add(v.x), team_add(v.y)); }
uvec4 team_add(uvec4 v) { return uvec4(team_add(v.xy), team_add(v.zw)); }

uint team_min(uint v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v = min(v, of_partner(v, 1u << log));
    return v;
}

float team_min(float v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v = min(v, of_partner(v, 1u << log));
    return v;
}

uint team_max(uint v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v = max(v, of_partner(v, 1u << log));
    return v;
}

float team_max(float v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v = max(v, of_partner(v, 1u << log));
    return v;
}

uint team_or(uint v) {
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) if (1u << log < TEAM) v |= of_partner(v, 1u << log);
    return v;
}

bool team_any(bool v) { return team_or(v ? 1u : 0u) != 0u; }

// A bit for each member, set if its value is true.
uint team_ballot(bool v) { return team_or(v ? 1u << member() : 0u); }

// The number of those of these bits that are of members before this one.
uint bits_before(uint bits) { return uint(bitCount(bits & ((1u << member()) - 1u))); }

// The sum over the members before this one.
uint team_before(uint v) {
    uint lane = member(), sum = v;
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++) {
        uint step_ = 1u << log;
        if (step_ < TEAM) {
            uint below = of_member(sum, max(lane, step_) - step_);
            sum += lane >= step_ ? below : 0u;
        }
    }
    return sum - v;
}

uvec2 team_before(uvec2 v) { return uvec2(team_before(v.x), team_before(v.y)); }
uvec4 team_before(uvec4 v) { return uvec4(team_before(v.xy), team_before(v.zw)); }

// Waits for the whole workgroup, so that members see what others of their team have written to shared memory. All invocations
// of the workgroup call this together.
void team_barrier() {
    if (TEAMS == 1u) subgroupBarrier(); else barrier();
}

#endif
