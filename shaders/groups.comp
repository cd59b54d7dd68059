// groups: enters the groups of cells of the round's tiles in the work lists, by the kinds of their tiles, as `enlist` does with
// tiles. An invocation takes a group.
// Reads: location_groups, tiles. Writes: tile_lists, counters. The order varies from run to run; `sample` does not depend on it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/tiles.glsl"
#include "include/work.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = invocation_number();
    uint count = counters[COUNTER_GROUPS];
    uint tile = texelFetch(location_groups, int(min(i, max(count, 1u) - 1u))).x, flags = tiles[tile].w;
    // POINTS in a tile without triangles need no samples: they see the background.
    bool needless = POINTS && tiles[tile].x == 0u;
    bool placed = i < count && in_round(tile) && !needless;
    uint needs = (flags & TILE_LISTED) == 0u ? 3u : (flags & TILE_HAS_BLEND) != 0u ? 2u : (flags & TILE_HAS_MASK) != 0u ? 1u : 0u;
    for (uint list = 0u; list < TILE_LISTS; list++) {
        bool mine = placed && needs == list;
        uvec4 together = subgroupBallot(mine);
        uint n = subgroupBallotBitCount(together), base = 0u;
        if (subgroupElect() && n != 0u) base = atomicAdd(counters[COUNTER_PLAIN_TILES + list], n);
        base = subgroupBroadcastFirst(base);
        if (mine) tile_lists[first_entry(list) + base + subgroupBallotExclusiveBitCount(together)] = work_entry(i, 0u);
    }
}
