// shade: computes the radiance of surfaces, in a dispatch for each material bin. With PIXELS an invocation takes the centre of a
// pixel of a span, which sees the triangle in raster's IDs. Otherwise it takes a visibility sample, which is shaded at its place
// in a pixel or in the cell of a location (LOCATIONS). The Jacobian of a location scales the footprint of textures.
// Reads: shade_order, bins, ids or records, the geometry, textures, shadow words. Writes: color and display, or shaded.
// All values are in linear light. TRANSMISSION: a layer has a tint (see tint.glsl), not an opacity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/environment.glsl"
#include "include/finite.glsl"
#include "include/record_position.glsl"
#include "include/shadows.glsl"
#include "include/triangle.glsl"
#include "include/tint.glsl"
#include "include/texture.glsl"
layout(local_size_x = 64) in;

layout(constant_id = SHADE_CONSTANT_PIXELS) const bool PIXELS = false;
layout(constant_id = SHADE_CONSTANT_ONE_BIN) const bool ONE_BIN = false;
layout(constant_id = SHADE_CONSTANT_DISPLAY_CODES) const bool DISPLAY_CODES = false;
layout(constant_id = SHADE_CONSTANT_VERTEX_COLORS) const bool VERTEX_COLORS = false;
layout(constant_id = SHADE_CONSTANT_UNLIT) const bool UNLIT = false;
layout(constant_id = SHADE_CONSTANT_PUNCTUAL) const bool PUNCTUAL = false;   // the scene has lights
layout(constant_id = SHADE_CONSTANT_LOCAL_LIGHTS) const bool LOCAL_LIGHTS = false; // some of them are point or spot lights
layout(constant_id = SHADE_CONSTANT_BLENDED) const bool BLENDED = false;    // BLEND layers have an opacity
layout(constant_id = SHADE_CONSTANT_SPECULAR) const bool SPECULAR = false;   // this and what follows: the bin's materials have it
layout(constant_id = SHADE_CONSTANT_CLEARCOAT) const bool CLEARCOAT = false;
layout(constant_id = SHADE_CONSTANT_SHEEN) const bool SHEEN = false;
layout(constant_id = SHADE_CONSTANT_ANISOTROPY) const bool ANISOTROPY = false;
layout(constant_id = SHADE_CONSTANT_IRIDESCENCE) const bool IRIDESCENCE = false;
layout(constant_id = SHADE_CONSTANT_DIFFUSE_TRANSMISSION) const bool DIFFUSE_TRANSMISSION = false;
layout(constant_id = SHADE_CONSTANT_TRANSMISSION) const bool TRANSMISSION = false;
layout(constant_id = SHADE_CONSTANT_SPECULAR_GLOSSINESS) const bool SPECULAR_GLOSSINESS = false;
const bool TANGENTS = NORMAL_TEXTURE != 0u || CLEARCOAT_NORMAL_TEXTURE != 0u || ANISOTROPY;

#include "include/brdf.glsl"
#include "include/normal.glsl"
#include "include/clearcoat.glsl"
#include "include/iridescence.glsl"
#include "include/sheen.glsl"
#include "include/transmission.glsl"

layout(push_constant) uniform Push { uint bin; } push;

// Share of the studio's light in a scene with lights of its own, so that surfaces that face away from these are not black.
const float STUDIO_AMBIENT = 0.06;

