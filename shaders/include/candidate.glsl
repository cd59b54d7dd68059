// A candidate of a tile: a triangle that may cover samples there, as edge functions E = a x + b y + c and a depth plane
// relative to the tile's centre.
#ifndef CANDIDATE_GLSL
#define CANDIDATE_GLSL
#include "team.glsl"
#include "tiles.glsl"
#include "triangle.glsl"

const float OUTSIDE = 1.1754944e-38;                    // the least E inside of an edge whose points the triangle does not own

struct Candidate {
    vec3 a, b, c, depth;
    float near, far;        // bounds of its depth, larger is nearer
    uint id;
    uint pixels;            // pixels of the tile that it may touch, a bit each
};

// Where the first vector of candidate `index` of a list begins, and where its last vector lies. Lists that are SCANNED for the last
// vectors have all of these before the others.
int candidate_at(uint first, uint index, uint count, bool scanned) {
    return scanned ? int(4u * first + count + 3u * index) : int(first + index) * 4;
}

int last_of_candidate(uint first, uint index, bool scanned) {
    return scanned ? int(4u * first + index) : int(first + index) * 4 + 3;
}

Candidate unpack_candidate(int at, uvec4 last) {
    Candidate k;
    vec4 q0 = uintBitsToFloat(texelFetch(candidates, at)), q1 = uintBitsToFloat(texelFetch(candidates, at + 1));
    vec4 q2 = uintBitsToFloat(texelFetch(candidates, at + 2)), q3 = uintBitsToFloat(last);
    k.a = vec3(q0.x, q0.w, q1.z); k.b = vec3(q0.y, q1.x, q1.w); k.c = vec3(q0.z, q1.y, q2.x);
    k.depth = q2.yzw; k.near = q3.x; k.far = q3.y; k.id = last.z; k.pixels = last.w;
    return k;
}

Candidate load_candidate(uint first, uint index, vec2 center) {
    uvec4 last = texelFetch(candidates, last_of_candidate(first, index, false));
    return unpack_candidate(candidate_at(first, index, 0u, false), last);
}

Candidate shuffle_candidate(Candidate k, uint lane) {
    Candidate r;
    r.a = of_member(k.a, lane);
    r.b = of_member(k.b, lane);
    r.c = of_member(k.c, lane);
    r.depth = of_member(k.depth, lane);
    r.near = of_member(k.near, lane);
    r.far = of_member(k.far, lane);
    r.id = of_member(k.id, lane);
    r.pixels = of_member(k.pixels, lane);
    return r;
}

// The least value of each edge function at which a sample is inside. Of the two triangles at an edge, one owns the points where
// E = 0.
vec3 thresholds(Candidate k) {
    return vec3(
        k.a.x > 0.0 || (k.a.x == 0.0 && k.b.x > 0.0) ? 0.0 : OUTSIDE,
        k.a.y > 0.0 || (k.a.y == 0.0 && k.b.y > 0.0) ? 0.0 : OUTSIDE,
        k.a.z > 0.0 || (k.a.z == 0.0 && k.b.z > 0.0) ? 0.0 : OUTSIDE);
}

// A sum that the driver can't reassociate: REASSOCIATED of workarounds.glsl.
vec3 sum_of(vec3 x, vec3 y) {
    precise vec3 sum = x + y;
    return uintBitsToFloat(floatBitsToUint(sum) ^ uvec3(gl_NumSubgroups >> 20));
}

float sum_of(float x, float y) {
    precise float sum = x + y;
    return uintBitsToFloat(floatBitsToUint(sum) ^ gl_NumSubgroups >> 20);
}

bool inside(Candidate k, vec3 least, vec2 p) {
    precise vec3 x = k.a * p.x, y = k.b * p.y;
    precise vec3 e = sum_of(x, y) + k.c;
    return e.x >= least.x && e.y >= least.y && e.z >= least.z;
}

float depth_at(Candidate k, vec2 p) {
    precise float x = k.depth.x * p.x, y = k.depth.y * p.y;
    precise float d = sum_of(x, y) + k.depth.z;
    return clamp(d, k.far, k.near);
}

bool covers(Candidate k, vec3 least, vec2 p, out float depth) {
    depth = depth_at(k, p);
    return inside(k, least, p) && depth <= 1.0;
}

// The result of testing a candidate against a rectangle.
struct RectangleTest {
    bool touches;
    float near;     // the candidate's nearest depth in the rectangle
    float hides;    // its farthest depth there if it is opaque and covers the whole rectangle, otherwise 0
};

RectangleTest test_rectangle(Candidate k, vec2 middle, vec2 half_side, bool has_mask) {
    vec3 e = k.a * middle.x + k.b * middle.y + k.c;
    vec3 reach = half_side.x * abs(k.a) + half_side.y * abs(k.b);
    float depth = k.depth.x * middle.x + k.depth.y * middle.y + k.depth.z;
    float slope = dot(half_side, abs(k.depth.xy)) + abs(depth) * 1e-6;
    RectangleTest r;
    r.touches = min(e.x + reach.x, min(e.y + reach.y, e.z + reach.z)) >= 0.0;
    r.near = min(depth + slope, k.near);
    bool spans = k.id <= (has_mask ? frame.first_mask : frame.first_blend) && k.near <= 1.0
        && min(e.x - reach.x, min(e.y - reach.y, e.z - reach.z)) > 0.0;
    r.hides = spans ? max(depth - slope, k.far) : 0.0;
    return r;
}

#endif
