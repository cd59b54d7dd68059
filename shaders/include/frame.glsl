// The descriptor set that all passes of a frame share, and its uniform block.
// Numbers of bindings are in interface.glsl. `make shaders` writes the host's structure for the block.
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#include "interface.glsl"

// In place of the number of fragments in a header: its block lacked room or iterations, so that the cell keeps its colour.
const uint LEFT_BLOCK = 0x80000000u;

// Pixel positions are relative to the screen's centre, x right, y down. A region is the part of the screen that this frame
// renders; pixel (0, 0) is its upper left one.
layout(set = SET_FRAME, binding = BINDING_FRAME) uniform Frame {
    mat4 transform;         // position -> (pixel x * w, pixel y * w, z, w)
    vec4 eye;               // xyz relative to the geometry's origin
    vec4 view_direction;    // xyz unit; w = 1 for a parallel projection
    vec4 irradiance[9];     // of the environment, over pi, as spherical harmonics
    vec4 environment[3];    // rows of the rotation from world space to the environment's; w: factor on the map, its last level, 0
    vec4 background;        // premultiplied linear light
    vec2 raster_scale;      // pixel position -> normalised device coordinates of the region
    vec2 raster_offset;
    vec2 origin;            // position of the centre of the region's pixel (0, 0)
    uvec2 size;             // region in pixels
    uvec2 tiles;            // region in tiles of 8 x 4 pixels, rounded up
    uvec2 interior_low;     // pixels that the region owns, the rest being halo for detection
    uvec2 interior_high;    // exclusive
    vec2 gap;               // least difference in depth from a triangle to a separate surface behind it: depth * x + y
    uint triangle_count;    // with indices that stand for no triangle, see triangle.glsl
    uint first_mask;        // index of the first MASK triangle
    uint first_blend;       // index of the first BLEND triangle
    uint sample_count;      // sub-samples of a cell
    uint survivor_capacity; // room for triangles that `thin` selects and that `cull` keeps
    uint pair_capacity;     // room for pairs of a triangle and a tile
    uint list_capacity;     // room for candidates of a round
    uint fragment_capacity;   // room for visibility samples
    uint bin_count;         // material bins
    uint light_count;
    uint material_vectors;  // vectors of a material in `materials`
    uint contrast;          // largest difference of 8-bit codes that is no contrast
    uint alike;             // largest difference of 8-bit codes around a pixel with which a material is shaded once there
    float exposure;         // factor on radiance
    float footprint;        // side of the square that textures are filtered over at a pixel's centre, in pixels of the region
    float place_footprint;  // the same at the place of a visibility sample; BOX_FILTER: factor on the sides that the place holds
    float sample_footprint; // the same where a sub-sample tests alpha
    uint side;              // pixels of the region along an output pixel's side: k for k x k supersampling
    float reach;            // farthest that a sample lies from the centre of its cell's pixel, in pixels; at least half a pixel
    uint group_count;       // groups of cells, where cells are locations
    uvec2 seen_corner;      // texel of the images of IDs and depth that is the region's pixel (0, 0)
    uvec2 color_corner;     // texel of a host's image of colours that is this pixel
} frame;

// Data that one pass writes and another reads is bound twice: BOUND_TWICE of workarounds.glsl.
layout(set = SET_DATA, binding = BINDING_POSITIONS) uniform textureBuffer positions;
layout(set = SET_DATA, binding = BINDING_TRIANGLES) uniform utextureBuffer triangles;   // vertex indices; material | bin << 16 | HIGH_FREQUENCY << 30 | double-sided << 31
layout(set = SET_DATA, binding = BINDING_NORMALS) uniform textureBuffer normals;          // w: length in the world / in the mesh
layout(set = SET_DATA, binding = BINDING_TANGENTS) uniform textureBuffer tangents;
layout(set = SET_DATA, binding = BINDING_UVS) uniform textureBuffer uvs;
layout(set = SET_DATA, binding = BINDING_COLORS) uniform textureBuffer colors;

layout(set = SET_DATA, binding = BINDING_MATERIALS) uniform utextureBuffer materials;      // see material.glsl
struct Light {
    vec4 position_range;    // xyz relative to the geometry's origin; w = 1 / range^2, 0 for none
    vec4 direction_kind;    // xyz unit; w = 0 directional, 1 point, 2 spot
    vec4 color_scale;       // rgb; w = spot angular scale
    vec4 offset;            // x = spot angular offset
};
layout(std430, set = SET_DATA, binding = BINDING_LIGHTS) readonly buffer Lights { Light lights[]; };    // the scene's, then the bright parts of its environment: see environment.glsl
layout(set = SET_DATA, binding = BINDING_ALPHA_ATLAS) uniform utextureBuffer alpha_atlas;    // see alpha.glsl

layout(set = SET_DATA, binding = BINDING_INSTANCE_OF) uniform utextureBuffer instance_of;   // an instance for every 64 indices
layout(set = SET_DATA, binding = BINDING_INSTANCES) uniform utextureBuffer instances;     // see triangle.glsl
layout(set = SET_DATA, binding = BINDING_IDS) uniform utexture2D ids;
layout(set = SET_DATA, binding = BINDING_BLEND_IDS) uniform utexture2D blend_ids;
layout(set = SET_DATA, binding = BINDING_IDS_MS) uniform texture2DMS ids_ms;
layout(set = SET_DATA, binding = BINDING_BLEND_IDS_MS) uniform texture2DMS blend_ids_ms;
layout(set = SET_DATA, binding = BINDING_DISPLAY) uniform utextureBuffer display;
layout(std430, set = SET_DATA, binding = BINDING_DISPLAY_OUT) writeonly buffer DisplayOut { uint display_out[]; };
layout(std430, set = SET_DATA, binding = BINDING_COLOR) buffer Color { vec4 color[]; };
layout(std430, set = SET_DATA, binding = BINDING_COUNTERS) buffer Counters { uint counters[]; };
layout(std430, set = SET_DATA, binding = BINDING_MASKS) buffer Masks { uint masks[]; };
layout(std430, set = SET_DATA, binding = BINDING_TILES) buffer Tiles { uvec4 tiles[]; };   // candidates, first one (before: bits of a run, see bin.comp), first header, flags; then stretches, see load.glsl
layout(std430, set = SET_DATA, binding = BINDING_TILE_LISTS) buffer TileLists { uint tile_lists[]; };
layout(std430, set = SET_DATA, binding = BINDING_SURVIVORS) buffer Survivors { uint survivors[]; };
layout(set = SET_DATA, binding = BINDING_CANDIDATES) uniform utextureBuffer candidates;  // 4 vectors each, see setup.comp; or see owners.glsl
layout(std430, set = SET_DATA, binding = BINDING_CANDIDATES_OUT) buffer CandidatesOut { uvec4 candidates_out[]; };
layout(std430, set = SET_DATA, binding = BINDING_HEADERS) buffer Headers { uvec2 headers[]; };  // first fragment, count or LEFT_BLOCK
layout(set = SET_DATA, binding = BINDING_FRAGMENTS) uniform utextureBuffer fragments;
layout(std430, set = SET_DATA, binding = BINDING_FRAGMENTS_OUT) writeonly buffer FragmentsOut { uvec4 fragments_out[]; };
layout(set = SET_DATA, binding = BINDING_SHADED) uniform textureBuffer shaded;
layout(std430, set = SET_DATA, binding = BINDING_SHADED_OUT) writeonly buffer ShadedOut { vec4 shaded_out[]; };
layout(std430, set = SET_DATA, binding = BINDING_SHADE_ORDER) buffer ShadeOrder { uint shade_order[]; };
layout(set = SET_DATA, binding = BINDING_PATTERN_OFFSETS) uniform textureBuffer pattern_offsets;      // sub-sample offsets, pixels
layout(std430, set = SET_DATA, binding = BINDING_BINS) buffer Bins { uvec4 bins[]; };        // count, first, cursor, 0
layout(std430, set = SET_DATA, binding = BINDING_ARGUMENTS) buffer Arguments { uvec4 arguments[]; }; // indirect dispatches

layout(set = SET_DATA, binding = BINDING_PAIRS) uniform utextureBuffer pairs;       // triangle, and its tile and rank there, see pairs.glsl
layout(std430, set = SET_DATA, binding = BINDING_PAIRS_OUT) writeonly buffer PairsOut { uvec2 pairs_out[]; };
// Three words for each tile, a bit a pixel, in three arrays one after the other:
// - pixels that a thin triangle crosses unseen (`thin`, `occlude`); later cells that a PROBE leaves
// - the same for triangles close to a surface, like paint; later pixels that contrast with a superpixel beside them
// - all superpixels before the last growth (`grow`)
layout(std430, set = SET_DATA, binding = BINDING_MARKS) buffer Marks { uint marks[]; };

// (n % width, n / width). Integer division is a loop on CPU devices. For quotients below 2^21 the quotient of floats is off by
// one at the most, and is then corrected. Vulkan lets a division be off by 2.5 units in the last place.
uvec2 split(uint n, uint width) {
    uint q = uint(float(n) * (1.0 / float(width)));
    int r = int(n - q * width);
    q = r < 0 ? q - 1u : r >= int(width) ? q + 1u : q;
    return uvec2(n - q * width, q);
}

// What the centre of a pixel of the region sees: ID of a triangle, or 0.
uint id_at(ivec2 pixel) {
    return texelFetch(ids, ivec2(frame.seen_corner) + pixel, 0).x;
}

// The fields of a triangle's last word: its material; its bin or shading key; whether lighting or textures may change within a
// pixel; whether back faces are invisible.
uint material_of(uint word) { return word & 0xffffu; }
uint bin_of(uint word) { return word >> 16 & 0x3fffu; }
bool high_frequency(uint word) { return (word >> 30 & 1u) != 0u; }
bool single_sided(uint word) { return (word >> 31) == 0u; }

#include "groups.glsl"
