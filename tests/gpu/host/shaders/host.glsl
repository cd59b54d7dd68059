// What the tests' host lends its own shaders.
layout(std430, set = 1, binding = 0) readonly buffer Colors { vec4 colors[]; };     // of each draw
layout(std430, set = 1, binding = 1) readonly buffer Paints { float paints[]; };    // of each vertex
layout(std430, set = 1, binding = 2) writeonly buffer Corners { vec4 corners[]; };  // in clip space, of each triangle
layout(push_constant) uniform Push {
    uint triangle_count;
    float back;             // brightness of back faces
} push;
