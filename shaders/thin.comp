// thin: pixels that a thin triangle crosses unseen become superpixels, although no pixel centre saw it: a rope or wire
// narrower than a pixel, the tip of a leaf. Runs twice: SELECT lists thin triangles, then each is walked along its
// longer side, pixel by pixel.
// Reads: the geometry, raster's depth, ids, blend_ids. Writes: marks, survivors (a scratch list here).
//
// A pixel is marked where the triangle, all of it that lies there, is nearer than the surface at the pixel's centre by
// more than a pixel's width. On a dense mesh each small triangle lies within its neighbours' surface, and marks nothing.
// Where a triangle lies close to a surface, like paint on a road, depth can't tell: pixels where it may be nearer are
// marked apart from the others, and become superpixels if `detect` finds them amid another triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool SELECT = false;
layout(constant_id = 1) const bool HAS_BLEND = false;

layout(set = 0, binding = 40) uniform texture2D raster_depth;

const float THIN = 1.5;             // height over the longest side, in pixels: a wider one is seen by some centre
const uint PER_INVOCATION = 8u;

float height_of(vec2 a, vec2 b, vec2 c) {
    vec2 ab = b - a, bc = c - b, ca = a - c;
    float longest = sqrt(max(dot(ab, ab), max(dot(bc, bc), dot(ca, ca))));
    return abs(ab.x * ca.y - ab.y * ca.x) / max(longest, 1e-20);
}

void select_thin() {
    uint first = gl_WorkGroupID.x * 64u * PER_INVOCATION + gl_LocalInvocationID.x, step_ = 0u;
    do {
        uint t = first + step_ * 64u;
        bool exists = t < frame.triangle_count;
        Triangle k = triangle_at(min(t, frame.triangle_count - 1u));
        Footprint f = footprint_of(k.v0, k.v1, k.v2);
        float height = height_of(k.v0.xy / k.v0.w, k.v1.xy / k.v1.w, k.v2.xy / k.v2.w);
        bool hidden = (k.word >> 31) == 0u && surely_backfacing(k.v0, k.v1, k.v2, frame.origin);
        bool thin = exists && !f.outside && !f.unprojected && height < THIN && height > 0.0 && !hidden;
        uvec4 together = subgroupBallot(thin);
        uint base = 0u;
        if (subgroupElect() && subgroupBallotBitCount(together) != 0u)
            base = atomicAdd(counters[COUNTER_THIN], subgroupBallotBitCount(together));
        base = subgroupBroadcastFirst(base);
        if (thin) survivors[base + subgroupBallotExclusiveBitCount(together)] = t;
    } while (++step_ < PER_INVOCATION);
}

// The y that the edge from p to q spans between two verticals.
vec2 span_of(vec2 p, vec2 q, float left, float right) {
    vec2 l = p.x < q.x ? p : q, r = p.x < q.x ? q : p;
    float from = max(left, l.x), to = min(right, r.x);
    float slope = (r.y - l.y) / max(r.x - l.x, 1e-20);
    float a = clamp(l.y + (from - l.x) * slope, min(l.y, r.y), max(l.y, r.y));
    float b = clamp(l.y + (to - l.x) * slope, min(l.y, r.y), max(l.y, r.y));
    return from <= to ? vec2(min(a, b), max(a, b)) : vec2(3.4e38, -3.4e38);
}

void mark(ivec2 pixel, uint t, vec3 plane, float near, float far) {
    float middle = dot(plane, vec3(pixel, 1.0)), slope = 0.5 * (abs(plane.x) + abs(plane.y));
    float farthest = clamp(middle - slope, far, near), nearest = clamp(middle + slope, far, near);
    float seen = texelFetch(raster_depth, pixel, 0).x;
    bool unseen = !HAS_BLEND || t < frame.first_blend || texelFetch(blend_ids, pixel, 0).x != t + 1u;
    bool apart = farthest - seen > frame.gap.x * farthest + frame.gap.y;
    bool painted = nearest >= seen && texelFetch(ids, pixel, 0).x != t + 1u;
    if (unseen && nearest <= 1.0 && (apart || painted)) {
        uvec2 tile = uvec2(pixel) / uvec2(8u, 4u), within = uvec2(pixel) % uvec2(8u, 4u);
        uint word = (apart ? 0u : frame.tiles.x * frame.tiles.y) + tile.y * frame.tiles.x + tile.x;
        atomicOr(marks[word], 1u << (within.y * 8u + within.x));
    }
}

void walk() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    if (i >= counters[COUNTER_THIN]) return;
    uint t = survivors[i];
    Triangle k = triangle_at(t);
    vec4 v0 = relative_to(k.v0, frame.origin), v1 = relative_to(k.v1, frame.origin), v2 = relative_to(k.v2, frame.origin);
    vec2 p0 = v0.xy / v0.w, p1 = v1.xy / v1.w, p2 = v2.xy / v2.w;
    float z0 = v0.z / v0.w, z1 = v1.z / v1.w, z2 = v2.z / v2.w;
    vec2 d1 = p1 - p0, d2 = p2 - p0;
    float inverse = 1.0 / (d1.x * d2.y - d1.y * d2.x);
    vec2 g = vec2((z1 - z0) * d2.y - (z2 - z0) * d1.y, (z2 - z0) * d1.x - (z1 - z0) * d2.x) * inverse;
    vec3 plane = vec3(g, z0 - dot(g, p0));
    float near = max(z0, max(z1, z2)), far = min(z0, min(z1, z2));

    // Along the longer side; the coordinates are exchanged where that is y.
    vec2 extent = max(p0, max(p1, p2)) - min(p0, min(p1, p2));
    bool swap = extent.y > extent.x;
    if (swap) { p0 = p0.yx; p1 = p1.yx; p2 = p2.yx; }
    ivec2 last = swap ? ivec2(frame.size.yx) - 1 : ivec2(frame.size) - 1;
    int x = int(clamp(floor(min(p0.x, min(p1.x, p2.x)) + 0.5), 0.0, float(last.x)));
    int end = int(clamp(floor(max(p0.x, max(p1.x, p2.x)) + 0.5), 0.0, float(last.x)));
    do {
        float left = float(x) - 0.5, right = float(x) + 0.5;
        vec2 a = span_of(p0, p1, left, right), b = span_of(p1, p2, left, right), c = span_of(p2, p0, left, right);
        int y = int(clamp(floor(min(a.x, min(b.x, c.x)) + 0.5), 0.0, float(last.y) + 1.0));
        int bottom = int(clamp(floor(max(a.y, max(b.y, c.y)) + 0.5), -1.0, float(last.y)));
        do {
            if (y <= bottom && x <= end) mark(swap ? ivec2(y, x) : ivec2(x, y), t, plane, near, far);
        } while (++y <= bottom);
    } while (++x <= end);
}

void main() {
    if (SELECT) select_thin();
    else walk();
}
