// tally: sums the loads of all tiles of a stretch (see load.glsl), so that `schedule` can take whole stretches instead of tiles.
// Reads: tiles (as `bin` left them), masks. Writes: loads of stretches.
// A team takes a stretch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/load.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

void main() {
    uint stretch = team_number();
    if (stretch >= stretch_count()) return;
    begin_loads();
    uvec4 needs = uvec4(0u), entries = uvec4(0u);
    uint i = 0u;
    do {
        uint tile = stretch * STRETCH + i + member();
        bool exists = tile < tile_count();
        tile = min(tile, tile_count() - 1u);
        Load load = load_of(tile, tiles[tile]);
        needs = add(needs, exists ? min(load.needs, room + 1u) : uvec4(0u));
        entries += exists ? load.entries : uvec4(0u);
        i += TEAM;
    } while (i < STRETCH);
    [[unroll]] for (uint log = 0u; log < LOG_TEAM; log++)
        if (1u << log < TEAM) needs = add(needs, of_partner(needs, 1u << log));
    entries = team_add(entries);
    if (member() == 0u) keep_load(stretch, Load(needs, entries));
}
