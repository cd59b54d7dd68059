// Writes a draw for each object that may be in the view. An invocation takes an object.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "gpc_instance.glsl"
layout(local_size_x = 64) in;

struct DrawIndexedIndirectCommand {
    uint index_count;
    uint instance_count;
    uint first_index;
    int vertex_offset;
    uint first_instance;
};

layout(std430, set = SCENE_SET, binding = 2) writeonly buffer Commands { DrawIndexedIndirectCommand commands[]; };
layout(std430, set = SCENE_SET, binding = 3) buffer Count { uint count; };
layout(std430, set = SCENE_SET, binding = 4) writeonly buffer Instances { GpcInstance instances[]; };
layout(push_constant) uniform Push {
    mat4 to_clip;           // of the world
    uint object_count;
    uint capacity;          // of commands
} push;

// Whether a sphere lies outside of a side of the view. `side` is a row of the matrix, added to the last one.
bool outside(vec4 side, vec3 centre, float radius) { return dot(side.xyz, centre) + side.w < -radius * length(side.xyz); }

void main() {
    uint object = gl_GlobalInvocationID.x;
    if (object >= push.object_count) return;
    mat4 to_world = objects[object].to_world, rows = transpose(push.to_clip);
    vec3 centre = to_world[3].xyz;
    // The box reaches from -1 to 1 along each axis.
    float radius = length(to_world[0].xyz) + length(to_world[1].xyz) + length(to_world[2].xyz);
    if (outside(rows[3] + rows[0], centre, radius) || outside(rows[3] - rows[0], centre, radius)
        || outside(rows[3] + rows[1], centre, radius) || outside(rows[3] - rows[1], centre, radius)
        || outside(rows[3], centre, radius)) return;
    uint slot = atomicAdd(count, 1u);
    if (slot >= push.capacity) return;
    commands[slot] = DrawIndexedIndirectCommand(INDEX_COUNT, 1u, 0u, 0, slot);
    instances[slot] = GpcInstance(push.to_clip * to_world, VERTEX_COUNT, 0u, object, 0u, 0u, 0u, 0u, 0u);
}
