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

// Stores the spread of the set bits of all members, whose number is `count`, for a fragment, if it `exists`.
void write_spread_of_bits(bool exists, uint fragment, uint bits[WORDS], uint count, bool columns) {
    uint sums[8];
    [[unroll]] for (uint i = 0u; i < 8u; i++) sums[i] = 0u;
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        // Integers u and v that are proportional to the place along lines and across them, and bent functions of them, all with the
        // mean 0 over the cell.
        ivec3 powers = powers_of_word(r, bits[r]);
        int along = 2 * powers.y - 15 * powers.x, squares = 4 * powers.z - 60 * powers.y + (225 - 85) * powers.x;
        int bent_along = SPREAD == SPREAD_ABSOLUTE ? (half_of(r) == 0u ? -along : along) - 8 * powers.x : squares;
        const int ALL = int(LINES);
        int v = 2 * int(line_of(r)) + 1 - ALL, bent_v = SPREAD == SPREAD_ABSOLUTE ? abs(v) - ALL / 2 : v * v - (ALL * ALL - 1) / 3;
        sums[0] += uint(along);
        sums[1] += uint(v * powers.x);
        sums[2] += uint(bent_along);
        sums[3] += uint(v * along);
        sums[4] += uint(bent_v * powers.x);
        sums[5] += uint(v * bent_along);
        sums[6] += uint(bent_v * along);
        sums[7] += uint(bent_v * bent_along);
    }
    uint turned[8];
    const uint TURNED[8] = uint[](1u, 0u, 4u, 3u, 2u, 6u, 5u, 7u);
    [[unroll]] for (uint i = 0u; i < 8u; i++) turned[i] = columns ? sums[TURNED[i]] : sums[i];

    // Sums over all members. Partners give each other the half of the sums that they do not keep, until each member has the two sums
    // of a word. A team has at least four members.
    uint word = member() & 3u, kept[4], pair[2];
    [[unroll]] for (uint i = 0u; i < 4u; i++) {
        bool upper = word >= 2u;
        kept[i] = (upper ? turned[4u + i] : turned[i]) + of_partner(upper ? turned[i] : turned[4u + i], 2u);
    }
    [[unroll]] for (uint i = 0u; i < 2u; i++) {
        bool odd = (word & 1u) != 0u;
        pair[i] = (odd ? kept[2u + i] : kept[i]) + of_partner(odd ? kept[i] : kept[2u + i], 1u);
        [[unroll]] for (uint log = 2u; log < LOG_TEAM; log++) if (1u << log < TEAM) pair[i] += of_partner(pair[i], 1u << log);
    }

    // From these integers to what is stored: u is 32 times the place along lines, v 2 LINES times that across them.
    const float LINE = 1.0 / float(LINES);
    const vec2 ALONG = vec2(1.0 / 16.0, SPREAD == SPREAD_ABSOLUTE ? 1.0 / 8.0 : 1.0 / 256.0);
    const vec2 ACROSS = vec2(LINE, SPREAD == SPREAD_ABSOLUTE ? 2.0 * LINE : LINE * LINE);
    vec2 x = columns ? ACROSS : ALONG, y = columns ? ALONG : ACROSS;
    vec2 scale = word == 0u ? vec2(x.x, y.x) : word == 1u ? vec2(x.y, x.x * y.x) : word == 2u ? vec2(y.y, x.y * y.x) : vec2(x.x * y.y, x.y * y.y);
    vec2 means = vec2(ivec2(pair[0], pair[1])) * (1.0 / float(max(count, 1u))) * scale;
    if (exists && member() < 4u) fragments_out[frame.fragment_capacity + fragment][word] = packSnorm2x16(means);
}

#endif
