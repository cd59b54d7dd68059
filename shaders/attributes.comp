// attributes: for callers that ask for it, what the centre of a pixel sees besides its colour. An invocation takes an output
// pixel.
// Reads: ids, the geometry, masks, marks. Writes: two vectors a pixel, floats as bits:
// (distance along the view direction, ID, sub-samples, superpixel 0 or 1), (world normal, 0).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/barycentric.glsl"
#include "include/triangle.glsl"
layout(local_size_x = 64) in;
layout(constant_id = ATTRIBUTES_CONSTANT_SUPERPIXELS) const bool SUPERPIXELS = false;
layout(constant_id = ATTRIBUTES_CONSTANT_GROWN) const bool GROWN = false;       // masks hold only what `grow` added last
layout(std430, set = SET_DATA, binding = BINDING_ATTRIBUTES_OUT) writeonly buffer AttributesOut { uvec4 attributes_out[]; };

void main() {
    uint i = invocation_number();
    // With supersampling, the pixel in the middle of the grid stands for the output pixel.
    uint side = frame.side;
    uvec2 size = frame.size / side;
    if (i >= size.x * size.y) return;
    uvec2 pixel = split(i, size.x) * side + side / 2u;
    uint id = id_at(ivec2(pixel));
    Triangle k = triangle_at(max(id, 1u) - 1u);
    Barycentric w = barycentric(k.v0, k.v1, k.v2, frame.origin + vec2(pixel));
    float distance_ = dot(position_of(k, w.at) - frame.eye.xyz, frame.view_direction.xyz);
    vec3 n = normal_of(k, w.at);
    n *= inversesqrt(max(dot(n, n), 1e-30));
    uint tile = pixel.y / 4u * frame.tiles.x + pixel.x / 8u;
    uint word = SUPERPIXELS ? masks[tile] : 0u;
    if (GROWN) word |= marks[2u * frame.tiles.x * frame.tiles.y + tile];
    bool super = (word >> (pixel.y % 4u * 8u + pixel.x % 8u) & 1u) != 0u;
    bool hit = id != 0u;
    attributes_out[2u * i] = uvec4(floatBitsToUint(hit ? distance_ : 0.0), id, super ? frame.sample_count : side * side, uint(super));
    attributes_out[2u * i + 1u] = uvec4(floatBitsToUint(hit ? n : vec3(0.0)), 0u);
}
