// Triangle setup for exact sampling: from clip-space vertices to edge functions around a point.
//
// An edge function E(x, y) = A x + B y + C is positive inside. Its coefficients depend only on the edge's two
// end points, and only change their signs when these are swapped. So two triangles that share an edge agree
// on every sample. `precise` keeps the compiler from contracting a product on one side only. A sample with
// E = 0 belongs to the triangle with A > 0, or with A = 0 and B > 0.
// Coefficients are relative to `center`, so that they are small and rounded little.
#ifndef SETUP_GLSL
#define SETUP_GLSL
#include "finite.glsl"

struct Edge { float a, b, c; };

// A vertex that is farther than this from `center`, in pixels, is not divided by w: its edges are computed in homogeneous form.
const float PROJECT_LIMIT = 16384.0;

bool projectable(vec4 v) {
    return v.w > 0.0 && max(abs(v.x), abs(v.y)) < PROJECT_LIMIT * v.w;
}

Edge edge_projected(vec2 p, vec2 q) {
    precise float a = p.y - q.y;
    precise float b = q.x - p.x;
    precise float l = p.x * q.y;
    precise float r = p.y * q.x;
    precise float c = l - r;
    return Edge(a, b, c);
}

// Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates" (1997): needs no clipping.
Edge edge_homogeneous(vec3 p, vec3 q) {
    precise float al = p.y * q.z; precise float ar = p.z * q.y; precise float a = al - ar;
    precise float bl = p.z * q.x; precise float br = p.x * q.z; precise float b = bl - br;
    precise float cl = p.x * q.y; precise float cr = p.y * q.x; precise float c = cl - cr;
    return Edge(a, b, c);
}

struct Setup {
    vec3 a, b, c;       // edge functions opposite to vertices 0, 1, 2; inside positive
    vec3 depth;         // depth = x * depth.x + y * depth.y + depth.z, larger is nearer
    float near, far;    // largest and smallest depth at the vertices
    bool valid;         // has area and, if culled, faces the camera
    bool facing;
};

// A vertex relative to `center`: this is subtracted from the vertex's pixel position.
vec4 relative_to(vec4 v, vec2 center) {
    precise float x = v.x - center.x * v.w;
    precise float y = v.y - center.y * v.w;
    return vec4(x, y, v.zw);
}

Setup setup_triangle(vec4 c0, vec4 c1, vec4 c2, vec2 center, bool cull) {
    Setup s;
    vec4 v0 = relative_to(c0, center), v1 = relative_to(c1, center), v2 = relative_to(c2, center);
    bool p0 = projectable(v0), p1 = projectable(v1), p2 = projectable(v2);
    vec2 q0 = v0.xy / v0.w, q1 = v1.xy / v1.w, q2 = v2.xy / v2.w;
    Edge e0 = edge_projected(q1, q2), e1 = edge_projected(q2, q0), e2 = edge_projected(q0, q1);
    bool all_projected = p0 && p1 && p2;
    if (!all_projected) {
        Edge h0 = edge_homogeneous(v1.xyw, v2.xyw), h1 = edge_homogeneous(v2.xyw, v0.xyw), h2 = edge_homogeneous(v0.xyw, v1.xyw);
        if (!(p1 && p2)) e0 = h0;
        if (!(p2 && p0)) e1 = h1;
        if (!(p0 && p1)) e2 = h2;
        float det = dot(vec3(h0.c, h1.c, h2.c), vec3(v0.w, v1.w, v2.w));
        // The determinant is 0 if the triangle is seen edge-on. It scales with w^3, so no tolerance would suit all triangles.
        s.facing = det < 0.0;
        s.valid = det != 0.0 && is_finite(det);
        float inverse = 1.0 / det;
        precise vec3 depth = (vec3(h0.a, h0.b, h0.c) * v0.z + vec3(h1.a, h1.b, h1.c) * v1.z + vec3(h2.a, h2.b, h2.c) * v2.z) * inverse;
        s.depth = depth;
        s.near = 3.4e38;
        s.far = -3.4e38;
    } else {
        precise vec2 d1 = q1 - q0, d2 = q2 - q0;
        precise float l = d1.x * d2.y, r = d1.y * d2.x;
        precise float area = l - r;
        s.facing = area < 0.0;
        s.valid = area != 0.0;
        float z0 = v0.z / v0.w, z1 = v1.z / v1.w, z2 = v2.z / v2.w;
        // Differences from one vertex keep the depth of tiny triangles accurate. The depth of slivers is bounded later, by a
        // clamp to the vertices' range.
        float inverse = 1.0 / area;
        precise float gx = ((z1 - z0) * d2.y - (z2 - z0) * d1.y) * inverse;
        precise float gy = ((z2 - z0) * d1.x - (z1 - z0) * d2.x) * inverse;
        precise float at_center = z0 - gx * q0.x - gy * q0.y;
        s.depth = vec3(gx, gy, at_center);
        s.near = max(z0, max(z1, z2));
        s.far = min(z0, min(z1, z2));
    }
    // y points down, so a front face, counter-clockwise to the eye, has a negative determinant.
    float sign_ = s.facing ? -1.0 : 1.0;
    s.a = vec3(e0.a, e1.a, e2.a) * sign_;
    s.b = vec3(e0.b, e1.b, e2.b) * sign_;
    s.c = vec3(e0.c, e1.c, e2.c) * sign_;
    s.valid = s.valid && (s.facing || !cull);
    return s;
}

// Whether a triangle is surely back-facing. Positions relative to a region's `center` are rounded more than those relative
// to a tile's. Slivers that rounding could turn over are not culled here, but by their setup.
bool surely_backfacing(vec4 c0, vec4 c1, vec4 c2, vec2 center) {
    vec4 v0 = relative_to(c0, center), v1 = relative_to(c1, center), v2 = relative_to(c2, center);
    vec2 d1 = v1.xy / v1.w - v0.xy / v0.w, d2 = v2.xy / v2.w - v0.xy / v0.w;
    float l = d1.x * d2.y, r = d1.y * d2.x;
    float slack = 1e-3 * (abs(d1.x) + abs(d1.y) + abs(d2.x) + abs(d2.y)) + 1e-4 * (abs(l) + abs(r));
    return projectable(v0) && projectable(v1) && projectable(v2) && l - r > slack;
}

#endif
