// Materials as vectors of one buffer; the host's twin is `GpuMaterial`.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#define MATERIAL_VECTORS 14u
#define MATERIAL_BASE_COLOR 0u
#define MATERIAL_EMISSIVE_METALLIC 1u
#define MATERIAL_FACTORS 2u         // roughness, normal scale, occlusion strength, alpha cutoff
#define MATERIAL_ALPHA 3u           // atlas: table of levels, width | height << 16, levels, flags
#define MATERIAL_UV_ROWS 4u         // two rows a texture: (m00, m01, m02, uv set), (m10, m11, m12, 0)

uvec4 material_words(uint m, uint vector) {
    return texelFetch(materials, int(m * MATERIAL_VECTORS + vector));
}

vec4 material_vector(uint m, uint vector) {
    return uintBitsToFloat(material_words(m, vector));
}

#endif
