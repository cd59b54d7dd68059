// What an application's shaders write about an instance of a draw, for GpcIndirectDraws. An array of GpcInstance in a std430
// buffer has 96 bytes an element, and is the same in C.
#ifndef GPC_INSTANCE_GLSL
#define GPC_INSTANCE_GLSL

struct GpcInstance {
    mat4 to_clip;           // from object space to clip space, with positions in object space; otherwise ignored
    uint vertex_count;      // vertices from the command's vertexOffset (or firstVertex) on, with positions in object space
    uint key;               // shading key
    uint material;          // a number for the application's shaders, GpcSample.material; surfaces with the same lower 16 bits are
                            // assumed to look alike
    uint alpha_map;         // 1 + index of the alpha map, in lists of alpha-tested draws; otherwise 0
    uint detailed;          // 1 if the colour may vary within a pixel, otherwise 0
    uint reserved_0;        // 0
    uint reserved_1;        // 0
    uint reserved_2;        // 0
};

#endif
