// neighbours: cells of an output beside superpixels, which contrast with what these were found to show, as `resolve` marks pixels.
// Superpixels of an output are locations of lists, so that `resolve` knows none beside another. `grow` reads the marks.
// Reads: masks, color, display. Writes: marks.
// An invocation takes a cell. Twin: src/reference/grow.rs.
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
