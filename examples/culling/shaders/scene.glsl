// What the host's shaders share: its objects, the mesh that all of them show, and their light.
#ifndef SCENE_GLSL
#define SCENE_GLSL

#ifndef SCENE_SET
#define SCENE_SET 0
#endif

struct Object {
    mat4 to_world;
    vec4 color;
};

layout(std430, set = SCENE_SET, binding = 0) readonly buffer Objects { Object objects[]; };
layout(std430, set = SCENE_SET, binding = 1) readonly buffer Vertices { uvec2 vertices[]; };  // 4 normalised integers of 16 bits

const uint INDEX_COUNT = 36u, VERTEX_COUNT = 24u;

vec3 position_of(uint vertex) {
    uvec2 words = vertices[vertex];
    return vec3(unpackSnorm2x16(words.x), unpackSnorm2x16(words.y).x);
}

// The colour of an object's face: each face of a box has four vertices of its own.
vec3 color_of(uint object, uint vertex) {
    uint face = vertex / 4u;
    vec3 normal = vec3(0.0);
    normal[face / 2u] = (face & 1u) == 0u ? -1.0 : 1.0;
    vec3 towards = normalize(mat3(objects[object].to_world) * normal);
    return objects[object].color.rgb * (0.25 + 0.75 * max(dot(towards, normalize(vec3(0.4, 0.8, 0.45))), 0.0));
}

#endif
