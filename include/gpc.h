// gpc: antialiases the pixels of a Vulkan application's own frames that alias, shaded by its own pipelines.
//
// An application draws its frame as ever, and one more attachment of triangle IDs, or leaves some or all of that to the
// library. gpc_frame_record then finds the pixels that alias, samples the application's triangles there, has the application
// shade what the samples see, and draws the resolved pixels over the aliased ones, all in the application's command buffer.
// docs/embedding.md is the manual.
//
// - Functions that can fail answer a GpcResult; gpc_last_error has the message. No error leaves anything behind, and no
//   panic of the library crosses this boundary.
// - A struct that is handed over is first filled by its gpc_init function, which sets size, type and defaults. Later versions of
//   the library may add members to its end, and take structs without them. So may they of GpcDraw, GpcMesh and GpcAlphaMap, which stand
//   in arrays: set what an application does not use to 0. GpcImageState, GpcImage, GpcLocation and GpcMemory stay as they are.
// - Numbers of type uint32_t that stand for one of a few values name the enumeration that has them.
// - A pointer or handle is null, which is an error where nothing else is said, or alive, of the type named and of the device
//   lent. That it is null is found out; the rest is the application's affair, as with Vulkan itself.

#if defined(__cplusplus) && __cplusplus < 201103L && !defined(_MSC_VER)
#error "gpc.h needs C++11 or later: compile with -std=c++11"
#endif


#pragma once

// Made by cbindgen of src/capi; do not edit.

#include <stdint.h>
#include <vulkan/vulkan_core.h>

// The version of Vulkan that instance and device are created for: 1.3, as in VkApplicationInfo.apiVersion. No extension is
// needed; GpcDevice.conditional_rendering names one that saves time.
#define GPC_VULKAN_API_VERSION ((1 << 22) | (3 << 12))

// The value of GpcOptions.contrast for the threshold that suits the samples: 6, and 1 from 128 samples on.
#define GPC_CONTRAST_OF_SAMPLES UINT32_MAX

// The value of GpcOptions.growths for the number that suits the samples: 1, and 2 from 128 samples on.
#define GPC_GROWTHS_OF_SAMPLES UINT32_MAX

// The version of the header: gpc_version says that of the library.
#define GPC_VERSION_MAJOR 0

// See GPC_VERSION_MAJOR.
#define GPC_VERSION_MINOR 2

// See GPC_VERSION_MAJOR.
#define GPC_VERSION_PATCH 0

// The version of the header as one number, larger for later versions; packed as by VK_MAKE_API_VERSION.
#define GPC_VERSION (((GPC_VERSION_MAJOR << 22) | (GPC_VERSION_MINOR << 12)) | GPC_VERSION_PATCH)

// The version of the binary interface: it changes only if programs that were compiled with an earlier header have to be
// compiled again. The shared library's name has it: libgpc.so.1.
#define GPC_ABI_VERSION 1

// What a function answers.
enum GpcResult
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // It did what was asked.
    GPC_RESULT_SUCCESS = 0,
    // A pointer is NULL or a handle VK_NULL_HANDLE.
    GPC_RESULT_NULL = 1,
    // A size or a stride is none that the struct has in this or an earlier version of the header: it was not set, or the
    // application was compiled with the header of a later version.
    GPC_RESULT_STRUCT_SIZE = 2,
    // A value is none of those possible, or contradicts another.
    GPC_RESULT_VALUE = 3,
    // A recording has more draws, triangles, vertices or indices than its frame was created for.
    GPC_RESULT_CAPACITY = 4,
    // The device, its instance or its loader lacks something that is needed.
    GPC_RESULT_UNSUPPORTED = 5,
    // Memory ran out, or GpcOptions.max_memory allows too little.
    GPC_RESULT_OUT_OF_MEMORY = 6,
    // The device was lost.
    GPC_RESULT_DEVICE_LOST = 7,
    // The driver refused something else.
    GPC_RESULT_VULKAN = 8,
    // A defect of the library. What took part in the call is to be destroyed and not used otherwise.
    GPC_RESULT_PANIC = 9,
    // The commands of the last recording are not done, or there was none.
    GPC_RESULT_NOT_READY = 10,
    // The member `type` of a struct is of another struct, or its member `next` leads to one that the library does not know.
    GPC_RESULT_STRUCT_TYPE = 11,
    // A shader was compiled with no gpc_visibility.glsl, or with one of a version that the library does not take.
    GPC_RESULT_SHADER_VERSION = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcResult GpcResult;
#else
typedef uint32_t GpcResult;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a struct is: the value of its member `type`, which its gpc_init function sets.
enum GpcStructType
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A GpcDevice.
    GPC_STRUCT_TYPE_DEVICE = 1,
    // A GpcGeometry.
    GPC_STRUCT_TYPE_GEOMETRY = 2,
    // A GpcImages.
    GPC_STRUCT_TYPE_IMAGES = 3,
    // A GpcOptions.
    GPC_STRUCT_TYPE_OPTIONS = 4,
    // A GpcScenery.
    GPC_STRUCT_TYPE_SCENERY = 5,
    // A GpcVisibilitySamples.
    GPC_STRUCT_TYPE_VISIBILITY_SAMPLES = 6,
    // A GpcOutcome.
    GPC_STRUCT_TYPE_OUTCOME = 7,
    // A GpcLocationList.
    GPC_STRUCT_TYPE_LOCATION_LIST = 8,
    // A GpcListScenery.
    GPC_STRUCT_TYPE_LIST_SCENERY = 9,
    // A GpcListOutcome.
    GPC_STRUCT_TYPE_LIST_OUTCOME = 10,
    // A GpcMemoryRequest.
    GPC_STRUCT_TYPE_MEMORY_REQUEST = 11,
    // A GpcImageKinds.
    GPC_STRUCT_TYPE_IMAGE_KINDS = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcStructType GpcStructType;
