// Vertices in their place: positions in clip space, and vertices in the world.
#ifndef POSED_ACCESS
#define POSED_ACCESS readonly
#endif
layout(std430, set = HOST_SET, binding = 5) POSED_ACCESS buffer Positions { vec4 positions[]; };
layout(std430, set = HOST_SET, binding = 6) POSED_ACCESS buffer Posed { Vertex posed[]; };
