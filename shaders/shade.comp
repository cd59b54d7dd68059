// shade: the radiance of what raster or the sub-samples see, one dispatch a material bin.
// Sources: PIXELS (the centres of the pixels of a span, by the IDs of raster) or visibility records at their location
// in a pixel or in the cell of a site (SITES), whose Jacobian then sets the footprint.
// Reads: shade_order, ids or records, the geometry, textures. Writes: color and display, or shaded.
// Linear light throughout. A texture is read once, at the level that its sampler chooses, or (BOX_FILTER) averaged over the
// square that a place stands for: at several places along the longer side that the square has in the texture.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/color.glsl"
#include "include/barycentric.glsl"
#include "include/brdf.glsl"
#include "include/material.glsl"
#include "include/studio.glsl"
#include "include/tiles.glsl"
#include "include/sites.glsl"
#include "include/place.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const bool PIXELS = false;
layout(constant_id = 1) const bool ONE_BIN = false;
layout(constant_id = 2) const bool DISPLAY_CODES = false;
layout(constant_id = 3) const bool BASE_COLOR_TEXTURE = false;
layout(constant_id = 4) const bool METALLIC_ROUGHNESS_TEXTURE = false;
layout(constant_id = 5) const bool NORMAL_TEXTURE = false;
layout(constant_id = 6) const bool OCCLUSION_TEXTURE = false;
layout(constant_id = 7) const bool EMISSIVE_TEXTURE = false;
layout(constant_id = 8) const bool VERTEX_COLORS = false;
layout(constant_id = 9) const bool UNLIT = false;
layout(constant_id = 10) const bool PUNCTUAL = false;   // the scene has lights
layout(constant_id = 11) const bool LOCAL_LIGHTS = false; // point or spot lights among them
layout(constant_id = 12) const bool BLENDED = false;    // opacity is used
layout(constant_id = 13) const bool PACKED_OCCLUSION = false;   // in the red channel of the metallic-roughness texture
layout(constant_id = 14) const bool ONE_UV_TRANSFORM = false;   // and UV set, for all textures
layout(constant_id = 15) const bool BOX_FILTER = false; // textures are filtered over the square that a place stands for, along both of its axes

layout(set = 1, binding = 0) uniform sampler2D base_color_texture;
layout(set = 1, binding = 1) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 2) uniform sampler2D normal_texture;
layout(set = 1, binding = 3) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 4) uniform sampler2D emissive_texture;

layout(push_constant) uniform Push { uint bin; } push;

// Light left of the studio in a scene with lights of its own, so that what faces away from them shows.
const float STUDIO_AMBIENT = 0.06;

// Places along the longer axis of a footprint that a texture is read at, at the most.
const float MOST_PROBES = 8.0;
// Width of the texels, over that of a box, whose trilinear filter has the variance of the box: root of 1/3.
const float LEVEL_WIDTH = 0.57735;

struct Corners { vec4 a, b, c; };       // both UV sets of the three vertices

vec4 read(sampler2D image, uint use, uint m, Corners corners, Barycentric w) {
    uint rows = MATERIAL_UV_ROWS + (ONE_UV_TRANSFORM ? 0u : 2u * use);
    vec4 row_u = material_vector(m, rows), row_v = material_vector(m, rows + 1u);
    mat3x2 uv = row_u.w != 0.0 ? mat3x2(corners.a.zw, corners.b.zw, corners.c.zw) : mat3x2(corners.a.xy, corners.b.xy, corners.c.xy);
    mat2 linear = mat2(row_u.x, row_v.x, row_u.y, row_v.y);
    vec2 at = linear * (uv * w.at) + vec2(row_u.z, row_v.z);
    vec2 dx = linear * (uv * w.dx), dy = linear * (uv * w.dy);
    if (!BOX_FILTER) return textureGrad(image, at, dx, dy);
    vec2 size = vec2(textureSize(image, 0));
    vec2 tx = dx * size, ty = dy * size;
    float square_x = dot(tx, tx), square_y = dot(ty, ty);
    float longest = sqrt(max(square_x, square_y));
    float across = abs(tx.x * ty.y - tx.y * ty.x) / max(longest, 1e-20);
    float wanted = clamp(ceil(longest / max(across, 1.0) - 0.25), 1.0, MOST_PROBES);
    vec2 step_ = (square_x > square_y ? dx : dy) / wanted;
    float level = log2(max(across, longest / wanted) * LEVEL_WIDTH);
    vec2 first = at - step_ * (0.5 * wanted - 0.5);
    vec4 sum = vec4(0.0);
    float probe = 0.0;
    do {
        vec4 texel = textureLod(image, first + probe * step_, level);
        sum += probe < wanted ? texel : vec4(0.0);
        probe += 1.0;
    } while (subgroupAny(probe < wanted));
    return sum / wanted;
}

