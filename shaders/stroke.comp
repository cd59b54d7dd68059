// stroke: places the corners of points and lines, whose size on the screen does not depend on the camera. An invocation takes a
// corner of a point or line, or one of the four corners of a mesh's edge.
// Reads: strokes, positions. Writes: positions, normals. Twin: twins/src/stroke.rs.
//
// A corner lies beside its point, or beside the end of its segment, in the plane through this that is parallel to the
// image. Where one segment goes on in another, they are mitred. If the mitre would be too long, a triangle fills the joint.
//
// Edges of meshes are drawn as lines that extend half a width beyond the edge's ends, or an eighth for smooth edges, so that no
// notch is left where they meet. The surface beside an edge must not hide the line. So the line is moved along the lines of
// sight towards the camera: by as much as the faces at the edge rise towards the camera within the line, but at most by 8
// widths, and by `apart` more.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;

layout(set = SET_DATA, binding = BINDING_POSITIONS_OUT, rgba32f) uniform writeonly imageBuffer positions_out;
layout(set = SET_DATA, binding = BINDING_NORMALS_OUT, rgba32f) uniform writeonly imageBuffer normals_out;
// Two vectors for each corner of a point or line:
//   the vertex to place; vertices: the end that the corner belongs to, the segment's other end, the far end of the segment in
//     which the line goes on (or the first end again)
//   kind and flag; for a disc: x and y of the corner from the disc's centre, floats as bits; 0
// Then two vectors for each edge:
//   the first of the four vertices to place; vertices: the two ends; flags
//   third vertices of the two faces at the edge: of the one whose order of vertices leads from the first end to the second, and
//     of the other one (or an end if there is no such face); 0; 0
layout(set = SET_DATA, binding = BINDING_STROKES) uniform utextureBuffer strokes;

layout(push_constant) uniform Push {
    vec4 right;     // xyz: one pixel to the right in the image, at w = 1; w: half the width of lines in pixels
    vec4 down;      // xyz: one pixel down; w: half the size of points in pixels
    uint corners;       // number of corners of points and lines
    float half_edge;    // half the width of edges in pixels
    float apart;        // least distance by which edges are moved towards the camera, in pixels
    uint edges;
} part;
const uint KIND = 255u;   // bits of a corner's kind

const float LONGEST_MITRE = 4.0;    // in widths of the line
const float CREASE_END = 1.0, SMOOTH_END = 0.25, MOST_RISE = 16.0; // in halves of the width

bool is_behind(vec4 clip) {
    return clip.z > clip.w;
}

// Where the way from a visible point to a point on the other side of the near plane crosses the plane, from 0 to 1.
float to_near_plane(vec4 front, vec4 behind) {
    float at = front.w - front.z;
    return at / (at - (behind.w - behind.z));
}

// The way from `to` to `from`, of which the latter is visible, clipped at the near plane: its direction on the screen, and its
// length in pixels.
vec3 way_from(vec4 from, vec4 to) {
    to = is_behind(to) ? mix(from, to, to_near_plane(from, to)) : to;
    vec2 d = from.xy * to.w - to.xy * from.w;
    float l = sqrt(dot(d, d));
    return l > 0.0 ? vec3(d / l, l / (from.w * to.w)) : vec3(0.0);
}

// The direction to the left of a direction on the screen, where y is down.
vec2 left_of(vec2 d) {
    return vec2(d.y, -d.x);
}

// The offset of a corner from the end `at` of its segment, in halves of the line's width. `beyond` is the end of the segment in
// which the line goes on.
vec2 corner(uint kind, vec4 at, vec4 other, vec4 beyond, bool goes_on, float half_width) {
    vec3 own = way_from(at, other), next = way_from(at, beyond);
    vec2 e = own.xy, f = -next.xy, s = e + f;
    bool has_joint = goes_on && own.z > 0.0 && next.z > 0.0;
    float l = dot(s, s), turn = e.x * f.y - e.y * f.x;
    bool mitred = has_joint && l * LONGEST_MITRE * LONGEST_MITRE >= 4.0 && half_width * abs(turn) <= 0.5 * l * min(own.z, next.z);
    if (kind <= CORNER_RIGHT) {
        vec2 left = mitred ? left_of(s) * (2.0 / l) : left_of(e);
        return kind == CORNER_LEFT ? left : -left;
    }
    // The corners of a joint's triangle: the outer corners of both segments, in counter-clockwise order.
    vec2 side = (kind == CORNER_JOINT_FIRST) != (turn > 0.0) ? left_of(e) : left_of(f);
    return has_joint && !mitred && kind != CORNER_JOINT_CENTRE ? (turn > 0.0 ? side : -side) : vec2(0.0);
}

// The vector from a position to the camera; for a parallel projection, a unit vector in this direction.
vec3 to_camera(vec3 p) {
    return frame.view_direction.w != 0.0 ? -frame.view_direction.xyz : frame.eye.xyz - p;
}

// Whether an edge is drawn. The computation is the same for both of its ends, so that they agree.
bool edge_shows(uvec2 ends, uvec2 opposite, uint flags) {
    bool turned = ends.x > ends.y;
    uvec2 e = turned ? ends.yx : ends, o = turned ? opposite.yx : opposite;
    vec3 a = texelFetch(positions, int(e.x)).xyz, along = texelFetch(positions, int(e.y)).xyz - a, view = to_camera(a);
    vec3 c = texelFetch(positions, int(o.x)).xyz - a, d = texelFetch(positions, int(o.y)).xyz - a;
    bool front = dot(cross(along, c), view) > 0.0, front_beyond = dot(cross(d, along), view) > 0.0;
    bool exists = o.x != e.x && o.x != e.y, exists_beyond = o.y != e.x && o.y != e.y;
    if ((flags & EDGE_SMOOTH) != 0u) return front != front_beyond;
    return (flags & EDGE_DOUBLE_SIDED) != 0u || (exists && front) || (exists_beyond && front_beyond);
}

