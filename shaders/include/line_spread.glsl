// The spread of samples on lines (lines.glsl, spread.glsl). Sums are of integers, and so exact. Along lines, the places of four
// neighbouring samples are taken for one: 16 places a line.
#ifndef LINE_SPREAD_GLSL
#define LINE_SPREAD_GLSL

// For the set bits of a word of this member: their number, and the sums over them of place / 4 and of its square, where places are
// numbered from the beginning of the line.
ivec3 powers_of_word(uint own, uint bits) {
    uint pairs = bits - (bits >> 1 & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + (pairs >> 2 & 0x33333333u);
    uint upper = fours >> 4 & 0x0f0f0f0fu, bytes = (fours & 0x0f0f0f0fu) + upper, uppers = upper * 0x01010101u >> 24;
    int count = int(bytes * 0x01010101u >> 24);
    // Number n of a nibble is 2 b or 2 b + 1, with the number b of its byte.
    int sum = int((bytes * 0x00010203u >> 24) * 2u + uppers);
    int squares = int((bytes * 0x00010409u >> 24) * 4u + (upper * 0x00010203u >> 24) * 4u + uppers);
    int before = int(half_of(own)) * 8;
    return ivec3(count, sum + before * count, squares + 2 * before * sum + before * before * count);
}

// The spread of the set bits of all members, whose number is `count`.
uvec4 spread_of_bits(uint bits[WORDS], uint count, bool columns) {
    int sums[8];
    [[unroll]] for (uint i = 0u; i < 8u; i++) sums[i] = 0;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        // Integers u and v that are proportional to the place along lines and across them, and bent functions of them, all with the
        // mean 0 over the cell.
        ivec3 powers = powers_of_word(r, bits[r]);
        int along = 2 * powers.y - 15 * powers.x, squares = 4 * powers.z - 60 * powers.y + (225 - 85) * powers.x;
        int bent_along = SPREAD == SPREAD_ABSOLUTE ? (half_of(r) == 0u ? -along : along) - 8 * powers.x : squares;
        const int ALL = int(LINES);
        int v = 2 * int(line_of(r)) + 1 - ALL, bent_v = SPREAD == SPREAD_ABSOLUTE ? abs(v) - ALL / 2 : v * v - (ALL * ALL - 1) / 3;
        sums[0] += along;
        sums[1] += v * powers.x;
        sums[2] += bent_along;
        sums[3] += v * along;
        sums[4] += bent_v * powers.x;
        sums[5] += v * bent_along;
        sums[6] += bent_v * along;
        sums[7] += bent_v * bent_along;
    }
    float spread[8], each = 1.0 / float(max(count, 1u));
    [[unroll]] for (uint i = 0u; i < 8u; i++) spread[i] = float(int(team_add(uint(sums[i])))) * each;
    // From these integers to what is stored: u is 32 times the place along lines, v 2 LINES times that across them.
    const float LINE = 1.0 / float(LINES);
    const float U = 1.0 / 16.0, V = LINE, BENT_U = SPREAD == SPREAD_ABSOLUTE ? 1.0 / 8.0 : 1.0 / 256.0;
    const float BENT_V = SPREAD == SPREAD_ABSOLUTE ? 2.0 * LINE : LINE * LINE;
    spread[0] *= U;
    spread[1] *= V;
    spread[2] *= BENT_U;
    spread[3] *= U * V;
    spread[4] *= BENT_V;
    spread[5] *= BENT_U * V;
    spread[6] *= U * BENT_V;
    spread[7] *= BENT_U * BENT_V;
    float turned[8];
    const uint TURNED[8] = uint[](1u, 0u, 4u, 3u, 2u, 6u, 5u, 7u);
    [[unroll]] for (uint i = 0u; i < 8u; i++) turned[i] = columns ? spread[TURNED[i]] : spread[i];
    return pack_spread(turned);
}

#endif
