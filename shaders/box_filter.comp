// box_filter: averages k x k supersampled pixels to an output pixel, which an invocation takes.
// Reads: color of a region at k times the resolution (linear light, as in the output). Writes: filtered.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
layout(local_size_x = 64) in;
layout(set = SET_DATA, binding = BINDING_FILTERED, rgba32f) uniform writeonly imageBuffer filtered;

layout(push_constant) uniform Push { uint side; } push;

void main() {
    uint i = invocation_number();
    uvec2 size = frame.size / push.side;
    if (i >= size.x * size.y) return;
    uvec2 low = split(i, size.x) * push.side;
    vec4 sum = vec4(0.0);
    for (uint y = 0u; y < push.side; y++) {
        vec4 row = vec4(0.0);
        for (uint x = 0u; x < push.side; x++) row += color[(low.y + y) * frame.size.x + low.x + x];
        sum += row;
    }
    imageStore(filtered, int(i), sum / float(push.side * push.side));
}
