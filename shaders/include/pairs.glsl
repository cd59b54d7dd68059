// A pair of a triangle and a tile that it may touch, in 64 bits, since a frame has millions of pairs. The first word is the
// triangle. The second word holds the tile, in as many low bits as the region's tiles need, and above them the triangle's rank
// in the tile's list.
#ifndef PAIRS_GLSL
#define PAIRS_GLSL

const uint INVOCATIONS_OF_PAIR = 8u;    // invocations of `crossings` that share a pair
const uint PAIRS_OF_SETUP = 16u;        // pairs that an invocation of `setup` looks at

uint pair_tile_bits() {
    return uint(findMSB(frame.tiles.x * frame.tiles.y) + 1);
}

// The number of ranks that fit in a pair. A tile with more triangles has no list.
uint pair_ranks() {
    return 1u << (32u - pair_tile_bits());
}

uvec2 make_pair(uint triangle, uint tile, uint rank) {
    return uvec2(triangle, tile | rank << pair_tile_bits());
}

uint pair_tile(uvec2 pair) {
    return pair.y & ((1u << pair_tile_bits()) - 1u);
}

uint pair_rank(uvec2 pair) {
    return pair.y >> pair_tile_bits();
}

#endif
