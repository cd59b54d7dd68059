// gpc: antialiasing for the frames of a Vulkan application. Only pixels that alias are sampled, and the application's own
// pipelines shade the samples.
//
// An application draws its frame as usual, with one sample a pixel. It may also draw triangle IDs and depth for the library, or
// leave all drawing to it. gpc_frame_record then finds the pixels that alias, samples the application's triangles there, has
// the application shade what the samples see, and draws the resolved pixels over the aliased ones. All of this is recorded
// into the application's command buffer. docs/embedding.md is the manual.
//
// - Functions that can fail return a GpcResult; gpc_last_error returns the message. A call that fails leaves no objects
//   behind. Panics of the library do not cross this boundary.
// - Before a struct is passed to the library, its gpc_init function fills it: with its size, its type and defaults. Later
//   versions of the library may add members at its end, and accept structs without them. Members may also be added to GpcDraw,
//   GpcMesh, GpcAlphaMap and GpcIndirectDraws, which are elements of arrays: set members that an application does not use to 0.
//   GpcImageState, GpcImage, GpcLocation, GpcInstance and GpcMemory never change.
// - This header includes Vulkan's, without which it needs nothing. Applications that declare Vulkan's functions themselves define
//   VK_NO_PROTOTYPES before.
// - The comment of a uint32_t with only a few possible values names their enumeration.
// - Pointers and handles must not be null unless their comments allow it. The library checks this. They must also be valid, of
//   the right type, and of the device that is lent. This is not checked, as with Vulkan itself.

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

// Value of GpcOptions.contrast for the default threshold: 6, or 1 from 128 samples on.
#define GPC_CONTRAST_OF_SAMPLES UINT32_MAX

// Value of GpcOptions.growths for the default number: 1, or 4 from 128 samples on.
#define GPC_GROWTHS_OF_SAMPLES UINT32_MAX

// Version of the header; gpc_version returns that of the library.
#define GPC_VERSION_MAJOR 0

// See GPC_VERSION_MAJOR.
#define GPC_VERSION_MINOR 2

// See GPC_VERSION_MAJOR.
#define GPC_VERSION_PATCH 0

// Version of the header as one number, larger for later versions, packed as by VK_MAKE_API_VERSION.
#define GPC_VERSION (((GPC_VERSION_MAJOR << 22) | (GPC_VERSION_MINOR << 12)) | GPC_VERSION_PATCH)

// Version of the binary interface. A new version requires programs to be compiled again with the new header. The name
// of the shared library contains it: libgpc.so.1.
#define GPC_ABI_VERSION 1

// Result of a function.
enum GpcResult
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Success.
    GPC_RESULT_SUCCESS = 0,
    // Pointer that is NULL, or handle that is VK_NULL_HANDLE.
    GPC_RESULT_NULL = 1,
    // Size or stride that the struct has in no version of the header up to the library's. Either the member was not
    // set, or the application was compiled with the header of a later version.
    GPC_RESULT_STRUCT_SIZE = 2,
    // Value that is not possible, or that contradicts another one.
    GPC_RESULT_VALUE = 3,
    // Recording with more draws, triangles, vertices, indices or locations than its frame or list was created for, or draw
    // whose vertices lie outside of its mesh.
    GPC_RESULT_CAPACITY = 4,
    // Device, instance or loader that lacks a requirement.
    GPC_RESULT_UNSUPPORTED = 5,
    // Memory that ran out, or a GpcOptions.max_memory that allows too little.
    GPC_RESULT_OUT_OF_MEMORY = 6,
    // Lost device.
    GPC_RESULT_DEVICE_LOST = 7,
    // Any other refusal by the driver.
    GPC_RESULT_VULKAN = 8,
    // Defect of the library. The objects that took part in the call must be destroyed and not used otherwise.
    GPC_RESULT_PANIC = 9,
    // Query about a recording whose commands are not done, or before the first recording.
    GPC_RESULT_NOT_READY = 10,
    // Member `type` with the value of another struct, or member `next` that points to a struct that the library does
    // not know.
    GPC_RESULT_STRUCT_TYPE = 11,
    // Shader that was compiled without gpc_visibility.glsl, or with a version of it that the library does not support.
    GPC_RESULT_SHADER_VERSION = 12,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcResult GpcResult;
#else
typedef uint32_t GpcResult;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Type of a struct: the value of its member `type`, which its gpc_init function sets.
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

// Kind of memory.
enum GpcMemoryUse
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Device memory.
    GPC_MEMORY_USE_DEVICE = 0,
    // Memory that the CPU writes and the device reads: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT.
    GPC_MEMORY_USE_UPLOAD = 1,
    // Memory that the device writes and the CPU reads: mapped, with VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, and
    // preferably VK_MEMORY_PROPERTY_HOST_CACHED_BIT.
    GPC_MEMORY_USE_READBACK = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcMemoryUse GpcMemoryUse;
#else
typedef uint32_t GpcMemoryUse;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Space and format of vertex positions.
enum GpcPositionSpace
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Clip space, four floats: the same values as the vertex shader's gl_Position.
    GPC_POSITION_SPACE_CLIP = 0,
    // Object space of the draw, three numbers, floats unless `position_format` says otherwise; GpcDraw.to_clip transforms
    // them to clip space.
    GPC_POSITION_SPACE_OBJECT = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcPositionSpace GpcPositionSpace;
#else
typedef uint32_t GpcPositionSpace;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Primitive topology of a draw: how consecutive corners (indices, or vertices without indices) form triangles.
// Primitive restart is not supported: a draw is a single strip or fan.
enum GpcTopology
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST: every three corners form a triangle.
    GPC_TOPOLOGY_LIST = 0,
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP: each corner from the third on forms a triangle with the two before it.
    GPC_TOPOLOGY_STRIP = 1,
    // As VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN: each corner from the third on forms a triangle with the one before it and
    // the first.
    GPC_TOPOLOGY_FAN = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcTopology GpcTopology;
