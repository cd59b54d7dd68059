// receivers: projects the surfaces that are about to be shaded on the plane of a light, and makes a list of sample locations
// there. An invocation takes one of PIXELS (what the centre of a pixel sees) or a visibility sample of a round, BLEND layers
// included.
// Places that the light does not reach, or that belong to another plane of the light, are left out: they get a location off the
// plane. If light and camera are on different sides of a triangle, its surface lies in its own shadow, unless its material has
// DIFFUSE_TRANSMISSION, which lets light from behind through.
// A probe is another place in a pixel, if the pixel's triangle covers it, too. `shadow` compares it with the pixel's centre. No
// shadow words are written for probes.
// If receivers are LOOKED_UP, the pass runs once for all lights. It stores the surfaces: (position, triangle ID or 0 if there is
// none to ask for), (normal, 1 if light from behind shines through).
// Reads: ids or records, the geometry. Writes: a location for each place, and the words of `include/shadows.glsl`.
// Twin: `gpc::reference::shadow`.
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
layout(constant_id = RECEIVERS_CONSTANT_DIFFUSE_TRANSMISSION) const bool DIFFUSE_TRANSMISSION = false;   // some material has it
layout(constant_id = RECEIVERS_CONSTANT_LOOKED_UP) const bool LOOKED_UP = false;      // `occlude` projects the surfaces and writes words
layout(std430, set = SET_BESIDE_FRAME, binding = RECEIVERS_BINDING_LOCATIONS_OUT) writeonly buffer LocationsOut { uvec4 locations_out[]; };   // those of OCCLUDERS
layout(std430, set = SET_BESIDE_FRAME, binding = RECEIVERS_BINDING_WORDS) buffer ShadowWords { uint words[]; };
layout(push_constant) uniform Push {
    mat4 to_plane;      // position -> (pixel x * w, pixel y * w, z, w), pixels from the plane's middle
    vec4 light;         // xyz: unit direction to a distant light (w = 0) or position of a local one (w = 1)
    vec4 cone;          // xyz: axis of a local light, unit; w: cosine of the cone's half angle, -2 for light in all directions
    ivec2 low;          // upper left pixel of the part of the plane that is sampled, from its middle
    uvec2 size;         // of that part, in pixels
    float range;        // how far the light of a local light reaches
    uint step_;         // light and probe, see RECEIVERS_LIGHT
    uint face;          // which of the six planes of a cube this is, as `face_of` numbers them, or SINGLE_PLANE
} push;
// Places of probes in their pixels. Growth finds those parts of a shadow that lie within two pixels of a probe or centre in the
// shadow. Of a shadow that is a line a fifth of a pixel wide, it misses 1 % on average over all directions of the line, and 14 %
// in the worst direction. With centres alone it would miss 22 % and 78 %.
const vec2 PROBES[3] = vec2[](vec2(0.34375, 0.34375), vec2(-0.296875, 0.40625), vec2(0.46875, -0.296875));
#include "include/light_plane.glsl"

void main() {
    uint i = invocation_number();
    uint count = PIXELS ? frame.size.x * frame.size.y : min(counters[COUNTER_RECORDS], frame.record_capacity);
    uint source = min(i, max(count, 1u) - 1u), id;
    uint probe = push.step_ >> RECEIVERS_PROBE_SHIFT;
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

    bool backlit = DIFFUSE_TRANSMISSION && diffuse_transmission_of(material_of(k.word)).factor > 0.0;
    if (LOOKED_UP) {
        locations_out[2u * i] = uvec4(floatBitsToUint(position), receives ? id : 0u);
        locations_out[2u * i + 1u] = uvec4(floatBitsToUint(normal), backlit ? 1u : 0u);
        return;
    }
    Projected r = project(position, normal, backlit, push.low, ivec2(push.size));
    bool turned = receives && r.turned, asked = receives && r.asked;
    if (i < count && probe == 0u) {
        uint place = (PIXELS ? i : place_of_record(i)) * SHADOW_WORDS, light = push.step_ & RECEIVERS_LIGHT;
        uint word = (push.step_ & RECEIVERS_BEGINS) != 0u ? 0u : words[place];
        words[place] = word | (turned ? 1u << light : 0u);
        if (SHADOW_WORDS > 1u && turned) words[place + 1u + light] = 0u;
    }
    locations_out[2u * i] = uvec4(asked ? ivec2(r.pixel) : ivec2(-1), floatBitsToUint(r.within));
    locations_out[2u * i + 1u] = uvec4(floatBitsToUint(r.least), id, 0u, 0u);
}
