// What the host's shaders read and write: one descriptor set.
#ifndef HOST_SET
#define HOST_SET 0
#endif

struct Vertex { vec3 position, normal; };
struct Instance { mat4 to_clip; mat4 to_world; };
struct Draw { uint first_triangle, first_index; uint vertex_offset, key; };

layout(std430, set = HOST_SET, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, set = HOST_SET, binding = 1) readonly buffer Instances { Instance instances[]; };
layout(std430, set = HOST_SET, binding = 2) readonly buffer Indices { uint indices[]; };
layout(std430, set = HOST_SET, binding = 3) readonly buffer Draws { Draw draws[]; };
layout(std430, set = HOST_SET, binding = 4) readonly buffer DrawOf { uint draw_of[]; };     // draw of each triangle
layout(std430, set = HOST_SET, binding = 7) readonly buffer Coordinates { vec2 coordinates[]; };    // of posed vertices
layout(set = HOST_SET, binding = 8) uniform sampler2D bricks;
layout(set = HOST_SET, binding = 9) uniform sampler2D fence;
layout(set = HOST_SET, binding = 10) uniform utexture2D ids;
