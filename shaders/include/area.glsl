// The exact area of a triangle within a cell's square.
//
// A convex region's area is half the sum, over the lines that bound it, of the line's distance from the cell's centre
// (positive where the centre lies inside) times the length of the line's segment within all other half-planes. There
// are seven lines, three of the triangle and four of the square. Twin: src/reference/edge.rs.
#ifndef AREA_GLSL
#define AREA_GLSL

// Clips the line normal . p + distance_ = 0 to the half-plane n . p + d >= 0. `from` and `to` bound the part of the line that
// is left, as coordinates along it. A half-plane does not clip its `own` border.
void clip_line(vec2 normal, float distance_, vec2 n, float d, bool own, inout float from, inout float to, inout bool empty) {
    float along = n.y * normal.x - n.x * normal.y;      // the line runs along (-normal.y, normal.x)
    float before = distance_ * dot(n, normal) - d;
    float t = before / along;
    from = !own && along > 0.0 ? max(from, t) : from;
    to = !own && along < 0.0 ? min(to, t) : to;
    empty = empty || (!own && along == 0.0 && before > 0.0);
}

// The least area that replaces a count of samples, in samples. If a triangle has a smaller area, and other surfaces share the
// rest of the cell, the whole cell goes by samples: what samples miss of one piece of a thin object they gain at the next
// piece, and the exact areas of only some pieces would upset that balance.
const float FEWEST = 6.0;
const float AGREEMENT = 0.1;                            // the largest difference between areas and samples, in cells

// Areas are sums of integers, so that they do not depend on the order of vertices and triangles.
const float AREA_UNIT = 1048576.0;      // units of area in a cell

// What line number `line` of the seven adds to the area: those of the triangle, then those of the square. `a`, `b` and `c`
// are the triangle's edge functions around the cell's centre, positive inside and of unit length.
float part_of_line(int line, vec2 normal, float distance_, vec3 a, vec3 b, vec3 c) {
    float from = -2.0, to = 2.0;
    bool empty = line > 6;
    clip_line(normal, distance_, vec2(a.x, b.x), c.x, line == 0, from, to, empty);
    clip_line(normal, distance_, vec2(a.y, b.y), c.y, line == 1, from, to, empty);
    clip_line(normal, distance_, vec2(a.z, b.z), c.z, line == 2, from, to, empty);
    clip_line(normal, distance_, vec2(1.0, 0.0), 0.5, line == 3, from, to, empty);
    clip_line(normal, distance_, vec2(-1.0, 0.0), 0.5, line == 4, from, to, empty);
    clip_line(normal, distance_, vec2(0.0, 1.0), 0.5, line == 5, from, to, empty);
    clip_line(normal, distance_, vec2(0.0, -1.0), 0.5, line == 6, from, to, empty);
    return empty || !(from < to) ? 0.0 : 0.5 * distance_ * (to - from);
}

// What line number `line` adds to the area, in units of area.
int units_of_line(uint line, vec3 a, vec3 b, vec3 c) {
    uint side = line - 3u;
    vec2 side_normal = vec2(side == 0u ? 1.0 : side == 1u ? -1.0 : 0.0, side == 2u ? 1.0 : side == 3u ? -1.0 : 0.0);
    vec2 normal = line == 0u ? vec2(a.x, b.x) : line == 1u ? vec2(a.y, b.y) : line == 2u ? vec2(a.z, b.z) : side_normal;
    float distance_ = line == 0u ? c.x : line == 1u ? c.y : line == 2u ? c.z : 0.5;
    return int(round(part_of_line(int(line), normal, distance_, a, b, c) * AREA_UNIT));
}

// Scales edge functions to gradients of unit length.
void normalize_edges(inout vec3 a, inout vec3 b, inout vec3 c) {
    vec3 inverse = 1.0 / sqrt(max(a * a + b * b, vec3(1e-37)));
    a *= inverse;
    b *= inverse;
    c *= inverse;
}

// The area of one triangle, computed by the whole subgroup: each invocation takes one of the lines, or two.
int area_in_cell(vec3 a, vec3 b, vec3 c, uint lane) {
    normalize_edges(a, b, c);
    int units = units_of_line(lane, a, b, c);
    if (LANES < 8u) units += units_of_line(lane + LANES, a, b, c);
    return clamp(lanes_add(units), 0, int(AREA_UNIT));
}

// The area of a triangle of this invocation, in a cell of its own.
int area_in_own_cell(vec3 a, vec3 b, vec3 c) {
    normalize_edges(a, b, c);
    int area = 0;
    [[unroll]] for (uint line = 0u; line < 7u; line++) area += units_of_line(line, a, b, c);
    return clamp(area, 0, int(AREA_UNIT));
}

#endif