#else
typedef uint32_t GpcTopology;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Pattern of the sample locations in a superpixel.
enum GpcPattern
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // First points of a scrambled Sobol sequence. Any number of samples.
    GPC_PATTERN_SOBOL = 0,
    // Rotated square lattice. Any number of samples; for a number that is no square, the same as GPC_PATTERN_KOROBOV.
    GPC_PATTERN_LATTICE = 1,
    // Best rank-1 lattice. Any number of samples.
    GPC_PATTERN_KOROBOV = 2,
    // Centres of a square grid. Square numbers of samples only.
    GPC_PATTERN_GRID = 3,
    // Standard sample locations of Vulkan: 1, 2, 4, 8 or 16 samples.
    GPC_PATTERN_ROTATED = 4,
    // Offsets of the application, in GpcOptions.locations.
    GPC_PATTERN_LIST = 5,
    // Samples on straight lines, 64 on each: 8 lines up to 64 samples, 32 up to 256, and 64 above (32 if any draw has
    // an alpha map). Any number of samples; the number determines in how many places a superpixel is shaded. Below 4
    // samples, and if each sample is shaded, the same as GPC_PATTERN_SOBOL.
    GPC_PATTERN_LINES = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcPattern GpcPattern;
#else
typedef uint32_t GpcPattern;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Rate of shading within a superpixel.
enum GpcShading
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // One shading for each visible triangle.
    GPC_SHADING_TRIANGLE = 0,
    // One shading for each visible triangle; several, in different parts of the pixel, where the surrounding colours
    // vary.
    GPC_SHADING_PART = 1,
    // One shading for each sample.
    GPC_SHADING_SAMPLE = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcShading GpcShading;
#else
typedef uint32_t GpcShading;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Rule by which a pixel becomes a superpixel.
enum GpcDetection
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A neighbour with a contrasting colour.
    GPC_DETECTION_CONTRAST = 0,
    // A neighbour with another triangle and a contrasting colour.
    GPC_DETECTION_EDGES = 1,
    // A neighbour with another triangle.
    GPC_DETECTION_EXACT = 2,
    // No condition: every pixel is a superpixel. For measurements.
    GPC_DETECTION_EVERY = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcDetection GpcDetection;
#else
typedef uint32_t GpcDetection;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Filter by which pixels are averaged; docs/filters.md compares them.
enum GpcFilter
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // The pixel: no pixel depends on others.
    GPC_FILTER_BOX = 0,
    // A triangle. The default radius is 1 pixel.
    GPC_FILTER_TENT = 1,
    // A Gaussian whose standard deviation is a quarter of the radius. The default radius is 2 pixels.
    GPC_FILTER_GAUSSIAN = 2,
    // The spline of Mitchell and Netravali, which has negative lobes. The default radius is 2 pixels.
    GPC_FILTER_MITCHELL = 3,
    // The window of Blackman and Harris with four terms. The default radius is 1.5 pixels.
    GPC_FILTER_BLACKMAN_HARRIS = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum GpcFilter GpcFilter;
#else
typedef uint32_t GpcFilter;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What frames of one device share: layouts, and the pipelines made so far.
typedef struct GpcAntialiaser GpcAntialiaser;

// Pipelines and memory to antialias one frame in flight.
typedef struct GpcFrame GpcFrame;

// Pipelines and memory to sample the locations of a list, for one frame in flight.
typedef struct GpcList GpcList;

// Memory that a buffer or an image of the library needs.
typedef struct GpcMemoryRequest {
    // The library's sizeof(GpcMemoryRequest).
    uint32_t size;
    // GPC_STRUCT_TYPE_MEMORY_REQUEST.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Purpose of the memory, for logs: UTF-8, alive until the function returns.
    const char *name;
    // Size, alignment and permitted memory types.
    VkMemoryRequirements requirements;
    // Kind of memory: a GpcMemoryUse.
    uint32_t usage;
    // VK_TRUE for a buffer, VK_FALSE for an image with optimal tiling: see
    // VkPhysicalDeviceLimits.bufferImageGranularity.
    VkBool32 linear;
} GpcMemoryRequest;

// Memory that the application allocated.
typedef struct GpcMemory {
    // Handle of the memory object.
    VkDeviceMemory memory;
    // Offset in the memory object in bytes: a multiple of the requested alignment.
    uint64_t offset;
    // Address at which the offset is mapped; NULL for device memory that is not mapped, or not coherent.
    void *mapped;
    // Any pointer of the application; the library does not use it.
    void *user;
} GpcMemory;

// Function of the application that allocates memory of the lent device. The memory has the requested size and
// alignment and one of the requested types, and nobody else uses it until it is freed. VK_FALSE if memory ran out. The
// function must not throw or jump out, and must not use the library.
//
// Threads: those that create antialiasers, frames and lists; several at the same time if the application creates
// several at the same time.
typedef VkBool32 (*GpcAllocate)(void *user, const struct GpcMemoryRequest *request, struct GpcMemory *memory);

// Function of the application that frees memory from GpcAllocate. No command uses the memory any more. The function
// must not throw or jump out, and must not use the library.
//
// Threads: as GpcAllocate, and those that destroy objects.
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
    // First index of the draw. For a mesh without indices: its first vertex, counted from `vertex_offset`.
    uint32_t first_index;
    // Number of triangles.
    uint32_t triangle_count;
    // Offset that is added to each index.
    int32_t vertex_offset;
    // Number of vertices from `vertex_offset` on, with GPC_POSITION_SPACE_OBJECT; otherwise ignored. An index beyond
    // the last of these vertices is clamped to the last one.
    uint32_t vertex_count;
    // Matrix from object space to clip space, by columns, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    float to_clip[4][4];
    // 1 + the index of the alpha map of the alpha test; 0 for a surface without holes. Draws with alpha maps come
    // after those without.
    uint32_t alpha_map;
    // Shading key: the number of the application's pipeline that shades the draw, from 0.
    uint32_t key;
    // Material number of the application's choice, up to 65,535, which its shaders can read. Triangles with the same
    // number are assumed to look alike where the surrounding colours decide in how many parts `detailed` ones are
    // shaded. Draws with alpha maps are told apart by their maps instead.
    uint32_t material;
    // VK_TRUE if back faces are visible. `front_face` says which faces these are.
    VkBool32 double_sided;
    // VK_TRUE if the colour may vary within a pixel, for example because of a texture or a glossy surface. If so, the
    // draw is shaded in several parts of a superpixel wherever the surrounding pixels vary in colour.
    VkBool32 detailed;
    // VK_TRUE if the draw is translucent. The application's shaders then store an opacity, with which the draw is
    // composited over the surfaces behind it. Blended draws have no alpha map and come after all others. They require
    // GpcGeometry.blended.
    VkBool32 blended;
    // Mesh whose buffers the draw reads: 0 for the buffers of GpcGeometry itself, n for GpcGeometry.more_meshes[n -
    // 1].
    uint32_t mesh;
    // Topology: how indices, or vertices without indices, form triangles: a GpcTopology.
    uint32_t topology;
    // Orientation of front faces in the image: frontFace of the application's pipeline. 0 is
    // VK_FRONT_FACE_COUNTER_CLOCKWISE.
    VkFrontFace front_face;
} GpcDraw;

