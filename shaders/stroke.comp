// stroke: the corners of points and lines, which are as large on the screen as asked for, wherever the camera is.
// Reads: strokes, positions. Writes: positions, normals. Twin: src/reference/stroke.rs.
//
// A corner lies beside its point, or beside the end of its segment, in the plane through it that is parallel to the
// image's. Segments that go on are mitred; where a mitre would be too long, the joint is filled by a triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 50, rgba32f) uniform writeonly imageBuffer positions_out;
layout(set = 0, binding = 51, rgba32f) uniform writeonly imageBuffer normals_out;
// Of each corner two vectors: the vertex to place, and those of the end that it belongs to, of the segment's other end and
// of where the line goes on, or the first of these again; what it is, and a disc's corner from its centre, floats as bits.
layout(set = 0, binding = 55) uniform utextureBuffer strokes;

layout(push_constant) uniform Push {
    vec4 right;     // xyz: one pixel to the right in the image, at w = 1; w: half the width of lines in pixels
    vec4 down;      // xyz: one pixel down; w: half the size of points in pixels
    uint count;     // corners
} part;
const uint LEFT = 0u, RIGHT = 1u, JOINT_CENTRE = 2u, JOINT_FIRST = 3u, JOINT_SECOND = 4u, DISC = 5u;
const uint FACES_CAMERA = 1u << 31;

const float LONGEST_MITRE = 4.0;    // in widths of the line

bool is_behind(vec4 clip) {
    return clip.z > clip.w;
}

// How far it is from what is before the near plane to the plane, of the way to what is behind it.
float to_near_plane(vec4 front, vec4 behind) {
    float at = front.w - front.z;
    return at / (at - (behind.w - behind.z));
}

// What is seen of the way from `from`, which is before the near plane, in pixels: its direction to `from`, its length.
vec3 way_from(vec4 from, vec4 to) {
    to = is_behind(to) ? mix(from, to, to_near_plane(from, to)) : to;
    vec2 d = from.xy * to.w - to.xy * from.w;
    float l = sqrt(dot(d, d));
    return l > 0.0 ? vec3(d / l, l / (from.w * to.w)) : vec3(0.0);
}

// Left of a direction on the screen, whose y is down.
vec2 left_of(vec2 d) {
    return vec2(d.y, -d.x);
}

// The corner from the end `at` of a segment, in halves of the line's width.
vec2 corner(uint kind, vec4 at, vec4 other, vec4 beyond, bool goes_on, float half_width) {
    vec3 own = way_from(at, other), next = way_from(at, beyond);
    vec2 e = own.xy, f = -next.xy, s = e + f;
    bool has_joint = goes_on && own.z > 0.0 && next.z > 0.0;
    float l = dot(s, s), turn = e.x * f.y - e.y * f.x;
    bool mitred = has_joint && l * LONGEST_MITRE * LONGEST_MITRE >= 4.0 && half_width * abs(turn) <= 0.5 * l * min(own.z, next.z);
    if (kind <= RIGHT) {
        vec2 left = mitred ? left_of(s) * (2.0 / l) : left_of(e);
        return kind == LEFT ? left : -left;
    }
    // The outer corners of both segments, counter-clockwise.
    vec2 side = (kind == JOINT_FIRST) != (turn > 0.0) ? left_of(e) : left_of(f);
    return has_joint && !mitred && kind != JOINT_CENTRE ? (turn > 0.0 ? side : -side) : vec2(0.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    if (i >= part.count) return;
    uvec4 ends = texelFetch(strokes, int(2u * i)), shape = texelFetch(strokes, int(2u * i + 1u));
    vec4 p = texelFetch(positions, int(ends.y)), q = texelFetch(positions, int(ends.z));
    vec4 at = to_clip(frame.transform, p), other = to_clip(frame.transform, q);
    vec4 beyond = to_clip(frame.transform, texelFetch(positions, int(ends.w)));
    uint kind = shape.x & ~FACES_CAMERA;
    bool is_line = kind != DISC, goes_on = ends.w != ends.y;
    bool seen = !is_behind(at);
    if (is_line && kind <= RIGHT && !seen && !is_behind(other)) {
        // The segment begins at the near plane.
        float t = to_near_plane(other, at);
        p = mix(q, p, t);
        at = mix(other, at, t);
        goes_on = false;
        seen = true;
    }
    vec2 offset = is_line ? corner(kind, at, other, beyond, goes_on, part.right.w) * part.right.w : uintBitsToFloat(shape.yz) * part.down.w;
    // What is not seen has no area.
    offset = seen ? offset * at.w : vec2(0.0);
    imageStore(positions_out, int(ends.x), vec4(p.xyz + offset.x * part.right.xyz + offset.y * part.down.xyz, 1.0));
    if ((shape.x & FACES_CAMERA) != 0u) imageStore(normals_out, int(ends.x), vec4(-frame.view_direction.xyz, 0.0));
}
