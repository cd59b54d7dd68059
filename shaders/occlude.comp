// occlude: finds the receivers of a light in front of which other triangles lie, in the lists of candidates that the tiles of
// the light's plane have. It then stores that the light is blocked there or, behind BLEND triangles, how much of it passes. If
// pixels have several points, it also marks pixels for `detect`: those at whose centre and another point different shares of the
// light arrive. A team takes 64 receivers: those of a superpixel, of 8 x 8 pixels, or of 4 x 4 pixels with four points each. They
// lie side by side, so that they have most candidates in common.
// Reads: locations (surfaces, from `receivers`), tiles, candidates; words. Writes: words of `include/shadows.glsl`,
// marks_of_pixels. Receivers in tiles without a list are counted as left, with what such a list needs.
// Twin: twins/src/shadow.rs.
//
// In each trip of the outer loop, the receivers in one tile are tested; in one pixel of a tile whose list is refined. The team
// searches the list for candidates that may touch a pixel (or a part of one) with receivers, and may lie in front of one. As soon as
// each member holds such a candidate, it tests it against the rectangle around the receivers. Candidates that pass are shown to the
// receivers, one after the other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/work.glsl"
#include "include/alpha.glsl"
#include "include/candidate.glsl"
#include "include/refined.glsl"
#include "include/shadows.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
layout(constant_id = OCCLUDE_CONSTANT_TRANSLUCENT) const bool TRANSLUCENT = false;    // some casters are alpha-tested or BLEND
layout(constant_id = OCCLUDE_CONSTANT_ROWS) const uint ROWS = 8u;          // receivers of an invocation
layout(std430, set = SET_BESIDE_FRAME, binding = OCCLUDE_BINDING_WORDS) buffer ShadowWords { uint words[]; };
layout(std430, set = SET_BESIDE_FRAME, binding = OCCLUDE_BINDING_LEFT) buffer Left {
    uint left;              // number of receivers that were left
    uint pairs_needed;      // number of pairs that the plane with the most needs, if it lacked room for them
    uint longest;           // number of triangles in the fullest tile that had too many for a list
};
layout(std430, set = SET_BESIDE_FRAME, binding = OCCLUDE_BINDING_MARKS_OF_PIXELS) buffer MarksOfPixels { uint marks_of_pixels[]; };     // of the frame that is shaded
layout(push_constant) uniform Push {
    mat4 to_plane;      // position -> (pixel x * w, pixel y * w, z, w), pixels from the plane's middle
    vec4 light;         // xyz: unit direction to a distant light (w = 0) or position of a local one (w = 1)
    vec4 cone;          // xyz: axis of a local light, unit; w: cosine of the cone's half angle, -2 for light in all directions
    float range;        // how far the light of a local light reaches
    uint number;        // of the light
    uint face;          // which of the six planes of a cube this is, as `face_of` numbers them, or SINGLE_PLANE
    uint first_place;   // place of the first receiver
    uvec2 region;       // size in pixels of the region whose pixels are the receivers; 0 if these are fragments
    uint points;        // number of points of a pixel: 1 or SHADOW_POINTS
    uint begins;        // 1 if this step is the first, which begins the shadow words; 0 otherwise
} push;
#include "include/light_plane.glsl"

const float ROUNDING = 1.0 / 64.0;                      // as in sample.comp
const bool BLENDS = SHADOW_WORDS > 1u;                  // some casters are BLEND
const float ALIKE = 1.0 / 64.0;                         // shares of a light that differ by no more than this are taken as equal

// What BLEND triangles keep from a receiver is the sum of the logarithms of what each lets pass. The sum is an integer, so that
// it does not depend on the order of the list: in steps of 2^-20, and at most MOST_ABSORBED, which lets nothing pass.
const float STEPS = 1048576.0;
const uint MOST_ABSORBED = 1u << 28;

uint trips = 0u;                                        // MOST_TRIPS of workarounds.glsl
uint my_left = 0u, my_longest = 0u;                     // receivers in tiles without a list, and the fullest of these tiles

// Bits of `where`: 5 for the part, 5 for the pixel, and the others for the tile.
const uint PIXEL_SHIFT = 5u, TILE_SHIFT = 10u;

