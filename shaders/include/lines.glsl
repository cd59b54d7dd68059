// Samples on straight lines across a cell: LINES rows or columns of BITS samples, a bit each. An invocation holds WORDS words
// of 32 of them; lines follow one after the other, and of each its first half before its second one. Twin: src/reference/sample_lines.rs.
#ifndef LINES_GLSL
#define LINES_GLSL

layout(constant_id = SAMPLE_LINES_CONSTANT_LINES) const uint LINES = 16u;            // 8, 16 or 32

const uint BITS = 64u, ALL_BITS = LINES * BITS, WORDS = ALL_BITS / 32u / LANES;
const uint HALVES = BITS / 32u;                             // words of a line
const uint LINE_WORDS = WORDS < HALVES ? WORDS : HALVES;    // those that an invocation has of one line
const uint OWN_LINES = WORDS / LINE_WORDS;                  // lines that an invocation has
const uint LOG_LINES = 5u;                                  // of as many lines as there may be

// The line and the half of it that a word of an invocation is.
uint line_of(uint own) { return (gl_SubgroupInvocationID * WORDS + own) / HALVES; }
uint half_of(uint own) { return (gl_SubgroupInvocationID * WORDS + own) % HALVES; }

// Where a line is, from the cell's centre.
float line_at(uint line) { return (float(line) + 0.5) * (1.0 / float(LINES)) - 0.5; }

// Where on it its first sample is, in distances of samples from its beginning: they are spread evenly over lines.
float line_phase(uint line) { return (float(bitfieldReverse(line) >> 27) + 0.5 * 32.0 / float(LINES)) * (1.0 / 32.0); }

// Linear functions E = along.x u + along.y v + c, at u along lines and v across them from the cell's centre.

// Whether E grows along lines. What is parallel to them is turned a little.
bool rises_along(vec2 along) { return along.x > 0.0 || (along.x == 0.0 && along.y > 0.0); }

// Where E = 0 crosses the line at v: x v + y, in distances of samples. It is the same number for -E.
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

// Bits of a word from number `from` on, which may lie outside of it.
uint bits_from(int from) { return from > 31 ? 0u : ~0u << max(from, 0); }

// Sums over the bits of a word: their number, and of the numbers of their groups of four.
uvec2 sums_of_bits(uint bits) {
    uint pairs = bits - (bits >> 1 & 0x55555555u);
    uint fours = (pairs & 0x33333333u) + (pairs >> 2 & 0x33333333u);
    uint upper = fours >> 4 & 0x0f0f0f0fu, bytes = (fours & 0x0f0f0f0fu) + upper;
    return uvec2(bytes * 0x01010101u >> 24, (bytes * 0x00010203u >> 23 & ~1u) + (upper * 0x01010101u >> 24));
}

// The same over the bits of a line, for word `own` of it, and with the numbers of their lines.
uvec3 sums_of_word(uint own, uint bits) {
    uvec2 s = sums_of_bits(bits);
    return uvec3(s.x, s.y + s.x * half_of(own) * 8u, s.x * line_of(own));
}

// The place that stands for some bits: in their middle.
uint place_of_bits(uvec3 sums, bool columns, bool wide) {
    float count = float(max(sums.x, 1u)), each = 1.0 / count;
    float u = (float(sums.y) * each + 0.5) * (4.0 / float(BITS)) - 0.5;
    float v = (float(sums.z) * each + 0.5) * (1.0 / float(LINES)) - 0.5;
    return pack_place(columns ? vec2(v, u) : vec2(u, v), count * (1.0 / float(ALL_BITS)), wide);
}

// The parts of a cell that a triangle is shaded in: fields of a word's bits, of some lines each.
struct Grid {
    uint field;             // bits, 4 to 32
    uint lines;
};

Grid grid_of(uint parts, bool columns) {
    // Halved again and again, its height first: see part_is_wide.
    uint number = uint(findMSB(max(frame.sample_count / part_length(parts), 1u)));
    uint along = (columns ? number + 1u : number) >> 1;
    return Grid(BITS >> along, LINES >> (number - along));
}

// Lowest bits of fields.
uint field_starts(Grid g) { return g.field >= 32u ? 1u : g.field == 16u ? 0x00010001u : g.field == 8u ? 0x01010101u : 0x11111111u; }

uint field_bits(Grid g) { return g.field >= 32u ? ~0u : (1u << g.field) - 1u; }

// Of which bits of its number those invocations differ that have lines of one part.
uint sharing_lanes(Grid g) {
    uint r = 0u;
    [[unroll]] for (uint log = 0u; log < LOG_LINES; log++) {
        uint span = 1u << log;
        r |= span >= OWN_LINES && g.lines > span ? span * HALVES / WORDS : 0u;
    }
    return r;
}

// Merges the fields of lines that are `span` apart into those of the first one: of lines that an invocation has by itself, ...
void merge_own_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span < OWN_LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bool merges = g.lines > span, second = (r / LINE_WORDS & span) != 0u;
            uint other = found[min(r + span * LINE_WORDS, WORDS - 1u)];
            found[r] = second ? (merges ? 0u : found[r]) : found[r] | (merges ? other : 0u);
        }
    }
}

// ... and of lines of several invocations, in each of them.
void merge_lanes_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span >= OWN_LINES && span < LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            uint other = subgroupShuffleXor(found[r], span * HALVES / WORDS);
            found[r] |= g.lines > span ? other : 0u;
        }
    }
}

// The fields of a triangle's bits that are shaded by themselves, by their lowest bits: those of which a line has half or
// more, in a row. Lines of a part are merged: into the first of an invocation, and all that share it agree on it.
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
    merge_lanes_lines(found, g, 1u);
    merge_lanes_lines(found, g, 2u);
    merge_lanes_lines(found, g, 4u);
    merge_lanes_lines(found, g, 8u);
    merge_lanes_lines(found, g, 16u);
}

// What merge_own_lines merged goes to the second of the lines, too.
void spread_own_lines(inout uint found[WORDS], Grid g, uint span) {
    if (span < OWN_LINES) {
        [[unroll]] for (uint r = 0u; r < WORDS; r++) {
            bool second = (r / LINE_WORDS & span) != 0u;
            uint other = found[max(r, span * LINE_WORDS) - span * LINE_WORDS];
            found[r] |= second && g.lines > span ? other : 0u;
        }
    }
}

// The triangle's other bits.
void find_rest(uint bits[WORDS], Grid g, uint found[WORDS], out uint rest[WORDS]) {
    // Written out for UNROLLED.
    spread_own_lines(found, g, 1u);
    spread_own_lines(found, g, 2u);
    spread_own_lines(found, g, 4u);
    [[unroll]] for (uint r = 0u; r < WORDS; r++) rest[r] = bits[r] & ~(found[r] * field_bits(g));
}

#endif
