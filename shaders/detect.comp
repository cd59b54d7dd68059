// detect: decides which pixels are superpixels, and stores a bit for each pixel, in a word for each tile of 8 x 4 pixels.
// By the MODE, a pixel is a superpixel if one of its 8 neighbours
//   CONTRAST  has a contrasting colour, by display-encoded 8-bit codes
//   EDGES     has a contrasting colour, and another triangle (opaque or the nearest BLEND one) or other shadows
//   EXACT     has another triangle or other shadows
// SECOND_DIFFERENCES: as CONTRAST, or if three pixels a, b, c of a row, a column or a diagonal of the 3 x 3 pixels around it have
// a second difference |a - 2 b + c| above the threshold in some channel. Faint textures have one; a gradient that is rounded to
// codes has none. Beyond the image's edge its pixels are repeated.
// BLENDED: if the pixel itself shows a BLEND triangle. EVERY: always.
// Twin: twins/src/detect.rs.
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

// What a pixel shows.
struct Texel {
    uint id, blend;         // its triangle, and its nearest BLEND triangle
    uint shadow;            // lights that do not reach it
    uint code;              // codes of its colour, see `spread`
    int alpha;
};

Texel texel_at(ivec2 p) {
    Texel t;
    int place = p.y * int(frame.size.x) + p.x;
    t.id = id_at(p);
    t.blend = 0u;
    if (BLEND_IDS) t.blend = blend_at(p);
    // Where a centre sees no triangle, nobody has written shadows.
    t.shadow = t.id != 0u ? shadows_at(uint(place)) : 0u;
    uint color_code = MODE == DETECT_EXACT ? 0u : texelFetch(display, place).x;
    t.code = spread(color_code);
    t.alpha = int(color_code >> 24);
    return t;
}

// Whether two neighbours differ by the rule of MODE.
bool differs(Texel a, Texel b) {
    bool other = a.id != b.id || (BLEND_IDS && a.blend != b.blend) || a.shadow != b.shadow;
    if (MODE == DETECT_EXACT) return other;
    bool contrast = contrasting(a.code, b.code) || (TRANSPARENT && abs(a.alpha - b.alpha) > int(frame.contrast));
    return contrast && (MODE != DETECT_EDGES || other);
}

// Whether three pixels in a line have a second difference above the threshold.
bool bends(Texel a, Texel b, Texel c) {
    return bending(a.code, b.code, c.code) || (TRANSPARENT && abs(a.alpha - 2 * b.alpha + c.alpha) > int(frame.contrast));
}

// Sets of pixels of a row, a bit each: bit i is that of pixel i - 1 of the tile.
struct Row {
    uint differing;         // those that differ from a neighbour
    uint middles;           // SECOND_DIFFERENCES: middle pixels of lines along the row
    uint beside, same;      // those between two neighbours on their triangle; those on that of the pixel above
};

// Compares the pixels of a row with each other and with those above. Returns those of the row above that differ.
uint compare(Texel here[10], Texel above[10], inout Row row) {
    uint over = 0u;
    row.differing = 0u;
    [[unroll]] for (int i = 0; i < 9; i++) row.differing |= differs(here[i], here[i + 1]) ? 3u << i : 0u;
    [[unroll]] for (int i = 1; i < 9; i++) {
        uint bit = differs(here[i], above[i]) ? 1u << i : 0u;
        row.differing |= bit;
        over |= bit;
    }
    [[unroll]] for (int i = 0; i < 9; i++) {
        bool falling = differs(above[i], here[i + 1]);
        row.differing |= falling ? 2u << i : 0u;
        over |= falling ? 1u << i : 0u;
        bool rising = differs(above[i + 1], here[i]);
        row.differing |= rising ? 1u << i : 0u;
        over |= rising ? 2u << i : 0u;
    }
    return over;
}

// The middle pixels of lines through the row above, which go up and down.
uint middles_of_lines(Texel here[10], Texel above[10], Texel top[10]) {
    uint middles = 0u;
    [[unroll]] for (int i = 0; i < 10; i++) middles |= bends(top[i], above[i], here[i]) ? 7u << i >> 1 : 0u;
    [[unroll]] for (int i = 1; i < 9; i++) {
        bool falling = bends(top[i - 1], above[i], here[i + 1]), rising = bends(top[i + 1], above[i], here[i - 1]);
        middles |= falling || rising ? 1u << i : 0u;
    }
    return middles;
}

// The pixels of a tile that differ from a neighbour, and those that lie `amid` a triangle.
uint differing_pixels(ivec2 base, out uint amid) {
    ivec2 last = ivec2(frame.size) - 1;
    Texel here[10], above[10], top[10];
    [[unroll]] for (int i = 0; i < 10; i++) above[i] = top[i] = Texel(0u, 0u, 0u, 0u, 0);
    Row row = Row(0u, 0u, 0u, 0u), before = row;
    uint word = 0u, top_middles = 0u;
    amid = 0u;
    // The tile's rows, with one above and one below. The results of the first two trips are shifted out of the words. ROLLED,
    // see workarounds.glsl.
    int r = -1;
    do {
        [[unroll]] for (int i = 0; i < 10; i++) here[i] = texel_at(ivec2(clamp(base.x - 1 + i, 0, last.x), clamp(base.y + r, 0, last.y)));
        uint over = before.differing | compare(here, above, row);
        if (MODE == DETECT_SECOND_DIFFERENCES) {
            row.middles = 0u;
            [[unroll]] for (int i = 1; i < 9; i++) row.middles |= bends(here[i - 1], here[i], here[i + 1]) ? 1u << i : 0u;
            over |= top_middles | before.middles | row.middles | middles_of_lines(here, above, top);
            top_middles = before.middles;
        }
        word = word >> 8 | (over >> 1 & 255u) << 24;
        if (THIN) {
            uint pairs_ = 0u;
            row.same = 0u;
            [[unroll]] for (int i = 1; i < 9; i++) row.same |= here[i].id == above[i].id && here[i].id != 0u ? 1u << i : 0u;
            [[unroll]] for (int i = 0; i < 9; i++) pairs_ |= here[i].id == here[i + 1].id && here[i].id != 0u ? 1u << i : 0u;
            row.beside = pairs_ & pairs_ << 1;
            amid = amid >> 8 | ((before.beside | (before.same & row.same)) >> 1 & 255u) << 24;
        }
        before = row;
        [[unroll]] for (int i = 0; i < 10; i++) {
            top[i] = above[i];
            above[i] = here[i];
        }
    } while (++r <= 4);
    return word;
}

uint blended_pixels(ivec2 base) {
    uint word = 0u;
    for (int i = 0; i < 32; i++) {
        ivec2 p = min(base + ivec2(i & 7, i >> 3), ivec2(frame.size) - 1);
        word |= blend_at(p) != 0u ? 1u << i : 0u;
    }
    return word;
}

void main() {
    uint tile = invocation_number(), tile_count = frame.tiles.x * frame.tiles.y;
    bool inside = tile < tile_count;
    tile = min(tile, tile_count - 1u);
    ivec2 base = ivec2(split(tile, frame.tiles.x)) * ivec2(8, 4);
    uint word = ~0u, amid = 0u;
    if (MODE == DETECT_BLENDED) word = blended_pixels(base);
    else if (MODE != DETECT_EVERY) word = differing_pixels(base, amid);
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
