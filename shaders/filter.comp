// filter: lists the triangles of a run that may cover a pixel's centre, in their order, so that `raster` draws no others. In a
// dense mesh, most triangles face away or lie between centres, and CPU devices process triangles on one thread. A team takes
// FILTER_TRIANGLES neighbouring triangles, and makes one draw of them.
// Reads: the geometry. Writes: corners, indexed_draws.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/team.glsl"
#include "include/thin.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
layout(local_size_x_id = CONSTANT_LOCAL_SIZE) in;

struct IndexedDraw {
    uint index_count;
    uint instance_count;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
};

layout(std430, set = SET_DATA, binding = BINDING_CORNERS_OUT) writeonly buffer Corners { uint corners_out[]; };
layout(std430, set = SET_DATA, binding = BINDING_INDEXED_DRAWS_OUT) writeonly buffer IndexedDraws {
    IndexedDraw indexed_draws_out[];
};

layout(push_constant) uniform Push {
    uint first_triangle;
    uint triangle_count;
    uint first_draw;
    float snap;             // how far a device may move a corner, in pixels
} push;

// Whether `p` lies in a triangle, where rounding of its corners decides.
bool may_contain(vec2 a, vec2 b, vec2 c, vec2 p) {
    vec2 ab = b - a, bc = c - b, ca = a - c;
    vec3 side = vec3(crossed(ab, p - a), crossed(bc, p - b), crossed(ca, p - c));
    vec3 slack = push.snap * (vec3(abs(ab.x), abs(bc.x), abs(ca.x)) + vec3(abs(ab.y), abs(bc.y), abs(ca.y)) + push.snap);
    return all(greaterThanEqual(side, -slack)) || all(lessThanEqual(side, slack));
}

// Whether a triangle covers a pixel's centre, where rounding decides. For triangles that are wider or higher than two pixels,
// the answer is yes.
bool may_cover_centre(Triangle k) {
    vec4 v0 = relative_to(k.v0, frame.origin), v1 = relative_to(k.v1, frame.origin), v2 = relative_to(k.v2, frame.origin);
    vec2 a = v0.xy / v0.w, b = v1.xy / v1.w, c = v2.xy / v2.w;
    vec2 first = ceil(min(a, min(b, c)) - push.snap), last = floor(max(a, max(b, c)) + push.snap);
    if (any(greaterThan(last, first + 1.0))) return true;
    bool some = may_contain(a, b, c, first) || may_contain(a, b, c, vec2(last.x, first.y))
        || may_contain(a, b, c, vec2(first.x, last.y)) || may_contain(a, b, c, last);
    return some && all(lessThanEqual(first, last));
}

void main() {
    uint part = team_number(), begin = part * FILTER_TRIANGLES, end = min(begin + FILTER_TRIANGLES, push.triangle_count);
    if (begin >= end) return;
    uint i = begin + member(), listed = 0u, steps = (end - begin + TEAM - 1u) / TEAM;
    do {
        uint t = push.first_triangle + i;
        Triangle k = triangle_at(min(t, frame.triangle_count - 1u));
        Footprint f = footprint_of(k.v0, k.v1, k.v2);
        bool hidden = (k.word >> 31) == 0u && surely_backfacing(k.v0, k.v1, k.v2, frame.origin);
        bool lists = i < end && k.exists && !f.outside && !hidden && (f.unprojected || may_cover_centre(k));
        uint at = 3u * (push.first_triangle + begin + listed + team_before(uint(lists)));
        for (uint corner = 0u; corner < 3u && lists; corner++) corners_out[at + corner] = 3u * (i - begin) + corner;
        listed += team_add(uint(lists));
        i += TEAM;
    } while (--steps > 0u);
    if (member() == 0u) {
        uint first = 3u * (push.first_triangle + begin);
        indexed_draws_out[push.first_draw + part] = IndexedDraw(3u * listed, 1u, first, first, 0u);
    }
}
