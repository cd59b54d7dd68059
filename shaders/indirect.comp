// indirect: reads a list of draws that the device wrote, as VkDrawIndexedIndirectCommand or VkDrawIndirectCommand, and places
// their instances, one after the other, in the part of the frame's draws, triangles and positions that the list has. Every
// instance of a command is a draw. It runs in four STEPs. An invocation takes
//   COMMANDS   commands: adds up their instances. One workgroup takes all
//   BLOCKS     a draw: its workgroup adds up the triangles and positions of a block of draws
//   SUMS       blocks: adds them up. One workgroup takes all
//   PLACE      a draw: writes it, after the sums of all draws before it
// Reads: commands, count, instances. Writes: draws, matrices, first_draws, blocks, totals.
//
// Draws are placed as long as they fit. From the first one on that does not, all are left out, and so is the rest of the list's
// part: a draw that is left out begins where the last one ended, so that a search for the draw of a triangle that no draw has
// finds it. The corners of such a triangle are the same position, so that no pixel sees it. A draw that is not possible, such as
// one with vertices that its mesh does not have, has no triangles.
// Sums that would exceed 32 bits stay at the largest number.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define DRAWS_ARE_WRITTEN
#include "include/interface.glsl"
#include "include/workgroup.glsl"
#include "include/draws.glsl"
#include "include/gpc_instance.glsl"
layout(local_size_x = 64) in;
layout(constant_id = INDIRECT_CONSTANT_STEP) const uint STEP = 0u;
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_COMMANDS) readonly buffer Commands { uint commands[]; };
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_COUNT) readonly buffer Count { uint count[]; };
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_INSTANCES) readonly buffer Instances { GpcInstance instances[]; };
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_DRAWS_OUT) writeonly buffer DrawsOut { Draw draws_out[]; };
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_MATRICES_OUT) writeonly buffer MatricesOut { mat4 matrices_out[]; };
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_FIRST_DRAWS) buffer FirstDraws { uint first_draws[]; };   // of each command
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_BLOCKS) buffer Blocks { uvec2 blocks[]; };     // triangles and positions
layout(std430, set = SET_OWN, binding = INDIRECT_BINDING_TOTALS) buffer Totals { uint totals[]; };
layout(push_constant) uniform Push {
    uint first_command;     // the word at which the first command begins
    uint command_stride;    // in words
    uint command_capacity;
    uint count_word;        // the word with the number of commands, with INDIRECT_COUNTED
    uint instance_capacity;
    uint draw_capacity;
    uint triangle_capacity;
    uint position_capacity;
    uint first_draw;        // the list's part of draws, triangles and positions; without INDIRECT_OBJECT, the mesh's positions
    uint first_triangle;
    uint first_position;
    uint vertex_capacity;   // of the mesh
    uint index_capacity;    // of the mesh
    uint topology;
    uint keys;
    uint alpha_maps;
    uint flags;
} push;

// Commands or blocks that a trip of a loop adds up, and those of an invocation.
const uint STRIP = 1024u, EACH = STRIP / 64u;

struct Item {
    uint first_index;
    uint vertex_offset;
    uint instance;
    uint triangles;
    uint positions;
    bool possible;
};

shared uvec2 sums[64];

bool has(uint flag) { return (push.flags & flag) != 0u; }

uvec2 plus(uvec2 a, uvec2 b) { return a + min(b, ~a); }

// The sum of what the workgroup's invocations before this one have, and of what all of them have.
uvec2 before(uvec2 mine, out uvec2 all_) {
    uint i = gl_LocalInvocationID.x;
    sums[i] = mine;
    barrier();
    [[unroll]] for (uint apart = 1u; apart < 64u; apart *= 2u) {
        uvec2 sum = sums[i], other = i >= apart ? sums[i - apart] : uvec2(0u);
        barrier();
        sums[i] = plus(sum, other);
        barrier();
    }
    all_ = sums[63];
    uvec2 found = i > 0u ? sums[i - 1u] : uvec2(0u);
    barrier();
    return found;
}

