// tally: sums the loads of all tiles of a stretch (see load.glsl), so that `schedule` can take whole stretches instead of tiles.
// Reads: tiles (as `bin` left them), masks. Writes: loads of stretches.
// A subgroup takes a stretch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/load.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

void main() {
    if (in_other_subgroups(LANES)) return;
    uint stretch = workgroup_number();
    if (stretch >= stretch_count()) return;
    begin_loads();
    uvec4 needs = uvec4(0u), entries = uvec4(0u);
    uint i = 0u;
    do {
        uint tile = stretch * STRETCH + i + gl_SubgroupInvocationID;
        bool exists = tile < tile_count();
        tile = min(tile, tile_count() - 1u);
        Load load = load_of(tile, tiles[tile]);
        needs = add(needs, exists ? min(load.needs, room + 1u) : uvec4(0u));
        entries += exists ? load.entries : uvec4(0u);
        i += LANES;
    } while (i < STRETCH);
    [[unroll]] for (uint log = 0u; log < 5u; log++)
        if (1u << log < LANES) needs = add(needs, subgroupShuffleXor(needs, 1u << log));
    entries = uvec4(lanes_add(entries.x), lanes_add(entries.y), lanes_add(entries.z), lanes_add(entries.w));
    if (subgroupElect()) keep_load(stretch, Load(needs, entries));
}
