// What an application's shader needs to shade visibility samples with its own materials.
//
// A compute shader of 64 invocations a workgroup, dispatched once for each shading key and round:
//
//     #version 460
//     #extension GL_GOOGLE_include_directive : require
//     #define GPC_SET 0                       // the set that the samples' descriptors are bound to
//     #include "gpc_visibility.glsl"
//     layout(local_size_x = 64) in;
//     layout(push_constant) uniform Push { uint key; };
//
//     void main() {
//         GpcSample s;
//         if (!gpc_sample(key, s)) return;
//         vec3 normal = mat3(normals[s.vertices.x], normals[s.vertices.y], normals[s.vertices.z]) * s.weights;
//         gpc_store(s, vec4(shade(normal), 1.0));
//     }
//
// A visibility sample is four words:
//     x   pixel: x | y << 16; in a list of locations, the index of its location in the lower 31 bits
//     y   triangle ID: 1 + index of the triangle in the order of the frame's draws
//     z   place in the pixel: offset from its centre, x and y in 12 bits each, signed, in units of 2^-12 of a pixel, and
//         above them how large a part of the pixel the sample stands for (place.glsl)
//     w   weight in the pixel, in samples, as a float
#ifndef GPC_VISIBILITY_GLSL
#define GPC_VISIBILITY_GLSL
#include "place.glsl"
#include "place_in_tile.glsl"
#include "barycentric.glsl"

#ifndef GPC_SET
#define GPC_SET 0
#endif

// Version of the interface between this file and the library: bindings, the words of a visibility sample,
// functions. gpc_check_shader reads it from a shader's SPIR-V. An application's own constants need other IDs.
layout(constant_id = 2046) const uint GPC_SHADER_VERSION = 1u;

layout(set = GPC_SET, binding = 0) uniform GpcFrame {
    vec2 scale;         // from clip space to (pixels from `middle`) * w
    vec2 middle;        // where the middle of clip space lies in the image, in pixels
    float place_side;   // side of the square that textures are filtered over, in pixels; with `box`, a factor on the sides in a
                        // sample's place
    uint box;           // whether each place says how wide and how high a part of the pixel it stands for
    uint list;          // whether the samples are those of a list of locations, not of pixels
} gpc_frame;
layout(std430, set = GPC_SET, binding = 1) readonly buffer GpcKeys { uvec4 gpc_keys[]; };           // number of samples, first in gpc_order
layout(std430, set = GPC_SET, binding = 2) readonly buffer GpcOrder { uint gpc_order[]; };          // indices in gpc_fragments
layout(std430, set = GPC_SET, binding = 3) readonly buffer GpcFragments { uvec4 gpc_fragments[]; };
layout(std430, set = GPC_SET, binding = 4) readonly buffer GpcTriangles { uvec4 gpc_triangles[]; }; // three positions; key << 16 and flags
layout(std430, set = GPC_SET, binding = 5) readonly buffer GpcPositions { vec4 gpc_positions[]; };  // clip space
layout(std430, set = GPC_SET, binding = 6) writeonly buffer GpcShaded { vec4 gpc_shaded[]; };
// Two vectors a draw. Of the second, z is added to the index of a position for that of the vertex, and w is the material.
layout(std430, set = GPC_SET, binding = 7) readonly buffer GpcDraws { uvec4 gpc_draws[]; };
layout(std430, set = GPC_SET, binding = 8) readonly buffer GpcDrawOf { uint gpc_draw_of[]; };       // draw of each triangle
layout(std430, set = GPC_SET, binding = 9) readonly buffer GpcLocations { uvec4 gpc_locations[]; }; // two each: pixel and place in it; Jacobian