#else
typedef uint32_t GpcStructType;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Where memory lies.
enum GpcMemoryUse
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // On the device.
    GPC_MEMORY_USE_DEVICE = 0,
    // Written by the CPU, read by the device: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT.
    GPC_MEMORY_USE_UPLOAD = 1,
    // Written by the device, read by the CPU: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, at best
    // VK_MEMORY_PROPERTY_HOST_CACHED_BIT too.
    GPC_MEMORY_USE_READBACK = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcMemoryUse GpcMemoryUse;
#else
typedef uint32_t GpcMemoryUse;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What positions are.
enum GpcPositionSpace
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Four floats in clip space: the very values of the vertex shader's gl_Position.
    GPC_POSITION_SPACE_CLIP = 0,
    // Three floats in a space of each draw's own, from which GpcDraw.to_clip leads to clip space.
    GPC_POSITION_SPACE_OBJECT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcPositionSpace GpcPositionSpace;
#else
typedef uint32_t GpcPositionSpace;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How the corners of a draw make triangles: which of its indices, or of its vertices where there are none, belong to which.
// Primitive restart is not known: a draw is one strip or fan.
enum GpcTopology
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST: each three make one.
    GPC_TOPOLOGY_LIST = 0,
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP: each one from the third on makes one with the two before it.
    GPC_TOPOLOGY_STRIP = 1,
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN: each one from the third on makes one with the one before it and the first.
    GPC_TOPOLOGY_FAN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcTopology GpcTopology;
#else
typedef uint32_t GpcTopology;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Where in a superpixel the samples lie.
enum GpcPattern
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The first points of a scrambled Sobol sequence: any count.
    GPC_PATTERN_SOBOL = 0,
    // A turned lattice; of counts that are no square, as GPC_PATTERN_KOROBOV.
    GPC_PATTERN_LATTICE = 1,
    // The best lattice of rank 1: any count.
    GPC_PATTERN_KOROBOV = 2,
    // The centres of a square grid: square counts only.
    GPC_PATTERN_GRID = 3,
    // The standard locations of Vulkan: 1, 2, 4, 8 or 16 samples.
    GPC_PATTERN_ROTATED = 4,
    // GpcOptions.locations.
    GPC_PATTERN_LIST = 5,
    // 512 or 1,024 samples on straight lines; the count decides in how many places a superpixel is shaded. Below 16 samples, and
    // where each sample is shaded, as GPC_PATTERN_SOBOL. Any count.
    GPC_PATTERN_LINES = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcPattern GpcPattern;
#else
typedef uint32_t GpcPattern;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How often the inside of a superpixel is shaded.
enum GpcShading
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Once a visible triangle.
    GPC_SHADING_TRIANGLE = 0,
    // Once a visible triangle, but in several parts of the pixel where the colours around it vary.
    GPC_SHADING_PART = 1,
    // Once a sample.
    GPC_SHADING_SAMPLE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcShading GpcShading;
#else
typedef uint32_t GpcShading;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What makes a pixel a superpixel.
enum GpcDetection
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A contrasting colour beside it.
    GPC_DETECTION_CONTRAST = 0,
    // Another triangle in a contrasting colour beside it.
    GPC_DETECTION_EDGES = 1,
    // Another triangle beside it.
    GPC_DETECTION_EXACT = 2,
    // Nothing: every pixel is one. To measure with.
    GPC_DETECTION_EVERY = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcDetection GpcDetection;
#else
typedef uint32_t GpcDetection;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What frames of one device share: layouts, and the pipelines made so far.
typedef struct GpcAntialiaser GpcAntialiaser;

// Pipelines and memory to antialias one frame in flight.
typedef struct GpcFrame GpcFrame;

// Pipelines and memory to sample the locations of a list, of one frame in flight.
typedef struct GpcList GpcList;

// Memory that a buffer or an image of the library needs.
typedef struct GpcMemoryRequest {
    // The library's sizeof(GpcMemoryRequest).
    uint32_t size;
    // GPC_STRUCT_TYPE_MEMORY_REQUEST.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // What it is for, for a log: UTF-8, alive until the function returns.
    const char *name;
    // Its size, alignment and possible types.
    VkMemoryRequirements requirements;
    // Where it lies: a GpcMemoryUse.
    uint32_t usage;
    // VK_TRUE for a buffer, VK_FALSE for an image of optimal tiling: see VkPhysicalDeviceLimits.bufferImageGranularity.
    VkBool32 linear;
} GpcMemoryRequest;

// Memory that the application allocated.
typedef struct GpcMemory {
    // The memory.
    VkDeviceMemory memory;
    // Where in it, in bytes: a multiple of the alignment that was asked for.
    uint64_t offset;
    // The address at which that offset is mapped; NULL for memory of the device that is not mapped, or not coherent.
    void *mapped;
    // The application's own.
    void *user;
} GpcMemory;

// Allocates memory of the device that was lent: as large and aligned as asked for, of one of the types asked for, used by nobody
// else until it is freed. VK_FALSE where memory ran out. It must not throw or jump out, and must not use the library.
//
// Threads: it is called by those that create antialiasers, frames and lists, several at once if the application has several do so.
typedef VkBool32 (*GpcAllocate)(void *user, const struct GpcMemoryRequest *request, struct GpcMemory *memory);

