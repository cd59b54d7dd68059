// Materials, as vectors in one buffer. interface.glsl has the vectors' numbers.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "interface.glsl"

uvec4 material_words(uint m, uint vector) {
    return texelFetch(materials, int(m * frame.material_vectors + vector));
}

vec4 material_vector(uint m, uint vector) {
    return uintBitsToFloat(material_words(m, vector));
}

vec4 base_color_of(uint m) { return material_vector(m, MATERIAL_BASE_COLOR); }

struct EmissiveMetallic { vec3 emissive; float metallic; };
EmissiveMetallic emissive_metallic_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_EMISSIVE_METALLIC);
    return EmissiveMetallic(v.rgb, v.w);
}

struct Factors { float roughness, normal_scale, occlusion_strength, cutoff; };  // cutoff of alpha; negative for BLEND
Factors factors_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_FACTORS);
    return Factors(v.x, v.y, v.z, v.w);
}

// `table` is the place of the table of levels in the alpha atlas.
struct AlphaMap { uint table; uvec2 size; uint levels, flags; };
AlphaMap alpha_map_of(uint m) {
    uvec4 v = material_words(m, MATERIAL_ALPHA);
    return AlphaMap(v.x, uvec2(v.y & 0xffffu, v.y >> 16), v.z, v.w);
}

struct SpecularFactors { vec3 reflectance; float strength; };   // of a dielectric, at normal incidence
SpecularFactors specular_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_SPECULAR);
    return SpecularFactors(v.rgb, v.w);
}

struct ClearcoatFactors { float factor, roughness, normal_scale; };
ClearcoatFactors clearcoat_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_CLEARCOAT);
    return ClearcoatFactors(v.x, v.y, v.z);
}

struct SheenFactors { vec3 color; float roughness; };
SheenFactors sheen_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_SHEEN);
    return SheenFactors(v.rgb, v.w);
}

struct AnisotropyFactors { float strength, cosine, sine; };     // of the rotation
AnisotropyFactors anisotropy_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_ANISOTROPY);
    return AnisotropyFactors(v.x, v.y, v.z);
}

struct IridescenceFactors { float factor, index, least, greatest; };    // index of refraction; thicknesses in nanometres
IridescenceFactors iridescence_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_IRIDESCENCE);
    return IridescenceFactors(v.x, v.y, v.z, v.w);
}

struct DiffuseTransmissionFactors { vec3 color; float factor; };
DiffuseTransmissionFactors diffuse_transmission_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_DIFFUSE_TRANSMISSION);
    return DiffuseTransmissionFactors(v.rgb, v.w);
}

struct TransmissionFactors { float factor, thickness; };
TransmissionFactors transmission_of(uint m) {
    vec4 v = material_vector(m, MATERIAL_TRANSMISSION);
    return TransmissionFactors(v.x, v.y);
}

vec3 absorption_of(uint m) { return material_vector(m, MATERIAL_VOLUME).rgb; }  // per unit of length

vec4 specular_glossiness_of(uint m) { return material_vector(m, MATERIAL_SPECULAR_GLOSSINESS); }    // w: glossiness

// The texture coordinates (u, v) of a slot are u and v times (coordinates of the vertices, 1).
struct UvTransform { vec3 u, v; bool second; };     // second: of the second set of coordinates
UvTransform uv_transform_of(uint m, uint slot) {
    vec4 u = material_vector(m, MATERIAL_UV_ROWS + 2u * slot), v = material_vector(m, MATERIAL_UV_ROWS + 2u * slot + 1u);
    return UvTransform(u.xyz, v.xyz, u.w != 0.0);
}

#endif