// Draws and view of a recording.
typedef struct GpcScenery {
    // sizeof(GpcScenery).
    uint32_t size;
    // GPC_STRUCT_TYPE_SCENERY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Number of draws.
    uint32_t draw_count;
    // sizeof(GpcDraw), if there are draws.
    uint32_t draw_stride;
    // Draws, read during the call only. Triangle IDs count from 1 in the order of the draws. May be NULL if there are
    // none.
    const struct GpcDraw *draws;
    // Projection matrix by columns, from view space, whose unit of length is the world's, to clip space: the one with
    // which positions in clip space were computed. The matrix tells how far apart two depths are.
    float projection[4][4];
    // Viewport of the application, as VkViewport: x, y, width and height in pixels of the images. The height is
    // negative with GpcGeometry.y_up.
    //
    // The viewport contains the frame's part of the images, which is the application's scissor rectangle: the upper
    // left pixel is GpcImages.corner, the size that in GpcOptions. Four zeros, as gpc_init_scenery sets them, stand
    // for a viewport equal to the part.
    float viewport[4];
} GpcScenery;

// Result of a recording.
typedef struct GpcOutcome {
    // sizeof(GpcOutcome).
    uint32_t size;
    // GPC_STRUCT_TYPE_OUTCOME.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Number of rounds that had work.
    uint32_t rounds;
    // Number of superpixels and tiles for which memory or GpcOptions.max_rounds did not suffice; these keep the colours that
    // they had. The frame's next recording has more memory, unless GpcOptions.fixed_memory is set.
    uint64_t left_over;
    // Number of superpixels.
    uint64_t superpixels;
    // Number of triangles in all draws, with the indirect ones that were not left out.
    uint64_t triangles;
    // Number of visibility samples that were shaded.
    uint64_t visibility_samples;
    // Number of bytes of device memory that the frame uses, without the application's buffers and images.
    uint64_t memory_bytes;
    // Time of the library's commands on the device in milliseconds; 0 if the queue has no timestamps.
    double gpu_milliseconds;
    // Number of draws of all GpcIndirectDraws that the device wrote.
    uint64_t indirect_draws;
    // Number of those that were left out because a capacity of a list was too small: all from the first one that did not
    // fit.
    uint64_t indirect_left_out;
    // Number of those that were left out because they are not possible, such as draws with vertices or indices beyond the
    // ends of the mesh, a shading key or an alpha map that does not exist, or an instance beyond the capacity.
    uint64_t indirect_impossible;
} GpcOutcome;

// Alpha map of draws. A surface exists where the map's alpha is at least `cutoff`. Filters and address modes should
// equal those of the sampler with which the application's own pass reads the map.
typedef struct GpcAlphaMap {
    // Two-dimensional view of an image that was created with VK_IMAGE_USAGE_SAMPLED_BIT and holds floats or normalised
    // numbers. The fourth component of the view is alpha; the view's swizzle can take alpha from any channel of the
    // image.
    VkImageView view;
    // Width in texels, up to 65,535.
    uint32_t width;
    // Height in texels, up to 65,535.
    uint32_t height;
    // Number of mipmap levels, at least 1.
    uint32_t levels;
    // Filter where texels are larger than pixels: VK_FILTER_LINEAR or VK_FILTER_NEAREST.
    VkFilter mag_filter;
    // Filter where texels are smaller than pixels: VK_FILTER_LINEAR or VK_FILTER_NEAREST.
    VkFilter min_filter;
    // Filter between mipmap levels: VK_SAMPLER_MIPMAP_MODE_LINEAR blends two levels, NEAREST reads the nearest level.
    VkSamplerMipmapMode mipmap_mode;
    // Address mode along u, for coordinates outside of the image: VK_SAMPLER_ADDRESS_MODE_REPEAT, MIRRORED_REPEAT or
    // CLAMP_TO_EDGE.
    VkSamplerAddressMode address_u;
    // Address mode along v: the same possibilities as for u.
    VkSamplerAddressMode address_v;
    // Smallest alpha at which the surface exists.
    float cutoff;
    // 0.
    uint32_t reserved;
} GpcAlphaMap;

// Buffers that draws read, bound together: those of one mesh, or of many meshes that share buffers. The members have
// the same requirements as those of GpcGeometry.
typedef struct GpcMesh {
    // Buffer of vertex positions.
    VkBuffer positions;
    // Offset of the first position in bytes.
    uint64_t positions_offset;
    // Distance in bytes from one position to the next.
    uint32_t position_stride;
    // Largest number of vertices.
    uint32_t vertex_capacity;
    // Index buffer; ignored with VK_INDEX_TYPE_NONE_KHR.
    VkBuffer indices;
    // Offset of the first index in bytes.
    uint64_t indices_offset;
    // Type of the indices: VK_INDEX_TYPE_UINT16, VK_INDEX_TYPE_UINT32, or VK_INDEX_TYPE_NONE_KHR for none.
    VkIndexType index_type;
    // Largest number of indices.
    uint32_t index_capacity;
    // Buffer of the vertices' texture coordinates. VK_NULL_HANDLE if no draw of the mesh has an alpha map.
    VkBuffer coordinates;
    // Offset of the first vertex's coordinates in bytes.
    uint64_t coordinates_offset;
    // Distance in bytes from one vertex to the next.
    uint32_t coordinates_stride;
    // 0.
    uint32_t reserved;
    // Format of positions; VK_FORMAT_UNDEFINED stands for floats.
    VkFormat position_format;
    // Format of texture coordinates; VK_FORMAT_UNDEFINED stands for floats.
    VkFormat coordinates_format;
    // Factor on each component of a position; three zeros stand for 1.
    float position_scale[3];
    // Summand of each component of a position.
    float position_bias[3];
} GpcMesh;

