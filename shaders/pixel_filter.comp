// pixel_filter: averages by a pixel filter that reaches beyond the pixel. An invocation takes a column of a tile: 4 pixels, whose
// surroundings are mostly the same. With SUPERSAMPLED, it takes an output pixel.
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
layout(constant_id = PIXEL_FILTER_CONSTANT_PREMULTIPLIED) const bool PREMULTIPLIED = false;     // colours are multiplied by alpha
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
layout(set = SET_DATA, binding = BINDING_SPREADS) uniform utextureBuffer spreads;     // SPREAD_VECTORS for each pixel
layout(set = SET_DATA, binding = BINDING_FILTERED, rgba32f) uniform writeonly imageBuffer filtered;
layout(std430, set = SET_DATA, binding = BINDING_FILTER_WEIGHTS) readonly buffer FilterWeights { float filter_weights[]; };     // along an axis

const int ROWS = 4;                                     // of a tile, and of a column
const int SPAN = 2 * int(REACH) + 1;                    // columns around a column
const int HEIGHT = ROWS + 2 * int(REACH);               // rows around a column

// Multiples of 1, x and the bent function whose sum is the filter, for pixels at a distance along an axis.
vec3 factors_at(int away) {
    uint apart = uint(abs(away));
    uvec3 bits = apart == 0u ? uvec3(WEIGHT_0, 0u, BEND_0) : apart == 1u ? uvec3(WEIGHT_1, SLOPE_1, BEND_1) : uvec3(WEIGHT_2, SLOPE_2, BEND_2);
    vec3 f = uintBitsToFloat(bits);
    return apart > 2u ? vec3(0.0) : vec3(f.x, away < 0 ? -f.y : f.y, f.z);
}

// A tile's superpixels, a bit each. Tiles outside of the region have none.
uint superpixels_of(ivec2 tile) {
    bool exists = all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(tile, ivec2(frame.tiles)));
    uint at = exists ? uint(tile.y) * frame.tiles.x + uint(tile.x) : 0u, word = masks[at];
    if (GROWN) word |= marks[2u * frame.tiles.x * frame.tiles.y + at];
    return exists ? word : 0u;
}

// The superpixels around a column of `tile`, whose surroundings begin at pixel `left`: a bit each, row by row. The first word has
// ROWS rows, and the second one has the others. The surroundings lie in at most 2 x 3 tiles.
uvec2 superpixels_around(ivec2 tile, int left) {
    uvec2 pairs[3], found = uvec2(0u);
    int first = (left + 8) / 8 - 1;
    [[unroll]] for (int y = 0; y < 3; y++) {
        pairs[y] = uvec2(superpixels_of(ivec2(first, tile.y + y - 1)), superpixels_of(ivec2(first + 1, tile.y + y - 1)));
    }
    [[unroll]] for (int y = 0; y < ROWS + 4; y++) {
        if (y < HEIGHT) {
            int row = ROWS - int(REACH) + y;
            uvec2 pair = pairs[row / ROWS] >> uint(row % ROWS * 8) & 255u;
            uint of_row = (pair.x | pair.y << 8) >> uint(left - 8 * first) & (1u << SPAN) - 1u;
            found[y / ROWS] |= of_row << (y % ROWS * SPAN);
        }
    }
    return found;
}

