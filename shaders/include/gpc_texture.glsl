// Textures averaged over what a visibility sample stands for.
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

#endif
