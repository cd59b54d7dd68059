// points: for locations that are sampled once, computes from their visibility samples what they see: a colour and, if asked for,
// ATTRIBUTES. An invocation takes a fragment, and does nothing unless this stands for all that a location sees.
// Reads: fragments, shaded, the geometry, shadow words. Writes: color, and two vectors a location, floats as bits:
// (distance along the view direction, ID, ID of the nearest BLEND layer, code of the displayed colour), (world normal, a bit for
// each light whose shadow is on the opaque or MASK triangle).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/tiles.glsl"
#include "include/color.glsl"
#include "include/barycentric.glsl"
#include "include/composite.glsl"
#include "include/shadows.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = POINTS_CONSTANT_ATTRIBUTES) const bool ATTRIBUTES = false;
layout(std430, set = SET_DATA, binding = BINDING_ATTRIBUTES_OUT) writeonly buffer AttributesOut { uvec4 attributes_out[]; };

void main() {
    uint i = invocation_number();
    if (i >= min(counters[COUNTER_FRAGMENTS], frame.fragment_capacity)) return;
    uvec4 fragment = texelFetch(fragments, int(i));
    if ((fragment.x & POINT_VALUE) == 0u) return;
    uint location = fragment.x & POINT_LOCATION;
    // A leaf is no surface, but links to the nearest one.
    uint nearest = fragment.y != 0u ? i : farther(i);
    bool hits = nearest != ~0u;
    nearest = hits ? nearest : i;
    vec4 c = hits ? composite(nearest) : frame.background;
    uvec4 at = texelFetch(locations, int(2u * location));
    color[location] = c;
    if (!ATTRIBUTES) return;

    uint seen = texelFetch(fragments, int(nearest)).y, blend_id = seen > frame.first_blend ? seen : 0u;
    uint last = nearest, next = farther(last);
    while (next != ~0u) {
        last = next;
        next = farther(last);
    }
    uint id = texelFetch(fragments, int(last)).y;
    id = id > frame.first_blend ? 0u : id;
    vec2 p = tile_center(ivec2(at.xy) >> ivec2(3, 2)) + place_in_tile(at);
    Triangle k = triangle_at(max(id, 1u) - 1u);
    Barycentric w = barycentric(k.v0, k.v1, k.v2, p);
    float distance_ = dot(position_of(k, w.at) - frame.eye.xyz, frame.view_direction.xyz);
    vec3 n = normal_of(k, w.at);
    n *= inversesqrt(max(dot(n, n), 1e-30));
    bool hit = id != 0u;
    attributes_out[2u * location] = uvec4(floatBitsToUint(hit ? distance_ : 0.0), id, blend_id, display_code(c));
    attributes_out[2u * location + 1u] = uvec4(floatBitsToUint(hit ? n : vec3(0.0)), hit ? shadows_at(place_of_fragment(last)) : 0u);
}
