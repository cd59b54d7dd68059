// How much the colours of a triangle vary around a superpixel, as far as the centres of its pixel and of the 8 around it
// tell, and so in how many parts of the pixel it is shaded. Twin: src/reference/variation.rs.
#ifndef VARIATION_GLSL
#define VARIATION_GLSL
#include "triangle.glsl"

// In which parts of a cell a triangle is shaded: in all, in these merged in pairs or in fours, or in one.
const uint PARTS_ALL = 0u, PARTS_PAIRS = 1u, PARTS_FOURS = 2u, PARTS_ONE = 3u;

// Those where colours are known to vary little, and those where none is known. Parts of one sample are few as they are.
const uint FEWER_PARTS = PART == 1u ? PARTS_PAIRS : PARTS_FOURS, SOME_PARTS = PART == 1u ? PARTS_ALL : PARTS_PAIRS;

// Samples of a part.
uint part_length(uint parts) { return PART << parts; }

// Whether such a part is twice as wide as high, not a square: a cell is halved again and again, its height first.
bool part_is_wide(uint samples, uint parts) {
    return (findMSB(max(samples / part_length(parts), 1u)) & 1) != 0;
}

// Two triangles that centres see, that of the pixel's own centre first, and the parts for each of them and, after that,
// for others of its material.
struct Variation {
    uvec2 ids;
    uvec2 materials;
    uint parts;             // 2 bits each: of the triangles, then of the materials
};

uint variation_material(uint of) {
    return of == 0u ? ~0u : triangle_word(of - 1u) & 0xffffu;
}

// The widest channel of the colours in a bit set of `codes`, in code values.
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
    return range <= alike ? PARTS_ONE : range <= 4.0 * alike ? FEWER_PARTS : PARTS_ALL;
}

// The parts of a triangle that centres in a bit set see.
uint variation_of_triangle(uint codes[9], uint own, uint of_material) {
    int count = bitCount(own);
    bool even = count >= 2 && 4.0 * variation_range(codes, own) <= float(frame.alike);
    return even && count >= 4 ? PARTS_ONE : even ? max(of_material, SOME_PARTS) : of_material;
}

// An invocation takes a pixel.
Variation variation_around(uvec2 pixel) {
    uint ids_[9], materials_[9], codes[9];
    [[unroll]] for (uint i = 0u; i < 9u; i++) {
        uint place = i == 0u ? 4u : i <= 4u ? i - 1u : i;      // the pixel's own comes first
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

Variation my_variation;     // of the pixel of an invocation's cell

Variation variation_of(uint member) {
    Variation r;
    r.ids = uvec2(subgroupShuffle(my_variation.ids.x, member), subgroupShuffle(my_variation.ids.y, member));
    r.materials = uvec2(subgroupShuffle(my_variation.materials.x, member), subgroupShuffle(my_variation.materials.y, member));
    r.parts = subgroupShuffle(my_variation.parts, member);
    return r;
}

bool high_frequency_triangle(uint of) {
    return high_frequency(triangle_word(max(of, 1u) - 1u));
}

// The parts that a triangle is shaded in.
uint parts_around(Variation around, uint triangle) {
    uint material = variation_material(triangle);
    uint at = triangle == around.ids.x ? 0u : triangle == around.ids.y ? 2u : material == around.materials.x ? 4u : 6u;
    return at == 6u && material != around.materials.y ? SOME_PARTS : around.parts >> at & 3u;
}

#endif