// Frees memory that a GpcAllocate gave. No command uses it any more. It must not throw or jump out, and must not use the library.
//
// Threads: as GpcAllocate, and those that destroy.
typedef void (*GpcFree)(void *user, const struct GpcMemory *memory);

// A device that the application lends; gpc_init_device fills it.
typedef struct GpcDevice {
    // sizeof(GpcDevice).
    uint32_t size;
    // GPC_STRUCT_TYPE_DEVICE.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // The family, with graphics and compute, of the queue that commands will be submitted to.
    uint32_t queue_family;
    // VK_TRUE if the device was created with VK_EXT_conditional_rendering and its feature conditionalRendering, which is not
    // needed: without it, rounds of a frame that have nothing to do take some time.
    VkBool32 conditional_rendering;
    // VK_TRUE if the instance was created with VK_EXT_debug_utils: buffers, images and pipelines of the library then have names,
    // which begin with "gpc", and dispatches have labels.
    VkBool32 debug_utils;
    // All functions of Vulkan are taken from it: of the loader that made the instance.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    // The instance, created for GPC_VULKAN_API_VERSION or later.
    VkInstance instance;
    // The physical device; see gpc_check_device.
    VkPhysicalDevice physical_device;
    // The device, created with the features that gpc_require_features sets.
    VkDevice device;
    // A cache that pipelines are made with, which outlives the antialiaser and its frames; it was not created with
    // VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT. VK_NULL_HANDLE for none.
    VkPipelineCache pipeline_cache;
    // Functions for device memory, both or none. Without them, the library has an allocator of its own.
    GpcAllocate allocate;
    // See `allocate`.
    GpcFree free;
    // Handed to both.
    void *memory_user;
} GpcDevice;

// A run of triangles that are shaded alike.
typedef struct GpcDraw {
    // Its first index; of a mesh without indices, its first vertex, counted from `vertex_offset`.
    uint32_t first_index;
    // How many triangles it has.
    uint32_t triangle_count;
    // Added to each of its indices.
    int32_t vertex_offset;
    // With GPC_POSITION_SPACE_OBJECT, how many vertices it has, from `vertex_offset` on. Larger indices are taken for the
    // last. Otherwise ignored.
    uint32_t vertex_count;
    // With GPC_POSITION_SPACE_OBJECT, the matrix that leads from there to clip space, in columns. Otherwise ignored.
    float to_clip[4][4];
    // 1 + the index of the alpha map that says where it is, 0 where it is everywhere. Draws with alpha maps come after those
    // without.
    uint32_t alpha_map;
    // The shading key, from 0: which of the application's pipelines shades it.
    uint32_t key;
    // A number of the application's, up to 65,535, which its shaders see. Triangles of one number are taken to look alike
    // where detection compares colours.
    uint32_t material;
    // VK_TRUE if back faces show. A front face is counter-clockwise on the screen.
    VkBool32 double_sided;
    // VK_TRUE if light or paint may change within a pixel, as with a texture or a glossy surface: it is then shaded in
    // several parts of a superpixel where the pixels around tell that it does.
    VkBool32 detailed;
    // VK_TRUE if it is seen through: what the application's shading stores has an opacity then, and is composited over what
    // lies behind. Such draws have no alpha map and come after all others; GpcGeometry.blended says that there may be some.
    VkBool32 blended;
    // The buffers that it reads: 0 for those of GpcGeometry itself, n for GpcGeometry.more_meshes[n - 1].
    uint32_t mesh;
    // How its indices, or its vertices, make triangles: a GpcTopology.
    uint32_t topology;
} GpcDraw;

// What a recording shows.
typedef struct GpcScenery {
    // sizeof(GpcScenery).
    uint32_t size;
    // GPC_STRUCT_TYPE_SCENERY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // How many draws there are.
    uint32_t draw_count;
    // sizeof(GpcDraw), where there are some.
    uint32_t draw_stride;
    // The draws, read during the call alone. IDs count from 1 in their order. May be NULL where there are none.
    const struct GpcDraw *draws;
    // The projection that positions in clip space were made with, in columns: from view space, in which distances are the world's, to
    // clip space. It tells how far apart two depths are.
    float projection[4][4];
    // Where clip space lies on the images: x, y, width and height of the application's VkViewport, in pixels of the images. The height
    // is negative with GpcGeometry.y_up. It holds the frame's part of the images, which is the application's scissor rectangle: the
    // pixels of the size in GpcOptions from GpcImages.corner on. Four zeros, as gpc_init_scenery gives, for a viewport that is the part.
    float viewport[4];
} GpcScenery;

// What a recording did.
typedef struct GpcOutcome {
    // sizeof(GpcOutcome).
    uint32_t size;
    // GPC_STRUCT_TYPE_OUTCOME.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Rounds that had work.
    uint32_t rounds;
    // Superpixels and tiles that found no room. gpc_frame_grow makes a frame with more.
    uint64_t left_over;
    // Superpixels.
    uint64_t superpixels;
    // Triangles in all draws.
    uint64_t triangles;
    // Visibility samples that were shaded.
    uint64_t visibility_samples;
    // Bytes of device memory that the frame takes, beside what the application lends.
    uint64_t memory_bytes;
    // Time of the library's commands on the device in milliseconds; 0 where the queue has no timestamps.
    double gpu_milliseconds;
} GpcOutcome;

