// pixel_filter: averages by a pixel filter that reaches beyond the pixel. An invocation takes an output pixel.
// Pixels that are no superpixels, and those of supersampling, weigh as much as the filter's integral over their square. Superpixels
// weigh by how their light is spread (include/spread.glsl). Pixels beyond the image's edge have no weight.
// Reads: pixel_colors (of the region, linear light as in the output); SUPERSAMPLED: filter_weights; SUPERPIXELS: masks, marks, spreads.
// Writes: filtered. Twin: twins/src/pixel_filter.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/spread.glsl"
layout(local_size_x = 64) in;
layout(constant_id = PIXEL_FILTER_CONSTANT_REACH) const uint REACH = 1u;          // pixels that the filter reaches on each side
layout(constant_id = PIXEL_FILTER_CONSTANT_SUPERSAMPLED) const bool SUPERSAMPLED = false;   // an output pixel has several pixels
layout(constant_id = PIXEL_FILTER_CONSTANT_SUPERPIXELS) const bool SUPERPIXELS = false;
layout(constant_id = PIXEL_FILTER_CONSTANT_GROWN) const bool GROWN = false;       // masks hold only what `grow` added last
// The bits of floats, for pixels at a distance of 0, 1 and 2 along an axis: their weights, and the factors of x (for pixels to the right)
// and of the bent function by which the spread of superpixels is weighed.
layout(constant_id = PIXEL_FILTER_CONSTANT_WEIGHT_0) const uint WEIGHT_0 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_WEIGHT_1) const uint WEIGHT_1 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_WEIGHT_2) const uint WEIGHT_2 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_SLOPE_1) const uint SLOPE_1 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_SLOPE_2) const uint SLOPE_2 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_BEND_0) const uint BEND_0 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_BEND_1) const uint BEND_1 = 0u;
layout(constant_id = PIXEL_FILTER_CONSTANT_BEND_2) const uint BEND_2 = 0u;
layout(set = SET_DATA, binding = BINDING_PIXEL_COLORS) uniform textureBuffer pixel_colors;
layout(set = SET_DATA, binding = BINDING_SPREADS) uniform utextureBuffer spreads;     // one for each channel of a pixel
layout(set = SET_DATA, binding = BINDING_FILTERED, rgba32f) uniform writeonly imageBuffer filtered;
layout(std430, set = SET_DATA, binding = BINDING_FILTER_WEIGHTS) readonly buffer FilterWeights { float filter_weights[]; };     // along an axis

const int SPAN = 2 * int(REACH) + 1;

// Multiples of 1, x and the bent function whose sum is the filter, for pixels at a distance along an axis.
vec3 factors_at(int away) {
    uint apart = uint(abs(away));
    uvec3 bits = apart == 0u ? uvec3(WEIGHT_0, 0u, BEND_0) : apart == 1u ? uvec3(WEIGHT_1, SLOPE_1, BEND_1) : uvec3(WEIGHT_2, SLOPE_2, BEND_2);
    vec3 f = uintBitsToFloat(bits);
    return vec3(f.x, away < 0 ? -f.y : f.y, f.z);
}

// A tile's superpixels, a bit each. Tiles outside of the region have none.
uint superpixels_of(ivec2 tile) {
    bool exists = all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(tile, ivec2(frame.tiles)));
    uint at = exists ? uint(tile.y) * frame.tiles.x + uint(tile.x) : 0u, word = masks[at];
    if (GROWN) word |= marks[2u * frame.tiles.x * frame.tiles.y + at];
    return exists ? word : 0u;
}

// The superpixels of the square around a pixel: a bit each, row by row. The square lies in at most 2 x 2 tiles.
uint superpixels_around(ivec2 pixel) {
    ivec2 low = pixel - int(REACH), tile = (low + ivec2(8, 4)) / ivec2(8, 4) - 1;
    uvec2 upper = uvec2(superpixels_of(tile), superpixels_of(tile + ivec2(1, 0)));
    uvec2 lower = uvec2(superpixels_of(tile + ivec2(0, 1)), superpixels_of(tile + ivec2(1, 1)));
    uint bits = 0u;
    [[unroll]] for (int y = 0; y < 5; y++) {
        if (y < SPAN) {
            int row = low.y + y - 4 * tile.y;
            uvec2 pair = (row < 4 ? upper : lower) >> uint((row & 3) * 8) & 255u;
            uint of_row = (pair.x | pair.y << 8) >> uint(low.x - 8 * tile.x) & (1u << SPAN) - 1u;
            bits |= of_row << (y * SPAN);
        }
    }
    return bits;
}

