// In how many parts of a superpixel a triangle is shaded. It depends on how much the triangle's colours vary at the centres of
// the superpixel and of the 8 pixels around it. Twin: twins/src/variation.rs.
#ifndef VARIATION_GLSL
#define VARIATION_GLSL
#include "triangle.glsl"

// The parts of a cell in which a triangle is shaded: all, or all merged in pairs or in fours, or one for the whole cell.
const uint PARTS_ALL = 0u, PARTS_PAIRS = 1u, PARTS_FOURS = 2u, PARTS_ONE = 3u;

// FEWER_PARTS: where colours are known to vary little. SOME_PARTS: where nothing is known about them. Cells with parts of one
// sample have few parts anyway, which are merged less.
const uint FEWER_PARTS = PART == 1u ? PARTS_PAIRS : PARTS_FOURS, SOME_PARTS = PART == 1u ? PARTS_ALL : PARTS_PAIRS;

// With 65 to 256 samples, parts are merged in pairs where colours differ by at most so many 8-bit codes. With fewer samples the
// error would rise more, and with more samples, too.
const float PAIRED_RANGE = 12.0;

// Number of samples of a part.
uint part_length(uint parts) { return PART << parts; }

// Whether a part is twice as wide as high, not a square. Parts come from halving the cell again and again, its height first.
bool part_is_wide(uint samples, uint parts) {
    return (findMSB(max(samples / part_length(parts), 1u)) & 1) != 0;
}

// What the nine centres tell about two of the triangles that they see, the first being the one at the pixel's own centre: the
// parts for each of the two, and for other triangles with their materials.
struct Variation {
    uvec2 ids;
    uvec2 materials;
    uint parts;             // 2 bits each: for the two triangles, then for their materials
};

uint variation_material(uint of) {
    return of == 0u ? ~0u : material_of(triangle_word(of - 1u));
}

// The range of the colours of `codes` that are in the bit set `among`, in the channel where it is largest, in 8-bit codes.
float variation_range(uint codes[9], uint among) {
    vec3 low = vec3(1.0), high = vec3(0.0);
    [[unroll]] for (uint i = 0u; i < 9u; i++) {
        vec3 color = unpackUnorm4x8(codes[i]).rgb;
        bool some = (among >> i & 1u) != 0u;
        low = some ? min(low, color) : low;
        high = some ? max(high, color) : high;
    }
    vec3 range = round(255.0 * (high - low));
    return max(range.r, max(range.g, range.b));
}

uint variation_parts(float range) {
    float alike = float(frame.alike);
    bool pairs = frame.alike != 0u && frame.sample_count > 64u && frame.sample_count <= 256u && range <= PAIRED_RANGE;
    // With many samples, triangles are shaded once only where colours do not differ at all.
    bool even = range <= (frame.sample_count < MANY_SAMPLES ? alike : 0.0);
    return even ? PARTS_ONE : range <= 4.0 * alike ? FEWER_PARTS : pairs ? SOME_PARTS : PARTS_ALL;
}

// The parts for a triangle that the centres in the bit set `own` see. `of_material` are those for its material.
uint variation_of_triangle(uint codes[9], uint own, uint of_material) {
    int count = bitCount(own);
    bool even = count >= 2 && 4.0 * variation_range(codes, own) <= float(frame.alike);
    return even && count >= 4 ? PARTS_ONE : even ? max(of_material, SOME_PARTS) : of_material;
}

// The variation around a pixel. Each invocation may take a pixel of its own.
Variation variation_around(uvec2 pixel) {
    uint ids_[9], materials_[9], codes[9];
    [[unroll]] for (uint i = 0u; i < 9u; i++) {
        uint place = i == 0u ? 4u : i <= 4u ? i - 1u : i;      // the pixel itself comes first
        ivec2 there = ivec2(pixel) + ivec2(place % 3u, place / 3u) - 1;
        bool exists = all(greaterThanEqual(there, ivec2(0))) && all(lessThan(there, ivec2(frame.size)));
        there = exists ? there : ivec2(min(pixel, frame.size - 1u));
        uint id_there = id_at(there);
        ids_[i] = exists ? id_there : 0u;
        materials_[i] = variation_material(ids_[i]);
        codes[i] = texelFetch(display, there.y * int(frame.size.x) + there.x).x;
    }
    Variation r;
    r.ids = uvec2(ids_[0], 0u);
    r.materials = uvec2(materials_[0], ~0u);
    [[unroll]] for (uint i = 1u; i < 9u; i++) {
        bool other = r.ids.y == 0u && ids_[i] != 0u && ids_[i] != ids_[0];
        r.ids.y = other ? ids_[i] : r.ids.y;
        r.materials.y = other ? materials_[i] : r.materials.y;
    }
    uvec2 own = uvec2(0u), alike = uvec2(0u);
    [[unroll]] for (uint i = 0u; i < 9u; i++) {
        own |= uvec2(ids_[i] == r.ids.x ? 1u << i : 0u, ids_[i] == r.ids.y ? 1u << i : 0u);
        alike |= uvec2(materials_[i] == r.materials.x ? 1u << i : 0u, materials_[i] == r.materials.y ? 1u << i : 0u);
    }
    uvec2 of_material = uvec2(
        bitCount(alike.x) >= 3 ? variation_parts(variation_range(codes, alike.x)) : SOME_PARTS,
        bitCount(alike.y) >= 3 ? variation_parts(variation_range(codes, alike.y)) : SOME_PARTS);
    uvec2 of_triangle = uvec2(
        variation_of_triangle(codes, own.x, of_material.x), variation_of_triangle(codes, own.y, of_material.y));
    r.parts = of_triangle.x | of_triangle.y << 2 | of_material.x << 4 | of_material.y << 6;
    return r;
}

Variation my_variation;     // of the pixel of a member's cell

Variation variation_of(uint holder) {
    Variation r;
    r.ids = of_member(my_variation.ids, holder);
    r.materials = of_member(my_variation.materials, holder);
    r.parts = of_member(my_variation.parts, holder);
    return r;
}

bool high_frequency_triangle(uint of) {
    return high_frequency(triangle_word(max(of, 1u) - 1u));
}

// The parts in which a triangle is shaded.
uint parts_around(Variation around, uint triangle) {
    uint material = variation_material(triangle);
    uint at = triangle == around.ids.x ? 0u : triangle == around.ids.y ? 2u : material == around.materials.x ? 4u : 6u;
    return at == 6u && material != around.materials.y ? SOME_PARTS : around.parts >> at & 3u;
}

#endif
