// Perspective-correct barycentric coordinates at a pixel position, with their screen-space derivatives.
#ifndef BARYCENTRIC_GLSL
#define BARYCENTRIC_GLSL
#include "finite.glsl"

struct Barycentric {
    vec3 at;    // weights of the three vertices, sum 1
    vec3 dx;    // change by one pixel right
    vec3 dy;    // change by one pixel down
    bool facing; // a front face is seen
};

// Barycentric coordinates at pixel position `p` of a triangle with vertices (pixel x * w, pixel y * w, z, w). Vertices are
// first made relative to `p`, so that the value of an edge function at `p` is its constant term.
Barycentric barycentric(vec4 c0, vec4 c1, vec4 c2, vec2 p) {
    vec3 v0 = vec3(c0.xy - p * c0.w, c0.w);
    vec3 v1 = vec3(c1.xy - p * c1.w, c1.w);
    vec3 v2 = vec3(c2.xy - p * c2.w, c2.w);
    vec3 e0 = cross(v1, v2), e1 = cross(v2, v0), e2 = cross(v0, v1);
    vec3 a = vec3(e0.x, e1.x, e2.x), b = vec3(e0.y, e1.y, e2.y), c = vec3(e0.z, e1.z, e2.z);
    float sum = c.x + c.y + c.z;
    float inverse = 1.0 / sum;
    Barycentric r;
    r.facing = sum < 0.0;   // the sum is the triangle's determinant over w
    r.at = c * inverse;
    r.dx = (a - r.at * (a.x + a.y + a.z)) * inverse;
    r.dy = (b - r.at * (b.x + b.y + b.z)) * inverse;
    // A shading position can lie just outside of its triangle (a centroid over a sliver, a pixel centre under
    // MSAA). The clamp keeps attributes within the triangle's range.
    r.at = clamp(r.at, vec3(0.0), vec3(1.0));
    r.at /= r.at.x + r.at.y + r.at.z;
    bool broken = !is_finite(inverse) || is_nan(r.at.x + r.at.y + r.at.z);
    if (broken) {
        r.at = vec3(1.0, 0.0, 0.0);
        r.dx = vec3(0.0);
        r.dy = vec3(0.0);
    }
    return r;
}

#endif