// What a draw's alpha is tested by: a surface is there where the map's alpha is at least the cutoff. Filters and address
// modes are best those of the sampler that the application's own pass reads the map with.
typedef struct GpcAlphaMap {
    // A two-dimensional view of an image made with VK_IMAGE_USAGE_SAMPLED_BIT, of floats or normalised numbers. Its fourth
    // component is alpha; that of a view may be any of the image.
    VkImageView view;
    // Width in texels, up to 65,535.
    uint32_t width;
    // Height in texels, up to 65,535.
    uint32_t height;
    // How many mipmap levels there are; 1 for none.
    uint32_t levels;
    // How alpha lies between texels that are larger than pixels: VK_FILTER_LINEAR or NEAREST.
    VkFilter mag_filter;
    // The same where texels are smaller.
    VkFilter min_filter;
    // Whether alpha is that of two levels, blended (VK_SAMPLER_MIPMAP_MODE_LINEAR), or of the nearest one (NEAREST).
    VkSamplerMipmapMode mipmap_mode;
    // What is beyond the image along u: VK_SAMPLER_ADDRESS_MODE_REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE.
    VkSamplerAddressMode address_u;
    // The same along v.
    VkSamplerAddressMode address_v;
    // The least alpha that is there.
    float cutoff;
    // 0.
    uint32_t reserved;
} GpcAlphaMap;

// Buffers that draws read, as they are bound for them: those of a mesh, or of many meshes. Members are as those of GpcGeometry.
typedef struct GpcMesh {
    // Positions of vertices.
    VkBuffer positions;
    // Where the first one is, in bytes.
    uint64_t positions_offset;
    // Bytes from one to the next.
    uint32_t position_stride;
    // How many vertices there can be.
    uint32_t vertex_capacity;
    // Indices; ignored with VK_INDEX_TYPE_NONE_KHR.
    VkBuffer indices;
    // Where they begin, in bytes.
    uint64_t indices_offset;
    // VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT32, or VK_INDEX_TYPE_NONE_KHR.
    VkIndexType index_type;
    // How many indices there can be.
    uint32_t index_capacity;
    // Texture coordinates of the vertices. VK_NULL_HANDLE where no draw of them has an alpha map.
    VkBuffer coordinates;
    // Where those of the first vertex are, in bytes.
    uint64_t coordinates_offset;
    // Bytes from one vertex to the next.
    uint32_t coordinates_stride;
    // 0.
    uint32_t reserved;
} GpcMesh;

// Buffers of the application. They may hold something else in every frame; the library reads them when a recording is
// executed.
typedef struct GpcGeometry {
    // sizeof(GpcGeometry).
    uint32_t size;
    // GPC_STRUCT_TYPE_GEOMETRY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // How many vertices there can be. Larger indices are taken for the last, or in object space for the last of the draw.
    uint32_t vertex_capacity;
    // Positions of vertices, made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; where they lie in clip space and 16 bytes apart,
    // with VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT too.
    VkBuffer positions;
    // Where the first one is, in bytes: a multiple of 4.
    uint64_t positions_offset;
    // Bytes from one to the next: a multiple of 4, and at least those of a position.
    uint32_t position_stride;
    // What they are: a GpcPositionSpace.
    uint32_t position_space;
    // With GPC_POSITION_SPACE_OBJECT, most vertices of all draws of a frame, those that several draws have counted for each.
    // Otherwise ignored.
    uint32_t position_capacity;
    // VK_INDEX_TYPE_UINT16 or VK_INDEX_TYPE_UINT32; VK_INDEX_TYPE_NONE_KHR if there are no indices, so that draws take vertices in
    // their order, as vkCmdDraw does.
    VkIndexType index_type;
    // Indices. Made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. The buffer of those of 16 bits reaches to a multiple of 4 bytes.
    // Ignored with VK_INDEX_TYPE_NONE_KHR.
    VkBuffer indices;
    // Where they begin, in bytes: a multiple of an index's size.
    uint64_t indices_offset;
    // How many indices there can be.
    uint32_t index_capacity;
    // Most triangles of all draws of a frame.
    uint32_t triangle_capacity;
    // Most draws of a frame.
    uint32_t draw_capacity;
    // How many shading keys there are, 1 to 16,383.
    uint32_t keys;
    // VK_TRUE if y points up in clip space, as with a viewport of negative height; VK_FALSE if down, as Vulkan has it.
    VkBool32 y_up;
    // VK_TRUE if depth runs from 1 near to 0 far; VK_FALSE if from 0 to 1.
    VkBool32 reversed_depth;
    // Where there are alpha maps, texture coordinates of the vertices, two floats each. Made with
    // VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. Otherwise ignored.
    VkBuffer coordinates;
    // Where those of the first vertex are, in bytes: a multiple of 4.
    uint64_t coordinates_offset;
    // Bytes from one vertex to the next: a multiple of 4, at least 8.
    uint32_t coordinates_stride;
    // How many alpha maps there are.
    uint32_t alpha_map_count;
    // sizeof(GpcAlphaMap), where there are some.
    uint32_t alpha_map_stride;
    // VK_TRUE if draws may be blended.
    VkBool32 blended;
    // What draws are tested by that are not opaque, read during the call alone. The library reads the images, in
    // VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, when a frame's first recording is executed, and keeps what they hold then. May
    // be NULL where there are none.
    const struct GpcAlphaMap *alpha_maps;
    // Further buffers that draws may read, read during the call alone. The members `positions` to `index_capacity` and
    // `coordinates` to `coordinates_stride` are mesh 0, the first of these is mesh 1: see GpcDraw.mesh. May be NULL where there are
    // none.
    const struct GpcMesh *more_meshes;
    // How many there are.
    uint32_t more_mesh_count;
    // sizeof(GpcMesh), where there are some.
    uint32_t more_mesh_stride;
    // What the image of depth holds where depth in clip space is 0: minDepth of the application's VkViewport. gpc_init_geometry
    // gives 0.
    float min_depth;
    // The same where it is 1: maxDepth. gpc_init_geometry gives 1.
    float max_depth;
} GpcGeometry;