// List of draws that the device writes, with the arguments of vkCmdDrawIndexedIndirect or, for a mesh without indices, of
// vkCmdDrawIndirect, and with capacities. The library reads the list when a recording is executed, so that compute shaders
// before, in the same command buffer, may decide what is drawn.
//
// Each instance of a command is a draw. Its number, firstInstance and on, which is gl_InstanceIndex of a vertex shader, is
// the index of its GpcInstance. All draws of a list have the state of one pipeline. Set members that are not used to 0.
typedef struct GpcIndirectDraws {
    // Buffer of commands, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT.
    VkBuffer commands;
    // Offset of the first command in bytes: a multiple of 4.
    uint64_t commands_offset;
    // Buffer with the number of commands, a 32-bit word, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT. With
    // VK_NULL_HANDLE the number is `command_capacity`.
    VkBuffer count;
    // Offset of the number of commands in bytes: a multiple of 4.
    uint64_t count_offset;
    // Buffer of the instances, an array of GpcInstance, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT.
    VkBuffer instances;
    // Offset of the first instance in bytes: a multiple of 256, or of the device's minStorageBufferOffsetAlignment and 16.
    uint64_t instances_offset;
    // Distance in bytes from one command to the next: a multiple of 4, at least the size of a command.
    uint32_t command_stride;
    // Largest number of commands, up to 1,048,576.
    uint32_t command_capacity;
    // Number of instances in the buffer.
    uint32_t instance_capacity;
    // Largest number of draws: instances of all commands.
    uint32_t draw_capacity;
    // Largest number of triangles of all draws.
    uint32_t triangle_capacity;
    // Largest number of vertices of all draws, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    uint32_t position_capacity;
    // Mesh whose buffers the draws read: see GpcDraw.mesh.
    uint32_t mesh;
    // Topology of the draws: a GpcTopology.
    uint32_t topology;
    // Orientation of front faces in the image: see GpcDraw.front_face.
    VkFrontFace front_face;
    // VK_TRUE if back faces are visible.
    VkBool32 double_sided;
    // VK_TRUE if the draws have alpha maps.
    VkBool32 alpha_tested;
    // VK_TRUE if the draws are blended.
    VkBool32 blended;
} GpcIndirectDraws;

// Buffers and capacities of the application. The contents of the buffers may change in every frame: the library reads
// them when a recording is executed.
typedef struct GpcGeometry {
    // sizeof(GpcGeometry).
    uint32_t size;
    // GPC_STRUCT_TYPE_GEOMETRY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Largest number of vertices. A larger index is clamped to the last vertex; in object space, to the last vertex of
    // the draw.
    uint32_t vertex_capacity;
    // Buffer of vertex positions, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, and with
    // VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT too if positions are in clip space with a stride of 16 bytes. With 16-bit
    // components, its size is a multiple of 4 bytes.
    VkBuffer positions;
    // Offset of the first position in bytes: a multiple of the size of a component, 4 bytes for floats.
    uint64_t positions_offset;
    // Distance in bytes from one position to the next: a multiple of the size of a component, and at least the size of a
    // position.
    uint32_t position_stride;
    // Space and format of positions: a GpcPositionSpace.
    uint32_t position_space;
    // Largest total number of vertices of a recording's draws, with GPC_POSITION_SPACE_OBJECT; otherwise ignored. Vertices
    // that several draws share count once for each draw.
    uint32_t position_capacity;
    // Type of the indices: VK_INDEX_TYPE_UINT16 or VK_INDEX_TYPE_UINT32; VK_INDEX_TYPE_NONE_KHR without indices, so
    // that draws read consecutive vertices, as vkCmdDraw does.
    VkIndexType index_type;
    // Index buffer, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; ignored with VK_INDEX_TYPE_NONE_KHR. With 16-bit
    // indices, its size is a multiple of 4 bytes.
    VkBuffer indices;
    // Offset of the first index in bytes: a multiple of the size of an index.
    uint64_t indices_offset;
    // Largest number of indices.
    uint32_t index_capacity;
    // Largest total number of triangles of a recording's draws. 0 is possible if there are indirect draws.
    uint32_t triangle_capacity;
    // Largest number of draws of a recording. 0 is possible if there are indirect draws.
    uint32_t draw_capacity;
    // Number of shading keys, 1 to 16,383.
    uint32_t keys;
    // VK_TRUE if y points up in clip space, as with a viewport of negative height; VK_FALSE if y points down, Vulkan's
    // default.
    VkBool32 y_up;
    // VK_TRUE if depth is reversed: from 1 at the near plane to 0 at the far plane; VK_FALSE if it runs from 0 to 1.
    VkBool32 reversed_depth;
    // Buffer of the vertices' texture coordinates, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; ignored without alpha
    // maps. With 16-bit components, its size is a multiple of 4 bytes.
    VkBuffer coordinates;
    // Offset of the first vertex's coordinates in bytes: a multiple of the size of a component, 4 bytes for floats.
    uint64_t coordinates_offset;
    // Distance in bytes from one vertex to the next: a multiple of the size of a component, at least two components.
    uint32_t coordinates_stride;
    // Number of alpha maps.
    uint32_t alpha_map_count;
    // sizeof(GpcAlphaMap), if there are alpha maps.
    uint32_t alpha_map_stride;
    // VK_TRUE if draws may be blended.
    VkBool32 blended;
    // Alpha maps of draws that are not opaque, read during the call only. The library reads their images when a
    // frame's first recording is executed, in the layout VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, and keeps a copy of
    // their alpha. May be NULL if there are none.
    const struct GpcAlphaMap *alpha_maps;
    // Meshes beyond the first, read during the call only; may be NULL if there are none. The members `positions` to
    // `index_capacity` and `coordinates` to `coordinates_stride` are mesh 0, and the first element here is mesh 1: see
    // GpcDraw.mesh.
    const struct GpcMesh *more_meshes;
    // Number of elements of `more_meshes`.
    uint32_t more_mesh_count;
    // sizeof(GpcMesh), if there are further meshes.
    uint32_t more_mesh_stride;
    // Value in the depth image for the clip-space depth 0: minDepth of the application's VkViewport. gpc_init_geometry
    // sets 0.
    float min_depth;
    // Value in the depth image for the clip-space depth 1: maxDepth of the application's VkViewport. gpc_init_geometry
    // sets 1.
    float max_depth;
    // Lists of draws that the device writes, in addition to the draws of a recording, with capacities of their own. Read
    // during the call only; may be NULL if there are none.
    const struct GpcIndirectDraws *indirect_draws;
    // Number of elements of `indirect_draws`.
    uint32_t indirect_draws_count;
    // sizeof(GpcIndirectDraws), if there are lists of indirect draws.
    uint32_t indirect_draws_stride;
    // Format of positions with GPC_POSITION_SPACE_OBJECT: three components or more, of 32-bit SFLOAT, or of 16-bit SFLOAT,
    // UNORM or SNORM. VK_FORMAT_UNDEFINED, as gpc_init_geometry sets it, stands for floats.
    VkFormat position_format;
    // Format of texture coordinates: two components or more, of these types. VK_FORMAT_UNDEFINED stands for floats.
    VkFormat coordinates_format;
    // Factor on each component of a position; three zeros, as gpc_init_geometry sets them, stand for 1. A component is
    // bias + scale * number, where UNORM and SNORM divide the integer by 65,535 and 32,767.
    float position_scale[3];
    // Summand of each component of a position.
    float position_bias[3];
} GpcGeometry;