// The receivers of an invocation. If pixels have several points, it takes all points of its pixels: those of the centres in its
// first rows.
uint where[ROWS];           // its tile, pixel of the tile and part of the pixel, see TILE_SHIFT; ~0 if nothing can hide it
vec2 place[ROWS];           // relative to its tile's centre
float least[ROWS];          // depth from which on a triangle lies in front of it
uint own[ROWS];             // the triangle that it lies on, which can't hide it
uint absorbed[ROWS];        // what BLEND triangles keep from it
uint hidden = 0u;           // a bit for each

// Rows of an invocation that hold the same point of pixels.
uint rows_of_point() { return push.points == 1u ? ROWS : ROWS / SHADOW_POINTS; }

// The pixel or fragment that row `g` of this invocation takes; ~0 for none.
uint receiver_of(uint g) {
    uint group = team_number(), n = (g & (rows_of_point() - 1u)) * TEAM + member();
    if (push.region.x == 0u) return group * 64u + n;
    uint log_side = push.points == 1u ? 3u : 2u, side = 1u << log_side;
    uvec2 pixel = split(group, (push.region.x + side - 1u) >> log_side) * side + uvec2(n & (side - 1u), n >> log_side);
    return all(lessThan(pixel, push.region)) ? pixel.y * push.region.x + pixel.x : ~0u;
}

uint exists = 0u;           // a bit for each that has a surface
uint turned = 0u;           // a bit for each whose surface is turned away from the light

// Loads the receivers. Returns a bit for each that other triangles may hide from the light.
uint load_receivers() {
    uint asked = 0u, points_apart = push.region.x * push.region.y;
    ivec2 first = ivec2(floor(frame.origin));
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        uint i = receiver_of(g);
        bool some = i != ~0u;
        int surface = int(2u * (g / rows_of_point() * points_apart + (some ? i : 0u)));
        uvec4 at = texelFetch(locations, surface), facing_ = texelFetch(locations, surface + 1);
        some = some && at.w != 0u;
        Projected r = project(uintBitsToFloat(at.xyz), uintBitsToFloat(facing_.xyz), facing_.w != 0u, first, ivec2(frame.size));
        uint tile = (r.pixel.y >> 2) * frame.tiles.x + (r.pixel.x >> 3), pixel = pixel_in_tile(r.pixel);
        where[g] = some && r.asked ? tile << TILE_SHIFT | pixel << PIXEL_SHIFT | part_at(r.within) : ~0u;
        place[g] = place_in_tile(uvec4(r.pixel, floatBitsToUint(r.within)));
        least[g] = r.least;
        own[g] = at.w;
        absorbed[g] = 0u;
        uint bit = 1u << g;
        exists |= some ? bit : 0u;
        turned |= some && r.turned ? bit : 0u;
        asked |= some && r.asked ? bit : 0u;
    }
    return asked;
}

// Shows a candidate to the receivers `rows` of this invocation.
void show_to(Candidate t, uint rows) {
    vec3 inner = thresholds(t);
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        float d;
        bool there = covers(t, inner, place[g], d) && d > least[g] && t.id != own[g];
        hidden |= there ? rows & 1u << g : 0u;
    }
}

// Shows a candidate to them that is alpha-tested or BLEND. Reading its alpha is expensive: rows in which that decides nothing are
// left out.
void show_translucent_to(Candidate t, uint rows, vec2 center) {
    bool blends = BLENDS && t.id > frame.first_blend;
    vec3 inner = thresholds(t);
    AlphaTest alpha = alpha_test(max(t.id, 1u) - 1u, center, place[0], mat2(0.0));
    uint asked = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        float d;
        bool there = covers(t, inner, place[g], d) && d > least[g] && t.id != own[g];
        asked |= there ? rows & ~hidden & 1u << g : 0u;
    }
    uint pending = team_or(asked);
    trips += uint(bitCount(pending));
    do {
        uint row = pending == 0u ? 0u : uint(findLSB(pending));
        vec2 p = place[0];
        [[unroll]] for (uint g = 1u; g < ROWS; g++) p = row == g ? place[g] : p;
        float opacity = alpha_at(alpha, p);
        uint mine = asked & pending & 1u << row;
        hidden |= opacity >= (blends ? 1.0 : alpha.cutoff) ? mine : 0u;
        if (BLENDS) {
            uint more = blends ? uint(round(-STEPS * log2(clamp(1.0 - opacity, 1.0 / 16777216.0, 1.0)))) : 0u;
            [[unroll]] for (uint g = 0u; g < ROWS; g++) absorbed[g] = min(absorbed[g] + (mine == 1u << g ? more : 0u), MOST_ABSORBED);
        }
        pending &= pending - 1u;
    } while (pending != 0u);
}

