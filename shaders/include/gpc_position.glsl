// A vertex in clip space, as the library has it where positions are in object space. A vertex shader that gives this to
// gl_Position draws triangle IDs and depth of the very triangles that the library samples.
#ifndef GPC_POSITION_GLSL
#define GPC_POSITION_GLSL

// Column by column from the last: each product and each sum is rounded once, to 32 bits, and none are fused.
vec4 gpc_clip_position(mat4 to_clip, vec3 position) {
    precise vec4 z = to_clip[3] + to_clip[2] * position.z;
    precise vec4 y = z + to_clip[1] * position.y;
    precise vec4 x = y + to_clip[0] * position.x;
    return x;
}

#endif