struct GpcSample {
    uint fragment;      // index, for gpc_store
    uint triangle;      // index in the order of the frame's draws
    uint draw;          // index of its draw
    uint material;      // that of its draw
    uvec3 vertices;     // indices, the draw's vertex offset added; the second and the third are exchanged if the draw's front
                        // faces are clockwise
    uint location;      // of a list: the index of its location
    vec2 position;      // in the image, in pixels from its upper left corner, y down
    vec3 weights;       // barycentric coordinates, perspective-correct: an attribute is the weighted sum of the vertices' values
    vec3 dx, dy;        // change of the weights across the rectangle that the sample stands for, to the right and down: with
                        // them as weights, an attribute's gradients for textureGrad, or for gpc_texture.glsl
    vec2 right, down;   // the sides of this rectangle, in pixels of the image
    bool front;         // whether the triangle is seen from its front
};

// Gets this invocation's sample among those of a key; returns false if there is none.
bool gpc_sample(uint key, out GpcSample s) {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u;
    uvec4 listed = gpc_keys[key];
    s.fragment = gpc_order[listed.y + min(i, max(listed.x, 1u) - 1u)];
    uvec4 fragment = gpc_fragments[s.fragment];
    s.triangle = max(fragment.y, 1u) - 1u;
    uvec4 words = gpc_triangles[s.triangle];
    s.draw = gpc_draw_of[s.triangle];
    uvec4 draw = gpc_draws[2u * s.draw + 1u];
    s.vertices = words.xyz + draw.z;
    s.material = draw.w;
    vec2 place = place_location(fragment.z), centred;
    mat2 jacobian = mat2(1.0);
    s.location = gpc_frame.list != 0u ? fragment.x & 0x7fffffffu : 0u;
    if (gpc_frame.list != 0u) {
        uvec4 at = gpc_locations[2u * s.location];
        vec4 axes = uintBitsToFloat(gpc_locations[2u * s.location + 1u]);
        jacobian = mat2(axes.xy, axes.zw);
        // Relative to the middle of a tile of 8 x 4 pixels, as where the location is sampled.
        vec2 tile = vec2((ivec2(at.xy) & ~ivec2(7, 3)) + ivec2(4, 2)) - gpc_frame.middle;
        centred = tile + place_in_tile(at) + jacobian * place;
    } else {
        centred = vec2(fragment.x & 0xffffu, fragment.x >> 16) + 0.5 - gpc_frame.middle + place;
    }
    s.position = centred + gpc_frame.middle;
    vec4 scale = vec4(gpc_frame.scale, 1.0, 1.0);
    Barycentric b = barycentric(gpc_positions[words.x] * scale, gpc_positions[words.y] * scale, gpc_positions[words.z] * scale, centred);
    vec2 sides = gpc_frame.place_side * (gpc_frame.box != 0u ? place_sides(fragment.z) : vec2(1.0));
    s.weights = b.at;
    mat2x3 change = mat2x3(b.dx, b.dy);
    if (gpc_frame.list != 0u) change = change * jacobian;
    s.dx = change[0] * sides.x;
    s.dy = change[1] * sides.y;
    s.right = jacobian[0] * sides.x;
    s.down = jacobian[1] * sides.y;
    s.front = b.facing;
    // The version is read here since compilers drop a constant that nothing reads.
    return i < listed.x && GPC_SHADER_VERSION != 0u;
}

// Part number `i` of side x side equal parts of a sample. With material code that can't use gradients, shade all parts and store
// the mean:
//
//     vec4 light = vec4(0.0);
//     for (uint i = 0u; i < 16u; ++i) light += material(gpc_part(s, i, 4u));
//     gpc_store(s, light / 16.0);
GpcSample gpc_part(GpcSample s, uint i, uint side) {
    float share = 1.0 / float(side);
    vec2 at = (vec2(i % side, i / side) + 0.5) * share - 0.5;
    s.position += at.x * s.right + at.y * s.down;
    s.weights += at.x * s.dx + at.y * s.dy;
    s.dx *= share;
    s.dy *= share;
    s.right *= share;
    s.down *= share;
    return s;
}

// Writes the colour of a sample: light, in the linear space in which the image's colours are averaged, and opacity. Light is not
// premultiplied by the opacity. If the draw is not blended, the opacity is ignored, and the sample's alpha is 1.
void gpc_store(GpcSample s, vec4 light) {
    gpc_shaded[s.fragment] = light;
}

#endif
