// Samples on straight lines across a cell: LINES rows or columns of BITS samples. A set of samples has a bit for each, in words
// of 32. A member of the team holds WORDS words. Words are ordered by line; the first half of a line comes before the second one.
// Twin: twins/src/sample_lines.rs.
#ifndef LINES_GLSL
#define LINES_GLSL

layout(constant_id = SAMPLE_LINES_CONSTANT_LINES) const uint LINES = 16u;            // 8, 16, 32 or 64

const uint BITS = 64u, ALL_BITS = LINES * BITS, WORDS = ALL_BITS / 32u / TEAM;
const uint HALVES = BITS / 32u;                             // words of a line
const uint LINE_WORDS = WORDS < HALVES ? WORDS : HALVES;    // words of one line that a member holds
const uint OWN_LINES = WORDS / LINE_WORDS;                  // lines of which a member holds words
const uint LOG_LINES = 6u;                                  // binary logarithm of the largest number of lines

// The line of word number `own` of this member, and the half of the line.
uint line_of(uint own) { return (member() * WORDS + own) / HALVES; }
uint half_of(uint own) { return (member() * WORDS + own) % HALVES; }

// The position of a line relative to the cell's centre, across lines.
float line_at(uint line) { return (float(line) + 0.5) * (1.0 / float(LINES)) - 0.5; }

// The position of a line's first sample, counted from the beginning of the line in distances of samples, from 0 to 1. These
// phases are evenly spread over the lines.
float line_phase(uint line) { return float(bitfieldReverse(line)) * (1.0 / 4294967296.0) + 0.5 / float(LINES); }

// Edges are linear functions E = along.x u + along.y v + c, where u is the position along lines and v the position across them,
// relative to the cell's centre.

// Whether E grows along lines. An edge that is parallel to lines is treated as if it were turned a little.
bool rises_along(vec2 along) { return along.x > 0.0 || (along.x == 0.0 && along.y > 0.0); }

// Where E = 0 crosses lines: on the line at v it is at x v + y, in distances of samples from the line's beginning. The result for
// -E is the same to the bit.
vec2 crossing(vec2 along, float c) {
    float slope = (rises_along(along) ? 1.0 : -1.0) * max(abs(along.x), max(abs(along.y) * (1.0 / 1048576.0), 1e-30));
    precise float by_line = -along.y / slope, start = -c / slope;
    precise vec2 r = vec2(by_line, start + 0.5) * float(BITS);
    return r;
}

const vec2 BEFORE_ALL = vec2(0.0, -1e9), BEYOND_ALL = vec2(0.0, 1e9);   // crossings that lie outside of the cell

float crossing_at(vec2 where, float v) {
    precise float x = where.x * v + where.y;
    return x;
}

// The bits of a word from number `from` on. `from` may be less than 0 or greater than 31.
uint bits_from(int from) { return from > 31 ? 0u : ~0u << max(from, 0); }

