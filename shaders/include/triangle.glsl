// Triangles by their index: their vertices in clip space, and their attributes in the geometry's space.
//
// Positions in clip space are not stored. Each pass that needs one multiplies the position in the mesh by one matrix. Three
// products cost about as much as reading three stored vertices, and a mesh that is drawn many times takes no more memory. The
// matrix is computed in 64 bits and rounded once, so that vertices are at least as exact as if they were rounded in world
// space. Triangles of one instance meet exactly at common edges; triangles of two instances meet up to this rounding.
#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL
#include "interface.glsl"

layout(constant_id = CONSTANT_INSTANCED) const bool INSTANCED = false;  // indices of triangles count those of all instances

// Vectors of an instance: (added to an index, modulo 2^32: the index of its words in `triangles`; end of its indices; flags; 0),
// four columns of the matrix to clip space, three rows of the matrix to the geometry's space.
const int INSTANCE_VECTORS = 8;

struct Triangle {
    bool exists;        // false for indices between those of two instances: the triangle has no area then
    ivec3 vertices;
    uint word;          // see frame.glsl
    vec4 v0, v1, v2;    // clip space: (pixel x * w, pixel y * w, z, w)
    int instance;       // the first vector of its instance, if INSTANCED
};

// A position in clip space. All passes compute the same bits, and so agree about shared edges.
vec4 to_clip(mat4 matrix, vec4 p) {
    precise vec4 z = matrix[3] * p.w + matrix[2] * p.z;
    precise vec4 y = z + matrix[1] * p.y;
    precise vec4 x = y + matrix[0] * p.x;
    return x;
}

// Vertices and word of the triangle at an index. `instance` is the first vector of its instance.
uvec4 triangle_in(uvec4 instance, uint index) {
    uvec4 words = texelFetch(triangles, int(min(index, instance.y - 1u) + instance.x));
    words.yz = (instance.z & INSTANCE_MIRRORED) != 0u ? words.zy : words.yz;
    words.yz = index < instance.y ? words.yz : words.xx;
    return words;
}

int instance_at(uint index) {
    return INSTANCE_VECTORS * int(texelFetch(instance_of, int(index >> 6)).x);
}

// The word of a triangle, without its vertices.
uint triangle_word(uint index) {
    if (!INSTANCED) return texelFetch(triangles, int(index)).w;
    return triangle_in(texelFetch(instances, instance_at(index)), index).w;
}

Triangle triangle_at(uint index) {
    Triangle t;
    uvec4 words;
    mat4 matrix;
    if (INSTANCED) {
        t.instance = instance_at(index);
        uvec4 instance = texelFetch(instances, t.instance);
        words = triangle_in(instance, index);
        t.exists = index < instance.y;
        matrix = mat4(
            uintBitsToFloat(texelFetch(instances, t.instance + 1)), uintBitsToFloat(texelFetch(instances, t.instance + 2)),
            uintBitsToFloat(texelFetch(instances, t.instance + 3)), uintBitsToFloat(texelFetch(instances, t.instance + 4)));
    } else {
        t.instance = 0;
        words = texelFetch(triangles, int(index));
        t.exists = true;
        matrix = frame.transform;
    }
    t.vertices = ivec3(words.xyz);
    t.word = words.w;
    t.v0 = to_clip(matrix, texelFetch(positions, t.vertices.x));
    t.v1 = to_clip(matrix, texelFetch(positions, t.vertices.y));
    t.v2 = to_clip(matrix, texelFetch(positions, t.vertices.z));
    return t;
}

// A row of the matrix from the triangle's mesh to the geometry's space.
vec4 placing_row(Triangle t, int axis) {
    return uintBitsToFloat(texelFetch(instances, t.instance + 5 + axis));
}

vec3 unit_or(vec3 v, vec3 otherwise) {
    float l = dot(v, v);
    return l > 0.0 ? v * inversesqrt(l) : otherwise;
}

// The interpolated position, relative to the geometry's origin.
vec3 position_of(Triangle t, vec3 weights) {
    vec3 p = mat3(texelFetch(positions, t.vertices.x).xyz, texelFetch(positions, t.vertices.y).xyz, texelFetch(positions, t.vertices.z).xyz) * weights;
    if (!INSTANCED) return p;
    vec4 q = vec4(p, 1.0);
    return vec3(dot(placing_row(t, 0), q), dot(placing_row(t, 1), q), dot(placing_row(t, 2), q));
}

// The interpolation of the vertices' unit normals.
vec3 normal_of(Triangle t, vec3 weights) {
    mat3 n = mat3(texelFetch(normals, t.vertices.x).xyz, texelFetch(normals, t.vertices.y).xyz, texelFetch(normals, t.vertices.z).xyz);
    if (!INSTANCED) return n * weights;
    // The cofactor matrix is the inverse transpose up to a factor, and exists for flat instances, too. The sign of the factor
    // is that of the determinant, and is in `up.z`.
    vec3 x = placing_row(t, 0).xyz, y = placing_row(t, 1).xyz, z = placing_row(t, 2).xyz;
    mat3 turn = transpose(mat3(cross(y, z), cross(z, x), cross(x, y)));
    vec3 up = vec3(0.0, 0.0, dot(x, cross(y, z)) < 0.0 ? -1.0 : 1.0);
    n = mat3(unit_or(turn * n[0], up), unit_or(turn * n[1], up), unit_or(turn * n[2], up));
    return n * weights * up.z;
}

// How much longer a length is in the world than in the mesh, interpolated between the vertices.
float scale_of(Triangle t, vec3 weights) {
    float scale = dot(vec3(texelFetch(normals, t.vertices.x).w, texelFetch(normals, t.vertices.y).w, texelFetch(normals, t.vertices.z).w), weights);
    if (!INSTANCED) return scale;
    return scale * pow(abs(dot(placing_row(t, 0).xyz, cross(placing_row(t, 1).xyz, placing_row(t, 2).xyz))), 1.0 / 3.0);
}

// The interpolation of the vertices' unit tangents, and of the signs of their bitangents.
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
