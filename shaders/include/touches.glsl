// Which pixels of a tile a triangle may touch, from its edge functions around the tile's centre.
#ifndef TOUCHES_GLSL
#define TOUCHES_GLSL

// The columns x = 0 to 7 of a row of pixels at which all three functions a x + e are at least 0, a bit each.
uint columns_within(vec3 a, vec3 e) {
    // An edge that is parallel to the row has the whole row on one side.
    bvec3 parallel = lessThan(abs(a), vec3(1e-30));
    a = mix(a, vec3(0.0), parallel);
    vec3 root = -e / mix(a, vec3(1.0), parallel);
    vec3 from = mix(vec3(0.0), root, greaterThan(a, vec3(0.0))), to = mix(vec3(7.0), root, lessThan(a, vec3(0.0)));
    int low = int(ceil(clamp(max(from.x, max(from.y, from.z)), 0.0, 8.0)));
    int high = int(floor(clamp(min(to.x, min(to.y, to.z)), -1.0, 7.0))) + 1;
    bool misses = (parallel.x && e.x < 0.0) || (parallel.y && e.y < 0.0) || (parallel.z && e.z < 0.0);
    return misses ? 0u : ((1u << max(high, low)) - 1u) & ~((1u << low) - 1u);
}

// The pixels of the tile in which the triangle may cover something of a rectangle, a bit each. The rectangle is given by its middle,
// relative to that of the pixel, and half of its sides.
uint pixels_touched(Setup s, vec2 middle, vec2 half_side) {
    vec3 e = s.c + (middle.x - 3.5) * s.a + (middle.y - 1.5) * s.b + half_side.x * abs(s.a) + half_side.y * abs(s.b);
    uint word = 0u;
    [[unroll]] for (uint row = 0u; row < 4u; row++) word |= columns_within(s.a, e + float(row) * s.b) << (8u * row);
    return word;
}

// The pixels in whose squares it may cover something. Squares are larger by 1/64 of a pixel on each side, for rounding.
uint pixels_touched(Setup s) {
    return pixels_touched(s, vec2(0.0), vec2(0.5 + 1.0 / 64.0));
}

#endif
