// The triangle of an ID, its vertices in clip space.
//
// A position goes from its mesh to clip space in one product wherever a pass needs it, and no pass writes it down: three
// products cost about what reading three stored vertices does, and a vertex costs no memory a frame. The matrix is rounded
// once, from one of 64 bits.
#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL

struct Triangle {
    ivec3 vertices;     // of the vertices' attributes
    uint word;          // see frame.glsl
    vec4 v0, v1, v2;    // clip space: (pixel x * w, pixel y * w, z, w)
};

// Every pass gets the same bits, so that they agree on shared edges.
vec4 to_clip(mat4 matrix, vec4 p) {
    precise vec4 z = matrix[3] * p.w + matrix[2] * p.z;
    precise vec4 y = z + matrix[1] * p.y;
    precise vec4 x = y + matrix[0] * p.x;
    return x;
}

Triangle triangle_at(uint index) {
    uvec4 record = texelFetch(triangles, int(index));
    Triangle t;
    t.vertices = ivec3(record.xyz);
    t.word = record.w;
    t.v0 = to_clip(frame.transform, texelFetch(positions, t.vertices.x));
    t.v1 = to_clip(frame.transform, texelFetch(positions, t.vertices.y));
    t.v2 = to_clip(frame.transform, texelFetch(positions, t.vertices.z));
    return t;
}

#endif
