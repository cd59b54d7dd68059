// The position of a vertex in clip space, to the bit as the library computes it for positions in object space. A vertex shader
// that writes it to gl_Position draws the IDs and depths of exactly the triangles that the library samples.
#ifndef GPC_POSITION_GLSL
#define GPC_POSITION_GLSL

// Adds the matrix's columns from the last one on. Each product and each sum is rounded to 32 bits; none are fused.
vec4 gpc_clip_position(mat4 to_clip, vec3 position) {
    precise vec4 z = to_clip[3] + to_clip[2] * position.z;
    precise vec4 y = z + to_clip[1] * position.y;
    precise vec4 x = y + to_clip[0] * position.x;
    return x;
}

#endif
