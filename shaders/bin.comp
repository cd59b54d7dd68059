// bin: survivors into lists per tile. Runs twice: COUNT adds up the length of each tile's list, SCATTER,
// after `schedule` has placed the lists of this round, writes set-up triangles into them.
// Reads: triangles, clip, masks, survivors, tiles. Writes: tiles, candidates (4 vectors each).
// The order within a list varies from run to run; `sample` does not depend on it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const bool SCATTER = false;
layout(constant_id = 1) const bool LARGE = false;

void main() {
    uint i = LARGE ? gl_WorkGroupID.x + gl_WorkGroupID.y * 32768u : gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    uint count_all = counters[LARGE ? COUNTER_LARGE : COUNTER_SURVIVORS];
    if (i >= count_all) return;
    uint t = survivors[LARGE ? frame.triangle_count - 1u - i : i];
    uvec4 indices = texelFetch(triangles, int(t));
    vec4 v0 = texelFetch(clip, int(indices.x)), v1 = texelFetch(clip, int(indices.y)), v2 = texelFetch(clip, int(indices.z));
    Footprint f = footprint_of(v0, v1, v2);
    bool cull = (indices.w >> 31) == 0u;
    uint flag = t >= frame.first_blend ? TILE_HAS_BLEND : t >= frame.first_mask ? TILE_HAS_MASK : 0u;

    ivec2 low = f.low / ivec2(8, 4), high = f.high / ivec2(8, 4);
    uint columns = uint(high.x - low.x + 1), count = columns * uint(high.y - low.y + 1);
    float inverse_columns = 1.0 / float(columns);
    uint k = LARGE ? gl_LocalInvocationID.x : 0u;
    do {
        uint kk = min(k, count - 1u);
        uint row = uint((float(kk) + 0.5) * inverse_columns);
        ivec2 tile = low + ivec2(kk - row * columns, row);
        uint index = uint(tile.y) * frame.tiles.x + uint(tile.x);
        vec2 center = tile_center(tile);
        Setup s = setup_triangle(v0, v1, v2, center, cull);
        // A sub-sample is within (4, 2) pixels of the tile's centre; a quarter more covers rounding.
        vec3 reach = s.c + 4.25 * abs(s.a) + 2.25 * abs(s.b);
        bool touches = k < count && (masks[index] & footprint_mask(f, tile)) != 0u && s.valid
            && min(reach.x, min(reach.y, reach.z)) >= 0.0;
        if (touches) {
            if (!SCATTER) {
                atomicAdd(tiles[index].x, 1u);
                if (flag != 0u) atomicOr(tiles[index].w, flag);
            } else if ((tiles[index].w & TILE_LISTED) != 0u) {
                int o = int(tiles[index].y + atomicAdd(tiles[index].x, ~0u) - 1u) * 4;
                imageStore(candidates_out, o, vec4(s.a.x, s.b.x, s.c.x, s.a.y));
                imageStore(candidates_out, o + 1, vec4(s.b.y, s.c.y, s.a.z, s.b.z));
                imageStore(candidates_out, o + 2, vec4(s.c.z, s.depth));
                imageStore(candidates_out, o + 3, vec4(s.near, s.far, uintBitsToFloat(t + 1u), 0.0));
            }
        }
        k += LARGE ? 64u : 1u;
    } while (k < count);
}
