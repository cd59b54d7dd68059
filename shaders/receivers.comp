// receivers: finds the surfaces that are about to be shaded, for `occlude` to project them on the planes of all lights. An
// invocation takes one of PIXELS (what the centre of a pixel sees) or a visibility sample of a round, BLEND layers included. It
// stores (position, triangle ID or 0 if there is none to ask for), (normal, 1 if DIFFUSE_TRANSMISSION lets light from behind
// through).
// Pixels may have further points, where the pixel's triangle covers these, too. `occlude` compares them with the pixel's centre.
// Reads: ids or fragments, the geometry. Writes: a surface for each point, those of all centres first.
// Twin: twins/src/shadow.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/barycentric.glsl"
#include "include/material.glsl"
#include "include/fragment_position.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = RECEIVERS_CONSTANT_PIXELS) const bool PIXELS = false;
layout(constant_id = RECEIVERS_CONSTANT_DIFFUSE_TRANSMISSION) const bool DIFFUSE_TRANSMISSION = false;   // some material has it
layout(std430, set = SET_BESIDE_FRAME, binding = RECEIVERS_BINDING_LOCATIONS_OUT) writeonly buffer LocationsOut { uvec4 locations_out[]; };
layout(push_constant) uniform Push {
    uint points;        // number of points of a pixel, from 1 to SHADOW_POINTS
} push;
// Points of a pixel. Growth finds those parts of a shadow that lie within two pixels of a point in the shadow. Of a shadow that is
// a line a fifth of a pixel wide, it misses 1 % on average over all directions of the line, and 14 % in the worst direction. With
// centres alone it would miss 22 % and 78 %.
const vec2 POINTS_OF_PIXEL[SHADOW_POINTS] = vec2[](vec2(0.0), vec2(0.34375, 0.34375), vec2(-0.296875, 0.40625), vec2(0.46875, -0.296875));

void main() {
    uint i = invocation_number();
    uint count = PIXELS ? frame.size.x * frame.size.y : min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity);
    uint source = min(i, max(count, 1u) - 1u), id;
    vec2 at;
    if (PIXELS) {
        uvec2 pixel = split(source, frame.size.x);
        id = id_at(ivec2(pixel));
        at = frame.origin + vec2(pixel);
    } else {
        uvec4 fragment = texelFetch(fragments, int(source));
        id = fragment.y;
        at = fragment_position(fragment);
    }
    bool receives = i < count && id != 0u;

    Triangle k = triangle_at(max(id, 1u) - 1u);
    vec3 a = position_of(k, vec3(1.0, 0.0, 0.0)), b = position_of(k, vec3(0.0, 1.0, 0.0)), c = position_of(k, vec3(0.0, 0.0, 1.0));
    vec3 normal = cross(b - a, c - a);
    vec3 to_eye = frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : frame.eye.xyz - a;
    normal = dot(normal, to_eye) < 0.0 ? -normal : normal;

    bool backlit = DIFFUSE_TRANSMISSION && diffuse_transmission_of(material_of(k.word)).factor > 0.0;

    uint point = 0u;
    do {
        vec3 weights = barycentric(k.v0, k.v1, k.v2, at + (PIXELS ? POINTS_OF_PIXEL[point] : vec2(0.0))).at;
        bool covered = point == 0u || min(weights.x, min(weights.y, weights.z)) >= 0.0;
        uint surface = 2u * (point * count + i);
        if (!PIXELS || i < count) {
            locations_out[surface] = uvec4(floatBitsToUint(position_of(k, weights)), receives && covered ? id : 0u);
            locations_out[surface + 1u] = uvec4(floatBitsToUint(normal), backlit ? 1u : 0u);
        }
    } while (PIXELS && ++point < push.points);
}
