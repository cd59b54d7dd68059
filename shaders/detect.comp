// detect: decides which pixels are superpixels, and stores a bit for each pixel, in a word for each tile of 8 x 4 pixels.
// By the MODE, a pixel is a superpixel if one of its 8 neighbours
//   CONTRAST  has a contrasting colour, by display-encoded 8-bit codes
//   EDGES     has a contrasting colour, and another triangle (opaque or the nearest BLEND one) or other shadows
//   EXACT     has another triangle or other shadows
// SECOND_DIFFERENCES: as CONTRAST, or if three pixels a, b, c of a row, a column or a diagonal of the 3 x 3 pixels around it have
// a second difference |a - 2 b + c| above the threshold in some channel. Faint textures have one; a gradient that is rounded to
// codes has none. Beyond the image's edge its pixels are repeated.
// BLENDED: if the pixel itself shows a BLEND triangle. EVERY: always.
// Twin: src/reference/detect.rs.
// Reads: ids, blend_ids, display, marks, shadow words. Writes: masks, COUNTER_SUPERPIXELS, COUNTER_TILES.
// An invocation takes a tile: it keeps rows in registers and compares every pair of neighbours once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/contrast.glsl"
#include "include/interior.glsl"
#include "include/shadows.glsl"
layout(local_size_x = 64) in;

layout(constant_id = DETECT_CONSTANT_MODE) const uint MODE = 0u;
layout(constant_id = DETECT_CONSTANT_BLEND_IDS) const bool BLEND_IDS = false;
layout(constant_id = DETECT_CONSTANT_THIN) const bool THIN = false;    // pixels that `thin` marked are superpixels, too; some only amid a triangle
layout(constant_id = DETECT_CONSTANT_TRANSPARENT) const bool TRANSPARENT = false;  // alpha is compared, too
layout(constant_id = DETECT_CONSTANT_BEYOND) const uint BEYOND = 0u;     // pixels around the region's own that may be superpixels, for `grow`

// The nearest BLEND triangle at a pixel. MULTISAMPLED: not 0 if any sample sees one.
uint blend_at(ivec2 p) {
#ifdef MULTISAMPLED
    uint any_id = 0u;
    for (int s = 0; s < int(frame.sample_count); s++) any_id |= packUnorm4x8(texelFetch(blend_ids_ms, p, s));
    return any_id;
#else
    return texelFetch(blend_ids, p, 0).x;
#endif
}

// Whether two neighbours differ by the rule of MODE.
bool differs(uint id_a, uint id_b, uint blend_a, uint blend_b, uint shadow_a, uint shadow_b, uint color_a, uint color_b, int alpha_a, int alpha_b) {
    bool other = id_a != id_b || (BLEND_IDS && blend_a != blend_b) || shadow_a != shadow_b;
    if (MODE == DETECT_EXACT) return other;
    bool contrast = contrasting(color_a, color_b) || (TRANSPARENT && abs(alpha_a - alpha_b) > int(frame.contrast));
    return contrast && (MODE != DETECT_EDGES || other);
}

// Whether three pixels in a line have a second difference above the threshold.
bool bends(uint color_a, uint color_b, uint color_c, int alpha_a, int alpha_b, int alpha_c) {
    return bending(color_a, color_b, color_c) || (TRANSPARENT && abs(alpha_a - 2 * alpha_b + alpha_c) > int(frame.contrast));
}