void main() {
    uint i = invocation_number();
    uint entry = PIXELS ? i / 8u : i;
    uint source;
    if (ONE_BIN && !PIXELS) {
        if (i >= min(counters[COUNTER_RECORDS], frame.record_capacity)) return;
        source = i;
    } else {
        uvec4 bin = bins[push.bin];
        if (entry >= bin.x) return;
        source = shade_order[bin.y + entry];
    }

    uint id;
    vec2 p;
    bool mine = true;
    vec2 sides = vec2(frame.footprint); // sides of the rectangle that textures are filtered over
    uint location = 0u, shadow_place;
    if (PIXELS) {
        uint columns = (frame.size.x + 7u) / 8u;
        uvec2 pixel = split(source, columns) * uvec2(8u, 1u) + uvec2(i % 8u, 0u);
        mine = pixel.x < frame.size.x;
        id = id_at(ivec2(min(pixel, frame.size - 1u)));
        p = frame.origin + vec2(pixel);
        source = pixel.y * frame.size.x + pixel.x;
        shadow_place = source;
    } else {
        uvec4 record = texelFetch(records, int(source));
        id = record.y;
        p = record_position(record);
        sides = frame.place_footprint * (BOX_FILTER ? place_sides(record.z) : vec2(1.0));
        location = record.x & POINT_LOCATION;
        shadow_place = place_of_record(source);
    }

    Triangle k = triangle_at(max(id, 1u) - 1u);
    ivec3 v = k.vertices;
    uint m = material_of(k.word);
    mine = mine && id != 0u && (ONE_BIN || bin_of(k.word) == push.bin);
    Barycentric w = barycentric(k.v0, k.v1, k.v2, p);
    if (LOCATIONS) {
        mat2x3 change = mat2x3(w.dx, w.dy) * location_jacobian(location);
        w.dx = change[0];
        w.dy = change[1];
    }
    w.dx *= sides.x;
    w.dy *= sides.y;

    Place place;
    place.material = m;
    place.w = w;
    if (TEXTURED) {
        vec4 a = texelFetch(uvs, v.x), b = texelFetch(uvs, v.y), c = texelFetch(uvs, v.z);
        place.first_uv = mat3x2(a.xy, b.xy, c.xy);
        place.second_uv = mat3x2(a.zw, b.zw, c.zw);
    }

    vec4 base = base_color_of(m);
    if (VERTEX_COLORS) base *= mat3x4(texelFetch(colors, v.x), texelFetch(colors, v.y), texelFetch(colors, v.z)) * w.at;
    base *= READ(BASE_COLOR_TEXTURE, place);

    vec3 radiance, through = vec3(0.0);     // light from the surface; share of the light from behind that passes it
    Factors factors = factors_of(m);
    if (UNLIT) {
        radiance = base.rgb;
    } else {
        vec3 position = position_of(k, w.at);
        vec3 to_eye = frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : safe_normalize(frame.eye.xyz - position, -frame.view_direction.xyz);

        vec3 normal = normal_of(k, w.at);
        float side_seen = w.facing ? 1.0 : -1.0;
        normal = safe_normalize(normal, to_eye * side_seen) * side_seen;
        vec3 tangent = vec3(0.0), bitangent = vec3(0.0);
        if (TANGENTS) {
            vec4 t = tangent_of(k, w.at);
            tangent = safe_normalize(t.xyz, vec3(0.0)) * side_seen;
            bitangent = cross(normal, tangent) * (t.w < 0.0 ? -1.0 : 1.0) * side_seen;
        }
        Surface s;
        s.normal = normal;
        if (NORMAL_TEXTURE != 0u) s.normal = bumped(READ(NORMAL_TEXTURE, place), factors.normal_scale, tangent, bitangent, normal);
        s.mirror = facing(s.normal, to_eye);
        float share = facing_share(s.normal, to_eye);
        float n_v = max(dot(s.mirror, to_eye), 1e-4);

        EmissiveMetallic emissive_metallic = emissive_metallic_of(m);
        vec4 metallic_roughness = READ(METALLIC_ROUGHNESS_TEXTURE, place);
        float metallic = emissive_metallic.metallic * metallic_roughness.b;
        s.roughness = factors.roughness * metallic_roughness.g;
        vec3 dielectric = vec3(0.04);
        float strength = 1.0;
        if (SPECULAR) {
            SpecularFactors given = specular_of(m);
            strength = given.strength * READ(SPECULAR_TEXTURE, place).a;
            dielectric = min(given.reflectance * READ(SPECULAR_COLOR_TEXTURE, place).rgb, vec3(1.0)) * strength;
        }
        s.diffuse = base.rgb * (1.0 - metallic);
        s.f0 = mix(dielectric, base.rgb, metallic);
        s.f90 = SPECULAR ? mix(strength, 1.0, metallic) : 1.0;
        if (SPECULAR_GLOSSINESS) {
            vec4 given = specular_glossiness_of(m) * READ(SPECULAR_GLOSSINESS_TEXTURE, place);
            s.diffuse = base.rgb * (1.0 - greatest(given.rgb));
            s.f0 = given.rgb;
            s.roughness = 1.0 - given.a;
        }
        s.roughness = clamp(s.roughness, 0.04, 1.0);
        s.alpha = s.roughness * s.roughness;
        if (IRIDESCENCE) s.f0 = film_f0(place, s.f0, n_v);
        s.f0 *= share;
        s.f90 *= share;
        if (ANISOTROPY) draw_out(s, place, tangent, bitangent);
        vec3 mirror = ANISOTROPY ? bent_normal(s, to_eye) : s.mirror;
        vec2 split = environment_brdf(s.roughness, n_v);
        vec3 reflected = s.f0 * split.x + s.f90 * split.y;

        if (TRANSMISSION) {
            float passes = transmitted(place);
            through = s.diffuse * remaining(reflected) * passes * volume_passes(place, scale_of(k, w.at));
            s.diffuse *= 1.0 - passes;
        }
        if (DIFFUSE_TRANSMISSION) {
            DiffuseTransmissionFactors given = diffuse_transmission_of(m);
            float passes = given.factor * READ(DIFFUSE_TRANSMISSION_TEXTURE, place).a;
            s.through = given.color * READ(DIFFUSE_TRANSMISSION_COLOR_TEXTURE, place).rgb * (1.0 - metallic) * passes;
            s.diffuse *= 1.0 - passes;
        }
        s.emissive = emissive_metallic.emissive * READ(EMISSIVE_TEXTURE, place).rgb;
        float occlusion = 1.0;
        if (OCCLUSION_TEXTURE != 0u)
            occlusion = OCCLUSION_TEXTURE == METALLIC_ROUGHNESS_TEXTURE ? metallic_roughness.r : READ(OCCLUSION_TEXTURE, place).r;
        s.occlusion = 1.0 + factors.occlusion_strength * (occlusion - 1.0);

        float ambient = s.occlusion * (PUNCTUAL && !ENVIRONMENT ? STUDIO_AMBIENT : 1.0);
        vec3 irradiance = environment_irradiance(s.normal);
        vec3 diffuse = s.diffuse * irradiance;
        if (DIFFUSE_TRANSMISSION) diffuse += s.through * environment_irradiance(-s.normal);
        radiance = (diffuse * remaining(reflected) + reflected * environment_reflection(reflect(-to_eye, mirror), s.roughness)) * ambient
            + s.emissive;
        Sheen sheen;
        vec3 of_sheen = vec3(0.0);
        if (SHEEN) {
            sheen = read_sheen(place, n_v, share);
            of_sheen = sheen.color * sheen.albedo * irradiance * ambient;
        }
        Coat coat;
        vec3 of_coat = vec3(0.0);
        if (CLEARCOAT) {
            coat = read_coat(place, tangent, bitangent, normal, to_eye);
            of_coat = coat_environment(coat, to_eye) * ambient;
        }

        if (PUNCTUAL) {
            uint shadows = shadows_at(shadow_place);
            for (uint l = 0u; l < frame.light_count; l++) {
                Light light = lights[l];
                vec3 to_light = -light.direction_kind.xyz;
                vec3 e = light.color_scale.rgb;
                if (LOCAL_LIGHTS && light.direction_kind.w != 0.0) {
                    vec3 d = light.position_range.xyz - position;
                    float square = max(dot(d, d), 1e-12);
                    to_light = d * inversesqrt(square);
                    float window = clamp(1.0 - square * square * light.position_range.w * light.position_range.w, 0.0, 1.0);
                    e *= (light.position_range.w > 0.0 ? window : 1.0) / square;
                    float cone = clamp(dot(-to_light, light.direction_kind.xyz) * light.color_scale.w + light.offset.x, 0.0, 1.0);
                    e *= light.direction_kind.w == 2.0 ? cone * cone : 1.0;
                }
                e *= light_share(shadow_place, shadows, l);
                radiance += reflect_light(s, to_eye, to_light, e);
                if (SHEEN) of_sheen += sheen_light(sheen, s.normal, s.mirror, to_eye, to_light, e);
                if (CLEARCOAT) of_coat += coat_light(coat, to_eye, to_light, e);
            }
        }
        if (SHEEN) {
            radiance = radiance * sheen_passes(sheen) + of_sheen;
            through *= sheen_passes(sheen);
        }
        if (CLEARCOAT) {
            radiance = mix(radiance, of_coat, coat.weight);
            through *= 1.0 - coat.weight;
        }
    }
    radiance *= frame.exposure;
    // Materials with absurd values must not make infinities or NaN.
    radiance = mix(clamp(radiance, vec3(0.0), vec3(3e38)), vec3(0.0), bvec3(is_nan(radiance.r), is_nan(radiance.g), is_nan(radiance.b)));

    if (PIXELS) {
        vec4 c = to_output(vec4(radiance, 1.0));
        if (mine) color[source] = c;
        if (DISPLAY_CODES && mine) display_out[source] = display_code(c);
    } else {
        // A negative cutoff stands for BLEND: alpha is the opacity. Otherwise alpha is compared with the cutoff.
        float opacity = factors.cutoff < 0.0 ? clamp(base.a, 0.0, 1.0) : base.a >= factors.cutoff ? 1.0 : 0.0;
        opacity = BLENDED && id > frame.first_blend ? opacity : 1.0;
        shaded_out[source] = TINTED ? vec4(radiance * opacity, pack_tint(mix(vec3(1.0), through, opacity))) : vec4(radiance, opacity);
    }
}
