// What the renderer's shaders read: one descriptor set, and push constants.
#ifndef HOST_SET
#define HOST_SET 0
#endif

struct Object { mat4 to_clip; mat4 to_world; vec4 color; };

// Packed vertices: x, y, z as floats, then the normal's x, y, z in 8 bits each, and 8 unused bits.
layout(std430, set = HOST_SET, binding = 0) readonly buffer Vertices { uvec4 vertices[]; };
layout(std430, set = HOST_SET, binding = 1) readonly buffer Objects { Object objects[]; };

layout(push_constant) uniform Push { vec4 eye; uint object, first_triangle; } push;

vec3 position_of(uint vertex) {
    return uintBitsToFloat(vertices[vertex].xyz);
}

vec3 normal_of(uint vertex) {
    return unpackSnorm4x8(vertices[vertex].w).xyz;
}
