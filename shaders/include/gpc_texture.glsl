// Textures averaged over what a visibility sample stands for: each function takes the coordinates in the middle of it, and their
// change over it to the right and down.
//
//     gpc_texture             a sampler with mipmaps and linear filters
//     gpc_texture_unmipmapped a sampler with linear filters, of an image without mipmaps
//     gpc_texture_nearest     a sampler with nearest filters
//     GPC_TEXTURE_OF          a function of the application
#ifndef GPC_TEXTURE_GLSL
#define GPC_TEXTURE_GLSL

// A texture averaged over the parallelogram of the gradients: in two rows of several places along its longer side. A sampler
// with mipmaps and linear filters is expected. Its filter is wider than the box that it stands for, so that a row for each
// half is sharper than one.
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

// The mean of `of(uv)` at columns x rows places of the parallelogram.
#define GPC_MEAN_OF(sum, of, uv, dx, dy, columns, rows)                                    \
    for (int row_ = 0; row_ < (rows); ++row_) {                                            \
        for (int column_ = 0; column_ < (columns); ++column_) {                            \
            vec2 at_ = (vec2(column_, row_) + 0.5) / vec2(columns, rows) - 0.5;            \
            sum += of((uv) + at_.x * (dx) + at_.y * (dy));                                 \
        }                                                                                  \
    }                                                                                      \
    sum /= float((columns) * (rows));

// The same at places that lie no more than a texel divided by `density` apart, up to 16 along each side, which more texels would need
// mipmaps for.
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

// Defines `vec4 name(vec2 uv, vec2 dx, vec2 dy)`, the mean of the application's own function `vec4 of(vec2 uv)` at side x side places:
// of an atlas, a virtual texture, or a pattern.
#define GPC_TEXTURE_OF(name, of, side)                                                     \
    vec4 name(vec2 uv, vec2 dx, vec2 dy) {                                                 \
        vec4 sum = vec4(0.0);                                                              \
        GPC_MEAN_OF(sum, of, uv, dx, dy, side, side)                                       \
        return sum;                                                                        \
    }

#endif