// Blocks of the draws that there is room for, and of one more, which ends the list's part.
uint block_count() { return push.draw_capacity / INDIRECT_BLOCK + 1u; }

uint command_count() {
    return has(INDIRECT_COUNTED) ? min(count[push.count_word], push.command_capacity) : push.command_capacity;
}

uint draws_of_command(uint c, uint commands_) {
    return c < commands_ ? commands[push.first_command + c * push.command_stride + 1u] : 0u;
}

void add_up_commands() {
    uint commands_ = command_count(), first = gl_LocalInvocationID.x * EACH;
    uvec2 sum = uvec2(0u), strip;
    do {
        uint mine = 0u, i = 0u;
        do {
            mine = plus(uvec2(mine), uvec2(draws_of_command(first + i, commands_))).x;
        } while (++i < EACH);
        uint at = plus(sum, before(uvec2(mine), strip)).x;
        i = 0u;
        do {
            uint c = first + i;
            if (c < commands_) first_draws[c] = at;
            at = plus(uvec2(at), uvec2(draws_of_command(c, commands_))).x;
        } while (++i < EACH);
        sum = plus(sum, strip);
        first += STRIP;
    } while (first - gl_LocalInvocationID.x * EACH < commands_);
    if (gl_LocalInvocationID.x == 0u) totals[TOTAL_FOUND] = sum.x;
    if (gl_LocalInvocationID.x >= 1u && gl_LocalInvocationID.x <= TOTAL_POSITIONS) totals[gl_LocalInvocationID.x] = 0u;
}

// Binary search: the last command that begins at draw `d` or before it.
uint command_of(uint d, uint commands_) {
    uint c = 0u, step_ = 1u << uint(findMSB(commands_));
    do {
        uint next = c + step_;
        c = next < commands_ && first_draws[min(next, commands_ - 1u)] <= d ? next : c;
        step_ >>= 1;
    } while (step_ > 0u);
    return c;
}

// Draw `d` of the list, whose instance exists. A draw that is not possible has no triangles and no positions.
Item item_at(uint d) {
    Item item = Item(0u, 0u, 0u, 0u, 0u, true);
    uint found = min(totals[TOTAL_FOUND], push.draw_capacity);
    if (d >= found) return item;
    uint c = command_of(d, command_count()), at = push.first_command + c * push.command_stride;
    uint corners = commands[at];
    item.first_index = has(INDIRECT_INDEXED) ? commands[at + 2u] : 0u;
    item.vertex_offset = has(INDIRECT_INDEXED) ? commands[at + 3u] : commands[at + 2u];
    uint first_instance = commands[at + (has(INDIRECT_INDEXED) ? 4u : 3u)];
    item.instance = plus(uvec2(first_instance), uvec2(d - first_draws[c])).x;
    item.triangles = push.topology == TOPOLOGY_LIST ? corners / 3u : max(corners, 2u) - 2u;
    if (item.triangles == 0u) return item;

    GpcInstance instance = instances[min(item.instance, push.instance_capacity - 1u)];
    item.positions = has(INDIRECT_OBJECT) ? instance.vertex_count : 0u;
    bool has_map = has(INDIRECT_ALPHA_TESTED) ? instance.alpha_map - 1u < push.alpha_maps : instance.alpha_map == 0u;
    bool has_indices = !has(INDIRECT_INDEXED)
        || (item.first_index <= push.index_capacity && corners <= push.index_capacity - item.first_index);
    uint vertices = has(INDIRECT_OBJECT) ? item.positions : has(INDIRECT_INDEXED) ? 0u : corners;
    bool has_vertices = (item.positions > 0u || !has(INDIRECT_OBJECT)) && (corners <= vertices || has(INDIRECT_INDEXED))
        && (vertices == 0u || (item.vertex_offset <= push.vertex_capacity && vertices <= push.vertex_capacity - item.vertex_offset));
    item.possible = item.instance < push.instance_capacity && instance.key < push.keys && has_map && has_indices && has_vertices;
    if (!item.possible) {
        item.triangles = 0u;
        item.positions = 0u;
    }
    return item;
}

