// The triangle of an ID, its vertices in clip space, and the way of its attributes to the geometry's space.
//
// A position goes from its mesh to clip space in one product wherever a pass needs it, and no pass writes it down: three
// products cost about what reading three stored vertices does, and a vertex costs no memory a frame, however often its
// mesh is drawn. The matrix is a product of 64 bits, rounded once, so that what is drawn lies at least as close to where
// it should as if each vertex had been rounded in world space. Two instances that share an edge in space meet there up to
// that rounding; triangles of one instance meet exactly.
#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL
#include "interface.glsl"

layout(constant_id = CONSTANT_INSTANCED) const bool INSTANCED = false;  // indices are those of instances, not of records

// Vectors of an instance: (what leads from an index to a record, end of its indices, flags, 0), four columns to clip
// space, three rows to the geometry's space.
const int INSTANCE_VECTORS = 8;

struct Triangle {
    bool exists;        // indices between two instances stand for nothing: for a triangle without area
    ivec3 vertices;
    uint word;          // see frame.glsl
    vec4 v0, v1, v2;    // clip space: (pixel x * w, pixel y * w, z, w)
    int instance;       // first of its vectors, if INSTANCED
};

// Every pass gets the same bits, so that they agree on shared edges.
vec4 to_clip(mat4 matrix, vec4 p) {
    precise vec4 z = matrix[3] * p.w + matrix[2] * p.z;
    precise vec4 y = z + matrix[1] * p.y;
    precise vec4 x = y + matrix[0] * p.x;
    return x;
}

// Corners and word of the triangle that an instance, by its first vector, has at an index.
uvec4 triangle_in(uvec4 instance, uint index) {
    uvec4 record = texelFetch(triangles, int(min(index, instance.y - 1u) + instance.x));
    record.yz = (instance.z & INSTANCE_MIRRORED) != 0u ? record.zy : record.yz;
    record.yz = index < instance.y ? record.yz : record.xx;
    return record;
}

int instance_at(uint index) {
    return INSTANCE_VECTORS * int(texelFetch(instance_of, int(index >> 6)).x);
}

// The word of a triangle alone.
uint triangle_word(uint index) {
    if (!INSTANCED) return texelFetch(triangles, int(index)).w;
    return triangle_in(texelFetch(instances, instance_at(index)), index).w;
}

Triangle triangle_at(uint index) {
    Triangle t;
    uvec4 record;
    mat4 matrix;
    if (INSTANCED) {
        t.instance = instance_at(index);
        uvec4 instance = texelFetch(instances, t.instance);
        record = triangle_in(instance, index);
        t.exists = index < instance.y;
        matrix = mat4(
            uintBitsToFloat(texelFetch(instances, t.instance + 1)), uintBitsToFloat(texelFetch(instances, t.instance + 2)),
            uintBitsToFloat(texelFetch(instances, t.instance + 3)), uintBitsToFloat(texelFetch(instances, t.instance + 4)));
    } else {
        t.instance = 0;
        record = texelFetch(triangles, int(index));
        t.exists = true;
        matrix = frame.transform;
    }
    t.vertices = ivec3(record.xyz);
    t.word = record.w;
    t.v0 = to_clip(matrix, texelFetch(positions, t.vertices.x));
    t.v1 = to_clip(matrix, texelFetch(positions, t.vertices.y));
    t.v2 = to_clip(matrix, texelFetch(positions, t.vertices.z));
    return t;
}

// Rows of a triangle's way to the geometry's space.
vec4 placing_row(Triangle t, int axis) {
    return uintBitsToFloat(texelFetch(instances, t.instance + 5 + axis));
}

vec3 unit_or(vec3 v, vec3 otherwise) {
    float l = dot(v, v);
    return l > 0.0 ? v * inversesqrt(l) : otherwise;
}

// The position, relative to the geometry's origin, that is between those of the vertices.
vec3 position_of(Triangle t, vec3 weights) {
    vec3 p = mat3(texelFetch(positions, t.vertices.x).xyz, texelFetch(positions, t.vertices.y).xyz, texelFetch(positions, t.vertices.z).xyz) * weights;
    if (!INSTANCED) return p;
    vec4 q = vec4(p, 1.0);
    return vec3(dot(placing_row(t, 0), q), dot(placing_row(t, 1), q), dot(placing_row(t, 2), q));
}

// What is between the vertices' unit normals.
vec3 normal_of(Triangle t, vec3 weights) {
    mat3 n = mat3(texelFetch(normals, t.vertices.x).xyz, texelFetch(normals, t.vertices.y).xyz, texelFetch(normals, t.vertices.z).xyz);
    if (!INSTANCED) return n * weights;
    // The inverse transpose up to a positive factor, which is there for flat instances too.
    vec3 x = placing_row(t, 0).xyz, y = placing_row(t, 1).xyz, z = placing_row(t, 2).xyz;
    mat3 turn = transpose(mat3(cross(y, z), cross(z, x), cross(x, y)));
    vec3 up = vec3(0.0, 0.0, dot(x, cross(y, z)) < 0.0 ? -1.0 : 1.0);
    n = mat3(unit_or(turn * n[0], up), unit_or(turn * n[1], up), unit_or(turn * n[2], up));
    return n * weights * up.z;
}

// How much longer a length is in the world than in the mesh, between the vertices.
float scale_of(Triangle t, vec3 weights) {
    float scale = dot(vec3(texelFetch(normals, t.vertices.x).w, texelFetch(normals, t.vertices.y).w, texelFetch(normals, t.vertices.z).w), weights);
    if (!INSTANCED) return scale;
    return scale * pow(abs(dot(placing_row(t, 0).xyz, cross(placing_row(t, 1).xyz, placing_row(t, 2).xyz))), 1.0 / 3.0);
}

// What is between the vertices' unit tangents, and between the signs of their bitangents.
vec4 tangent_of(Triangle t, vec3 weights) {
    mat3x4 w = mat3x4(texelFetch(tangents, t.vertices.x), texelFetch(tangents, t.vertices.y), texelFetch(tangents, t.vertices.z));
    if (!INSTANCED) return w * weights;
    vec3 x = placing_row(t, 0).xyz, y = placing_row(t, 1).xyz, z = placing_row(t, 2).xyz;
    mat3 turn = transpose(mat3(x, y, z));
    vec3 right = vec3(1.0, 0.0, 0.0);
    mat3 along = mat3(unit_or(turn * w[0].xyz, right), unit_or(turn * w[1].xyz, right), unit_or(turn * w[2].xyz, right));
    float side = dot(x, cross(y, z)) < 0.0 ? -1.0 : 1.0;
    return vec4(along * weights, side * dot(vec3(w[0].w, w[1].w, w[2].w), weights));
}

#endif