vec3 safe_normalize(vec3 v, vec3 otherwise) {
    float l = dot(v, v);
    return l > 1e-30 ? v * inversesqrt(l) : otherwise;
}

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
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
    float side = frame.footprint;       // of the square that textures are filtered over
    uint site = 0u, shadows = 0u;       // a bit for each light that the surface lies in the shadow of
    if (PIXELS) {
        uint columns = (frame.size.x + 7u) / 8u;
        uvec2 pixel = split(source, columns) * uvec2(8u, 1u) + uvec2(i % 8u, 0u);
        mine = pixel.x < frame.size.x;
        id = texelFetch(ids, ivec2(min(pixel, frame.size - 1u)), 0).x;
        p = frame.origin + vec2(pixel);
        source = pixel.y * frame.size.x + pixel.x;
    } else {
        uvec4 record = texelFetch(records, int(source));
        id = record.y;
        vec2 location = place_location(record.z);
        side = frame.place_footprint * (BOX_FILTER ? place_side(record.z) : 1.0);
        if (SITES) {
            site = record.x & POINT_SITE;
            uvec4 at = texelFetch(sites, int(2u * site));
            // BLEND layers lie before the surface that shadows are known of.
            shadows = POINTS && (record.x & POINT_OPAQUE) != 0u ? at.w : 0u;
            p = tile_center(ivec2(split(at.z, frame.tiles.x))) + uintBitsToFloat(at.xy) + site_jacobian(site) * location;
        } else {
            p = frame.origin + vec2(record.x & 0xffffu, record.x >> 16) + location;
        }
    }

    Triangle k = triangle_at(max(id, 1u) - 1u);
    ivec3 v = k.vertices;
    uint m = k.word & 0xffffu;
    mine = mine && id != 0u && (ONE_BIN || (k.word >> 16 & 0x3fffu) == push.bin);
    Barycentric w = barycentric(k.v0, k.v1, k.v2, p);
    if (SITES) {
        mat2x3 change = mat2x3(w.dx, w.dy) * site_jacobian(site);
        w.dx = change[0];
        w.dy = change[1];
    }
    w.dx *= side;
    w.dy *= side;

    Corners corners;
    if (BASE_COLOR_TEXTURE || METALLIC_ROUGHNESS_TEXTURE || NORMAL_TEXTURE || OCCLUSION_TEXTURE || EMISSIVE_TEXTURE)
        corners = Corners(texelFetch(uvs, v.x), texelFetch(uvs, v.y), texelFetch(uvs, v.z));

    vec4 base = material_vector(m, MATERIAL_BASE_COLOR);
    if (VERTEX_COLORS) base *= mat3x4(texelFetch(colors, v.x), texelFetch(colors, v.y), texelFetch(colors, v.z)) * w.at;
    if (BASE_COLOR_TEXTURE) base *= read(base_color_texture, 0u, m, corners, w);

    vec3 radiance;
    if (UNLIT) {
        radiance = base.rgb;
    } else {
        mat3 world = mat3(texelFetch(positions, v.x).xyz, texelFetch(positions, v.y).xyz, texelFetch(positions, v.z).xyz);
        vec3 position = world * w.at;
        vec3 to_eye = frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : safe_normalize(frame.eye.xyz - position, -frame.view_direction.xyz);

        vec3 normal = mat3(texelFetch(normals, v.x).xyz, texelFetch(normals, v.y).xyz, texelFetch(normals, v.z).xyz) * w.at;
        float facing = w.facing ? 1.0 : -1.0;
        normal = safe_normalize(normal, to_eye * facing) * facing;
        if (NORMAL_TEXTURE) {
            vec4 tangent = mat3x4(texelFetch(tangents, v.x), texelFetch(tangents, v.y), texelFetch(tangents, v.z)) * w.at;
            vec3 t = safe_normalize(tangent.xyz, vec3(0.0)) * facing;
            vec3 b = cross(normal, t) * (tangent.w < 0.0 ? -1.0 : 1.0) * facing;
            vec3 n = read(normal_texture, 2u, m, corners, w).xyz * 2.0 - 1.0;
            n.xy *= material_vector(m, MATERIAL_FACTORS).y;
            normal = safe_normalize(t * n.x + b * n.y + normal * n.z, normal);
        }
        // An interpolated normal may face away at a silhouette.
        float turned = dot(normal, to_eye);
        normal = turned < 0.0 ? safe_normalize(normal - to_eye * turned, normal) : normal;

        vec4 emissive_metallic = material_vector(m, MATERIAL_EMISSIVE_METALLIC), factors = material_vector(m, MATERIAL_FACTORS);
        float metallic = emissive_metallic.w, roughness = factors.x, occlusion = 1.0;
        if (METALLIC_ROUGHNESS_TEXTURE) {
            vec4 mr = read(metallic_roughness_texture, 1u, m, corners, w);
            roughness *= mr.g;
            metallic *= mr.b;
            if (PACKED_OCCLUSION) occlusion = mr.r;
        }
        roughness = clamp(roughness, 0.04, 1.0);

        Surface s;
        s.normal = normal;
        s.diffuse = base.rgb * (1.0 - metallic);
        s.f0 = mix(vec3(0.04), base.rgb, metallic);
        s.alpha = roughness * roughness;
        s.emissive = emissive_metallic.rgb;
        if (EMISSIVE_TEXTURE) s.emissive *= read(emissive_texture, 4u, m, corners, w).rgb;
        if (OCCLUSION_TEXTURE) occlusion = read(occlusion_texture, 3u, m, corners, w).r;
        s.occlusion = 1.0 + factors.z * (occlusion - 1.0);

        float n_v = max(dot(normal, to_eye), 1e-4);
        vec2 split = environment_brdf(roughness, n_v);
        vec3 specular = s.f0 * split.x + split.y;
        vec3 studio = s.diffuse * (1.0 - specular) * studio_irradiance(normal)
            + specular * studio_reflection(reflect(-to_eye, normal), s.alpha);
        radiance = studio * s.occlusion * (PUNCTUAL ? STUDIO_AMBIENT : 1.0) + s.emissive;

        if (PUNCTUAL) {
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
                e *= POINTS && l < 32u && (shadows >> l & 1u) != 0u ? 0.0 : 1.0;
                radiance += reflect_light(s, to_eye, to_light, e);
            }
        }
    }
    radiance *= frame.exposure;
    // What a hostile material makes of a pixel stays in that pixel's range.
    radiance = mix(clamp(radiance, vec3(0.0), vec3(3e38)), vec3(0.0), isnan(radiance));

    if (PIXELS) {
        vec4 c = to_output(vec4(radiance, 1.0));
        if (mine) color[source] = c;
        if (DISPLAY_CODES && mine) display_out[source] = display_code(c);
    } else {
        shaded_out[source] = vec4(radiance, BLENDED && id > frame.first_blend ? clamp(base.a, 0.0, 1.0) : 1.0);
    }
}
