// receivers: where the surfaces that are about to be shaded appear on the plane of a light, as a list of sample locations.
// Sources: PIXELS (what the centres of a region's pixels see) or the visibility samples of a round, BLEND layers among them.
// What the light does not reach, or another plane of a light with several is asked for, is left out: it gets a pixel off the
// plane. A surface whose triangle turns the light the side that is not seen lies in the shadow of itself, but of
// DIFFUSE_TRANSMISSION, which light from behind shines through.
// A probe is another place in a pixel that its triangle covers too; `shadow` compares it with the centre. It begins no word.
// Reads: ids or records, the geometry. Writes: a location each, and a word of `include/shadows.glsl`. Twin, with what hides them: `gpc::reference::shadow`.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/barycentric.glsl"
#include "include/material.glsl"
#include "include/record_position.glsl"
#include "include/shadows.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = RECEIVERS_CONSTANT_PIXELS) const bool PIXELS = false;
layout(constant_id = RECEIVERS_CONSTANT_DIFFUSE_TRANSMISSION) const bool DIFFUSE_TRANSMISSION = false;   // of some materials
layout(std430, set = SET_BESIDE_FRAME, binding = RECEIVERS_BINDING_LOCATIONS_OUT) writeonly buffer LocationsOut { uvec4 locations_out[]; };   // as OCCLUDERS have them
layout(std430, set = SET_BESIDE_FRAME, binding = RECEIVERS_BINDING_WORDS) buffer ShadowWords { uint words[]; };
layout(push_constant) uniform Push {
    mat4 to_plane;      // position -> (pixel x * w, pixel y * w, z, w), pixels from the plane's middle
    vec4 light;         // xyz: unit direction to a distant light (w = 0) or position of a local one (w = 1)
    vec4 cone;          // xyz: axis of a local light, unit; w: cosine of the angle from it up to which light goes, -2 for all directions
    ivec2 low;          // upper left pixel of the part of the plane that is sampled, from its middle
    uvec2 size;         // of that part, in pixels
    float range;        // how far the light of a local one reaches
    uint step_;         // of the light: its bit; 32 more in the first step of all, which begins the words; of a probe, 64 times its number from 1 on
    uint face;          // which of the six planes of a cube this is, as `face_of` numbers them; SINGLE_PLANE is no cube's
} push;
// Places of probes in their pixels. Growth finds what lies within two pixels of a place that a shadow covers: of a line a fifth of a
// pixel wide, all but 1 % on average over its directions, and all but 14 % in the worst. Centres alone miss 22 % and 78 %.
const vec2 PROBES[3] = vec2[](vec2(0.34375, 0.34375), vec2(-0.296875, 0.40625), vec2(0.46875, -0.296875));
// What lies nearer to the light than this is the receiver itself: part of its distance or, of distant light, of the scene's depth.
const float BIAS = 1.0 / 131072.0;

// The plane of a cube that a direction belongs to, by the axis that it is nearest to: x, -x, y, -y, z, -z; of equally near ones the first.
uint face_of(vec3 way) {
    vec3 size = abs(way);
    float largest = max(size.x, max(size.y, size.z));
    uint axis = size.x == largest ? 0u : size.y == largest ? 1u : 2u;
    float along = axis == 0u ? way.x : axis == 1u ? way.y : way.z;
    return 2u * axis + (along < 0.0 ? 1u : 0u);
}

void main() {
    uint i = invocation_number();
    uint count = PIXELS ? frame.size.x * frame.size.y : min(counters[COUNTER_RECORDS], frame.record_capacity);
    uint source = min(i, max(count, 1u) - 1u), id;
    uint probe = push.step_ >> 6;
    vec2 p;
    if (PIXELS) {
        uvec2 pixel = split(source, frame.size.x);
        id = id_at(ivec2(pixel));
        p = frame.origin + vec2(pixel) + (probe != 0u ? PROBES[probe - 1u] : vec2(0.0));
    } else {
        uvec4 record = texelFetch(records, int(source));
        id = record.y;
        p = record_position(record);
    }
    bool receives = i < count && id != 0u;

    Triangle k = triangle_at(max(id, 1u) - 1u);
    vec3 weights = barycentric(k.v0, k.v1, k.v2, p).at;
    receives = receives && (probe == 0u || min(weights.x, min(weights.y, weights.z)) >= 0.0);
    vec3 position = position_of(k, weights);
    vec3 a = position_of(k, vec3(1.0, 0.0, 0.0)), b = position_of(k, vec3(0.0, 1.0, 0.0)), c = position_of(k, vec3(0.0, 0.0, 1.0));
    vec3 normal = cross(b - a, c - a);
    vec3 to_eye = frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : frame.eye.xyz - a;
    normal = dot(normal, to_eye) < 0.0 ? -normal : normal;

    bool local = push.light.w != 0.0;
    vec3 to_light = local ? push.light.xyz - position : push.light.xyz;
    float distance_ = length(to_light);
    bool reached = receives && (!local || (distance_ <= push.range && dot(-to_light, push.cone.xyz) >= push.cone.w * distance_));
    bool backlit = DIFFUSE_TRANSMISSION && material_vector(k.word & 0xffffu, MATERIAL_DIFFUSE_TRANSMISSION).w > 0.0;
    bool turned = reached && !backlit && dot(normal, to_light) < 0.0;
    if (i < count && probe == 0u) {
        uint place = (PIXELS ? i : place_of_record(i)) * SHADOW_WORDS, light = push.step_ & 31u;
        uint word = (push.step_ & 32u) != 0u ? 0u : words[place];
        words[place] = word | (turned ? 1u << light : 0u);
        if (SHADOW_WORDS > 1u && turned) words[place + 1u + light] = 0u;
    }

    vec4 at = to_clip(push.to_plane, vec4(position, 1.0));
    vec2 uv = at.xy / at.w, low = floor(uv);
    bool asked = reached && !turned && at.w > 0.0 && (push.face == SINGLE_PLANE || face_of(-to_light) == push.face);
    // Rounding takes what lies on the part's rim off it.
    ivec2 pixel = ivec2(clamp(low, -8388608.0, 8388607.0)) - push.low, last = ivec2(push.size) - 1;
    vec2 within = uv - low;
    within = mix(mix(within, vec2(0.0), lessThan(pixel, ivec2(0))), vec2(1.0), greaterThan(pixel, last));
    asked = asked && all(greaterThanEqual(pixel, ivec2(-1))) && all(lessThanEqual(pixel, last + 1));
    float depth = at.z / at.w, least = local ? depth * (1.0 + BIAS) : depth + BIAS;
    locations_out[2u * i] = uvec4(asked ? clamp(pixel, ivec2(0), last) : ivec2(-1), floatBitsToUint(within));
    locations_out[2u * i + 1u] = uvec4(floatBitsToUint(least), id, 0u, 0u);
}
