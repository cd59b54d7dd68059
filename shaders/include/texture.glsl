// The textures of a material. Each texture is read once, also if it has several roles.
// By default the sampler chooses the mipmap level. With BOX_FILTER, a texture is averaged over the rectangle that a visibility
// sample or a pixel stands for: it is read at several places of the rectangle's image in the texture.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "interface.glsl"
#include "barycentric.glsl"
#include "material.glsl"

layout(constant_id = CONSTANT_TEXTURED) const bool TEXTURED = false;            // the material has textures
layout(constant_id = CONSTANT_ONE_UV_TRANSFORM) const bool ONE_UV_TRANSFORM = false;   // all have one UV set and transform
layout(constant_id = CONSTANT_ONE_TEXTURE_SIZE) const bool ONE_TEXTURE_SIZE = false;   // all textures have the size of the first
layout(constant_id = CONSTANT_BOX_FILTER) const bool BOX_FILTER = false; // textures are averaged over a sample's rectangle

// 16 + the index in `textures` of the texture with this role; 0 for none.
layout(constant_id = CONSTANT_BASE_COLOR_TEXTURE) const uint BASE_COLOR_TEXTURE = 0u;
layout(constant_id = CONSTANT_METALLIC_ROUGHNESS_TEXTURE) const uint METALLIC_ROUGHNESS_TEXTURE = 0u;
layout(constant_id = CONSTANT_NORMAL_TEXTURE) const uint NORMAL_TEXTURE = 0u;
layout(constant_id = CONSTANT_OCCLUSION_TEXTURE) const uint OCCLUSION_TEXTURE = 0u;
layout(constant_id = CONSTANT_EMISSIVE_TEXTURE) const uint EMISSIVE_TEXTURE = 0u;
layout(constant_id = CONSTANT_SPECULAR_TEXTURE) const uint SPECULAR_TEXTURE = 0u;
layout(constant_id = CONSTANT_SPECULAR_COLOR_TEXTURE) const uint SPECULAR_COLOR_TEXTURE = 0u;
layout(constant_id = CONSTANT_CLEARCOAT_TEXTURE) const uint CLEARCOAT_TEXTURE = 0u;
layout(constant_id = CONSTANT_CLEARCOAT_ROUGHNESS_TEXTURE) const uint CLEARCOAT_ROUGHNESS_TEXTURE = 0u;
layout(constant_id = CONSTANT_CLEARCOAT_NORMAL_TEXTURE) const uint CLEARCOAT_NORMAL_TEXTURE = 0u;
layout(constant_id = CONSTANT_SHEEN_COLOR_TEXTURE) const uint SHEEN_COLOR_TEXTURE = 0u;
layout(constant_id = CONSTANT_SHEEN_ROUGHNESS_TEXTURE) const uint SHEEN_ROUGHNESS_TEXTURE = 0u;
layout(constant_id = CONSTANT_ANISOTROPY_TEXTURE) const uint ANISOTROPY_TEXTURE = 0u;
layout(constant_id = CONSTANT_IRIDESCENCE_TEXTURE) const uint IRIDESCENCE_TEXTURE = 0u;
layout(constant_id = CONSTANT_IRIDESCENCE_THICKNESS_TEXTURE) const uint IRIDESCENCE_THICKNESS_TEXTURE = 0u;
layout(constant_id = CONSTANT_DIFFUSE_TRANSMISSION_TEXTURE) const uint DIFFUSE_TRANSMISSION_TEXTURE = 0u;
layout(constant_id = CONSTANT_DIFFUSE_TRANSMISSION_COLOR_TEXTURE) const uint DIFFUSE_TRANSMISSION_COLOR_TEXTURE = 0u;
layout(constant_id = CONSTANT_TRANSMISSION_TEXTURE) const uint TRANSMISSION_TEXTURE = 0u;
layout(constant_id = CONSTANT_THICKNESS_TEXTURE) const uint THICKNESS_TEXTURE = 0u;
layout(constant_id = CONSTANT_SPECULAR_GLOSSINESS_TEXTURE) const uint SPECULAR_GLOSSINESS_TEXTURE = 0u;

