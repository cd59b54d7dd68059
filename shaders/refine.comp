// refine: divides the lists of crowded tiles of a light's plane among the pixels of the tile, so that `occlude` searches only those
// of the pixels in which its receivers lie. Where many small triangles lie near the camera, a tile may list hundreds, while the
// receivers of a superpixel share a part of one pixel.
// A refined list begins with a word for each pixel of the tile: where the entries of the pixel begin, and, in the lower half, their
// number. Entries are vectors: (nearest depth in the pixel, 0, rank of the candidate in the tile's list, parts of the pixel that it
// may touch). A pixel has 8 x 4 parts.
// Reads: tiles, candidates. Writes: candidates, behind all lists; where a tile's refined list begins, and TILE_REFINED.
// A team takes a stretch of tiles. Tiles for which there is no room are not refined.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/candidate.glsl"
#include "include/refined.glsl"
#include "include/touches.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;
const uint CROWDED = 16u;           // a tile with more candidates is crowded
const uint MOST_ENTRIES = 65535u;   // of a refined list

// Pixels of a tile of which a member counts the entries: those with the numbers k * TEAM + member().
const uint OWN = 32u / TEAM;

// The pixels of the candidate with this rank; none behind the end of the list.
uint pixels_of(uvec4 tile, uint rank, uint count) {
    uint pixels = texelFetch(candidates, last_of_candidate(tile.y, min(rank, max(count, 1u) - 1u), true)).w;
    return rank < count ? pixels : 0u;
}

// Adds the candidates of all members to the numbers of entries.
void add_entries(inout uint entries[OWN], uint pixels) {
    [[unroll]] for (uint m = 0u; m < TEAM; m++) {
        uint its = of_member(pixels, m);
        [[unroll]] for (uint k = 0u; k < OWN; k++) entries[k] += its >> (k * TEAM + member()) & 1u;
    }
}

// Where the entry of this member's candidate lies in the list of `pixel`, which begins with those of earlier candidates.
uint place_of_entry(uint next[OWN], uint pixels, uint pixel) {
    uint place = 0u;
    [[unroll]] for (uint k = 0u; k < OWN; k++) {
        uint its = of_member(next[k], pixel % TEAM);
        place = pixel / TEAM == k ? its : place;
    }
    [[unroll]] for (uint m = 0u; m < TEAM; m++) {
        uint its = of_member(pixels, m) >> pixel & 1u;
        place += m < member() ? its : 0u;
    }
    return place;
}

// The entry of a candidate in the list of a pixel.
uvec4 entry_of(Candidate k, uint rank, uint pixel) {
    vec2 middle = low_of_pixel(pixel) + 0.5;
    Setup s;
    s.a = k.a / 8.0;
    s.b = k.b / 4.0;
    s.c = k.a * middle.x + k.b * middle.y + k.c;
    float near = test_rectangle(k, middle, vec2(0.5 + 1.0 / 64.0), true).near;
    return uvec4(floatBitsToUint(near), 0u, rank, pixels_touched(s));
}

// Refines the list of a tile with `count` candidates; 0 for none.
void refine_tile(uint tile_index, uint count) {
    uint lane = member();
    uvec4 tile = tiles[tile_index];
    uint entries[OWN], total = 0u, chunk = 0u;
    [[unroll]] for (uint k = 0u; k < OWN; k++) entries[k] = 0u;
    do {
        add_entries(entries, pixels_of(tile, chunk + lane, count));
        chunk += TEAM;
    } while (chunk < count);
    [[unroll]] for (uint k = 0u; k < OWN; k++) total += team_add(entries[k]);

    uint first = 0u;
    if (lane == 0u && total != 0u) first = atomicAdd(counters[COUNTER_REFINED], total + REFINED_HEADER);
    first = of_member(first, 0u);
    bool has_room = total != 0u && total <= MOST_ENTRIES && first <= frame.list_capacity && total + REFINED_HEADER <= frame.list_capacity - first;
    first += 4u * frame.list_capacity;
    uint begin = 0u, next[OWN];
    [[unroll]] for (uint k = 0u; k < OWN; k++) {
        uint before = begin + team_before(entries[k]), pixel = k * TEAM + lane;
        begin += team_add(entries[k]);
        next[k] = first + REFINED_HEADER + before;
        if (has_room) candidates_out[first + (pixel >> 2)][pixel & 3u] = before << 16 | entries[k];
    }
    if (has_room && lane == 0u) tiles[tile_index].zw = uvec2(first, tile.w | TILE_REFINED);

    chunk = 0u;
    do {
        uint rank = min(chunk + lane, max(count, 1u) - 1u);
        uvec4 last = texelFetch(candidates, last_of_candidate(tile.y, rank, true));
        Candidate k = unpack_candidate(candidate_at(tile.y, rank, count, true), last);
        uint pixels = has_room && chunk + lane < count ? k.pixels : 0u, left = pixels;
        do {
            uint pixel = left == 0u ? 0u : uint(findLSB(left));
            uint place = place_of_entry(next, pixels, pixel);
            uvec4 entry = entry_of(k, rank, pixel);
            if (left != 0u) candidates_out[place] = entry;
            left &= left - 1u;
        } while (team_any(left != 0u));
        add_entries(next, pixels);
        chunk += TEAM;
    } while (chunk < count);
}

void main() {
    uint tile_count = frame.tiles.x * frame.tiles.y, first = team_number() * STRETCH, end = min(first + STRETCH, tile_count);
    if (first >= end) return;
    do {
        uint crowded = 0u;          // a bit for each of 32 tiles
        [[unroll]] for (uint i = 0u; i < 32u; i += TEAM) {
            uint tile = first + i + member(), flags = tiles[min(tile, end - 1u)].w;
            bool is_crowded = tile < end && (flags & TILE_LISTED) != 0u && flags >> TILE_COUNT_SHIFT > CROWDED;
            crowded |= team_ballot(is_crowded) << i;
        }
        do {
            uint tile = first + (crowded == 0u ? 0u : uint(findLSB(crowded)));
            refine_tile(tile, crowded == 0u ? 0u : tiles[tile].w >> TILE_COUNT_SHIFT);
            crowded &= crowded - 1u;
        } while (crowded != 0u);
        first += 32u;
    } while (first < end);
}
