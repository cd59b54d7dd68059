// shade: computes the radiance of surfaces, in a dispatch for each material bin. With PIXELS an invocation takes the centre of a
// pixel of a span, which sees the triangle in raster's IDs. Otherwise it takes a visibility sample, which is shaded at its place
// in a pixel or in the cell of a location (LOCATIONS). The Jacobian of a location scales the footprint of textures.
// Reads: shade_order, bins, ids or fragments, the geometry, textures, shadow words. Writes: color and display, or shaded.
// All values are in linear light. TRANSMISSION: a layer has a tint (see tint.glsl), not an opacity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/environment.glsl"
#include "include/finite.glsl"
#include "include/fragment_position.glsl"
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

// What an invocation shades.
struct Task {
    uint source;            // where the result is stored: a pixel or a visibility sample
    bool mine;              // whether the result is stored
    uint id;                // the triangle
    vec2 at;                // position in the image
    vec2 sides;             // sides of the rectangle that textures are filtered over
    uint location, shadow_place;
};

Task task_of(uint source, uint i) {
    Task t = Task(source, true, 0u, vec2(0.0), vec2(frame.footprint), 0u, 0u);
    if (PIXELS) {
        uint columns = (frame.size.x + 7u) / 8u;
        uvec2 pixel = split(source, columns) * uvec2(8u, 1u) + uvec2(i % 8u, 0u);
        t.mine = pixel.x < frame.size.x;
        t.id = id_at(ivec2(min(pixel, frame.size - 1u)));
        t.at = frame.origin + vec2(pixel);
        t.source = pixel.y * frame.size.x + pixel.x;
        t.shadow_place = t.source;
    } else {
        uvec4 fragment = texelFetch(fragments, int(source));
        t.id = fragment.y;
        t.at = fragment_position(fragment);
        t.sides = frame.place_footprint * (BOX_FILTER ? place_sides(fragment.z) : vec2(1.0));
        t.location = fragment.x & POINT_LOCATION;
        t.shadow_place = place_of_fragment(source);
    }
    return t;
}

Place place_of(Task t, Triangle k) {
    Place place;
    place.material = material_of(k.word);
    place.whole = PIXELS || frame.sample_count == 1u;
    place.w = barycentric(k.v0, k.v1, k.v2, t.at);
    if (LOCATIONS) {
        mat2x3 change = mat2x3(place.w.dx, place.w.dy) * location_jacobian(t.location);
        place.w.dx = change[0];
        place.w.dy = change[1];
    }
    place.w.dx *= t.sides.x;
    place.w.dy *= t.sides.y;
    if (TEXTURED) {
        vec4 a = texelFetch(uvs, k.vertices.x), b = texelFetch(uvs, k.vertices.y), c = texelFetch(uvs, k.vertices.z);
        place.first_uv = mat3x2(a.xy, b.xy, c.xy);
        place.second_uv = mat3x2(a.zw, b.zw, c.zw);
    }
    return place;
}

vec4 color_of(Place place, ivec3 v) {
    vec4 base = base_color_of(place.material);
    if (VERTEX_COLORS) base *= mat3x4(texelFetch(colors, v.x), texelFetch(colors, v.y), texelFetch(colors, v.z)) * place.w.at;
    return base * READ(BASE_COLOR_TEXTURE, place);
}

// A point of a surface, the direction to the eye, and the axes of the side that is seen.
struct Point {
    vec3 position, to_eye, normal, tangent, bitangent;
};

Point point_of(Triangle k, Barycentric w) {
    Point p;
    p.position = position_of(k, w.at);
    p.to_eye = frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : safe_normalize(frame.eye.xyz - p.position, -frame.view_direction.xyz);
    float side_seen = w.facing ? 1.0 : -1.0;
    p.normal = safe_normalize(normal_of(k, w.at), p.to_eye * side_seen) * side_seen;
    p.tangent = vec3(0.0);
    p.bitangent = vec3(0.0);
    if (TANGENTS) {
        vec4 t = tangent_of(k, w.at);
        p.tangent = safe_normalize(t.xyz, vec3(0.0)) * side_seen;
        p.bitangent = cross(p.normal, p.tangent) * (t.w < 0.0 ? -1.0 : 1.0) * side_seen;
    }
    return p;
}

// What the surface at a place does with light, and what it makes of the light of all directions together.
struct Response {
    float share, n_v;       // see facing_share; cosine between the normal and the direction to the eye
    vec3 mirror;            // normal that reflections of the environment turn around
    vec3 reflected;         // share of the light that is reflected
    vec3 through;           // share of the light from behind that passes
};

