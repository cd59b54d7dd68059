// The place at which a visibility sample is shaded, and the part of its cell that it stands for, in a word:
// - offsets x and y from the middle of the cell, in 12 bits each, in units of 2^-12 of the cell's sides
// - above them, in 7 bits, the side of the square that the fragment stands for, as -16 log2 of (side / side of the cell)
// - in the topmost bit, whether it stands for a rectangle of the same area that is twice as wide as high, not a square
#ifndef PLACE_GLSL
#define PLACE_GLSL

// `share` is the share of the cell's area that the fragment stands for, from 2^-15 to 1.
uint pack_place(vec2 offset, float share, bool wide) {
    ivec2 q = clamp(ivec2(round(offset * 4096.0)), ivec2(-2048), ivec2(2047));
    uint side = uint(round(clamp(-8.0 * log2(share), 0.0, 127.0)));
    return uint(q.x & 0xfff) | uint(q.y & 0xfff) << 12 | side << 24 | (wide ? 1u << 31 : 0u);
}

// The place in the middle of some samples of a cell. `samples` is their number, and `all` that of the cell.
uint place_of_samples(vec2 sum_of_offsets, float samples, float all, bool wide) {
    return pack_place(sum_of_offsets / max(samples, 1.0), max(samples, 1.0) / all, wide);
}

vec2 place_location(uint place) {
    return vec2(ivec2(place << 20, place << 8) >> 20) * (1.0 / 4096.0);
}

// Width and height of what a place stands for, over those of the cell.
vec2 place_sides(uint place) {
    float side = exp2(float(place >> 24 & 127u) * (-1.0 / 16.0));
    return (place >> 31) != 0u ? side * vec2(1.41421356, 0.70710678) : vec2(side);
}

#endif