// Kinds of images with which a frame is recorded.
typedef struct GpcImageKinds {
    // sizeof(GpcImageKinds).
    uint32_t size;
    // GPC_STRUCT_TYPE_IMAGE_KINDS.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // VK_TRUE if the application lends triangle IDs; VK_FALSE if the library draws IDs and depth itself.
    VkBool32 ids;
    // VK_TRUE if the application lends depth. This requires `ids`; with `ids`, GpcOptions.thin requires depth.
    VkBool32 depth;
    // Format of the views of the colour image: 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or
    // B10G11R11_UFLOAT.
    VkFormat color_format;
    // VK_TRUE if the application's shaders write sRGB codes into a format of plain numbers; VK_FALSE if the colour
    // image holds linear light, or its format encodes the light.
    VkBool32 color_encoded;
    // VK_TRUE if the colour image has VK_IMAGE_USAGE_TRANSFER_SRC_BIT in the place of VK_IMAGE_USAGE_SAMPLED_BIT, as the
    // images of some swapchains. The library then reads a copy of the frame's part, in an image of its own.
    VkBool32 color_copied;
    // 0.
    uint32_t reserved;
} GpcImageKinds;

// Options of antialiasing a frame; gpc_init_options sets defaults.
typedef struct GpcOptions {
    // sizeof(GpcOptions).
    uint32_t size;
    // GPC_STRUCT_TYPE_OPTIONS.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Width of the frame in pixels: of the part of the lent images that is antialiased.
    uint32_t width;
    // Height of the frame in pixels: of the part of the lent images that is antialiased.
    uint32_t height;
    // Number of samples of a superpixel, 1 to 1,024.
    uint32_t samples;
    // Pattern of the sample locations: a GpcPattern.
    uint32_t pattern;
    // Rate of shading within a superpixel: a GpcShading.
    uint32_t shading;
    // Rule by which a pixel becomes a superpixel: a GpcDetection.
    uint32_t detection;
    // Contrast threshold in 8-bit sRGB code values, 0 to 255, or GPC_CONTRAST_OF_SAMPLES: two colours contrast if any
    // channel differs by more.
    uint32_t contrast;
    // VK_TRUE if a triangle that is too thin to cover a pixel's centre makes the pixel a superpixel. If IDs are lent,
    // depth is needed too.
    VkBool32 thin;
    // VK_TRUE if the image holds radiance that is tone-mapped later; detection then compares tone-mapped colours.
    VkBool32 high_dynamic_range;
    // VK_TRUE if textures are filtered over the area that each sample represents; VK_FALSE if over the whole pixel.
    VkBool32 sharp;
    // VK_TRUE if the application's shading computes the colours of all pixels, so that the colour image may have any
    // contents before; VK_FALSE if only superpixels are shaded, and drawn over the image's contents.
    VkBool32 shade_all;
    // VK_TRUE if the background has the colour `background`; VK_FALSE if it is transparent. The background is visible
    // where there is no triangle and, unless `flat_background` is set, where the application has drawn nothing either.
    VkBool32 has_background;
    // Background as linear light.
    float background[3];
    // VK_TRUE if the background is visible wherever there is no triangle.
    //
    // With VK_FALSE, if the application lends its colours, a sample of a superpixel that meets no triangle takes the
    // colour and alpha that the application has drawn: of the pixel if its centre shows no triangle, else of the
    // nearest such pixel among the 8 around it, then among the 24 around it, else the background.
    //
    // GpcGeometry.blended requires VK_TRUE. With `shade_all`, the flag is ignored.
    VkBool32 flat_background;
    // Largest number of rounds for the detected superpixels, and for each growth; this bounds the time of a recording.
    // Superpixels that these rounds leave keep their drawn colours and are counted as left over.
    //
    // 0 allows as many rounds as any image may need. Rounds without work take next to no time on devices with
    // GpcDevice.conditional_rendering. On others each takes a little, and the time of the callback's commands.
    uint32_t max_rounds;
    // Number of pairs in `locations`: equal to `samples`, with GPC_PATTERN_LIST.
    uint32_t location_count;
    // Offsets of the samples from the pixel's centre in pixels, with GPC_PATTERN_LIST; otherwise ignored. x points to
    // the right and y down, each at least -0.5 and below 0.5. Read during the call only.
    const float (*locations)[2];
    // Largest number of bytes of device memory for a frame. With 0, a first frame takes at most 960 MiB besides its
    // triangles on GPUs with memory of their own, if the image has up to 3840 x 2160 pixels, and as much as it needs otherwise.
    uint64_t max_memory;
    // Number of growths, with GPC_DETECTION_CONTRAST: 0 to 8, or GPC_GROWTHS_OF_SAMPLES. In each growth, pixels that
    // contrast with a neighbouring superpixel become superpixels too.
    uint32_t growths;
    // VK_TRUE if the memory of a frame or list stays as it is; VK_FALSE if gpc_frame_record and gpc_list_record make
    // more after a recording that was left unfinished.
    VkBool32 fixed_memory;
    // VK_TRUE if the alpha of the colour image stays as it is. With VK_FALSE, each pixel that the library draws gets the
    // mean opacity of its samples: 1 where a triangle that is not blended is seen, whatever the shading stores, and the
    // drawn alpha, or that of the background, where none is. With `shade_all`, the image has to hold something before.
    VkBool32 keep_alpha;
    // 0.
    uint32_t reserved;
    // Filter by which pixels are averaged: a GpcFilter. With filters other than GPC_FILTER_BOX, the library draws all pixels of
    // the frame: each is an average of the superpixels and of the application's pixels around it, also where the application has
    // drawn what the library does not know. Pixels beyond the frame's edge have no weight. Alpha is filtered as a channel of its
    // own, and limited to 0 to 1. Lists have GPC_FILTER_BOX only.
    uint32_t filter;
    // Distance from the pixel's centre at which the filter ends, along x and along y: 0.5 to 2.5 pixels, or 0 for the default of
    // `filter`. With GPC_FILTER_BOX, 0 or 0.5.
    float filter_radius;
} GpcOptions;

