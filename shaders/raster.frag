// raster: writes the triangle ID of each pixel, or of each sample under MSAA. `shade` makes the colours later.
// MASKED discards fragments with an alpha below the cutoff. BYTES splits the ID over four 8-bit channels, since devices need
// not support multisampled attachments of integers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/frame.glsl"
layout(location = 0) flat in uint triangle_id;
#ifdef BYTES
layout(location = 0) out vec4 id;
#else
layout(location = 0) out uint id;
#endif
#ifdef MASKED
#include "include/alpha.glsl"
#endif

void main() {
#ifdef MASKED
    vec2 p = frame.origin + floor(gl_FragCoord.xy);
    if (!alpha_passes(alpha_test(triangle_id - 1u, p, vec2(0.0), mat2(frame.sample_footprint)), vec2(0.0))) discard;
#endif
#ifdef BYTES
    id = unpackUnorm4x8(triangle_id);
#else
    id = triangle_id;
#endif
}