void main() {
    uint tile = invocation_number();
    uint tile_count = frame.tiles.x * frame.tiles.y;
    bool inside = tile < tile_count;
    tile = min(tile, tile_count - 1u);
    ivec2 base = ivec2(split(tile, frame.tiles.x)) * ivec2(8, 4);
    ivec2 last = ivec2(frame.size) - 1;

    uint word = 0u, previous_row = 0u;
    uint amid = 0u, previous_beside = 0u, previous_same = 0u;   // pixels between two neighbours on their triangle
    if (MODE == DETECT_EVERY) {
        word = ~0u;
    } else if (MODE == DETECT_BLENDED) {
        for (int i = 0; i < 32; i++) {
            ivec2 p = min(base + ivec2(i & 7, i >> 3), last);
            word |= blend_at(p) != 0u ? 1u << i : 0u;
        }
    } else {
        uint id[10], blend[10], shadow[10], code[10], above_id[10], above_blend[10], above_shadow[10], above_code[10];
        int alpha[10], above_alpha[10];
        // SECOND_DIFFERENCES: the row above that one, and the middle pixels of lines along the last rows.
        uint top_code[10], middles = 0u, above_middles = 0u, top_middles = 0u;
        int top_alpha[10];
        [[unroll]] for (int i = 0; i < 10; i++) {
            top_code[i] = 0u; top_alpha[i] = 0;
            above_id[i] = 0u; above_blend[i] = 0u; above_code[i] = 0u; blend[i] = 0u; shadow[i] = 0u; above_shadow[i] = 0u; above_alpha[i] = 0;
        }
        // The tile's rows, with one above and one below. The results of the first two trips are shifted out of the word. ROLLED,
        // see workarounds.glsl.
        int r = -1;
        do {
            int y = clamp(base.y + r, 0, last.y);
            [[unroll]] for (int i = 0; i < 10; i++) {
                ivec2 p = ivec2(clamp(base.x - 1 + i, 0, last.x), y);
                id[i] = id_at(p);
                int place = p.y * int(frame.size.x) + p.x;
                if (BLEND_IDS) blend[i] = blend_at(p);
                shadow[i] = shadows_at(uint(place));
                uint color_code = MODE == DETECT_EXACT ? 0u : texelFetch(display, place).x;
                code[i] = spread(color_code);
                alpha[i] = int(color_code >> 24);
            }
            uint row = 0u, above = 0u;
            [[unroll]] for (int i = 0; i < 9; i++)
                row |= differs(id[i], id[i + 1], blend[i], blend[i + 1], shadow[i], shadow[i + 1], code[i], code[i + 1], alpha[i], alpha[i + 1]) ? 3u << i : 0u;
            [[unroll]] for (int i = 1; i < 9; i++) {
                uint bit = differs(id[i], above_id[i], blend[i], above_blend[i], shadow[i], above_shadow[i], code[i], above_code[i], alpha[i], above_alpha[i]) ? 1u << i : 0u;
                row |= bit;
                above |= bit;
            }
            [[unroll]] for (int i = 0; i < 9; i++) {
                bool falling = differs(above_id[i], id[i + 1], above_blend[i], blend[i + 1], above_shadow[i], shadow[i + 1], above_code[i], code[i + 1], above_alpha[i], alpha[i + 1]);
                row |= falling ? 2u << i : 0u;
                above |= falling ? 1u << i : 0u;
                bool rising = differs(above_id[i + 1], id[i], above_blend[i + 1], blend[i], above_shadow[i + 1], shadow[i], above_code[i + 1], code[i], above_alpha[i + 1], alpha[i]);
                row |= rising ? 1u << i : 0u;
                above |= rising ? 2u << i : 0u;
            }
            if (MODE == DETECT_SECOND_DIFFERENCES) {
                // Lines through the row above, which has its neighbours now.
                top_middles = above_middles;
                above_middles = middles;
                middles = 0u;
                [[unroll]] for (int i = 1; i < 9; i++)
                    middles |= bends(code[i - 1], code[i], code[i + 1], alpha[i - 1], alpha[i], alpha[i + 1]) ? 1u << i : 0u;
                above |= top_middles | above_middles | middles;
                [[unroll]] for (int i = 0; i < 10; i++) {
                    bool column = bends(top_code[i], above_code[i], code[i], top_alpha[i], above_alpha[i], alpha[i]);
                    above |= column ? 7u << i >> 1 : 0u;
                }
                [[unroll]] for (int i = 1; i < 9; i++) {
                    int left = i - 1, right = i + 1;
                    bool falling = bends(top_code[left], above_code[i], code[right], top_alpha[left], above_alpha[i], alpha[right]);
                    bool rising = bends(top_code[right], above_code[i], code[left], top_alpha[right], above_alpha[i], alpha[left]);
                    above |= falling || rising ? 1u << i : 0u;
                }
                [[unroll]] for (int i = 0; i < 10; i++) { top_code[i] = above_code[i]; top_alpha[i] = above_alpha[i]; }
            }
            word = word >> 8 | ((previous_row | above) >> 1 & 255u) << 24;
            if (THIN) {
                uint same = 0u, pairs_ = 0u;
                [[unroll]] for (int i = 1; i < 9; i++) same |= id[i] == above_id[i] && id[i] != 0u ? 1u << i : 0u;
                [[unroll]] for (int i = 0; i < 9; i++) pairs_ |= id[i] == id[i + 1] && id[i] != 0u ? 1u << i : 0u;
                amid = amid >> 8 | ((previous_beside | (previous_same & same)) >> 1 & 255u) << 24;
                previous_beside = pairs_ & pairs_ << 1;
                previous_same = same;
            }
            previous_row = row;
            [[unroll]] for (int i = 0; i < 10; i++) {
                above_id[i] = id[i];
                above_blend[i] = blend[i];
                above_shadow[i] = shadow[i];
                above_code[i] = code[i];
                above_alpha[i] = alpha[i];
            }
        } while (++r <= 4);
    }

    if (THIN && inside) word |= marks[tile] | (marks[tile_count + tile] & amid);

    word &= inside ? interior_mask(base, int(BEYOND)) : 0u;

    if (inside) masks[tile] = word;
    uint pixels = subgroupAdd(uint(bitCount(word & interior_mask(base, 0))));
    uint busy = subgroupBallotBitCount(subgroupBallot(word != 0u));
    if (subgroupElect() && busy != 0u) {
        atomicAdd(counters[COUNTER_SUPERPIXELS], pixels);
        atomicAdd(counters[COUNTER_TILES], busy);
    }
}