// Tests receivers of tile `its`, among those with a bit in `mine`: all of them, or those of a pixel if the list is refined. Returns
// their bits.
uint test_in(uint its, uint mine) {
    uint lane = member();
    uvec4 header = tiles[its];
    bool listed = (header.w & TILE_LISTED) != 0u;
    uint count = listed ? header.w >> TILE_COUNT_SHIFT : 0u;
    my_left += mine != 0u && !listed ? 1u : 0u;
    my_longest = max(my_longest, mine != 0u && !listed ? header.x : 0u);
    uint pixels = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) pixels |= (mine >> g & 1u) != 0u ? 1u << (where[g] >> PIXEL_SHIFT & 31u) : 0u;
    pixels = team_or(pixels);

    // Where the list begins that is searched, and its length.
    bool refined = (header.w & TILE_REFINED) != 0u;
    uint pixel = pixels == 0u ? 0u : uint(findLSB(pixels));
    uint word = texelFetch(candidates, int((refined ? header.z : 0u) + (pixel >> 2)))[pixel & 3u];
    uint begin = refined ? header.z + REFINED_HEADER + (word >> 16) : uint(last_of_candidate(header.y, 0u, true)), length_ = refined ? word & 0xffffu : count;

    vec2 center = tile_center(ivec2(split(its, frame.tiles.x))), low = vec2(3.4e38), high = vec2(-3.4e38);
    float lowest = 3.4e38;
    uint parts = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) {
        mine &= refined && (where[g] >> PIXEL_SHIFT & 31u) != pixel ? ~(1u << g) : ~0u;
        bool is_mine = (mine >> g & 1u) != 0u;
        low = is_mine ? min(low, place[g]) : low;
        high = is_mine ? max(high, place[g]) : high;
        lowest = is_mine ? min(lowest, least[g]) : lowest;
        parts |= is_mine ? 1u << (where[g] & 31u) : 0u;
    }
    low = vec2(team_min(low.x), team_min(low.y));
    high = vec2(team_max(high.x), team_max(high.y));
    lowest = team_min(lowest);
    pixels = refined ? team_or(parts) : pixels;
    vec2 middle = 0.5 * (low + high), half_side = 0.5 * (high - low) + ROUNDING;

    uint next = 0u;             // the first entry of the list that has not been looked at
    uint pending = 0u;          // a bit for each of the TEAM entries before `next` that is still to be taken
    bool more;
    do {
        uint held = 0u, my_entry = 0u;
        do {
            uint entry = next + lane;
            uvec4 last = texelFetch(candidates, int(begin + min(entry, max(length_, 1u) - 1u)));
            bool may = entry < length_ && (last.w & pixels) != 0u && uintBitsToFloat(last.x) > lowest;
            uint found = team_ballot(may);
            bool fresh = pending == 0u;
            pending = fresh ? found : pending;
            next += fresh ? TEAM : 0u;
            uint number = lane - held, bit = bit_of_cell(pending, number), taken = min(uint(bitCount(pending)), TEAM - held);
            my_entry = number < taken ? next - TEAM + bit : my_entry;
            held += taken;
            pending = taken == uint(bitCount(pending)) ? 0u : pending & ~((1u << bit_of_cell(pending, taken)) - 1u);
            trips++;
        } while (held < TEAM && (pending != 0u || next < length_) && trips <= MOST_TRIPS);
        my_entry = min(my_entry, max(length_, 1u) - 1u);
        uint rank = refined ? texelFetch(candidates, int(begin + my_entry)).z : my_entry;
        uvec4 its_last = texelFetch(candidates, last_of_candidate(header.y, rank, true));
        Candidate k = unpack_candidate(candidate_at(header.y, rank, count, true), its_last);
        RectangleTest test = test_rectangle(k, middle, half_side, TRANSLUCENT);
        bool shows = lane < held && test.touches && test.near > lowest, translucent = TRANSLUCENT && k.id > frame.first_mask;
        uint showing = team_ballot(shows && !translucent);
        trips += 3u + uint(bitCount(showing));
        do {
            show_to(shuffle_candidate(k, showing != 0u ? uint(findLSB(showing)) : 0u), showing != 0u ? mine : 0u);
            showing &= showing - 1u;
        } while (showing != 0u);
        if (TRANSLUCENT) {
            showing = team_ballot(shows && translucent);
            trips += uint(bitCount(showing));
            do {
                Candidate t = shuffle_candidate(k, showing != 0u ? uint(findLSB(showing)) : 0u);
                show_translucent_to(t, showing != 0u ? mine : 0u, center);
                showing &= showing - 1u;
            } while (showing != 0u);
        }
        more = (pending != 0u || next < length_) && team_any((mine & ~hidden) != 0u) && trips <= MOST_TRIPS;
    } while (more);
    return mine;
}