// The kinds of images that a frame is recorded with.
typedef struct GpcImageKinds {
    // sizeof(GpcImageKinds).
    uint32_t size;
    // GPC_STRUCT_TYPE_IMAGE_KINDS.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // VK_TRUE if triangle IDs are lent; VK_FALSE if the library draws IDs and depth for itself.
    VkBool32 ids;
    // VK_TRUE if depth is lent, which goes with IDs and is needed there by GpcOptions.thin.
    VkBool32 depth;
    // The format of the views of colours: 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or B10G11R11_UFLOAT.
    VkFormat color_format;
    // VK_TRUE if the application's shaders write sRGB codes into a format of plain numbers; VK_FALSE if the image of colours holds
    // linear light, or encodes it itself.
    VkBool32 color_encoded;
} GpcImageKinds;

// How a frame is antialiased; gpc_init_options gives defaults.
typedef struct GpcOptions {
    // sizeof(GpcOptions).
    uint32_t size;
    // GPC_STRUCT_TYPE_OPTIONS.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Width in pixels of the images lent.
    uint32_t width;
    // Their height.
    uint32_t height;
    // Samples of a superpixel, 1 to 1,024.
    uint32_t samples;
    // Where they lie: a GpcPattern.
    uint32_t pattern;
    // How often a superpixel is shaded: a GpcShading.
    uint32_t shading;
    // What makes a superpixel: a GpcDetection.
    uint32_t detection;
    // Differences above this, in 8-bit sRGB code values of any channel, are a contrast: 0 to 255, or GPC_CONTRAST_OF_SAMPLES.
    uint32_t contrast;
    // VK_TRUE if triangles too thin for a pixel's centre to see make superpixels too; where IDs are lent, this needs depth,
    // too.
    VkBool32 thin;
    // VK_TRUE if the image holds radiance that is tone-mapped later, so that detection compares tone-mapped colours.
    VkBool32 high_dynamic_range;
    // VK_TRUE if textures are filtered over what each sample stands for, VK_FALSE if over the whole pixel.
    VkBool32 sharp;
    // VK_TRUE if the application's shading makes the colours of all pixels, so that the colour image may hold anything before;
    // VK_FALSE if of superpixels alone, which are drawn over what it holds.
    VkBool32 shade_all;
    // VK_TRUE if `background` shows where neither a triangle nor, unless `flat_background` says otherwise, something that the
    // application has drawn is; VK_FALSE if that is transparent.
    VkBool32 has_background;
    // Linear light.
    float background[3];
    // VK_TRUE if `background`, or nothing, shows wherever no triangle is. With VK_FALSE, where the application lends its colours,
    // a sample of a superpixel that sees no triangle shows what the application has drawn, with its alpha: the colour of the pixel
    // if its centre saw no triangle, else of the nearest one of the 8 pixels around it, then of the 24, whose centre saw none, else
    // the background. It has to be VK_TRUE with GpcGeometry.blended, and does not matter with `shade_all`.
    VkBool32 flat_background;
    // Bound on the time that a recording takes: the most rounds of superpixels that are detected, and of each growth of these. What
    // rounds leave keeps the colours that were drawn, and is counted as left over. 0 for as many as an image may need or, on GPUs
    // with plenty of memory, usually needs; those that it does not need take next to no time on devices with
    // GpcDevice.conditional_rendering, and little on others.
    uint32_t max_rounds;
    // How many pairs `locations` has: `samples`, with GPC_PATTERN_LIST.
    uint32_t location_count;
    // With GPC_PATTERN_LIST, offsets of the samples from the pixel's centre in pixels, x to the right and y down, each from
    // -0.5 up to 0.5, read during the call alone. Otherwise ignored.
    const float (*locations)[2];
    // Bound on the device memory of a frame in bytes, 0 for none.
    uint64_t max_memory;
    // How often pixels become superpixels because they contrast with a superpixel beside them, with GPC_DETECTION_CONTRAST: 0 to 8, or
    // GPC_GROWTHS_OF_SAMPLES.
    uint32_t growths;
    // 0.
    uint32_t reserved;
} GpcOptions;

// State of an image, as in VkImageMemoryBarrier2.
typedef struct GpcImageState {
    // Its layout.
    VkImageLayout layout;
    // Stages that use it.
    VkPipelineStageFlags2 stage;
    // How they use it.
    VkAccessFlags2 access;
} GpcImageState;

// An image: single-sampled, one level, one layer, of the size in GpcOptions or larger.
typedef struct GpcImage {
    // The image.
    VkImage image;
    // A two-dimensional view of it, of one aspect.
    VkImageView view;
    // The aspects of the image; of a format with stencil, that too, although it is not read.
    VkImageAspectFlags aspects;
    // Its state when the recording begins.
    struct GpcImageState before;
    // Its state when the recording is done.
    struct GpcImageState after;
} GpcImage;