void add_up_draws() {
    Item item = item_at(invocation_number());
    uvec2 all_;
    before(uvec2(item.triangles, item.positions), all_);
    if (gl_LocalInvocationID.x == 0u && workgroup_number() < block_count()) blocks[workgroup_number()] = all_;
}

void add_up_blocks() {
    uint blocks_ = block_count(), first = gl_LocalInvocationID.x * EACH;
    uvec2 sum = uvec2(0u), strip;
    do {
        uvec2 mine = uvec2(0u);
        uint i = 0u;
        do {
            if (first + i < blocks_) mine = plus(mine, blocks[first + i]);
        } while (++i < EACH);
        uvec2 at = plus(sum, before(mine, strip));
        i = 0u;
        do {
            if (first + i < blocks_) {
                uvec2 block = blocks[first + i];
                blocks[first + i] = at;
                at = plus(at, block);
            }
        } while (++i < EACH);
        sum = plus(sum, strip);
        first += STRIP;
    } while (first - gl_LocalInvocationID.x * EACH < blocks_);
}

void place() {
    uint d = invocation_number();
    Item item = item_at(d);
    uvec2 mine = uvec2(item.triangles, item.positions), all_, capacity = uvec2(push.triangle_capacity, push.position_capacity);
    uvec2 sum = before(mine, all_);
    if (d > push.draw_capacity) return;
    uvec2 first = plus(blocks[workgroup_number()], sum), end = plus(first, mine);
    bool fits = d < min(totals[TOTAL_FOUND], push.draw_capacity) && all(lessThanEqual(end, capacity));
    if (fits) {
        atomicAdd(totals[TOTAL_PLACED], 1u);
        atomicAdd(totals[TOTAL_IMPOSSIBLE], uint(!item.possible));
        atomicMax(totals[TOTAL_TRIANGLES], end.x);
        atomicMax(totals[TOTAL_POSITIONS], end.y);
    }
    bool drawn = fits && item.triangles > 0u, object = has(INDIRECT_OBJECT);
    GpcInstance instance = instances[min(item.instance, push.instance_capacity - 1u)];
    Draw draw;
    draw.first_triangle = push.first_triangle + min(first.x, push.triangle_capacity);
    draw.first_index = drawn ? item.first_index : 0u;
    draw.vertex_offset = drawn && !object ? item.vertex_offset : 0u;
    uint look = has(INDIRECT_ALPHA_TESTED) ? instance.alpha_map - 1u : instance.material & 0xffffu;
    draw.word = drawn ? look | instance.key << 16 | uint(instance.detailed != 0u) << 30 | uint(has(INDIRECT_DOUBLE_SIDED)) << 31 : 0u;
    draw.first_position = push.first_position + (object ? min(first.y, push.position_capacity) : 0u);
    draw.last_position = !drawn ? 0u : object ? item.positions - 1u : push.vertex_capacity - 1u;
    draw.shift = (drawn && object ? item.vertex_offset : 0u) - draw.first_position;
    draw.material = instance.material;
    draws_out[push.first_draw + d] = draw;
    // Positions of no draw lie outside of the image.
    if (object) matrices_out[push.first_draw + d] = drawn ? instance.to_clip
        : mat4(vec4(0.0), vec4(0.0), vec4(0.0), vec4(2.0, 2.0, 0.0, 1.0));
}

void main() {
    if (STEP == INDIRECT_COMMANDS) add_up_commands();
    else if (STEP == INDIRECT_BLOCKS) add_up_draws();
    else if (STEP == INDIRECT_SUMS) add_up_blocks();
    else place();
}
