// thin: marks pixels that a thin triangle crosses without covering their centres, such as a rope or wire narrower than a pixel,
// or the tip of a leaf. `detect` makes superpixels of them.
// The pass runs in two steps. SELECT lists thin triangles; an invocation takes THIN_PER_INVOCATION triangles. Then each listed
// triangle is followed along its longer side, pixel by pixel, by an invocation or, if it is long, by a workgroup.
// Reads: the geometry, raster's depth, ids, blend_ids. Writes: marks, survivors (here a list of thin ones: short ones from the
// front, long ones from the back).
//
// For a triangle that is wider than high, the part in a column of pixels is considered; otherwise, the part in a row. A pixel
// that it crosses is marked if the whole part is nearer than the surface at the pixel's centre by more than a pixel's width.
// On a dense mesh, small triangles lie within the surface of their neighbours, and mark nothing.
// If a triangle lies close to a surface, like paint on a road, depths do not tell which is nearer. Pixels where some of it may be
// nearer get marks of another kind, and become superpixels only if `detect` finds them amid another triangle.
// FOLDS: such a pixel is also marked if the triangle and the one at the pixel's centre are a fold, like the tread and the riser
// of a small step. Light differs on the two. Twin: twins/src/thin.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/fold.glsl"
#include "include/survivors.glsl"
#include "include/thin.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = THIN_CONSTANT_SELECT) const bool SELECT = false;
layout(constant_id = THIN_CONSTANT_BLEND_IDS) const bool BLEND_IDS = false;
layout(constant_id = THIN_CONSTANT_FOLDS) const bool FOLDS = false;

layout(set = SET_DATA, binding = BINDING_RASTER_DEPTH) uniform texture2D raster_depth;

const float LONG = 64.0;            // in pixels: longer triangles are followed by a workgroup, not an invocation
layout(push_constant) uniform Push {
    uint long_;             // 1: follows the long triangles, not the short ones
    float depth_factor;     // raster's depth * depth_factor + depth_constant = depth of triangles
    float depth_constant;
} push;

void select_thin() {
    uint first = workgroup_number() * 64u * THIN_PER_INVOCATION + gl_LocalInvocationID.x, step_ = 0u;
    uint short_ = 0u, long_ = 0u;       // a bit for each step
    do {
        uint t = first + step_ * 64u;
        bool exists = t < frame.triangle_count;
        Triangle k = triangle_at(min(t, frame.triangle_count - 1u));
        Footprint f = footprint_of(k.v0, k.v1, k.v2);
        vec2 q0 = k.v0.xy / k.v0.w, q1 = k.v1.xy / k.v1.w, q2 = k.v2.xy / k.v2.w;
        float height = height_of(q0, q1, q2);
        bool hidden = single_sided(k.word) && surely_backfacing(k.v0, k.v1, k.v2, frame.origin);
        bool thin = exists && !f.outside && !f.unprojected && height < THIN && height > 0.0 && !hidden;
        vec2 extent = max(q0, max(q1, q2)) - min(q0, min(q1, q2));
        bool is_long = max(extent.x, extent.y) > LONG;
        short_ |= thin && !is_long ? 1u << step_ : 0u;
        long_ |= thin && is_long ? 1u << step_ : 0u;
    } while (++step_ < THIN_PER_INVOCATION);
    list_survivors(first, uvec2(short_, long_), uvec2(COUNTER_THIN, COUNTER_THIN_LONG));
}

// Marks a pixel if triangle `t` is not seen there and passes the tests above. `depths`: the triangle's farthest and nearest depth
// there; `normal`: its normal.
void mark(ivec2 pixel, uint t, vec2 depths, vec3 normal) {
    float drawn = texelFetch(raster_depth, ivec2(frame.seen_corner) + pixel, 0).x;
    float seen = push.depth_factor * drawn + push.depth_constant;
    bool unseen = !BLEND_IDS || t < frame.first_blend || texelFetch(blend_ids, pixel, 0).x != t + 1u;
    bool apart = depths.x - seen > frame.gap.x * depths.x + frame.gap.y;
    bool painted = depths.y >= seen && id_at(pixel) != t + 1u;
    if (FOLDS) apart = apart || (painted && is_fold(normal, id_at(pixel)));
    if (unseen && depths.y <= 1.0 && (apart || painted)) {
        uvec2 tile = uvec2(pixel) / uvec2(8u, 4u), within = uvec2(pixel) % uvec2(8u, 4u);
        uint word = (apart ? 0u : frame.tiles.x * frame.tiles.y) + tile.y * frame.tiles.x + tile.x;
        atomicOr(marks[word], 1u << (within.y * 8u + within.x));
    }
}

vec3 projected(vec4 vertex) {
    vec4 v = relative_to(vertex, frame.origin);
    return v.xyz / v.w;
}

void walk() {
    bool long_ = push.long_ != 0u;
    uint i = long_ ? workgroup_number() : invocation_number();
    if (i >= min(counters[long_ ? COUNTER_THIN_LONG : COUNTER_THIN], frame.survivor_capacity)) return;
    uint t = survivors[long_ ? frame.survivor_capacity - 1u - i : i];
    Triangle k = triangle_at(t);
    vec3 normal = FOLDS ? facing_normal(k) : vec3(0.0);
    vec3 p0 = projected(k.v0), p1 = projected(k.v1), p2 = projected(k.v2);

    // The triangle is followed along its longer side. If that is along y, x and y are exchanged.
    vec2 extent = max(p0, max(p1, p2)).xy - min(p0, min(p1, p2)).xy;
    bool swap = extent.y > extent.x;
    if (swap) { p0 = p0.yxz; p1 = p1.yxz; p2 = p2.yxz; }
    ivec2 last = swap ? ivec2(frame.size.yx) - 1 : ivec2(frame.size) - 1;
    int x = int(clamp(floor(min(p0.x, min(p1.x, p2.x)) + 0.5), 0.0, float(last.x)));
    x += long_ ? int(gl_LocalInvocationID.x) : 0;
    int step_ = long_ ? 64 : 1;
    int end = int(clamp(floor(max(p0.x, max(p1.x, p2.x)) + 0.5), 0.0, float(last.x)));
    do {
        float left = float(x) - 0.5, right = float(x) + 0.5;
        vec4 span = both_of(both_of(span_of(p0, p1, left, right), span_of(p1, p2, left, right)), span_of(p2, p0, left, right));
        int y = int(clamp(floor(span.x + 0.5), 0.0, float(last.y) + 1.0));
        int bottom = int(clamp(floor(span.y + 0.5), -1.0, float(last.y)));
        do {
            if (y <= bottom && x <= end) mark(swap ? ivec2(y, x) : ivec2(x, y), t, span.zw, normal);
        } while (++y <= bottom);
        x += step_;
    } while (x <= end);
}

void main() {
    if (SELECT) select_thin();
    else walk();
}
