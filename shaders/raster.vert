// raster: fetches vertices by itself (vertex pulling), so that the ID of a triangle is 1 + gl_VertexIndex / 3, which is cheaper
// than gl_PrimitiveID, and so that positions are the same as in `sample`. An invocation takes a vertex of a triangle.
// Reads: triangles, positions. The matrix and the vector of an instance are pushed, which costs less than reading them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/triangle.glsl"
layout(location = 0) flat out uint triangle_id;
layout(push_constant) uniform Push {
    mat4 matrix;        // position -> (pixel x * w, pixel y * w, z, w)
    uvec4 instance;     // the instance's first vector, see triangle.glsl
} push;

void main() {
    uint t = uint(gl_VertexIndex) / 3u;
    uint corner = uint(gl_VertexIndex) - 3u * t;
    uvec4 indices = triangle_in(push.instance, t);
    uint v = corner == 0u ? indices.x : corner == 1u ? indices.y : indices.z;
    vec4 p = to_clip(push.matrix, texelFetch(positions, int(v)));
    gl_Position = vec4(p.xy * frame.raster_scale + frame.raster_offset * p.w, p.zw);
    triangle_id = t + 1u;
}
