// Which pixels of a tile the region owns; those of the halo belong to another region.
#ifndef INTERIOR_GLSL
#define INTERIOR_GLSL

// A bit a pixel of the tile whose first pixel is `corner`: those that the region owns, and those `beyond` pixels around them.
uint interior_mask(ivec2 corner, int beyond) {
    ivec2 low = clamp(ivec2(frame.interior_low) - beyond - corner, ivec2(0), ivec2(8, 4));
    ivec2 high = clamp(min(ivec2(frame.interior_high) + beyond, ivec2(frame.size)) - corner, ivec2(0), ivec2(8, 4));
    uint columns = ((1u << high.x) - 1u) & ~((1u << low.x) - 1u);
    uint rows = columns * 0x01010101u;
    return rows & (high.y >= 4 ? ~0u : (1u << (high.y * 8)) - 1u) & ~(low.y >= 4 ? ~0u : (1u << (low.y * 8)) - 1u);
}

#endif
