// Textures averaged over the part of a pixel that a visibility sample stands for. Each function takes the texture coordinates in
// the middle of this part, and their change across it, to the right and down.
//
//     gpc_texture             a sampler with mipmaps and linear filters
//     gpc_texture_unmipmapped a sampler with linear filters, of an image without mipmaps
//     gpc_texture_nearest     a sampler with nearest filters
//     GPC_TEXTURE_OF          a function of the application
#ifndef GPC_TEXTURE_GLSL
#define GPC_TEXTURE_GLSL

// A texture averaged over the parallelogram that `dx` and `dy` span, for a sampler with mipmaps and linear filters. The texture
// is read at two rows of places along the parallelogram's longer side. The sampler's filter is wider than a box, so two rows,
// one in each half, give a sharper result than one.
vec4 gpc_texture(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
    const float MOST_PROBES = 16.0, LEVEL_WIDTH = 0.57735;
    vec2 size = vec2(textureSize(image, 0)), tx = dx * size, ty = dy * size;
    float square_x = dot(tx, tx), square_y = dot(ty, ty), longest = sqrt(max(square_x, square_y));
    float across = 0.5 * abs(tx.x * ty.y - tx.y * ty.x) / max(longest, 1e-20);
    float probes = clamp(ceil(longest / max(across, 1.0) - 0.25), 2.0, MOST_PROBES);
    bool wide = square_x > square_y;
    vec2 step_ = (wide ? dx : dy) / probes, half_row = 0.25 * (wide ? dy : dx), first = uv - step_ * (0.5 * probes - 0.5);
    float level = log2(max(max(across, longest / probes) * LEVEL_WIDTH, 1e-20));
    vec4 sum = vec4(0.0);
    for (float probe = 0.0; probe < MOST_PROBES; probe += 1.0) {
        vec2 at = first + probe * step_;
        vec4 both = textureLod(image, at - half_row, level) + textureLod(image, at + half_row, level);
        sum += probe < probes ? both : vec4(0.0);
    }
    return sum * (0.5 / probes);
}

// Adds the mean of `of(uv)` at columns x rows places of the parallelogram to `sum`, which has to be 0.
#define GPC_MEAN_OF(sum, of, uv, dx, dy, columns, rows)                                    \
    for (int row_ = 0; row_ < (rows); ++row_) {                                            \
        for (int column_ = 0; column_ < (columns); ++column_) {                            \
            vec2 at_ = (vec2(column_, row_) + 0.5) / vec2(columns, rows) - 0.5;            \
            sum += of((uv) + at_.x * (dx) + at_.y * (dy));                                 \
        }                                                                                  \
    }                                                                                      \
    sum /= float((columns) * (rows));

// The mean of a texture at a grid of places in the parallelogram, no more than 1 / `density` texels apart. A side has at least
// `least` and at most 16 places. With larger distances than a texel a coarser mipmap level is read, if there is one.
vec4 gpc_texture_grid(sampler2D image, vec2 uv, vec2 dx, vec2 dy, float density, float least) {
    const float MOST = 16.0;
    vec2 size = vec2(textureSize(image, 0)), texels = density * vec2(length(dx * size), length(dy * size));
    ivec2 count = ivec2(clamp(ceil(texels - 0.01), least, MOST));
    vec2 apart = texels / (density * vec2(count));
    float level = log2(max(max(apart.x, apart.y), 1.0));
    vec4 sum = vec4(0.0);
#define GPC_AT(at) textureLod(image, at, level)
    GPC_MEAN_OF(sum, GPC_AT, uv, dx, dy, count.x, count.y)
#undef GPC_AT
    return sum;
}

// A texture without mipmaps, and with linear filters.
vec4 gpc_texture_unmipmapped(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
    return gpc_texture_grid(image, uv, dx, dy, 1.0, 2.0);
}

// A texture with nearest filters, with or without mipmaps.
vec4 gpc_texture_nearest(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
    return gpc_texture_grid(image, uv, dx, dy, 2.0, 4.0);
}

// Defines `vec4 name(vec2 uv, vec2 dx, vec2 dy)`: the mean of an application's own function `vec4 of(vec2 uv)` at side x side
// places. The function may read an atlas or a virtual texture, or compute a pattern.
#define GPC_TEXTURE_OF(name, of, side)                                                     \
    vec4 name(vec2 uv, vec2 dx, vec2 dy) {                                                 \
        vec4 sum = vec4(0.0);                                                              \
        GPC_MEAN_OF(sum, of, uv, dx, dy, side, side)                                       \
        return sum;                                                                        \
    }

#endif
