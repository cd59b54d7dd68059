// pose: moves the vertices of a mesh from their pose at rest: applies morph targets, then the matrices of joints or of the mesh's
// node. An invocation takes a vertex.
// Reads: resting, influences, displacements, moment. Writes: positions, normals, tangents. Twin: the poses of `gpc::scene`.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;

layout(set = SET_DATA, binding = BINDING_MOMENT) uniform textureBuffer moment;         // rows of matrices; weights, targets
layout(set = SET_DATA, binding = BINDING_RESTING) uniform textureBuffer resting;        // position, normal, tangent of each vertex
layout(set = SET_DATA, binding = BINDING_INFLUENCES) uniform utextureBuffer influences;    // joints of a vertex, bits of their weights
layout(set = SET_DATA, binding = BINDING_DISPLACEMENTS) uniform textureBuffer displacements;  // 1 to 3 vectors of a vertex
layout(set = SET_DATA, binding = BINDING_POSITIONS_OUT, rgba32f) uniform writeonly imageBuffer positions_out;
layout(set = SET_DATA, binding = BINDING_NORMALS_OUT, rgba32f) uniform writeonly imageBuffer normals_out;
layout(set = SET_DATA, binding = BINDING_TANGENTS_OUT, rgba32f) uniform writeonly imageBuffer tangents_out;

layout(push_constant) uniform Push {
    uint count;             // vertices
    uint first_vertex;      // where the vertices are written
    uint first_resting;
    uint first_influence;
    uint sets;              // sets of four influences; 0: the mesh follows its node
    uint first_displacement;
    uint displacement_vectors;
    uint first_matrix;      // in `moment`
    uint first_weight;
    uint weight_count;
    uint flags;
} part;

// The position (`stream` 0), normal (1) or tangent (2) of a vertex, displaced by the morph targets.
vec3 morphed(uint v, uint stream) {
    vec3 value = texelFetch(resting, int((part.first_resting + v) * 3u + stream)).xyz;
    uint k = 0u;
    do {
        bool wanted = k < part.weight_count && stream < part.displacement_vectors;
        vec2 weight = texelFetch(moment, int(part.first_weight + (wanted ? k : 0u))).xy;
        uint place = wanted ? (uint(weight.y) * part.count + v) * part.displacement_vectors + stream : 0u;
        vec3 displacement = texelFetch(displacements, int(part.first_displacement + place)).xyz;
        value += wanted ? displacement * weight.x : vec3(0.0);
    } while (++k < part.weight_count);
    return value;
}

struct Rows { vec4 x, y, z; };

Rows matrix(uint index) {
    int row = int(part.first_matrix + 3u * index);
    return Rows(texelFetch(moment, row), texelFetch(moment, row + 1), texelFetch(moment, row + 2));
}

// The weighted sum of the matrices of a vertex's joints; without joints, the matrix of its node.
Rows blended(uint v) {
    Rows sum = matrix(0u);
    if (part.sets == 0u) return sum;
    sum = Rows(vec4(0.0), vec4(0.0), vec4(0.0));
    uint set_ = 0u;
    do {
        int at = 2 * int(part.first_influence + set_ * part.count + v);
        uvec4 joints = texelFetch(influences, at);
        vec4 weights = uintBitsToFloat(texelFetch(influences, at + 1));
        [[unroll]] for (int i = 0; i < 4; i++) {
            Rows joint = matrix(joints[i]);
            sum.x += joint.x * weights[i];
            sum.y += joint.y * weights[i];
            sum.z += joint.z * weights[i];
        }
    } while (++set_ < part.sets);
    return sum;
}

vec3 position_at(Rows rows, uint v) {
    vec4 p = vec4(morphed(v, 0u), 1.0);
    return vec3(dot(rows.x, p), dot(rows.y, p), dot(rows.z, p));
}

vec3 face_normal(uint v) {
    uint first = v - v % 3u;
    vec3 a = position_at(blended(first), first), b = position_at(blended(first + 1u), first + 1u), c = position_at(blended(first + 2u), first + 2u);
    vec3 normal = unit_or(cross(b - a, c - a), vec3(0.0, 0.0, 1.0));
    return (part.flags & POSE_INSIDE_OUT) != 0u ? -normal : normal;
}

void main() {
    uint v = invocation_number();
    if (v >= part.count) return;
    int to = int(part.first_vertex + v);
    Rows rows = blended(v);
    imageStore(positions_out, to, vec4(position_at(rows, v), 1.0));

    // The cofactor matrix times `side` is the inverse transpose up to a positive factor. It exists for flat joints, too.
    vec3 cofactors = cross(rows.y.xyz, rows.z.xyz);
    float side = dot(rows.x.xyz, cofactors) < 0.0 ? -1.0 : 1.0;
    vec3 n = morphed(v, 1u);
    n = side * vec3(dot(cofactors, n), dot(cross(rows.z.xyz, rows.x.xyz), n), dot(cross(rows.x.xyz, rows.y.xyz), n));
    bool is_flat = (part.flags & POSE_FLAT) != 0u;
    vec3 normal = is_flat ? face_normal(v) : unit_or(n, vec3(0.0, 0.0, 1.0));
    imageStore(normals_out, to, vec4(normal, pow(abs(dot(rows.x.xyz, cofactors)), 1.0 / 3.0)));
    if ((part.flags & POSE_TANGENTS) == 0u) return;
    vec3 t = morphed(v, 2u);
    t = unit_or(vec3(dot(rows.x.xyz, t), dot(rows.y.xyz, t), dot(rows.z.xyz, t)), vec3(1.0, 0.0, 0.0));
    imageStore(tangents_out, to, vec4(t, side * texelFetch(resting, int((part.first_resting + v) * 3u + 2u)).w));
}
