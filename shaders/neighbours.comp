// neighbours: marks cells of an output that lie beside a superpixel and contrast with its resolved colour, for `grow`. In frames,
// `resolve` does this. Superpixels of an output are sampled as locations of a list, where `resolve` does not know which cells
// lie beside each other.
// Reads: masks, color, display. Writes: marks.
// An invocation takes a cell. Twin: twins/src/grow.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
#include "include/workgroup.glsl"
#include "include/color.glsl"
#include "include/seen_beside.glsl"
layout(local_size_x = 64) in;

void main() {
    uint i = invocation_number();
    if (i >= frame.size.x * frame.size.y) return;
    uvec2 cell = split(i, frame.size.x);
    uint word = masks[cell.y / 4u * frame.tiles.x + cell.x / 8u];
    if ((word >> (cell.y % 4u * 8u + cell.x % 8u) & 1u) != 0u) mark_contrasting_neighbours(cell, display_code(color[i]));
}