// How far a face at an edge rises towards the camera over the step `across` from the edge, which is parallel to the image. If the
// step leads to the other side of the edge, the opposite step is taken. `along`, `third` and `across` are relative to an end of
// the edge; `third` is the face's third vertex.
float rise(vec3 along, vec3 third, vec3 view, vec3 across, float most) {
    vec3 normal = cross(along, third), sides = cross(view, along);
    float facing = dot(normal, view), slope = dot(normal, across) * (dot(sides, across) * dot(sides, third) < 0.0 ? 1.0 : -1.0);
    slope *= facing < 0.0 ? -1.0 : 1.0;
    return slope <= 0.0 ? 0.0 : min(slope, most * abs(facing)) / max(abs(facing), 1e-37);
}

void main() {
    uint i = invocation_number();
    if (i >= part.corners + 4u * part.edges) return;
    bool is_edge = i >= part.corners;
    uint corner_of_edge = (i - part.corners) & 3u;
    uint stroke = is_edge ? part.corners + (i - part.corners) / 4u : i;
    uvec4 ends = texelFetch(strokes, int(2u * stroke)), shape = texelFetch(strokes, int(2u * stroke + 1u));
    uint flags = 0u;
    uvec2 opposite = uvec2(0u);
    if (is_edge) {
        // The edge's corners as those of a line: left of the first end, right and left of the second end (seen from there), right
        // of the first.
        bool is_first = corner_of_edge == 0u || corner_of_edge == 3u;
        flags = ends.w;
        opposite = is_first ? shape.xy : shape.yx;
        ends = is_first ? uvec4(ends.x + corner_of_edge, ends.y, ends.z, ends.y) : uvec4(ends.x + corner_of_edge, ends.z, ends.y, ends.z);
        shape = uvec4((corner_of_edge & 1u) == 0u ? CORNER_LEFT | CORNER_FACES_CAMERA : CORNER_RIGHT | CORNER_FACES_CAMERA, uvec3(0u));
    }
    vec4 p = texelFetch(positions, int(ends.y)), q = texelFetch(positions, int(ends.z));
    vec4 at = to_clip(frame.transform, p), other = to_clip(frame.transform, q);
    vec4 beyond = to_clip(frame.transform, texelFetch(positions, int(ends.w)));
    uint kind = shape.x & KIND;
    bool is_line = kind != CORNER_DISC, goes_on = ends.w != ends.y;
    bool seen = !is_behind(at);
    vec3 end = p.xyz, along = q.xyz - end;
    if (is_line && kind <= CORNER_RIGHT && !seen && !is_behind(other)) {
        // The segment begins at the near plane.
        float t = to_near_plane(other, at);
        p = mix(q, p, t);
        at = mix(other, at, t);
        goes_on = false;
        seen = true;
    }
    float half_width = is_edge ? part.half_edge : part.right.w;
    if (is_edge && seen) {
        if (is_behind(other)) {
            float t = to_near_plane(at, other);
            q = mix(p, q, t);
            other = mix(at, other, t);
        }
        // Extends the line along the edge itself, so that it keeps the edge's depth.
        float beyond_end = half_width * ((flags & EDGE_SMOOTH) != 0u ? SMOOTH_END : CREASE_END), span = other.w * way_from(at, other).z;
        float share = span > 0.0 ? beyond_end * at.w / max(span - beyond_end * (at.w - other.w), 0.5 * span) : 0.0;
        p += (p - q) * share;
        at += (at - other) * share;
    }
    vec2 offset = is_line ? corner(kind, at, other, beyond, goes_on, half_width) * half_width : uintBitsToFloat(shape.yz) * part.down.w;
    seen = seen && (!is_edge || edge_shows(ends.yz, opposite, flags));
    // Lines that are not seen get no area.
    offset = seen ? offset * at.w : vec2(0.0);
    vec3 beside = offset.x * part.right.xyz + offset.y * part.down.xyz, placed = p.xyz + beside;
    if (is_edge && seen) {
        vec3 view = normalize(to_camera(p.xyz));
        float pixel = at.w * length(part.right.xyz), most = MOST_RISE * half_width * pixel;
        vec3 c = texelFetch(positions, int(opposite.x)).xyz - end, d = texelFetch(positions, int(opposite.y)).xyz - end;
        float lift = max(rise(along, c, view, beside, most), rise(along, d, view, beside, most)) + part.apart * pixel;
        bool parallel = frame.view_direction.w != 0.0;
        vec3 sight = to_camera(placed);
        // The line is moved at most half the way to the near plane.
        float share = parallel ? lift : min(lift / max(length(to_camera(p.xyz)), 1e-37), max(0.5 * (1.0 - at.z / at.w), 0.0));
        placed += sight * share;
    }
    imageStore(positions_out, int(ends.x), vec4(placed, 1.0));
    if ((shape.x & CORNER_FACES_CAMERA) != 0u) imageStore(normals_out, int(ends.x), vec4(-frame.view_direction.xyz, 0.0));
}