// Sums over the set bits of a word: how many they are, and the sum of bit number / 4, rounded down.
uvec2 sums_of_bits(uint bits) {
    uint pairs = bits - (bits >> 1 & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + (pairs >> 2 & 0x33333333u);
    uint upper = fours >> 4 & 0x0f0f0f0fu, bytes = (fours & 0x0f0f0f0fu) + upper;
    return uvec2(bytes * 0x01010101u >> 24, (bytes * 0x00010203u >> 23 & ~1u) + (upper * 0x01010101u >> 24));
}

// The same for word `own` of this member, with bits numbered from the beginning of their line; and, above the number of bits, the sum
// of the numbers of their lines.
const uint COUNT_BITS = 13u;        // 4,096 samples on lines that are numbered up to 63 fit into a word with their number

uvec2 sums_of_word(uint own, uint bits) {
    uvec2 s = sums_of_bits(bits);
    return uvec2(s.x | s.x * line_of(own) << COUNT_BITS, s.y + s.x * half_of(own) * 8u);
}

uint count_of(uvec2 sums) { return sums.x & (1u << COUNT_BITS) - 1u; }

// The place in the middle of some samples, from the sums over their bits.
uint place_of_bits(uvec2 sums, bool columns, bool wide) {
    float count = float(max(count_of(sums), 1u)), each = 1.0 / count;
    float u = (float(sums.y) * each + 0.5) * (4.0 / float(BITS)) - 0.5;
    float v = (float(sums.x >> COUNT_BITS) * each + 0.5) * (1.0 / float(LINES)) - 0.5;
    return pack_place(columns ? vec2(v, u) : vec2(u, v), count * (1.0 / float(ALL_BITS)), wide);
}

// The parts of a cell in which a triangle may be shaded. A part is a rectangle: `field` neighbouring bits of `lines` neighbouring
// lines.
struct Grid {
    uint field;             // bits, 4 to 32
    uint lines;
};

Grid grid_of(uint parts, bool columns) {
    // The cell is halved again and again, its height first: see part_is_wide.
    uint number = max(uint(findMSB(max(frame.sample_count / part_length(parts), 1u))), 2u);
    uint along = (columns ? number + 1u : number) >> 1;
    return Grid(BITS >> along, LINES >> (number - along));
}

// A word with the lowest bits of all fields.
uint field_starts(Grid g) { return g.field >= 32u ? 1u : g.field == 16u ? 0x00010001u : g.field == 8u ? 0x01010101u : 0x11111111u; }

uint field_bits(Grid g) { return g.field >= 32u ? ~0u : (1u << g.field) - 1u; }

// A mask of those bits of a member's number in which the members with lines of the same part differ.
uint sharing_lanes(Grid g) {
    uint r = 0u;
    [[unroll]] for (uint log = 0u; log < LOG_LINES; log++) {
        uint span = 1u << log;
        r |= span >= OWN_LINES && g.lines > span ? span * HALVES / WORDS : 0u;
    }
    return r;
}

// Merges the fields of lines that are `span` apart, where this member holds both lines: the first line gets those of both.
void merge_own_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span < OWN_LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bool merges = g.lines > span, second = (r / LINE_WORDS & span) != 0u;
            uint other = found[min(r + span * LINE_WORDS, WORDS - 1u)];
            found[r] = second ? (merges ? 0u : found[r]) : found[r] | (merges ? other : 0u);
        }
    }
}

// The same where different members hold the two lines: both get the fields of both.
void merge_lanes_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span >= OWN_LINES && span < LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            uint other = of_partner(found[r], span * HALVES / WORDS);
            found[r] |= g.lines > span ? other : 0u;
        }
    }
}

// Finds the parts in which a triangle is shaded: those in which some line has half of its field or more in a row. A part is
// marked by the lowest bit of its field. In a member, the mark is in the part's first line. All members that share a part
// have its mark.
void find_parts(uint bits[WORDS], Grid g, out uint found[WORDS]) {
    uint starts = field_starts(g), runs_begin = starts * (field_bits(g) >> (g.field / 2u - 1u));
    [[unroll]] for (uint r = 0u; r < WORDS; r++) {
        uint b = bits[r];
        b &= b >> 1;
        b &= g.field > 4u ? b >> 2 : ~0u;
        b &= g.field > 8u ? b >> 4 : ~0u;
        b &= g.field > 16u ? b >> 8 : ~0u;
        b &= runs_begin;
        b |= b >> 1;
        b |= b >> 2;
        b |= g.field > 4u ? b >> 4 : 0u;
        b |= g.field > 8u ? b >> 8 : 0u;
        b |= g.field > 16u ? b >> 16 : 0u;
        found[r] = b & starts;
    }
    // Written out for UNROLLED.
    merge_own_lines(found, g, 1u);
    merge_own_lines(found, g, 2u);
    merge_own_lines(found, g, 4u);
    merge_own_lines(found, g, 8u);
    merge_lanes_lines(found, g, 1u);
    merge_lanes_lines(found, g, 2u);
    merge_lanes_lines(found, g, 4u);
    merge_lanes_lines(found, g, 8u);
    merge_lanes_lines(found, g, 16u);
    merge_lanes_lines(found, g, 32u);
}

// Copies the marks that merge_own_lines has moved to the first line back to the second one.
void spread_own_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span < OWN_LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bool second = (r / LINE_WORDS & span) != 0u;
            uint other = found[max(r, span * LINE_WORDS) - span * LINE_WORDS];
            found[r] |= second && g.lines > span ? other : 0u;
        }
    }
}

// Finds the triangle's samples that are in none of these parts.
void find_rest(uint bits[WORDS], Grid g, uint found[WORDS], out uint rest[WORDS]) {
    // Written out for UNROLLED.
    spread_own_lines(found, g, 1u);
    spread_own_lines(found, g, 2u);
    spread_own_lines(found, g, 4u);
    spread_own_lines(found, g, 8u);
    [[unroll]] for (uint r = 0u; r < WORDS; r++) rest[r] = bits[r] & ~(found[r] * field_bits(g));
}

#endif
