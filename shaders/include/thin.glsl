// Which triangles are thin, and which part of a column of pixels or cells a triangle crosses. Points are (x, y, depth); for
// `crossings` the third number is nearness.
#ifndef THIN_GLSL
#define THIN_GLSL

// Triangles are thin if their height over the longest side is less than this, in pixels or cells. Wider ones are seen by some
// centre.
const float THIN = 1.5;

float crossed(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// The height of a triangle over its longest side.
float height_of(vec2 a, vec2 b, vec2 c) {
    vec2 ab = b - a, bc = c - b, ca = a - c;
    float longest = sqrt(max(dot(ab, ab), max(dot(bc, bc), dot(ca, ca))));
    return abs(crossed(ab, ca)) / max(longest, 1e-20);
}

// The same for a convex quadrilateral: twice its area over the distance of its farthest corners. If two corners coincide, this is
// the height of a triangle.
float height_of(vec2 a, vec2 b, vec2 c, vec2 d) {
    vec2 ab = b - a, bc = c - b, cd = d - c, da = a - d, ac = c - a, bd = d - b;
    float sides = max(max(dot(ab, ab), dot(bc, bc)), max(dot(cd, cd), dot(da, da)));
    float longest = sqrt(max(sides, max(dot(ac, ac), dot(bd, bd))));
    return abs(crossed(ac, bd)) / max(longest, 1e-20);
}

// The part of the edge from p to q between the verticals `left` and `right`: y from .x to .y, depth from .z to .w. The range is
// empty (.x > .y) if the edge lies outside.
vec4 span_of(vec3 p, vec3 q, float left, float right) {
    vec3 l = p.x < q.x ? p : q, r = p.x < q.x ? q : p;
    float from = max(left, l.x), to = min(right, r.x), length_ = max(r.x - l.x, 1e-20);
    vec2 a = mix(l.yz, r.yz, clamp((from - l.x) / length_, 0.0, 1.0)), b = mix(l.yz, r.yz, clamp((to - l.x) / length_, 0.0, 1.0));
    vec2 low = min(a, b), high = max(a, b);
    return from <= to ? vec4(low.x, high.x, low.y, high.y) : vec2(3.4e38, -3.4e38).xyxy;
}

// The union of two such ranges.
vec4 both_of(vec4 a, vec4 b) {
    vec4 low = min(a, b), high = max(a, b);
    return vec4(low.x, high.y, low.z, high.w);
}

#endif