// The share of the light that passes to the receiver of row `g`.
float share_of(uint g) {
    return (hidden >> g & 1u) != 0u ? 0.0 : BLENDS ? exp2(-float(absorbed[g]) / STEPS) : 1.0;
}

// Stores what reaches centres and fragments. The first step begins their words. Others change those of receivers that something
// keeps light from, which most teams have in few rows, or in none.
void store_words() {
    bool begins = push.begins != 0u;
    uint stored = 0u;
    [[unroll]] for (uint g = 0u; g < ROWS; g++) stored |= g < rows_of_point() && (begins || share_of(g) < 1.0) ? exists & 1u << g : 0u;
    uint pending = team_or(stored);
    do {
        uint row = pending == 0u ? 0u : uint(findLSB(pending));
        float share = share_of(0u);
        [[unroll]] for (uint g = 1u; g < ROWS; g++) share = row == g ? share_of(g) : share;
        if ((stored >> row & 1u) != 0u) {
            uint place = (push.first_place + receiver_of(row)) * SHADOW_WORDS;
            words[place] = (begins ? 0u : words[place]) | (share < 1.0 ? 1u << push.number : 0u);
            if (BLENDS && share < 1.0) words[place + 1u + push.number] = floatBitsToUint(share);
        }
        pending &= pending - 1u;
    } while (pending != 0u);
}

// Marks pixels of which another point gets another share of the light than the centre. All lie in one tile of the image.
void mark_pixels(uint asked) {
    uint differing = 0u;
    [[unroll]] for (uint g = ROWS / SHADOW_POINTS; g < ROWS; g++) {
        uint centre = g % (ROWS / SHADOW_POINTS);
        bool differs = (asked >> g & 1u) != 0u && abs(share_of(g) - share_of(centre)) > ALIKE;
        differing |= differs ? 1u << pixel_in_tile(split(receiver_of(g), push.region.x)) : 0u;
    }
    differing = team_or(differing);
    uvec2 corner = split(team_number(), (push.region.x + 3u) >> 2) * 4u;
    uint tile = (corner.y >> 2) * ((push.region.x + 7u) >> 3) + (corner.x >> 3);
    if (differing != 0u && member() == 0u) atomicOr(marks_of_pixels[tile], differing);
}

void main() {
    uint asked = load_receivers(), waits = asked;
    do {
        uint waiting = team_ballot(waits != 0u), my_next = 0u;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) my_next = (waits & (0u - waits)) == 1u << g ? where[g] >> TILE_SHIFT : my_next;
        uint its = waiting != 0u ? of_member(my_next, uint(findLSB(waiting))) : 0u, mine = 0u;
        [[unroll]] for (uint g = 0u; g < ROWS; g++) mine |= where[g] >> TILE_SHIFT == its ? waits & 1u << g : 0u;
        waits &= ~test_in(its, mine);
    } while (team_any(waits != 0u) && trips <= MOST_TRIPS);
    my_left += trips > MOST_TRIPS ? 1u : 0u;
    if (my_left != 0u) {
        atomicAdd(left, my_left);
        if (counters[COUNTER_PAIRS] > frame.pair_capacity) atomicMax(pairs_needed, counters[COUNTER_PAIRS]);
        else atomicMax(longest, my_longest);
    }
    hidden |= turned;
    store_words();
    if (push.points != 1u) mark_pixels(asked);
}
