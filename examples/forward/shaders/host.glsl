// What the renderer's shaders read: one descriptor set, and push constants.
#ifndef HOST_SET
#define HOST_SET 0
#endif

struct Object { mat4 to_clip; mat4 to_world; vec4 color; uint first_vertex, first_position, padding0, padding1; };

// Vertices as they are packed: 16 bits of x, y, z and nothing, then 8 bits of the normal's x, y, z and nothing.
layout(std430, set = HOST_SET, binding = 0) readonly buffer Vertices { uint vertices[]; };
layout(std430, set = HOST_SET, binding = 1) readonly buffer Objects { Object objects[]; };
#ifndef CLIP_ACCESS
#define CLIP_ACCESS readonly
#endif
layout(std430, set = HOST_SET, binding = 2) CLIP_ACCESS buffer Clip { vec4 clip[]; };

layout(push_constant) uniform Push { vec4 eye; uint object, first_triangle, vertex_count; } push;

vec3 position_of(uint vertex) {
    return vec3(unpackSnorm2x16(vertices[3u * vertex]), unpackSnorm2x16(vertices[3u * vertex + 1u]).x);
}

vec3 normal_of(uint vertex) {
    return unpackSnorm4x8(vertices[3u * vertex + 2u]).xyz;
}
