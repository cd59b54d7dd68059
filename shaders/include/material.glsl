// Materials as vectors of one buffer; the host's twin is `GpuMaterial`.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL

#define MATERIAL_BASE_COLOR 0u
#define MATERIAL_EMISSIVE_METALLIC 1u
#define MATERIAL_FACTORS 2u         // roughness, normal scale, occlusion strength, alpha cutoff; negative for BLEND
#define MATERIAL_ALPHA 3u           // atlas: table of levels, width | height << 16, levels, flags
#define MATERIAL_SPECULAR 4u        // rgb of a dielectric's reflectance at normal incidence, strength
#define MATERIAL_CLEARCOAT 5u       // factor, roughness, normal scale
#define MATERIAL_SHEEN 6u           // rgb, roughness
#define MATERIAL_ANISOTROPY 7u      // strength, cosine and sine of the rotation
#define MATERIAL_IRIDESCENCE 8u     // factor, index of refraction, least and greatest thickness in nanometres
#define MATERIAL_DIFFUSE_TRANSMISSION 9u    // rgb, factor
#define MATERIAL_TRANSMISSION 10u   // factor, thickness
#define MATERIAL_VOLUME 11u         // rgb of absorption per unit of length
#define MATERIAL_SPECULAR_GLOSSINESS 12u    // rgb, glossiness
#define MATERIAL_UV_ROWS 13u        // two rows a texture, the base colour's first: (m00, m01, m02, uv set), (m10, m11, m12, 0)

uvec4 material_words(uint m, uint vector) {
    return texelFetch(materials, int(m * frame.material_vectors + vector));
}

vec4 material_vector(uint m, uint vector) {
    return uintBitsToFloat(material_words(m, vector));
}

#endif
