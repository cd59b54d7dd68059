// crossings: marks cells of a list that a thin triangle crosses although no location sees it. It does for cells what `thin` does
// for pixels: see there for the rules. Columns and rows are those of a cell, whose axes are x and y of the output. Instead of
// depth there is nearness: 1 / distance along the view direction or, for a parallel projection, minus the distance. Triangles
// are clipped at the near plane. Twin: twins/src/crossings.rs.
// Reads: the geometry, pairs, cells, what each location sees. Writes: cell_marks of the output, tile by tile, which
// `detect` reads.
// INVOCATIONS_OF_PAIR invocations share a pair of a triangle and a tile. They take the tile's cells near the triangle by turns.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/fold.glsl"
#include "include/locations.glsl"
#include "include/pairs.glsl"
#include "include/thin.glsl"
#include "include/tile_locations.glsl"
#include "include/tiles.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = CROSSINGS_CONSTANT_BLEND_IDS) const bool BLEND_IDS = false;
layout(constant_id = CROSSINGS_CONSTANT_FOLDS) const bool FOLDS = false;
layout(std430, set = SET_BESIDE_FRAME, binding = CROSSINGS_BINDING_LOADS) readonly buffer TileLocations { uint loads[]; };
// A vector a location: (distance along the view direction as a float's bits, 0 for background; ID; ID of the nearest BLEND
// triangle, 0 for none; number of its cell of the output, row by row).
layout(std430, set = SET_BESIDE_FRAME, binding = CROSSINGS_BINDING_SEEN) readonly buffer Seen { uvec4 seen[]; };
layout(std430, set = SET_BESIDE_FRAME, binding = CROSSINGS_BINDING_CELL_MARKS) buffer CellMarks { uint cell_marks[]; };  // as `marks` of pixels
layout(push_constant) uniform Push {
    uvec2 tiles;        // of the output
    uint width;         // of the output, in cells
    float pixel;        // width of a pixel of the plane at a distance of 1 or, for a parallel projection, at any distance
} push;

// A vertex in clip space, and its distance along the view direction.
struct Corner { vec4 at; float distance_; };

Corner corner_of(Triangle k, vec4 vertex, vec3 weights, vec2 center) {
    float distance_ = dot(position_of(k, weights) - frame.eye.xyz, frame.view_direction.xyz);
    return Corner(relative_to(vertex, center), distance_);
}

// How far a vertex lies on the visible side of the near plane; negative on the other side.
float behind_near(Corner v) { return v.at.w - v.at.z; }

Corner on_near(Corner a, Corner b) {
    float t = behind_near(a) / (behind_near(a) - behind_near(b));
    return Corner(mix(a.at, b.at, t), mix(a.distance_, b.distance_, t));
}

float nearness_at(float distance_) { return frame.view_direction.w != 0.0 ? -distance_ : 1.0 / distance_; }

vec3 projected(Corner v) { return vec3(v.at.xy / v.at.w, nearness_at(v.distance_)); }

void mark(uint location, uint t, vec2 nearness, float cell_width, vec3 normal) {
    uvec4 there = seen[location];
    float distance_ = uintBitsToFloat(there.x);
    bool parallel = frame.view_direction.w != 0.0;
    float behind = distance_ != 0.0 ? nearness_at(distance_) : parallel ? -3.4e38 : 0.0;
    bool unseen = !BLEND_IDS || t < frame.first_blend || there.z != t + 1u;
    bool apart = nearness.x - behind > push.pixel * cell_width * (parallel ? 1.0 : nearness.x);
    bool painted = nearness.y >= behind && there.y != t + 1u;
    if (FOLDS) apart = apart || (painted && is_fold(normal, there.y));
    if (unseen && (apart || painted)) {
        uvec2 cell = split(there.w, push.width), tile = cell / uvec2(8u, 4u), within = cell % uvec2(8u, 4u);
        uint word = (apart ? 0u : push.tiles.x * push.tiles.y) + tile.y * push.tiles.x + tile.x;
        atomicOr(cell_marks[word], 1u << (within.y * 8u + within.x));
    }
}

