// Reads the fields of a triangle, of its vertices, of its instance and material, and of a light, by the functions of the includes.
// The test in src/render/data/rows.rs compares them with what the host wrote.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "alpha.glsl"
layout(local_size_x = 1) in;

layout(std430, set = SET_BESIDE_FRAME, binding = 0) writeonly buffer Fields { uint fields[]; };

layout(push_constant) uniform Push {
    uint triangle;
    uint material;
    uint light;
} push;

uint count = 0u;

void put(uint v) { fields[count++] = v; }
void put(bool v) { put(uint(v)); }
void put(float v) { put(floatBitsToUint(v)); }
void put(vec2 v) { put(v.x); put(v.y); }
void put(vec3 v) { put(v.xy); put(v.z); }
void put(vec4 v) { put(v.xyz); put(v.w); }

void main() {
    Triangle t = triangle_at(push.triangle);
    put(t.exists);
    for (int i = 0; i < 3; i++) put(uint(t.vertices[i]));
    put(material_of(t.word));
    put(bin_of(t.word));
    put(high_frequency(t.word));
    put(single_sided(t.word));
    put(t.v0);
    if (INSTANCED) {
        for (int axis = 0; axis < 3; axis++) put(placing_row(t, axis));
        return;
    }
    const vec3 FIRST = vec3(1.0, 0.0, 0.0);     // weights of the vertices
    put(position_of(t, FIRST));
    put(normal_of(t, FIRST));
    put(scale_of(t, FIRST));
    put(tangent_of(t, FIRST));
    put(texelFetch(uvs, t.vertices.x));
    put(texelFetch(colors, t.vertices.x));

    uint m = push.material;
    put(base_color_of(m));
    EmissiveMetallic light = emissive_metallic_of(m);
    put(light.emissive);
    put(light.metallic);
    Factors factors = factors_of(m);
    put(factors.roughness);
    put(factors.normal_scale);
    put(factors.occlusion_strength);
    put(factors.cutoff);
    SpecularFactors specular = specular_of(m);
    put(specular.reflectance);
    put(specular.strength);
    ClearcoatFactors coat = clearcoat_of(m);
    put(coat.factor);
    put(coat.roughness);
    put(coat.normal_scale);
    SheenFactors sheen = sheen_of(m);
    put(sheen.color);
    put(sheen.roughness);
    AnisotropyFactors anisotropy = anisotropy_of(m);
    put(anisotropy.strength);
    put(anisotropy.cosine);
    put(anisotropy.sine);
    IridescenceFactors film = iridescence_of(m);
    put(film.factor);
    put(film.index);
    put(film.least);
    put(film.greatest);
    DiffuseTransmissionFactors diffuse = diffuse_transmission_of(m);
    put(diffuse.color);
    put(diffuse.factor);
    TransmissionFactors transmission = transmission_of(m);
    put(transmission.factor);
    put(transmission.thickness);
    put(absorption_of(m));
    put(specular_glossiness_of(m));
    for (uint slot = 0u; slot < 2u; slot++) {
        UvTransform transform = uv_transform_of(m, slot);
        put(transform.u);
        put(transform.v);
        put(transform.second);
    }
    AlphaMap map = alpha_map_of(m);
    put(map.size.x);
    put(map.size.y);
    put(map.levels);
    put(map.flags);
    // The texel in the lower right corner of the finest level.
    uint first = texelFetch(alpha_atlas, int(map.table)).x;
    put(uint(round(255.0 * alpha_bilinear(first, map.size, vec2(0.99), true))));

    put(lights[push.light].position_range);
    put(lights[push.light].direction_kind);
    put(lights[push.light].color_scale);
    put(lights[push.light].offset.x);
}