// What the application has drawn, one sample a pixel, and where its picture goes: images of the kinds that the frame was created
// for.
typedef struct GpcImages {
    // sizeof(GpcImages).
    uint32_t size;
    // GPC_STRUCT_TYPE_IMAGES.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Triangle IDs, VK_FORMAT_R32_UINT, made with VK_IMAGE_USAGE_SAMPLED_BIT: 1 + the index of the nearest triangle in the
    // order of the frame's draws, 0 where there is none. Without GpcImageKinds.ids, image and view are VK_NULL_HANDLE.
    struct GpcImage ids;
    // Depth of the nearest triangle, of any depth format, made with VK_IMAGE_USAGE_SAMPLED_BIT; the view shows depth alone.
    // Without GpcImageKinds.depth, image and view are VK_NULL_HANDLE.
    struct GpcImage depth;
    // Colours, made with VK_IMAGE_USAGE_SAMPLED_BIT and VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT: superpixels are drawn into it.
    struct GpcImage color;
    // Upper left corner of the part of these images that the frame is of, in pixels. The part has the size in GpcOptions; the
    // library neither reads nor writes what lies around it.
    uint32_t corner[2];
} GpcImages;

// Visibility samples of a round, sorted by shading key, on the device.
typedef struct GpcVisibilitySamples {
    // The library's sizeof(GpcVisibilitySamples).
    uint32_t size;
    // GPC_STRUCT_TYPE_VISIBILITY_SAMPLES.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // How many keys there are.
    uint32_t keys;
    // The set of gpc_antialiaser_samples_layout, to be bound for compute where the shaders expect it.
    VkDescriptorSet descriptor_set;
    // Buffer of the keys' indirect dispatches, in workgroups of 64 invocations.
    VkBuffer dispatches;
    // Where in it, in bytes, the dispatch of key 0 is.
    uint64_t dispatch_offset;
    // Bytes from the dispatch of a key to that of the next one.
    uint64_t dispatch_stride;
    // A buffer whose first word is zero where the round has nothing to do, so that its dispatches are of no workgroups. Recorded
    // after vkCmdBeginConditionalRenderingEXT with it, at offset 0, and ended before the callback returns, they take no time
    // there, as the library's own. VK_NULL_HANDLE without GpcDevice.conditional_rendering, and where what is shaded is no round.
    VkBuffer condition;
} GpcVisibilitySamples;

// Records the shading of a round's samples into a command buffer: for each key a pipeline, the samples' set, and the
// key's indirect dispatch. It is called a fixed number of times during gpc_frame_record or gpc_list_record, in rounds that have
// nothing to do as well, on its thread, outside of a render pass and of conditional rendering. Dispatches need no barrier between them: what the library wrote is visible to them, and it waits for what they
// write. It may bind and push what it likes, must not throw or jump out, and must not use the frame or list. `samples` lives until
// it returns.
typedef void (*GpcShade)(void *user, VkCommandBuffer commands, const struct GpcVisibilitySamples *samples);

// Where a list of locations lies, and where what they see goes.
typedef struct GpcLocationList {
    // sizeof(GpcLocationList).
    uint32_t size;
    // GPC_STRUCT_TYPE_LOCATION_LIST.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Most locations of a recording.
    uint32_t capacity;
    // GpcLocations, made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT. They may change
    // with every recording.
    VkBuffer locations;
    // Where the first one is, in bytes: a multiple of 256, or of what the device's descriptors of buffers may begin at.
    uint64_t offset;
    // What they see, made with VK_BUFFER_USAGE_TRANSFER_DST_BIT: four floats a location, in their order: linear light and
    // opacity, by which the light is multiplied.
    VkBuffer colors;
    // Where that of the first location goes, in bytes: a multiple of 4.
    uint64_t colors_offset;
} GpcLocationList;

// What a recording of a list samples, and where.
typedef struct GpcListScenery {
    // sizeof(GpcListScenery).
    uint32_t size;
    // GPC_STRUCT_TYPE_LIST_SCENERY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // How many locations are sampled: the first ones of the buffer.
    uint32_t location_count;
    // How many draws there are.
    uint32_t draw_count;
    // The draws that locations see, read during the call alone. May be NULL where there are none.
    const struct GpcDraw *draws;
    // sizeof(GpcDraw), where there are some.
    uint32_t draw_stride;
    // 0.
    uint32_t reserved;
} GpcListScenery;

// What a recording of a list did.
typedef struct GpcListOutcome {
    // sizeof(GpcListOutcome).
    uint32_t size;
    // GPC_STRUCT_TYPE_LIST_OUTCOME.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Locations off the image, or that are no numbers. They show the background.
    uint32_t left_out;
    // Cells and tiles that found no room, and show the background. gpc_list_grow makes a list with more.
    uint64_t left_over;
    // Visibility samples that were shaded.
    uint64_t visibility_samples;
    // Bytes of device memory that the list takes, beside what the application lends.
    uint64_t memory_bytes;
    // Time of the library's commands on the device in milliseconds; 0 where the queue has no timestamps.
    double gpu_milliseconds;
} GpcListOutcome;