void main() {
    uint i = invocation_number(), pair_count = min(counters[COUNTER_PAIRS], frame.pair_capacity);
    bool exists = i / INVOCATIONS_OF_PAIR < pair_count;
    uvec2 pair = texelFetch(pairs, int(min(i / INVOCATIONS_OF_PAIR, max(pair_count, 1u) - 1u))).xy;
    uint t = min(pair.x, frame.triangle_count - 1u), tile = min(pair_tile(pair), frame.tiles.x * frame.tiles.y - 1u);
    vec2 center = tile_center(ivec2(split(tile, frame.tiles.x)));
    Triangle k = triangle_at(t);
    vec3 normal = FOLDS ? facing_normal(k) : vec3(0.0);
    Corner a = corner_of(k, k.v0, vec3(1.0, 0.0, 0.0), center);
    Corner b = corner_of(k, k.v1, vec3(0.0, 1.0, 0.0), center);
    Corner c = corner_of(k, k.v2, vec3(0.0, 0.0, 1.0), center);

    // Clipping at the near plane. `a` becomes the corner that is alone on its side; four corners or fewer are left.
    bvec3 shown = greaterThanEqual(vec3(behind_near(a), behind_near(b), behind_near(c)), vec3(0.0));
    int shown_count = int(shown.x) + int(shown.y) + int(shown.z);
    bool second = shown_count == 1 ? shown.y : !shown.y, third = shown_count == 1 ? shown.z : !shown.z;
    Corner first_ = a;
    if (shown_count != 3 && second) { a = b; b = c; c = first_; }
    else if (shown_count != 3 && third) { a = c; c = b; b = first_; }
    Corner near_b = on_near(a, b), near_c = on_near(a, c);
    if (shown_count == 2) a = near_b;
    if (shown_count == 1) { b = near_b; c = near_c; }
    vec3 p0 = projected(a), p1 = projected(b), p2 = projected(c), p3 = p2;
    if (shown_count == 2) p3 = projected(near_c);

    // Cells of a tile lie along a Morton curve through its pixels. On this curve, all pixels of a rectangle lie between its upper
    // left and its lower right pixel. Only cells from the one to the other are tried.
    Footprint f = footprint_of(k.v0, k.v1, k.v2);
    ivec2 corner = ivec2(split(tile, frame.tiles.x)) * ivec2(8, 4);
    uvec2 low = uvec2(clamp(f.low - corner, ivec2(0), ivec2(7, 3))), high = uvec2(clamp(f.high - corner, ivec2(0), ivec2(7, 3)));
    uint base = tile * LOAD_WORDS, after = morton_of(high) + 1u, tile_end = loads[base + LOAD_FIRST] + loads[base + LOAD_COUNT];
    uint first = loads[base + bit_at(morton_of(low))], end = after < 32u ? loads[base + bit_at(after)] : tile_end;
    end = exists && shown_count > 0 ? end : 0u;
    uint n = first + i % INVOCATIONS_OF_PAIR;
    do {
        int cell = int(2u * min(n, max(tile_end, 1u) - 1u));
        uint location = texelFetch(location_cells, cell + 1).x;
        vec2 at = uintBitsToFloat(texelFetch(location_cells, cell).xy);
        mat2 jacobian = location_jacobian(location);
        float area = determinant(jacobian);
        mat2 to_cell = mat2(jacobian[1].y, -jacobian[0].y, -jacobian[1].x, jacobian[0].x) / area;
        vec3 q0 = vec3(to_cell * (p0.xy - at), p0.z), q1 = vec3(to_cell * (p1.xy - at), p1.z);
        vec3 q2 = vec3(to_cell * (p2.xy - at), p2.z), q3 = vec3(to_cell * (p3.xy - at), p3.z);
        float height = height_of(q0.xy, q1.xy, q2.xy, q3.xy);
        // The triangle is taken along its longer side. If that is along y, x and y are exchanged.
        vec2 extent = max(max(q0, q1), max(q2, q3)).xy - min(min(q0, q1), min(q2, q3)).xy;
        bool swap = extent.y > extent.x;
        q0.xy = swap ? q0.yx : q0.xy;
        q1.xy = swap ? q1.yx : q1.xy;
        q2.xy = swap ? q2.yx : q2.xy;
        q3.xy = swap ? q3.yx : q3.xy;
        vec4 span = both_of(
            both_of(span_of(q0, q1, -0.5, 0.5), span_of(q1, q2, -0.5, 0.5)),
            both_of(span_of(q2, q3, -0.5, 0.5), span_of(q3, q0, -0.5, 0.5)));
        bool crosses = n < end && area != 0.0 && height < THIN && height > 0.0 && span.x < 0.5 && span.y >= -0.5;
        if (crosses) mark(location, t, span.zw, sqrt(abs(area)), normal);
        n += INVOCATIONS_OF_PAIR;
    } while (n < end);
}
