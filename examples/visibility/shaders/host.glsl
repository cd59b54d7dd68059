// What the host's shaders read and write: one descriptor set.
#ifndef HOST_SET
#define HOST_SET 0
#endif

struct Vertex { vec4 position_u; vec4 normal_v; };      // of a mesh; the texture's coordinates in w
struct Instance { mat4 to_clip; mat4 to_world; };
struct Draw { uint first_triangle, first_index; uint vertex_offset, key; };

layout(std430, set = HOST_SET, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(std430, set = HOST_SET, binding = 1) readonly buffer Instances { Instance instances[]; };
layout(std430, set = HOST_SET, binding = 2) readonly buffer Indices { uint indices[]; };
layout(std430, set = HOST_SET, binding = 3) readonly buffer Draws { Draw draws[]; };
layout(std430, set = HOST_SET, binding = 4) readonly buffer DrawOf { uint draw_of[]; };     // of each triangle
layout(set = HOST_SET, binding = 7) uniform sampler2D bricks;
layout(set = HOST_SET, binding = 8) uniform utexture2D ids;