// State of an image, as in VkImageMemoryBarrier2.
typedef struct GpcImageState {
    // Layout of the image.
    VkImageLayout layout;
    // Pipeline stages that use the image.
    VkPipelineStageFlags2 stage;
    // Memory accesses of these stages.
    VkAccessFlags2 access;
} GpcImageState;

// Image of the application: single-sampled, with one level, and at least as large as the size in GpcOptions.
typedef struct GpcImage {
    // Handle of the image.
    VkImage image;
    // Two-dimensional view of the image, with a single aspect and a single layer.
    VkImageView view;
    // All aspects of the image's format, including stencil, which the library does not read.
    VkImageAspectFlags aspects;
    // State of the image when the recording begins.
    struct GpcImageState before;
    // State of the image when the recording is done.
    struct GpcImageState after;
} GpcImage;

// Images that the application has drawn with one sample a pixel. The result is drawn into `color`. The images are of
// the kinds for which the frame was created.
typedef struct GpcImages {
    // sizeof(GpcImages).
    uint32_t size;
    // GPC_STRUCT_TYPE_IMAGES.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Image of triangle IDs, VK_FORMAT_R32_UINT, created with VK_IMAGE_USAGE_SAMPLED_BIT: 1 + the index of the nearest
    // triangle in the order of the frame's draws, 0 for no triangle. Without GpcImageKinds.ids, image and view are
    // VK_NULL_HANDLE.
    struct GpcImage ids;
    // Image of the nearest triangle's depth, of any depth format, created with VK_IMAGE_USAGE_SAMPLED_BIT; its view
    // has the depth aspect only. Without GpcImageKinds.depth, image and view are VK_NULL_HANDLE.
    struct GpcImage depth;
    // Colour image, created with VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, and with VK_IMAGE_USAGE_SAMPLED_BIT unless
    // GpcImageKinds.color_copied says otherwise. Superpixels are drawn into it.
    struct GpcImage color;
    // Upper left pixel of the frame's part of these images. The part has the size in GpcOptions; the library neither
    // reads nor writes pixels outside of it.
    uint32_t corner[2];
    // Array layer of the images that the views show, of which the library changes the layout.
    uint32_t layer;
    // 0.
    uint32_t reserved;
} GpcImages;

// Visibility samples of a round, sorted by shading key, on the device.
typedef struct GpcVisibilitySamples {
    // The library's sizeof(GpcVisibilitySamples).
    uint32_t size;
    // GPC_STRUCT_TYPE_VISIBILITY_SAMPLES.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Number of shading keys.
    uint32_t keys;
    // Descriptor set with the layout of gpc_antialiaser_samples_layout, to be bound for compute at the set number that
    // the shaders use.
    VkDescriptorSet descriptor_set;
    // Buffer of the keys' indirect dispatches, in workgroups of 64 invocations.
    VkBuffer dispatches;
    // Offset of the dispatch of key 0 in the buffer, in bytes.
    uint64_t dispatch_offset;
    // Distance in bytes from the dispatch of one key to that of the next.
    uint64_t dispatch_stride;
    // Buffer for conditional rendering; its first 32-bit word is zero if the round has no work. The dispatches of such
    // a round have no workgroups. To skip them altogether, record them between vkCmdBeginConditionalRenderingEXT, with
    // this buffer and offset 0, and its end, within the callback. VK_NULL_HANDLE without
    // GpcDevice.conditional_rendering, and for shading outside of rounds.
    VkBuffer condition;
} GpcVisibilitySamples;

// Function of the application that records the shading of a round's samples into a command buffer: for each key, a
// pipeline, the samples' descriptor set, and the key's indirect dispatch. `samples` lives until the function returns.
//
// gpc_frame_record and gpc_list_record call the function on their thread, a fixed number of times, also for rounds
// without work, outside of a render pass and of conditional rendering. The library's writes are visible to the
// dispatches, which need no barrier between them, and the library waits for their writes.
//
// The function may bind and push anything. The function must not throw or jump out, and must not use the frame or
// list.
typedef void (*GpcShade)(void *user, VkCommandBuffer commands, const struct GpcVisibilitySamples *samples);

// Buffers of the application for a list: sample locations, and the resulting colours.
typedef struct GpcLocationList {
    // sizeof(GpcLocationList).
    uint32_t size;
    // GPC_STRUCT_TYPE_LOCATION_LIST.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Largest number of locations of a recording.
    uint32_t capacity;
    // Buffer of GpcLocations, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and
    // VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT. Its contents may change with every recording.
    VkBuffer locations;
    // Offset of the first location in bytes: a multiple of 256, or of the device's offset alignment for buffer
    // descriptors.
    uint64_t offset;
    // Buffer for the colours of the locations, created with VK_BUFFER_USAGE_TRANSFER_DST_BIT. Each location, in the
    // order of the list, gets four floats: linear light, premultiplied by opacity, and opacity.
    VkBuffer colors;
    // Offset of the first location's colour in bytes: a multiple of 4.
    uint64_t colors_offset;
} GpcLocationList;

// Locations and draws of a recording of a list.
typedef struct GpcListScenery {
    // sizeof(GpcListScenery).
    uint32_t size;
    // GPC_STRUCT_TYPE_LIST_SCENERY.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Number of locations to sample, from the first one of the buffer on.
    uint32_t location_count;
    // Number of draws.
    uint32_t draw_count;
    // Draws, read during the call only. May be NULL if there are none.
    const struct GpcDraw *draws;
    // sizeof(GpcDraw), if there are draws.
    uint32_t draw_stride;
    // 0.
    uint32_t reserved;
} GpcListScenery;