// A place on the image plane, as it lies in the buffer of a GpcLocationList: 32 bytes.
typedef struct GpcLocation {
    // The pixel that it lies in: column and row from the upper left corner of the image that GpcOptions names.
    int32_t pixel[2];
    // Where it lies in the pixel, x and y down, from 0 to 1.
    float within[2];
    // How far apart it lies from its neighbours, in pixels: the change of x and y to the next column, and to the next row, of
    // what the application makes of the list. Sub-samples and filters of textures spread over this parallelogram.
    float jacobian[2][2];
} GpcLocation;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Fills a GpcDevice of `size` bytes, which is sizeof(GpcDevice): its handles are null, and nothing is enabled.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_device(struct GpcDevice *device,
                          size_t size);

// Sets the features that the library needs to VK_TRUE, and leaves all else in the struct as it is: chain it to
// VkDeviceCreateInfo. Set its sType before.
//
// Threads: any. Errors: GPC_RESULT_NULL; GPC_RESULT_VALUE for another sType.
GpcResult gpc_require_features(VkPhysicalDeviceVulkan13Features *features);

// Whether a physical device has all that the library needs, and the instance was created for GPC_VULKAN_API_VERSION or later; to
// find that out, it makes a device and destroys it again. `queue_family`, if not NULL, becomes the first family with graphics and
// compute.
//
// Threads: any.
// Errors: GPC_RESULT_UNSUPPORTED, with gpc_last_error listing all that is missing; GPC_RESULT_NULL; GPC_RESULT_VULKAN if the driver
// makes no device.
GpcResult gpc_check_device(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                           VkInstance instance,
                           VkPhysicalDevice physical_device,
                           uint32_t *queue_family);

// Makes an antialiaser in a lent device.
//
// Threads: any. An antialiaser may be used by several threads at once.
// Lifetime: instance, device and the loader's library outlive the antialiaser and all frames created with it.
// Errors: GPC_RESULT_UNSUPPORTED lists what is missing; GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_OUT_OF_MEMORY,
// GPC_RESULT_VULKAN. `*antialiaser` is then NULL.
GpcResult gpc_antialiaser_create(const struct GpcDevice *device,
                                 struct GpcAntialiaser **antialiaser);

// The layout of the descriptor set that shaders read visibility samples from, for the layouts of the application's own
// pipelines. VK_NULL_HANDLE for NULL.
//
// Threads: any. Lifetime: that of the antialiaser and all its frames; it is the library's to destroy.
VkDescriptorSetLayout gpc_antialiaser_samples_layout(const struct GpcAntialiaser *antialiaser);

// Destroys an antialiaser; frames created with it go on. NULL does nothing.
//
// Threads: no other call uses the antialiaser at the time.
void gpc_antialiaser_destroy(struct GpcAntialiaser *antialiaser);

// What the last call of the calling thread that failed has to say: UTF-8, in English, for a log. Never NULL; empty where
// none has failed.
//
// Threads: any. The text is the thread's own.
// Lifetime: until the thread's next call of this library that fails, or its end.
const char *gpc_last_error(void);

// Fills a GpcScenery of `size` bytes, which is sizeof(GpcScenery): there are no draws.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_scenery(struct GpcScenery *scenery, size_t size);

// Fills a GpcOutcome of `size` bytes, which is sizeof(GpcOutcome).
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_outcome(struct GpcOutcome *outcome, size_t size);

// Makes the pipelines and memory of a frame. An application has one for each frame that it has in flight, whatever the number of
// its swapchain's images, and makes new ones where a buffer changes. Frames share the memory that the library's passes hand to
// each other, where its size suffices for several, so that the commands of all frames of an antialiaser are executed on one queue.
//
// Threads: any; several frames may be created at once.
// Lifetime: the buffers and alpha maps lent outlive the frame. The structs are read during the call alone.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
// GPC_RESULT_VULKAN. `*frame` is then NULL.
GpcResult gpc_frame_create(const struct GpcAntialiaser *antialiaser,
                           const struct GpcGeometry *geometry,
                           const struct GpcImageKinds *kinds,
                           const struct GpcOptions *options,
                           struct GpcFrame **frame);

// Makes a frame like this one, for the same buffers and kinds of images, with more of what its last recording lacked. Where it
// lacked nothing, the new one has as much. The old one is still to be destroyed.
//
// Threads: no other call uses the frame at the time. Lifetime: the buffers and alpha maps lent outlive the new frame too.
// Errors: as gpc_frame_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
GpcResult gpc_frame_grow(const struct GpcFrame *frame,
                         struct GpcFrame **grown);

// Goes on with images of another size, in pixels. Pipelines stay, and so does memory where it suffices: a frame that becomes smaller
// keeps what it has. Where that is too small, the first frame that is resized makes more, and the others share it.
//
// Threads: no other call uses the frame at the time.
// Lifetime: the commands of the frame's last recording are done, or will never be executed.
// Errors: as gpc_frame_create; the frame is then as it was.
GpcResult gpc_frame_resize(struct GpcFrame *frame,
                           uint32_t width,
                           uint32_t height);

// Records the antialiasing of what the application has drawn, in any images of the kinds and the size that the frame was created
// for, such as the swapchain's image at hand. It submits nothing, waits for nothing and allocates nothing on the device. It updates
// descriptor sets of the frame's own, for which the last recording has to be done. `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the family
// lent; what was bound and pushed before has to be bound and pushed again. `user` is handed to `shade`, whose shaders write
// no memory of the library but by gpc_store.
//
// Threads: no other call uses the frame or the command buffer at the time. Different frames may be recorded at once.
// Lifetime: the commands of the frame's last recording are done, or will never be executed. The frame, the buffers, the images and what `shade` records
// outlive the execution of the commands.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY. Nothing is recorded then.
GpcResult gpc_frame_record(struct GpcFrame *frame,
                           VkCommandBuffer commands,
                           const struct GpcImages *images,
                           const struct GpcScenery *scenery,
                           GpcShade shade,
                           void *user);