// The weights of a superpixel's channels, besides the weight that all pixels in its place have.
vec4 spread_weights(int at, vec3 across, vec3 down) {
    vec4 low = vec4(across.y * down.x, across.x * down.y, across.z * down.x, across.y * down.y);
    vec4 high = vec4(across.x * down.z, across.z * down.y, across.y * down.z, across.z * down.z), sum;
    [[unroll]] for (int channel = 0; channel < 4; channel++) {
        float spread[8];
        unpack_spread(texelFetch(spreads, 4 * at + channel), spread);
        sum[channel] = dot(low, vec4(spread[0], spread[1], spread[2], spread[3])) + dot(high, vec4(spread[4], spread[5], spread[6], spread[7]));
    }
    return sum;
}

// The weighted sum of the colours around a pixel. `total` is the sum of the weights.
vec4 sum_around(ivec2 pixel, out float total) {
    ivec2 low = pixel - int(REACH), size = ivec2(frame.size);
    vec4 sum = vec4(0.0);
    vec2 totals = vec2(0.0);
    // ROLLED, see workarounds.glsl.
    int y = 0;
    do {
        int row = low.y + y;
        bool row_exists = row >= 0 && row < size.y;
        float down = row_exists ? factors_at(y - int(REACH)).x : 0.0;
        int first = clamp(row, 0, size.y - 1) * size.x;
        vec4 of_row = vec4(0.0);
        float of_weights = 0.0;
        [[unroll]] for (int x = 0; x < 5; x++) {
            if (x < SPAN) {
                int column = low.x + x;
                float across = column >= 0 && column < size.x ? factors_at(x - int(REACH)).x : 0.0;
                of_row += across * texelFetch(pixel_colors, first + clamp(column, 0, size.x - 1));
                of_weights += across;
            }
        }
        sum += down * of_row;
        totals = vec2(of_weights, totals.y + down);
    } while (++y < SPAN);
    total = totals.x * totals.y;
    if (SUPERPIXELS) {
        // Drivers execute code that no invocation needs, but leave a loop when no invocation goes on.
        uint pending = superpixels_around(pixel);
        do {
            bool some = pending != 0u;
            int place = some ? findLSB(pending) : 0, row = place / SPAN, column = place - row * SPAN;
            pending &= pending - 1u;
            ivec2 there = clamp(low + ivec2(column, row), ivec2(0), size - 1);
            int at = there.y * size.x + there.x;
            vec4 weights = spread_weights(at, factors_at(column - int(REACH)), factors_at(row - int(REACH)));
            sum += some ? weights * texelFetch(pixel_colors, at) : vec4(0.0);
        } while (pending != 0u);
    }
    return sum;
}

// The same for the pixels of supersampling: `side` x `side` in each output pixel.
vec4 sum_of_samples(ivec2 pixel, int side, out float total) {
    ivec2 low = (pixel - int(REACH)) * side, size = ivec2(frame.size);
    int span = SPAN * side, y = 0;
    vec4 sum = vec4(0.0);
    total = 0.0;
    do {
        int row = low.y + y;
        bool row_exists = row >= 0 && row < size.y;
        vec4 of_row = vec4(0.0);
        float of_weights = 0.0;
        int x = 0;
        do {
            int column = low.x + x;
            bool exists = row_exists && column >= 0 && column < size.x;
            float across = exists ? filter_weights[x] : 0.0;
            of_row += across * texelFetch(pixel_colors, exists ? row * size.x + column : 0);
            of_weights += across;
        } while (++x < span);
        sum += filter_weights[y] * of_row;
        total += filter_weights[y] * of_weights;
    } while (++y < span);
    return sum;
}

void main() {
    uint i = invocation_number();
    uvec2 size = frame.size / frame.side;
    if (i >= size.x * size.y) return;
    ivec2 pixel = ivec2(split(i, size.x));
    float total;
    vec4 sum;
    if (SUPERSAMPLED) sum = sum_of_samples(pixel, int(frame.side), total);
    else sum = sum_around(pixel, total);
    sum /= total;
    // Negative lobes: alpha is brought to 0 to 1 without changing the colour, and light that is still negative becomes 0.
    sum *= sum.a > 1.0 ? 1.0 / sum.a : sum.a > 0.0 ? 1.0 : 0.0;
    imageStore(filtered, int(i), max(sum, vec4(0.0)));
}