// The light of superpixels around a column that is not spread evenly over them.
void add_spreads(ivec2 tile, ivec2 low, inout vec4 sums[ROWS]) {
    // Drivers execute code that no invocation needs, but leave a loop when no invocation goes on.
    uvec2 pending = superpixels_around(tile, low.x);
    do {
        bool upper = pending.x != 0u;
        uint word = upper ? pending.x : pending.y, rest = word & (word - 1u);
        pending = upper ? uvec2(rest, pending.y) : uvec2(0u, rest);
        int place = word != 0u ? findLSB(word) : 0, row = place / SPAN, column = place - row * SPAN;
        row += upper ? 0 : ROWS;
        ivec2 there = clamp(low + ivec2(column, row), ivec2(0), ivec2(frame.size) - 1);
        int at = there.y * int(frame.size.x) + there.x;
        vec4 light = word != 0u ? texelFetch(pixel_colors, at) : vec4(0.0), spread[8];
        [[unroll]] for (int v = 0; v < int(SPREAD_VECTORS); v++) {
            uvec4 words = texelFetch(spreads, int(SPREAD_VECTORS) * at + v);
            spread[2 * v] = light * vec4(unpackSnorm2x16(words.x), unpackSnorm2x16(words.y));
            spread[2 * v + 1] = light * vec4(unpackSnorm2x16(words.z), unpackSnorm2x16(words.w));
        }
        // What is to be multiplied by the factors along y.
        vec3 across = factors_at(column - int(REACH));
        vec4 even = across.y * spread[0] + across.z * spread[2];
        vec4 sloping = across.x * spread[1] + across.y * spread[3] + across.z * spread[5];
        vec4 bent = across.x * spread[4] + across.y * spread[6] + across.z * spread[7];
        [[unroll]] for (int y = 0; y < ROWS; y++) {
            vec3 down = factors_at(row - int(REACH) - y);
            sums[y] += down.x * even + down.y * sloping + down.z * bent;
        }
    } while ((pending.x | pending.y) != 0u);
}

// The weighted sums of the colours around the pixels of a column. `totals` are the sums of the weights.
void sum_around(ivec2 tile, ivec2 top, out vec4 sums[ROWS], out float totals[ROWS]) {
    ivec2 low = top - int(REACH), size = ivec2(frame.size);
    float across[5], of_weights = 0.0;
    [[unroll]] for (int x = 0; x < 5; x++) {
        int column = low.x + x;
        across[x] = x < SPAN && column >= 0 && column < size.x ? factors_at(x - int(REACH)).x : 0.0;
        of_weights += across[x];
    }
    [[unroll]] for (int y = 0; y < ROWS; y++) {
        sums[y] = vec4(0.0);
        totals[y] = 0.0;
    }
    // ROLLED, see workarounds.glsl.
    int number = 0;
    do {
        int row = low.y + number, first = clamp(row, 0, size.y - 1) * size.x;
        vec4 of_row = vec4(0.0);
        [[unroll]] for (int x = 0; x < 5; x++) {
            if (x < SPAN) of_row += across[x] * texelFetch(pixel_colors, first + clamp(low.x + x, 0, size.x - 1));
        }
        [[unroll]] for (int y = 0; y < ROWS; y++) {
            float down = row >= 0 && row < size.y ? factors_at(number - int(REACH) - y).x : 0.0;
            sums[y] += down * of_row;
            totals[y] += down * of_weights;
        }
    } while (++number < HEIGHT);
    if (SUPERPIXELS) add_spreads(tile, low, sums);
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

// Stores the average of a pixel.
void write(ivec2 pixel, int width, vec4 average) {
    // Negative lobes: alpha is brought to 0 to 1, without changing a colour that is PREMULTIPLIED. Light that is still negative becomes 0.
    if (PREMULTIPLIED) average *= average.a > 1.0 ? 1.0 / average.a : average.a > 0.0 ? 1.0 : 0.0;
    else average.a = min(average.a, 1.0);
    imageStore(filtered, pixel.y * width + pixel.x, max(average, vec4(0.0)));
}

void main() {
    uint i = invocation_number();
    if (SUPERSAMPLED) {
        uvec2 size = frame.size / frame.side;
        if (i >= size.x * size.y) return;
        ivec2 pixel = ivec2(split(i, size.x));
        float total;
        vec4 sum = sum_of_samples(pixel, int(frame.side), total);
        write(pixel, int(size.x), sum / total);
        return;
    }
    if (i >= 8u * frame.tiles.x * frame.tiles.y) return;
    ivec2 tile = ivec2(split(i >> 3, frame.tiles.x)), top = tile * ivec2(8, ROWS) + ivec2(i & 7u, 0);
    vec4 sums[ROWS];
    float totals[ROWS];
    sum_around(tile, top, sums, totals);
    [[unroll]] for (int y = 0; y < ROWS; y++) {
        ivec2 pixel = top + ivec2(0, y);
        if (all(lessThan(pixel, ivec2(frame.size)))) write(pixel, int(frame.size.x), sums[y] / totals[y]);
    }
}