// Result of a recording of a list.
typedef struct GpcListOutcome {
    // sizeof(GpcListOutcome).
    uint32_t size;
    // GPC_STRUCT_TYPE_LIST_OUTCOME.
    uint32_t type;
    // NULL, or a structure that extends this one.
    const void *next;
    // Number of locations that lie outside of the image or are not finite; these show the background.
    uint32_t left_out;
    // Number of cells and tiles for which memory or GpcOptions.max_rounds did not suffice; these show the background.
    // The list's next recording has more memory, unless GpcOptions.fixed_memory is set.
    uint64_t left_over;
    // Number of visibility samples that were shaded.
    uint64_t visibility_samples;
    // Number of bytes of device memory that the list uses, without the application's buffers.
    uint64_t memory_bytes;
    // Time of the library's commands on the device in milliseconds; 0 if the queue has no timestamps.
    double gpu_milliseconds;
} GpcListOutcome;

// Sample location on the image plane: 32 bytes, an element of a GpcLocationList's buffer.
typedef struct GpcLocation {
    // Column and row of the pixel that contains the location, from the upper left corner of the image of the size in
    // GpcOptions.
    int32_t pixel[2];
    // Position in that pixel: x to the right and y down, from 0 to 1.
    float within[2];
    // Jacobian of the location's mapping, in pixels: the changes of x and y to the next column, and those to the next
    // row, of the application's output. Sub-samples and texture filters cover this parallelogram.
    float jacobian[2][2];
} GpcLocation;

// What a draw of a GpcIndirectDraws has besides its command: an element of a buffer that the device reads, and never
// changes. gpc_instance.glsl declares the same structure for shaders.
typedef struct GpcInstance {
    // Matrix from object space to clip space, by columns, with GPC_POSITION_SPACE_OBJECT; otherwise ignored.
    float to_clip[4][4];
    // Number of vertices from the command's vertexOffset or firstVertex on, with GPC_POSITION_SPACE_OBJECT.
    uint32_t vertex_count;
    // Shading key.
    uint32_t key;
    // Number of the application's choice, which its shaders can read. Triangles with the same lower 16 bits are assumed to
    // look alike: see GpcDraw.material.
    uint32_t material;
    // 1 + the index of the alpha map, if the draws of the list have alpha maps; otherwise 0.
    uint32_t alpha_map;
    // 1 if the colour may vary within a pixel, otherwise 0.
    uint32_t detailed;
    // 0.
    uint32_t reserved[3];
} GpcInstance;

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
// Errors: GPC_RESULT_UNSUPPORTED lists what is missing; GPC_RESULT_VALUE is a flag or a queue family that is not possible;
// GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_VULKAN.
// `*antialiaser` is then NULL.
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

// Message of the calling thread's last call that failed: UTF-8, in English, for logs. Never NULL; empty if no call has
// failed. The pointer is the same in all calls of a thread, so printf("%u %s", gpc_frame_record(...), gpc_last_error())
// prints the message of that call, whichever argument is computed first.
//
// Threads: any. Each thread has its own message.
// Lifetime: the text is that of the thread's last failure; the pointer is valid until the thread ends.
const char *gpc_last_error(void);

// Fills a GpcScenery of `size` bytes, which is sizeof(GpcScenery), without draws.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_scenery(struct GpcScenery *scenery, size_t size);

// Fills a GpcOutcome of `size` bytes, which is sizeof(GpcOutcome).
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_outcome(struct GpcOutcome *outcome, size_t size);

// Makes the pipelines and memory of a frame. An application has one for each frame in flight, whatever the number of
// its swapchain's images, and makes new ones if a buffer changes. Frames share the memory that the library's passes
// hand to each other if its size suffices for several, so the commands of all frames of an antialiaser must be
// executed on one queue.
//
// Threads: any; several frames may be created at once.
// Lifetime: the lent buffers and alpha maps outlive the frame. The structs are read during the call only.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
// GPC_RESULT_VULKAN. `*frame` is then NULL.
GpcResult gpc_frame_create(const struct GpcAntialiaser *antialiaser,
                           const struct GpcGeometry *geometry,
                           const struct GpcImageKinds *kinds,
                           const struct GpcOptions *options,
                           struct GpcFrame **frame);

// Makes a frame like `frame`, for the same buffers and kinds of images, with more of the memory that the last
// recording lacked. If it lacked none, the new frame has as much memory as the old one. The old frame still has to be
// destroyed. With GpcOptions.fixed_memory, this is the way to more memory; otherwise gpc_frame_record takes care of it.
//
// Threads: no other call uses the frame at the same time. Lifetime: the lent buffers and alpha maps outlive the new
// frame too.
// Errors: as gpc_frame_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
GpcResult gpc_frame_grow(const struct GpcFrame *frame,
                         struct GpcFrame **grown);

// Changes the size of the images, in pixels. Pipelines are kept, and so is shared memory that suffices. Memory of the frame
// alone, which is small, is made anew. If shared memory does not suffice, the first frame that is resized allocates memory, which the other frames
// of the antialiaser then share.
//
// Threads: no other call uses the frame at the same time.
// Lifetime: the commands of the frame's last recording are done, or will never be executed.
// Errors: as gpc_frame_create; the frame is unchanged then.
GpcResult gpc_frame_resize(struct GpcFrame *frame,
                           uint32_t width,
                           uint32_t height);

// Records the antialiasing of the images that the application has drawn, such as the current image of a swapchain. The
// images have the kinds and the size for which the frame was created. The call neither submits nor waits. It updates
// descriptor sets of the frame, so the commands of the frame's last recording must be done.
//
// The call allocates no device memory, with one exception: if the last recording left work over for want of memory, the
// frame first gets more of it, as by gpc_frame_resize. If the device has no more, the frame keeps what it has.
// GpcOptions.fixed_memory forbids this.
//
// `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the lent family.
// The application must bind and push its state again afterwards. `user` is passed to `shade`, whose shaders write no
// memory of the library except by gpc_store.
//
// Threads: no other call uses the frame or the command buffer at the same time. Different frames may be recorded at
// the same time.
// Lifetime: the commands of the frame's last recording are done, or will never be executed. The frame, the buffers,
// the images and the objects that `shade` records outlive the execution of the commands.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY; GPC_RESULT_DEVICE_LOST
// and GPC_RESULT_VULKAN while the frame gets more memory. Nothing is recorded then.
GpcResult gpc_frame_record(struct GpcFrame *frame,
                           VkCommandBuffer commands,
                           const struct GpcImages *images,
                           const struct GpcScenery *scenery,
                           GpcShade shade,
                           void *user);