layout(set = SET_TEXTURES, binding = BINDING_TEXTURES) uniform sampler2D textures[15];

// Where a material is evaluated: its number, and a place in a triangle.
struct Place {
    uint material;
    bool whole;                     // it stands for a whole pixel or cell, in which nothing else is shaded
    mat3x2 first_uv, second_uv;     // of the three vertices
    Barycentric w;
};

// The probes of a texture: positions in rows along the longer axis of the footprint, each in the middle of an equal share of it.
struct Probes {
    vec2 first;
    vec2 along, across;     // steps to the next probe of a row, and to the next row
    float in_row, count;    // number of probes in a row, and of all probes
    float level;
};

const float MOST_IN_ROW = 8.0;
// Width of a texel / width of a box, such that the trilinear filter has the same variance as the box: the root of 1/3.
const float LEVEL_WIDTH = 0.57735;
// Length in texels up to which a footprint is read as one place.
const float SMALL_FOOTPRINT = 0.5;

// The probes in a texture of `size` texels. A `whole` pixel is read in shares of half its width, since nothing else is read in it.
// Twin: twins/src/texture.rs.
Probes probes_of(vec2 size, vec2 at, vec2 dx, vec2 dy, bool whole) {
    vec2 tx = dx * size, ty = dy * size;
    float square_x = dot(tx, tx), square_y = dot(ty, ty);
    float longest = sqrt(max(square_x, square_y));
    float width = abs(tx.x * ty.y - tx.y * ty.x) / max(longest, 1e-20);
    float shares = whole && longest > SMALL_FOOTPRINT ? 2.0 : 1.0;
    Probes r;
    r.in_row = clamp(shares * ceil(longest / max(width, 1.0) - 0.25), 1.0, MOST_IN_ROW);
    float rows = width > longest / r.in_row ? shares : 1.0;
    r.count = rows * r.in_row;
    r.along = (square_x > square_y ? dx : dy) / r.in_row;
    r.across = (square_x > square_y ? dy : dx) / rows;
    r.first = at - r.along * (0.5 * r.in_row - 0.5) - r.across * (0.5 * rows - 0.5);
    // The level is rounded, so that one mipmap is read, not two.
    r.level = round(log2(max(max(width / rows, longest / r.in_row) * LEVEL_WIDTH, 1e-20)));
    return r;
}

vec4 read_texture(sampler2D image, uint slot, Place place) {
    UvTransform row = uv_transform_of(place.material, ONE_UV_TRANSFORM ? 0u : slot);
    mat3x2 uv = row.second ? place.second_uv : place.first_uv;
    mat2 linear = mat2(row.u.x, row.v.x, row.u.y, row.v.y);
    vec2 at = linear * (uv * place.w.at) + vec2(row.u.z, row.v.z);
    vec2 dx = linear * (uv * place.w.dx), dy = linear * (uv * place.w.dy);
    if (!BOX_FILTER) return textureGrad(image, at, dx, dy);
    // Where coordinates and sizes are the same, compilers compute the probes once for all textures.
    ivec2 size = ONE_TEXTURE_SIZE ? textureSize(textures[0], 0) : textureSize(image, 0);
    Probes probes = probes_of(vec2(size), at, dx, dy, place.whole);
    vec4 sum = vec4(0.0);
    float probe = 0.0;
    do {
        float row = floor((probe + 0.5) / probes.in_row), in_row = probe - row * probes.in_row;
        vec4 texel = textureLod(image, probes.first + in_row * probes.along + row * probes.across, probes.level);
        sum += probe < probes.count ? texel : vec4(0.0);
        probe += 1.0;
    } while (subgroupAny(probe < probes.count));
    return sum / probes.count;
}

// The texture of a role at a place; white if there is none. This is a macro since the index has to be a constant.
#define READ(ROLE, place) (ROLE != 0u ? read_texture(textures[ROLE & 15u], ROLE & 15u, place) : vec4(1.0))

#endif
