// The place at which a visibility record is shaded, in a word: offsets from the middle of its cell, 12 bits each in units
// of 2^-12 of its sides, and above them the side of the square that the record stands for, as -16 log2 of its share of
// the cell's.
#ifndef PLACE_GLSL
#define PLACE_GLSL

// `share` is that of the cell's area, from 2^-31 to 1.
uint pack_place(vec2 offset, float share) {
    ivec2 q = clamp(ivec2(round(offset * 4096.0)), ivec2(-2048), ivec2(2047));
    return uint(q.x & 0xfff) | uint(q.y & 0xfff) << 12 | uint(round(clamp(-8.0 * log2(share), 0.0, 255.0))) << 24;
}

// The place that stands for samples of a cell that has `all`: in their middle, filtered over so many times their area.
uint place_of_samples(vec2 sum_of_offsets, float samples, float all, float filtered) {
    return pack_place(sum_of_offsets / max(samples, 1.0), filtered * max(samples, 1.0) / all);
}

vec2 place_location(uint place) {
    return vec2(ivec2(place << 20, place << 8) >> 20) * (1.0 / 4096.0);
}

float place_side(uint place) {
    return exp2(float(place >> 24) * (-1.0 / 16.0));
}

#endif