// Result of the last recording, available once its commands are done, until the next recording begins. The call does
// not wait: if the commands were not submitted or still run, the result is GPC_RESULT_NOT_READY. If the commands are
// submitted again, call this only when that submission is done: until the device begins it, it is taken for done.
//
// Threads: no gpc_frame_record of the frame runs at the same time.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
GpcResult gpc_frame_outcome(const struct GpcFrame *frame,
                            struct GpcOutcome *outcome);

// Number of bytes of device memory that a frame uses, without the application's buffers and images; 0 for NULL.
//
// Threads: any.
uint64_t gpc_frame_memory_bytes(const struct GpcFrame *frame);

// Part of gpc_frame_memory_bytes that other frames of the same antialiaser may use too, in bytes; counts once for all
// of them. 0 for NULL.
//
// Threads: any.
uint64_t gpc_frame_shared_memory_bytes(const struct GpcFrame *frame);

// Destroys a frame, whose commands are done. NULL is ignored.
//
// Threads: no other call uses the frame at the same time.
void gpc_frame_destroy(struct GpcFrame *frame);

// Fills a GpcGeometry of `size` bytes, which is sizeof(GpcGeometry): without buffers, with one shading
// key, positions in clip space, 16-bit indices, and depth from 0 to 1.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_geometry(struct GpcGeometry *geometry, size_t size);

// Fills a GpcImageKinds of `size` bytes, which is sizeof(GpcImageKinds): with a colour image only, whose format still
// has to be set.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_image_kinds(struct GpcImageKinds *kinds,
                               size_t size);

// Fills a GpcImages of `size` bytes, which is sizeof(GpcImages), without images.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_images(struct GpcImages *images, size_t size);

// Fills a GpcLocationList of `size` bytes, which is sizeof(GpcLocationList), without buffers.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_location_list(struct GpcLocationList *list, size_t size);

// Fills a GpcListScenery of `size` bytes, which is sizeof(GpcListScenery), without locations and draws.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_list_scenery(struct GpcListScenery *scenery, size_t size);

// Fills a GpcListOutcome of `size` bytes, which is sizeof(GpcListOutcome).
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_list_outcome(struct GpcListOutcome *outcome, size_t size);

// Makes the pipelines and memory to sample a list of locations. With one sample, each location is sampled at its own
// position; with more, as a superpixel around it. `width` and `height` are the size of the image in whose pixels
// locations are given. A list has no neighbouring pixels, so that the options `detection`, `contrast`, `growths`,
// `thin`, `flat_background`, `high_dynamic_range` and `shade_all` have no effect, and `filter` has to be GPC_FILTER_BOX.
//
// Threads: any; several lists may be created at once.
// Lifetime: the lent buffers and views outlive the list. The structs are read during the call only.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
// GPC_RESULT_VULKAN. `*list` is then NULL.
GpcResult gpc_list_create(const struct GpcAntialiaser *antialiaser,
                          const struct GpcGeometry *geometry,
                          const struct GpcLocationList *locations,
                          const struct GpcOptions *options,
                          struct GpcList **list);

// Makes a list like `list`, for the same buffers, with more of the memory that the last recording lacked. If it lacked
// none, the new list has as much memory as the old one. The old list still has to be destroyed. With
// GpcOptions.fixed_memory, this is the way to more memory; otherwise gpc_list_record takes care of it.
//
// Threads: no other call uses the list at the same time. Lifetime: the lent buffers and views outlive the new list
// too.
// Errors: as gpc_list_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
GpcResult gpc_list_grow(const struct GpcList *list,
                        struct GpcList **grown);

// Records the sampling of locations. The call neither submits nor waits.
//
// The call allocates no device memory and updates no descriptor, with one exception: if the last recording left work over
// for want of memory, the list first gets more of it. If the device has no more, the list keeps what it has.
// GpcOptions.fixed_memory forbids this.
//
// `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the lent family.
// The application must bind and push its state again afterwards; the results are visible to all later commands. `user`
// is passed to `shade`, whose shaders write no memory of the library except by gpc_store.
//
// Threads: no other call uses the list or the command buffer at the same time. Different lists may be recorded at the
// same time.
// Lifetime: the commands of the list's last recording are done, or will never be executed. The list, the buffers and
// the objects that `shade` records outlive the execution of the commands.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY; GPC_RESULT_DEVICE_LOST
// and GPC_RESULT_VULKAN while the list gets more memory. Nothing is recorded then.
GpcResult gpc_list_record(struct GpcList *list,
                          VkCommandBuffer commands,
                          const struct GpcListScenery *scenery,
                          GpcShade shade,
                          void *user);

// Result of the last recording, available once its commands are done, until the next recording begins. The call does
// not wait: if the commands were not submitted or still run, the result is GPC_RESULT_NOT_READY. If the commands are
// submitted again, call this only when that submission is done: until the device begins it, it is taken for done.
//
// Threads: no gpc_list_record of the list runs at the same time.
// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
GpcResult gpc_list_outcome(const struct GpcList *list,
                           struct GpcListOutcome *outcome);

// Number of bytes of device memory that a list uses, without the application's buffers; 0 for NULL.
//
// Threads: any.
uint64_t gpc_list_memory_bytes(const struct GpcList *list);

// Destroys a list, whose commands are done. NULL is ignored.
//
// Threads: no other call uses the list at the same time.
void gpc_list_destroy(struct GpcList *list);

// Fills a GpcOptions of `size` bytes, which is sizeof(GpcOptions), with defaults: 64 samples, detection of contrast
// and thin triangles, shading in parts. `width` and `height` still have to be set.
//
// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
GpcResult gpc_init_options(struct GpcOptions *options,
                           size_t size);

// Checks that a shader was compiled with a supported version of gpc_visibility.glsl. Call this for each shader that
// shades samples, where its pipeline is made. The arguments are those of VkShaderModuleCreateInfo: `code_size` is in
// bytes.
//
// Threads: any.
// Errors: GPC_RESULT_NULL; GPC_RESULT_VALUE if the code is not SPIR-V; GPC_RESULT_SHADER_VERSION.
GpcResult gpc_check_shader(const uint32_t *code,
                           size_t code_size);

// Version of the library, packed as GPC_VERSION is.
//
// Threads: any.
uint32_t gpc_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus
