// Numbers that the host and the shaders share: bindings, specialisation constants, counters, indirect dispatches. They are
// defined here alone, except those of `gpc_visibility.glsl`, which is for the shaders of hosts. `make shaders` copies them by
// name into `src/engine/spirv.rs`, with the interfaces that it finds in the compiled shaders. A name that begins with the
// name of a shader belongs to this shader alone.
#ifndef INTERFACE_GLSL
#define INTERFACE_GLSL

// Descriptor sets. Set 0 has the uniform blocks of all passes of a frame. Set 1 has other data of a frame: each shader has a set
// of what it uses. Set 2 has the textures of a material, or is a set of the shader's own beside the frame's. Shaders without a
// frame have one set. The uniform blocks have a set of their own: STAYS_BOUND of workarounds.glsl.
#define SET_FRAME 0
#define SET_DATA 1
#define SET_TEXTURES 2
#define SET_BESIDE_FRAME 2
#define SET_OWN 0

// Bindings of the frame's sets.
#define BINDING_FRAME 0
#define BINDING_POSITIONS 1
#define BINDING_TRIANGLES 2
#define BINDING_NORMALS 3
#define BINDING_TANGENTS 4
#define BINDING_UVS 5
#define BINDING_COLORS 6
#define BINDING_MATERIALS 7
#define BINDING_LIGHTS 8
#define BINDING_ALPHA_ATLAS 9
#define BINDING_INSTANCE_OF 10
#define BINDING_INSTANCES 11
#define BINDING_IDS 12
#define BINDING_BLEND_IDS 13
#define BINDING_IDS_MS 14
#define BINDING_BLEND_IDS_MS 15
#define BINDING_DISPLAY 16
#define BINDING_DISPLAY_OUT 17
#define BINDING_COLOR 18
#define BINDING_COUNTERS 19
#define BINDING_MASKS 20
#define BINDING_TILES 21
#define BINDING_TILE_LISTS 22
#define BINDING_SURVIVORS 23
#define BINDING_CANDIDATES 24
#define BINDING_CANDIDATES_OUT 25
#define BINDING_HEADERS 26
#define BINDING_FRAGMENTS 27
#define BINDING_FRAGMENTS_OUT 28
#define BINDING_SHADED 29
#define BINDING_SHADED_OUT 30
#define BINDING_SHADE_ORDER 31
#define BINDING_PATTERN_OFFSETS 32
#define BINDING_BINS 33
#define BINDING_ARGUMENTS 34
#define BINDING_FILTERED 35
#define BINDING_ATTRIBUTES_OUT 36
#define BINDING_ENCODED 37
#define BINDING_PAIRS 38
#define BINDING_PAIRS_OUT 39
#define BINDING_RASTER_DEPTH 40
#define BINDING_MARKS 41
#define BINDING_LOCATIONS 42
#define BINDING_LOCATION_CELLS 43
#define BINDING_LOCATION_GROUPS 44
#define BINDING_TILE_LOADS 45
#define BINDING_MOMENT 46
#define BINDING_RESTING 47
#define BINDING_INFLUENCES 48
#define BINDING_DISPLACEMENTS 49
#define BINDING_POSITIONS_OUT 50
#define BINDING_NORMALS_OUT 51
#define BINDING_TANGENTS_OUT 52
#define BINDING_ENVIRONMENT_MAP 53
#define BINDING_STROKES 55
#define BINDING_SHADOW_WORDS 56
#define BINDING_LOCATION_ORDER 57
#define BINDING_CORNERS_OUT 58
#define BINDING_INDEXED_DRAWS_OUT 59
#define BINDING_SPREADS 60
#define BINDING_SPREADS_OUT 61
#define BINDING_FILTER_WEIGHTS 62
#define BINDING_PIXEL_COLORS 63

// Binding of the set of textures.
#define BINDING_TEXTURES 0

// Bindings of sets that only one shader or a few bind.
#define BINDING_DRAWS 0
#define BINDING_HOST_IMAGE 0
#define ADOPT_BINDING_INDICES 1
#define ADOPT_BINDING_TRIANGLES_OUT 2
#define ADOPT_BINDING_DRAW_OF_OUT 3
#define ALPHA_MAP_BINDING_MAP 0
#define ALPHA_MAP_BINDING_ATLAS 1
#define BINDING_VERTICES 1
#define COORDINATES_BINDING_COORDINATES_OUT 2
#define CROSSINGS_BINDING_LOADS 0
#define CROSSINGS_BINDING_SEEN 1
#define CROSSINGS_BINDING_CELL_MARKS 2
#define DISTRIBUTE_BINDING_LOADS 0
#define DISTRIBUTE_BINDING_RANKS 1
#define DISTRIBUTE_BINDING_ORDER_OUT 2
#define DISTRIBUTE_BINDING_CELLS_OUT 3
#define DISTRIBUTE_BINDING_GROUPS_OUT 4
#define DISTRIBUTE_BINDING_TILE_LOADS 5
#define DISTRIBUTE_BINDING_MASKS 6
#define DISTRIBUTE_BINDING_COUNTERS 7
#define DISTRIBUTE_BINDING_LOCATIONS 8
#define DISTRIBUTE_BINDING_ORDER 9
#define INDIRECT_BINDING_COMMANDS 0
#define INDIRECT_BINDING_COUNT 1
#define INDIRECT_BINDING_INSTANCES 2
#define INDIRECT_BINDING_DRAWS_OUT 3
#define INDIRECT_BINDING_MATRICES_OUT 4
#define INDIRECT_BINDING_FIRST_DRAWS 5
#define INDIRECT_BINDING_BLOCKS 6
#define INDIRECT_BINDING_TOTALS 7
#define MERGE_BINDING_WORDS 0
#define OCCLUDE_BINDING_WORDS 0
#define OCCLUDE_BINDING_LEFT 1
#define OCCLUDE_BINDING_MARKS_OF_PIXELS 2
#define PREFILTER_BINDING_TEXELS 0
#define PREFILTER_BINDING_RAYS 1
#define RECEIVERS_BINDING_LOCATIONS_OUT 0
#define TRANSFORM_BINDING_MATRICES 2
#define TRANSFORM_BINDING_POSITIONS_OUT 3

// IDs of specialisation constants of several shaders.
#define CONSTANT_LOCAL_SIZE 0
#define CONSTANT_TEAM 1
#define CONSTANT_TEXTURED 3
#define CONSTANT_ONE_UV_TRANSFORM 14
#define CONSTANT_BOX_FILTER 15
#define CONSTANT_TINTED 16
#define CONSTANT_ENVIRONMENT 17
#define CONSTANT_ENCODED 18
#define CONSTANT_ONE_TEXTURE_SIZE 19
#define CONSTANT_LOCATIONS 20
#define CONSTANT_POINTS 21
#define CONSTANT_INSTANCED 23
#define CONSTANT_TEAMS 24
#define CONSTANT_CELLS_OF_ENTRY 26
#define CONSTANT_SHADOW_WORDS 25
#define CONSTANT_TONEMAP 30
#define CONSTANT_TONEMAP_CODES 31
#define CONSTANT_BASE_COLOR_TEXTURE 40
#define CONSTANT_METALLIC_ROUGHNESS_TEXTURE 41
#define CONSTANT_NORMAL_TEXTURE 42
#define CONSTANT_OCCLUSION_TEXTURE 43
#define CONSTANT_EMISSIVE_TEXTURE 44
#define CONSTANT_SPECULAR_TEXTURE 45
#define CONSTANT_SPECULAR_COLOR_TEXTURE 46
#define CONSTANT_CLEARCOAT_TEXTURE 47
#define CONSTANT_CLEARCOAT_ROUGHNESS_TEXTURE 48
#define CONSTANT_CLEARCOAT_NORMAL_TEXTURE 49
#define CONSTANT_SHEEN_COLOR_TEXTURE 50
#define CONSTANT_SHEEN_ROUGHNESS_TEXTURE 51
#define CONSTANT_ANISOTROPY_TEXTURE 52
#define CONSTANT_IRIDESCENCE_TEXTURE 53
#define CONSTANT_IRIDESCENCE_THICKNESS_TEXTURE 54
#define CONSTANT_DIFFUSE_TRANSMISSION_TEXTURE 55
#define CONSTANT_DIFFUSE_TRANSMISSION_COLOR_TEXTURE 56
#define CONSTANT_TRANSMISSION_TEXTURE 57
#define CONSTANT_THICKNESS_TEXTURE 58
#define CONSTANT_SPECULAR_GLOSSINESS_TEXTURE 59
#define CONSTANT_VERTEX_FORMAT 60

// IDs of specialisation constants of one shader. `sample_lines` shares those of `sample`.
#define ADOPT_CONSTANT_SHORT 0
#define ADOPT_CONSTANT_INDEXED 1
#define ATTRIBUTES_CONSTANT_SUPERPIXELS 0
#define ATTRIBUTES_CONSTANT_GROWN 1
#define BIN_CONSTANT_STEP 0
#define CENTRES_CONSTANT_GATHER 0
#define COORDINATES_CONSTANT_OBJECT 0
#define CROSSINGS_CONSTANT_BLEND_IDS 1
#define CROSSINGS_CONSTANT_FOLDS 2
#define CULL_CONSTANT_THIN_ALONE 0
#define DETECT_CONSTANT_MODE 0
#define DETECT_CONSTANT_BLEND_IDS 1
#define DETECT_CONSTANT_THIN 2
#define DETECT_CONSTANT_TRANSPARENT 3
#define DETECT_CONSTANT_BEYOND 4
#define DISTRIBUTE_CONSTANT_STEP 0
#define DISTRIBUTE_CONSTANT_POINTS 1
#define ENCODE_CONSTANT_FORMAT 0
#define GROW_CONSTANT_BEYOND 0
#define INDIRECT_CONSTANT_STEP 0
#define MERGE_CONSTANT_ROWS 2
#define MERGE_CONSTANT_LIST 3
#define MERGE_CONSTANT_BY_PART 4
#define MERGE_CONSTANT_PART 5
#define OCCLUDE_CONSTANT_TRANSLUCENT 2
#define OCCLUDE_CONSTANT_ROWS 3
#define PATCH_CONSTANT_ENCODED 0
#define PATCH_CONSTANT_GROWN 1
#define PATCH_CONSTANT_ALL 2
#define PIXEL_FILTER_CONSTANT_REACH 0
#define PIXEL_FILTER_CONSTANT_SUPERSAMPLED 1
#define PIXEL_FILTER_CONSTANT_SUPERPIXELS 2
#define PIXEL_FILTER_CONSTANT_GROWN 3
#define PIXEL_FILTER_CONSTANT_WEIGHT_0 4
#define PIXEL_FILTER_CONSTANT_WEIGHT_1 5
#define PIXEL_FILTER_CONSTANT_WEIGHT_2 6
#define PIXEL_FILTER_CONSTANT_SLOPE_1 7
#define PIXEL_FILTER_CONSTANT_SLOPE_2 8
#define PIXEL_FILTER_CONSTANT_BEND_0 9
#define PIXEL_FILTER_CONSTANT_BEND_1 10
#define PIXEL_FILTER_CONSTANT_BEND_2 11
#define PIXEL_FILTER_CONSTANT_PREMULTIPLIED 12
#define POINTS_CONSTANT_ATTRIBUTES 2
#define RECEIVERS_CONSTANT_PIXELS 0
#define RECEIVERS_CONSTANT_DIFFUSE_TRANSMISSION 37
#define RESOLVE_CONSTANT_BLOCK 2
#define RESOLVE_CONSTANT_LAYERED 3
#define RESOLVE_CONSTANT_LIST 4
#define RESOLVE_CONSTANT_DISPLAY_CODES 5
#define RESOLVE_CONSTANT_BY_LINES 6
#define RESOLVE_CONSTANT_GROWS 7
#define SAMPLE_CONSTANT_PER_SAMPLE 2
#define SAMPLE_CONSTANT_HAS_MASK 3
#define SAMPLE_CONSTANT_LIST 4
#define SAMPLE_CONSTANT_LEFT_CELLS 5
#define SAMPLE_CONSTANT_BY_PART 6
#define SAMPLE_CONSTANT_ROWS 7
#define SAMPLE_CONSTANT_PART 8
#define SAMPLE_CONSTANT_APART 9
#define SAMPLE_CONSTANT_LONG 12
#define SAMPLE_CONSTANT_SPREAD 13
#define SAMPLE_LINES_CONSTANT_HEADER 10
#define SAMPLE_LINES_CONSTANT_LINES 11
#define SCATTER_CONSTANT_HAS_MASK 2
#define SCATTER_CONSTANT_HAS_BLEND 3
#define SCATTER_CONSTANT_ROWS 5
#define SETUP_CONSTANT_SCANNED 0
#define SHADE_CONSTANT_PIXELS 0
#define SHADE_CONSTANT_ONE_BIN 1
#define SHADE_CONSTANT_DISPLAY_CODES 2
#define SHADE_CONSTANT_VERTEX_COLORS 8
#define SHADE_CONSTANT_UNLIT 9
#define SHADE_CONSTANT_PUNCTUAL 10
#define SHADE_CONSTANT_LOCAL_LIGHTS 11
#define SHADE_CONSTANT_BLENDED 12
#define SHADE_CONSTANT_SPECULAR 32
#define SHADE_CONSTANT_CLEARCOAT 33
#define SHADE_CONSTANT_SHEEN 34
#define SHADE_CONSTANT_ANISOTROPY 35
#define SHADE_CONSTANT_IRIDESCENCE 36
#define SHADE_CONSTANT_DIFFUSE_TRANSMISSION 37
#define SHADE_CONSTANT_TRANSMISSION 38
#define SHADE_CONSTANT_SPECULAR_GLOSSINESS 39
#define SPANS_CONSTANT_ONE_BIN 2
#define THIN_CONSTANT_SELECT 0
#define THIN_CONSTANT_BLEND_IDS 1
#define THIN_CONSTANT_FOLDS 2
#define TRANSFORM_CONSTANT_OBJECT 0

// Indices into `counters`.
#define COUNTER_SUPERPIXELS 0
#define COUNTER_TILES 1
#define COUNTER_SURVIVORS 2
#define COUNTER_LARGE 3
#define COUNTER_OUTSIDE 4
#define COUNTER_BACKFACING 5
#define COUNTER_DEGENERATE 6
#define COUNTER_UNTOUCHING 7
#define COUNTER_ROUND_FIRST 8
#define COUNTER_NEXT_TILE 9
#define COUNTER_UNFINISHED 10
#define COUNTER_FRAGMENTS 11
#define COUNTER_PLAIN_TILES 12
#define COUNTER_MASKED_TILES 13
#define COUNTER_BLENDED_TILES 14
#define COUNTER_UNLISTED_TILES 15
#define COUNTER_ROUNDS 16
#define COUNTER_CANDIDATES_TOTAL 17
#define COUNTER_FRAGMENTS_TOTAL 18
#define COUNTER_SHADED_TOTAL 19
#define COUNTER_UNLISTED_TOTAL 20
#define COUNTER_PAIRS 21
#define COUNTER_THIN 22
#define COUNTER_RESAMPLED 23
#define COUNTER_PLAIN_LEFT 24
#define COUNTER_MASKED_LEFT 25
#define COUNTER_BLENDED_LEFT 26
#define COUNTER_STALLED 27
#define COUNTER_PLACED 28
#define COUNTER_LEFT_OUT 29
#define COUNTER_CELLS 30
#define COUNTER_GROUPS 31
#define COUNTER_REACH 32
#define COUNTER_WIDEST 33
#define COUNTER_THIN_LONG 34
#define COUNTER_WAITING 35
#define COUNTER_OWNERS 36
#define COUNTER_LAYERS 37
#define COUNTER_MOST_CELLS 38
#define COUNTER_REFINED 39

// Indices into `arguments`.
#define ARGUMENT_CULL 0
#define ARGUMENT_BIN_SMALL 1
#define ARGUMENT_BIN_LARGE 2
#define ARGUMENT_SETUP 3
#define ARGUMENT_SAMPLE_PLAIN 4
#define ARGUMENT_SAMPLE_MASKED 5
#define ARGUMENT_SAMPLE_BLENDED 6
#define ARGUMENT_SAMPLE_UNLISTED 7
#define ARGUMENT_SORT 8
#define ARGUMENT_THIN 9
#define ARGUMENT_GROUPS 10
#define ARGUMENT_PLAIN_LEFT 11
#define ARGUMENT_MASKED_LEFT 12
#define ARGUMENT_BLENDED_LEFT 13
#define ARGUMENT_TALLY 14
#define ARGUMENT_ENLIST 15
#define ARGUMENT_THIN_LONG 16
#define ARGUMENT_OWNERS 17
#define ARGUMENT_SCATTER 18
#define ARGUMENT_SCATTER_EVERY 19
#define ARGUMENT_LAYERS 20
#define ARGUMENT_FRAGMENTS 21
#define ARGUMENT_RESOLVE_PLAIN 22
#define ARGUMENT_RESOLVE_MASKED 23
#define ARGUMENT_RESOLVE_BLENDED 24
#define ARGUMENT_RESOLVE_UNLISTED 25
#define ARGUMENT_BIN_BUSY 26
#define ARGUMENT_SHADE 27

// What has been counted when `arguments` runs.
#define AFTER_DETECT 0u
#define AFTER_CULL 1u
#define AFTER_SAMPLE 2u
#define AFTER_FRAGMENTS 3u
#define AFTER_SPANS 4u
#define AFTER_THIN 5u
#define AFTER_GROUPS 6u
#define AFTER_LINES 7u
#define AFTER_PAIRS 8u
#define AFTER_SCATTER 9u

// What makes a pixel a superpixel, in `detect`.
#define DETECT_CONTRAST 0u
#define DETECT_EDGES 1u
#define DETECT_EXACT 2u
#define DETECT_BLENDED 3u
#define DETECT_EVERY 4u
#define DETECT_SECOND_DIFFERENCES 5u

// Steps of `bin`.
#define BIN_BUSY 0u
#define BIN_SMALL 1u
#define BIN_LARGE 2u

// Steps of `distribute`, in their order.
#define DISTRIBUTE_NUMBER 0u
#define DISTRIBUTE_LAY_OUT 1u
#define DISTRIBUTE_ARRANGE 2u
#define DISTRIBUTE_ENCLOSE 3u

// Steps of `indirect`, in their order.
#define INDIRECT_COMMANDS 0u
#define INDIRECT_BLOCKS 1u
#define INDIRECT_SUMS 2u
#define INDIRECT_PLACE 3u
// Draws of a block, which a workgroup takes.
#define INDIRECT_BLOCK 64u
// Flags of a list of draws.
#define INDIRECT_COUNTED 1u
#define INDIRECT_INDEXED 2u
#define INDIRECT_OBJECT 4u
#define INDIRECT_ALPHA_TESTED 8u
#define INDIRECT_DOUBLE_SIDED 16u
// What `indirect` counts, a word each: draws of the list, draws that fit, those of the latter that are not possible, and the
// triangles and the positions of the draws that fit.
#define TOTAL_FOUND 0
#define TOTAL_PLACED 1
#define TOTAL_IMPOSSIBLE 2
#define TOTAL_TRIANGLES 3
#define TOTAL_POSITIONS 4

// Steps of `scatter`, in their order.
#define SCATTER_CLEAR 0u
#define SCATTER_DEPTHS 1u
#define SCATTER_IDS 2u
#define SCATTER_COUNT 3u
#define SCATTER_PLACE 4u
#define SCATTER_LAYERS 5u
#define SCATTER_ORDER 6u

// How the spread of fragments is stored for pixel filters, by their bent function (spread.glsl): not at all, or by x squared or |x|.
#define SPREAD_NONE 0u
#define SPREAD_SQUARE 1u
#define SPREAD_ABSOLUTE 2u
// Texels of a superpixel's spread.
#define SPREAD_VECTORS 4u

// Formats that `encode` writes: premultiplied sRGB codes, premultiplied light, sRGB codes and straight alpha as in image files.
#define ENCODE_RGBA8_SRGB 0u
#define ENCODE_RGBA16F 1u
#define ENCODE_STRAIGHT_RGBA8 2u
// Words before the encoded pixels: two for each threshold of codes, those of colours before those of alpha.
#define ENCODE_THRESHOLD_WORDS 1024u
// Number of thresholds of a channel.
#define ENCODE_THRESHOLDS 255u

// Work lists of tiles, one for each kernel of `sample`: tiles with opaque triangles only; also with alpha-tested ones; also with
// BLEND ones; tiles without a list of candidates. The lists' counters and indirect dispatches have the same order.
#define TILE_LIST_PLAIN 0u
#define TILE_LIST_MASKED 1u
#define TILE_LIST_BLENDED 2u
#define TILE_LIST_UNLISTED 3u
#define TILE_LISTS 4u

// Formats of the components of a host's vertices: floats of 32 and of 16 bits, and unsigned and signed integers of 16 bits.
#define VERTEX_FLOAT 0u
#define VERTEX_HALF 1u
#define VERTEX_UNORM 2u
#define VERTEX_SNORM 3u

// How the vertices of a host's draw make triangles.
#define TOPOLOGY_LIST 0u
#define TOPOLOGY_STRIP 1u
#define TOPOLOGY_FAN 2u

// Flags of the vertices that `pose` moves: their normals are those of the triangles (flat shading); the transform is mirrored;
// the geometry has tangents.
#define POSE_FLAT 1u
#define POSE_INSIDE_OUT 2u
#define POSE_TANGENTS 4u

// Kinds of the corners of lines and points, and a flag: the corner is lit as if it faced the camera.
#define CORNER_LEFT 0u
#define CORNER_RIGHT 1u
#define CORNER_JOINT_CENTRE 2u
#define CORNER_JOINT_FIRST 3u
#define CORNER_JOINT_SECOND 4u
#define CORNER_DISC 5u
#define CORNER_FACES_CAMERA 0x80000000u

// Flags of an edge of a mesh.
#define EDGE_SMOOTH 1u
#define EDGE_DOUBLE_SIDED 2u

// Flag of an instance that mirrors its triangles.
#define INSTANCE_MIRRORED 1u

// Flags of an alpha map, and the wrap modes in the two bits of each axis.
#define ALPHA_TEXTURED 1u
#define ALPHA_NEAREST_MAG 2u
#define ALPHA_NEAREST_MIN 4u
#define ALPHA_NO_MIP 8u
#define ALPHA_NEAREST_MIP 16u
#define WRAP_REPEAT 0u
#define WRAP_MIRRORED_REPEAT 1u
#define WRAP_CLAMP_TO_EDGE 2u

// The number of the plane of a light that needs only one. Smaller numbers are faces of a cube of planes around a light.
#define SINGLE_PLANE 6u

// Number of samples from which on more pixels become superpixels, and a triangle is shaded once only where colours do not differ.
#define MANY_SAMPLES 128u

// Number of points of a pixel that `receivers` finds where shadows narrower than pixels are looked for: the centre and three others.
#define SHADOW_POINTS 4u

// Words that `distribute` has for a tile, see tile_locations.glsl.
#define LOAD_WORDS 35u

// Triangles that an invocation of the first dispatch of `thin` takes.
#define THIN_PER_INVOCATION 8u
#define FILTER_TRIANGLES 2048u

// Vectors of a material; material.glsl has their fields.
#define MATERIAL_BASE_COLOR 0u
#define MATERIAL_EMISSIVE_METALLIC 1u
#define MATERIAL_FACTORS 2u
#define MATERIAL_ALPHA 3u
#define MATERIAL_SPECULAR 4u
#define MATERIAL_CLEARCOAT 5u
#define MATERIAL_SHEEN 6u
#define MATERIAL_ANISOTROPY 7u
#define MATERIAL_IRIDESCENCE 8u
#define MATERIAL_DIFFUSE_TRANSMISSION 9u
#define MATERIAL_TRANSMISSION 10u
#define MATERIAL_VOLUME 11u
#define MATERIAL_SPECULAR_GLOSSINESS 12u
#define MATERIAL_UV_ROWS 13u        // two a texture, the base colour's first: (m00, m01, m02, uv set), (m10, m11, m12, 0)

// Tiles of a stretch, see load.glsl.
#define STRETCH 256

// Limit of a round for tiles without a list, in trials of a triangle in a tile. They take some tenths of a second on small GPUs,
// which is well below the time that systems allow a dispatch. FEWEST_TRIED entries of such tiles fit in every round.
#define MOST_TRIALS 0x10000000u
#define FEWEST_TRIED 4096u

// The longest list of candidates; a tile with more triangles has none. Loops over LONGEST_LIST candidates usually end within
// MOST_TRIPS (workarounds.glsl), since hidden candidates take few trips. If a team takes a block of one cell at a time, loops
// over SHORT_LIST opaque or alpha-tested candidates always do, and so do loops over SHORT_LAYERED if some are BLEND.
#define LONGEST_LIST 40000u
#define SHORT_LIST 2500u
#define SHORT_LAYERED 160u

// The most fragments that `sample_lines` makes of a cell in excess of its number of samples. Triangles that are seen in the same
// part of a cell have a fragment each.
#define MORE_FRAGMENTS 16u

#endif