Surface surface_of(Place place, Point p, Triangle k, vec4 base, Factors factors, out Response r) {
    Surface s;
    uint m = place.material;
    s.normal = p.normal;
    if (NORMAL_TEXTURE != 0u) s.normal = bumped(READ(NORMAL_TEXTURE, place), factors.normal_scale, p.tangent, p.bitangent, p.normal);
    s.mirror = facing(s.normal, p.to_eye);
    r.share = facing_share(s.normal, p.to_eye);
    r.n_v = max(dot(s.mirror, p.to_eye), 1e-4);

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
    if (IRIDESCENCE) s.f0 = film_f0(place, s.f0, r.n_v);
    s.f0 *= r.share;
    s.f90 *= r.share;
    if (ANISOTROPY) draw_out(s, place, p.tangent, p.bitangent);
    r.mirror = ANISOTROPY ? bent_normal(s, p.to_eye) : s.mirror;
    vec2 brdf = environment_brdf(s.roughness, r.n_v);
    r.reflected = s.f0 * brdf.x + s.f90 * brdf.y;

    r.through = vec3(0.0);
    if (TRANSMISSION) {
        float passes = transmitted(place);
        r.through = s.diffuse * remaining(r.reflected) * passes * volume_passes(place, scale_of(k, place.w.at));
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
    return s;
}

// The light of a lamp at a position, and the direction to the lamp.
vec3 light_at(Light light, vec3 position, out vec3 to_light) {
    to_light = -light.direction_kind.xyz;
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
    return e;
}

// The radiance of a surface in the light of the environment and of all lamps.
vec3 radiance_of(Place place, Point p, Surface s, inout Response r, uint shadow_place) {
    float ambient = s.occlusion * (PUNCTUAL && !ENVIRONMENT ? STUDIO_AMBIENT : 1.0);
    vec3 irradiance = environment_irradiance(s.normal);
    vec3 diffuse = s.diffuse * irradiance;
    if (DIFFUSE_TRANSMISSION) diffuse += s.through * environment_irradiance(-s.normal);
    vec3 radiance = (diffuse * remaining(r.reflected) + r.reflected * environment_reflection(reflect(-p.to_eye, r.mirror), s.roughness)) * ambient
        + s.emissive;
    Sheen sheen;
    vec3 of_sheen = vec3(0.0);
    if (SHEEN) {
        sheen = read_sheen(place, r.n_v, r.share);
        of_sheen = sheen.color * sheen.albedo * irradiance * ambient;
    }
    Coat coat;
    vec3 of_coat = vec3(0.0);
    if (CLEARCOAT) {
        coat = read_coat(place, p.tangent, p.bitangent, p.normal, p.to_eye);
        of_coat = coat_environment(coat, p.to_eye) * ambient;
    }
    if (PUNCTUAL) {
        uint shadows = shadows_at(shadow_place);
        for (uint l = 0u; l < frame.light_count; l++) {
            vec3 to_light, e = light_at(lights[l], p.position, to_light) * light_share(shadow_place, shadows, l);
            radiance += reflect_light(s, p.to_eye, to_light, e);
            if (SHEEN) of_sheen += sheen_light(sheen, s.normal, s.mirror, p.to_eye, to_light, e);
            if (CLEARCOAT) of_coat += coat_light(coat, p.to_eye, to_light, e);
        }
    }
    if (SHEEN) {
        radiance = radiance * sheen_passes(sheen) + of_sheen;
        r.through *= sheen_passes(sheen);
    }
    if (CLEARCOAT) {
        radiance = mix(radiance, of_coat, coat.weight);
        r.through *= 1.0 - coat.weight;
    }
    return radiance;
}

void main() {
    uint i = invocation_number(), entry = PIXELS ? i / 8u : i, source = i;
    if (ONE_BIN && !PIXELS) {
        if (i >= min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity)) return;
    } else {
        uvec4 bin = bins[push.bin];
        if (entry >= bin.x) return;
        source = shade_order[bin.y + entry];
    }
    Task t = task_of(source, i);
    Triangle k = triangle_at(max(t.id, 1u) - 1u);
    t.mine = t.mine && t.id != 0u && (ONE_BIN || bin_of(k.word) == push.bin);
    Place place = place_of(t, k);
    vec4 base = color_of(place, k.vertices);
    Factors factors = factors_of(place.material);
    vec3 radiance = base.rgb;
    Response r;
    r.through = vec3(0.0);
    if (!UNLIT) {
        Point p = point_of(k, place.w);
        Surface s = surface_of(place, p, k, base, factors, r);
        radiance = radiance_of(place, p, s, r, t.shadow_place);
    }
    radiance *= frame.exposure;
    // Materials with absurd values must not make infinities or NaN.
    radiance = mix(clamp(radiance, vec3(0.0), vec3(3e38)), vec3(0.0), bvec3(is_nan(radiance.r), is_nan(radiance.g), is_nan(radiance.b)));

    if (PIXELS) {
        vec4 c = to_output(vec4(radiance, 1.0));
        if (t.mine) color[t.source] = c;
        if (DISPLAY_CODES && t.mine) display_out[t.source] = display_code(c);
    } else {
        // A negative cutoff stands for BLEND: alpha is the opacity. Otherwise alpha is compared with the cutoff.
        float opacity = factors.cutoff < 0.0 ? clamp(base.a, 0.0, 1.0) : base.a >= factors.cutoff ? 1.0 : 0.0;
        opacity = BLENDED && t.id > frame.first_blend ? opacity : 1.0;
        shaded_out[t.source] = TINTED ? vec4(radiance * opacity, pack_tint(mix(vec3(1.0), r.through, opacity))) : vec4(radiance, opacity);
    }
}