// What the last recording did, once its commands are done, until the next one. It waits for nothing: where they were not
// submitted or still run, it answers GPC_RESULT_NOT_READY.
//
// Threads: no gpc_frame_record of the frame runs at the time.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
GpcResult gpc_frame_outcome(const struct GpcFrame *frame,
                            struct GpcOutcome *outcome);

// Bytes of device memory that a frame takes, beside what the application lends; 0 for NULL.
//
// Threads: any.
uint64_t gpc_frame_memory_bytes(const struct GpcFrame *frame);

// Bytes of these that other frames of the same antialiaser may use as well, and that count once for all of them; 0 for NULL.
//
// Threads: any.
uint64_t gpc_frame_shared_memory_bytes(const struct GpcFrame *frame);

// Destroys a frame, whose commands are done. NULL does nothing.
//
// Threads: no other call uses the frame at the time.
void gpc_frame_destroy(struct GpcFrame *frame);

// Fills a GpcGeometry of `size` bytes, which is sizeof(GpcGeometry): nothing is lent, and there is one
// shading key.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_geometry(struct GpcGeometry *geometry, size_t size);

// Fills a GpcImageKinds of `size` bytes, which is sizeof(GpcImageKinds): colours alone are lent. Their format is still to be set.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_image_kinds(struct GpcImageKinds *kinds,
                               size_t size);

// Fills a GpcImages of `size` bytes, which is sizeof(GpcImages): no image is lent.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_images(struct GpcImages *images, size_t size);

// Fills a GpcLocationList of `size` bytes, which is sizeof(GpcLocationList): nothing is
// lent.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_location_list(struct GpcLocationList *list, size_t size);

// Fills a GpcListScenery of `size` bytes, which is sizeof(GpcListScenery): no locations are
// sampled.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_list_scenery(struct GpcListScenery *scenery, size_t size);

// Fills a GpcListOutcome of `size` bytes, which is sizeof(GpcListOutcome).
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_list_outcome(struct GpcListOutcome *outcome, size_t size);

// Makes the pipelines and memory to sample a list of locations. With one sample each location is sampled where it is, with
// more as a superpixel around it. Of the options, detection, contrast, thin and shade_all do not matter; width and height are
// those of the image whose pixels locations count in.
//
// Threads: any; several lists may be created at once.
// Lifetime: the buffers and views lent outlive the list. The structs are read during the call alone.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
// GPC_RESULT_VULKAN. `*list` is then NULL.
GpcResult gpc_list_create(const struct GpcAntialiaser *antialiaser,
                          const struct GpcGeometry *geometry,
                          const struct GpcLocationList *locations,
                          const struct GpcOptions *options,
                          struct GpcList **list);

// Makes a list like this one, for the same buffers, with more of what its last recording lacked. Where it lacked nothing, the
// new one has as much. The old one is still to be destroyed.
//
// Threads: no other call uses the list at the time. Lifetime: the buffers and views lent outlive the new list too.
// Errors: as gpc_list_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
GpcResult gpc_list_grow(const struct GpcList *list,
                        struct GpcList **grown);

// Records the sampling of locations. It submits nothing, waits for nothing, allocates nothing on the device
// and updates no descriptor. `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the family lent; what was
// bound and pushed before has to be bound and pushed again, and what is recorded is visible to all commands after it. `user`
// is handed to `shade`, whose shaders write no memory of the library but by gpc_store.
//
// Threads: no other call uses the list or the command buffer at the time. Different lists may be recorded at once.
// Lifetime: the commands of the list's last recording are done, or will never be executed. The list, the buffers and what `shade` records outlive the
// execution of the commands.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY. Nothing is recorded then.
GpcResult gpc_list_record(struct GpcList *list,
                          VkCommandBuffer commands,
                          const struct GpcListScenery *scenery,
                          GpcShade shade,
                          void *user);

// What the last recording did, once its commands are done, until the next one. It waits for nothing: where they were not
// submitted or still run, it answers GPC_RESULT_NOT_READY.
//
// Threads: no gpc_list_record of the list runs at the time.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
GpcResult gpc_list_outcome(const struct GpcList *list,
                           struct GpcListOutcome *outcome);

// Bytes of device memory that a list takes, beside what the application lends; 0 for NULL.
//
// Threads: any.
uint64_t gpc_list_memory_bytes(const struct GpcList *list);

// Destroys a list, whose commands are done. NULL does nothing.
//
// Threads: no other call uses the list at the time.
void gpc_list_destroy(struct GpcList *list);

// Fills a GpcOptions of `size` bytes, which is sizeof(GpcOptions), with defaults: 64 samples, contrast and thin
// triangles detected, shading in parts. Width and height are still to be set.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_options(struct GpcOptions *options,
                           size_t size);

// Checks that a shader was compiled with a gpc_visibility.glsl that this library takes. Check each shader that shades samples,
// where its pipeline is made. Arguments are those of VkShaderModuleCreateInfo: `code_size` is in bytes.
//
// Threads: any.
// Errors: GPC_RESULT_NULL; GPC_RESULT_VALUE for what is no SPIR-V; GPC_RESULT_SHADER_VERSION.
GpcResult gpc_check_shader(const uint32_t *code,
                           size_t code_size);

// The version of the library, packed as GPC_VERSION is.
//
// Threads: any.
uint32_t gpc_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus
