/* Results and messages for bad input, through the header in C99. The program's exit status says whether all was as expected. */

#include <gpc.h>
#include <vulkan/vulkan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define EXPECT(condition, what)                                                 \
    do {                                                                        \
        if (!(condition)) {                                                     \
            ++failures;                                                         \
            printf("line %d: %s: \"%s\"\n", __LINE__, what, gpc_last_error());  \
        }                                                                       \
    } while (0)

/* Expects that a call returns a result, and sets a message that contains a text. */
#define ANSWERS(call, result, text)                                             \
    EXPECT((call) == (result) && strstr(gpc_last_error(), text) != NULL, #call)

#define MUST(call)                                                              \
    do {                                                                        \
        if ((call) != VK_SUCCESS) {                                             \
            printf("%s failed: \"%s\"\n", #call, gpc_last_error());             \
            exit(1);                                                            \
        }                                                                       \
    } while (0)

enum { SIDE = 64, VERTICES = 12, INDICES = 12 };

static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice device;
static uint32_t family;
static GpcAntialiaser *antialiaser;

static VkDeviceMemory allocate(VkMemoryRequirements needs) {
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size};
    VkDeviceMemory memory;
    while (!(needs.memoryTypeBits >> info.memoryTypeIndex & 1)) ++info.memoryTypeIndex;
    MUST(vkAllocateMemory(device, &info, NULL, &memory));
    return memory;
}

static VkBuffer make_buffer(VkDeviceSize bytes, VkDeviceMemory *memory) {
    VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = bytes,
        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
    };
    VkMemoryRequirements needs;
    VkBuffer buffer;
    MUST(vkCreateBuffer(device, &info, NULL, &buffer));
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    *memory = allocate(needs);
    MUST(vkBindBufferMemory(device, buffer, *memory, 0));
    return buffer;
}

static GpcImage make_image(VkFormat format, VkDeviceMemory *memory) {
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {SIDE, SIDE, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
    };
    GpcImage image = {
        .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
        .before = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE},
        .after = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE},
    };
    VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    VkMemoryRequirements needs;
    MUST(vkCreateImage(device, &info, NULL, &image.image));
    vkGetImageMemoryRequirements(device, image.image, &needs);
    *memory = allocate(needs);
    MUST(vkBindImageMemory(device, image.image, *memory, 0));
    view.image = image.image;
    MUST(vkCreateImageView(device, &view, NULL, &image.view));
    return image;
}

static void without_a_device(void) {
    VkPhysicalDeviceVulkan13Features features = {.privateData = VK_TRUE};
    const uint32_t words[5] = {0x07230203};
    EXPECT(gpc_version() == GPC_VERSION && GPC_VERSION >> 12 == (GPC_VERSION_MAJOR << 10 | GPC_VERSION_MINOR), "the version");
    const char *message = gpc_last_error();
    EXPECT(message[0] == '\0', "the message before any failure");
    ANSWERS(gpc_require_features(NULL), GPC_RESULT_NULL, "features is NULL");
    EXPECT(strcmp(message, "features is NULL") == 0, "a pointer to the message from before the failure");
    ANSWERS(gpc_require_features(&features), GPC_RESULT_VALUE, "features->sType is 0");
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    EXPECT(gpc_require_features(&features) == GPC_RESULT_SUCCESS, "features");
    EXPECT(features.privateData && features.dynamicRendering && features.synchronization2 && !features.inlineUniformBlock,
           "features are added to what is set");

    GpcOptions options = {.samples = 7};
    ANSWERS(gpc_init_options(NULL, sizeof options), GPC_RESULT_NULL, "GpcOptions is NULL");
    ANSWERS(gpc_init_options(&options, 4), GPC_RESULT_STRUCT_SIZE, "the size of a GpcOptions is 4; it can be sizeof(GpcOptions), which is");
    ANSWERS(gpc_init_options(&options, sizeof options + 8), GPC_RESULT_STRUCT_SIZE, "compiled with the header of a later version");
    EXPECT(options.samples == 7, "a struct of another size is left alone");
    MUST((VkResult)gpc_init_options(&options, sizeof options));
    EXPECT(options.size == sizeof options && options.type == GPC_STRUCT_TYPE_OPTIONS && !options.next && options.samples == 64,
           "a struct that was filled");

    ANSWERS(gpc_check_device(NULL, NULL, NULL, NULL), GPC_RESULT_NULL, "get_instance_proc_addr is NULL");
    ANSWERS(gpc_check_device(vkGetInstanceProcAddr, NULL, NULL, NULL), GPC_RESULT_NULL, "instance is NULL");
    ANSWERS(gpc_antialiaser_create(NULL, NULL), GPC_RESULT_NULL, "antialiaser is NULL");
    ANSWERS(gpc_antialiaser_create(NULL, &antialiaser), GPC_RESULT_NULL, "GpcDevice is NULL");
    ANSWERS(gpc_check_shader(NULL, 4), GPC_RESULT_NULL, "code is NULL");
    ANSWERS(gpc_check_shader(words, 3), GPC_RESULT_VALUE, "the size of a shader is 3 bytes; it can be a multiple of 4");
    ANSWERS(gpc_check_shader(words, 4), GPC_RESULT_VALUE, "the shader is not SPIR-V");
    ANSWERS(gpc_check_shader(words, sizeof words), GPC_RESULT_SHADER_VERSION, "no specialization constant 2046");
    EXPECT(gpc_antialiaser_samples_layout(NULL) == VK_NULL_HANDLE, "the layout of nothing");
    EXPECT(gpc_frame_memory_bytes(NULL) == 0, "the memory of nothing");
    ANSWERS(gpc_frame_grow(NULL, NULL), GPC_RESULT_NULL, "grown is NULL");
    ANSWERS(gpc_frame_outcome(NULL, NULL), GPC_RESULT_NULL, "frame is NULL");
    ANSWERS(gpc_frame_record(NULL, NULL, NULL, NULL, NULL, NULL), GPC_RESULT_NULL, "frame is NULL");
    gpc_frame_destroy(NULL);
    gpc_antialiaser_destroy(NULL);
}

static PFN_vkVoidFunction VKAPI_PTR without_features2(VkInstance asked, const char *name) {
    return strcmp(name, "vkGetPhysicalDeviceFeatures2") == 0 ? NULL : vkGetInstanceProcAddr(asked, name);
}

static void old_instances(void) {
    for (uint32_t minor = 0; minor < 3; ++minor) {
        VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_MAKE_API_VERSION(0, 1, minor, 0)};
        VkInstanceCreateInfo instance_info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
        float priority = 1;
        VkDeviceQueueCreateInfo queue = {
            .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
        VkDeviceCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
        uint32_t count = 1;
        VkInstance old;
        GpcDevice lent;
        MUST(vkCreateInstance(&instance_info, NULL, &old));
        vkEnumeratePhysicalDevices(old, &count, &physical);
        ANSWERS(gpc_check_device(vkGetInstanceProcAddr, old, physical, NULL), GPC_RESULT_UNSUPPORTED,
                "create the instance for Vulkan 1.3");
        MUST(vkCreateDevice(physical, &info, NULL, &device));
        MUST((VkResult)gpc_init_device(&lent, sizeof lent));
        lent.get_instance_proc_addr = vkGetInstanceProcAddr;
        lent.instance = old;
        lent.physical_device = physical;
        lent.device = device;
        ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_UNSUPPORTED,
                "create the instance for Vulkan 1.3");
        vkDestroyDevice(device, NULL);
        vkDestroyInstance(old, NULL);
    }
}

/* Counts calls of functions that are lent to the library: naming of objects, allocation of memory, creation of pipelines. */
static int pipelines_named, buffers_named, images_named, allocated, freed, mapped, cached, uncached;
static VkPipelineCache cache;

static VkResult VKAPI_PTR count_name(VkDevice named, const VkDebugUtilsObjectNameInfoEXT *info) {
    PFN_vkSetDebugUtilsObjectNameEXT set =
        (PFN_vkSetDebugUtilsObjectNameEXT)vkGetDeviceProcAddr(named, "vkSetDebugUtilsObjectNameEXT");
    EXPECT(strncmp(info->pObjectName, "gpc ", 4) == 0 && info->pObjectName[4], "a name");
    pipelines_named += info->objectType == VK_OBJECT_TYPE_PIPELINE;
    buffers_named += info->objectType == VK_OBJECT_TYPE_BUFFER;
    images_named += info->objectType == VK_OBJECT_TYPE_IMAGE;
    return set(named, info);
}

static VkResult VKAPI_PTR count_compute(VkDevice used, VkPipelineCache with, uint32_t count, const VkComputePipelineCreateInfo *infos,
                                        const VkAllocationCallbacks *callbacks, VkPipeline *made) {
    *(with == cache ? &cached : &uncached) += 1;
    return vkCreateComputePipelines(used, with, count, infos, callbacks, made);
}

static VkResult VKAPI_PTR count_graphics(VkDevice used, VkPipelineCache with, uint32_t count,
                                         const VkGraphicsPipelineCreateInfo *infos, const VkAllocationCallbacks *callbacks,
                                         VkPipeline *made) {
    *(with == cache ? &cached : &uncached) += 1;
    return vkCreateGraphicsPipelines(used, with, count, infos, callbacks, made);
}

static PFN_vkVoidFunction VKAPI_PTR counting_device(VkDevice asked, const char *name) {
    PFN_vkVoidFunction found = vkGetDeviceProcAddr(asked, name);
    if (strcmp(name, "vkCreateComputePipelines") == 0) return (PFN_vkVoidFunction)count_compute;
    if (strcmp(name, "vkCreateGraphicsPipelines") == 0) return (PFN_vkVoidFunction)count_graphics;
    return found && strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0 ? (PFN_vkVoidFunction)count_name : found;
}

static PFN_vkVoidFunction VKAPI_PTR counting(VkInstance asked, const char *name) {
    return strcmp(name, "vkGetDeviceProcAddr") == 0 ? (PFN_vkVoidFunction)counting_device : vkGetInstanceProcAddr(asked, name);
}

static VkBool32 allocate_for_library(void *user, const GpcMemoryRequest *request, GpcMemory *memory) {
    VkPhysicalDeviceMemoryProperties properties;
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkMemoryPropertyFlags wanted = request->usage == GPC_MEMORY_USE_DEVICE
                                       ? VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                                       : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    EXPECT(request->size >= sizeof *request && request->type == GPC_STRUCT_TYPE_MEMORY_REQUEST && request->name[0], "a request");
    vkGetPhysicalDeviceMemoryProperties(physical, &properties);
    while (!(request->requirements.memoryTypeBits >> info.memoryTypeIndex & 1) ||
           (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted) {
        ++info.memoryTypeIndex;
    }
    /* The library must use the offset, so it is not 0. */
    memory->offset = request->requirements.alignment;
    memory->user = user;
    info.allocationSize = memory->offset + request->requirements.size;
    if (*(int *)user <= allocated || vkAllocateMemory(device, &info, NULL, &memory->memory) != VK_SUCCESS) return VK_FALSE;
    if (request->usage != GPC_MEMORY_USE_DEVICE) {
        MUST(vkMapMemory(device, memory->memory, memory->offset, request->requirements.size, 0, &memory->mapped));
        ++mapped;
    }
    ++allocated;
    return VK_TRUE;
}

static void free_of_library(void *user, const GpcMemory *memory) {
    EXPECT(memory->user == user && memory->offset > 0, "what was allocated");
    vkFreeMemory(device, memory->memory, NULL);
    ++freed;
}

static void make_device(void) {
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = GPC_VULKAN_API_VERSION};
    const char *names[1] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    VkInstanceCreateInfo instance_info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                          .pApplicationInfo = &application,
                                          .enabledExtensionCount = 1,
                                          .ppEnabledExtensionNames = names};
    uint32_t count = 1;
    float priority = 1;
    VkPhysicalDeviceVulkan13Features features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                               .pNext = &features,
                               .queueCreateInfoCount = 1,
                               .pQueueCreateInfos = &queue};
    MUST(vkCreateInstance(&instance_info, NULL, &instance));
    vkEnumeratePhysicalDevices(instance, &count, &physical);
    ANSWERS(gpc_check_device(without_features2, instance, physical, NULL), GPC_RESULT_UNSUPPORTED,
            "there is no vkGetPhysicalDeviceFeatures2: create the instance for Vulkan 1.3");
    ANSWERS(gpc_check_device(vkGetInstanceProcAddr, instance, NULL, NULL), GPC_RESULT_NULL, "physical_device is NULL");
    MUST((VkResult)gpc_check_device(vkGetInstanceProcAddr, instance, physical, &family));
    queue.queueFamilyIndex = family;
    gpc_require_features(&features);
    MUST(vkCreateDevice(physical, &info, NULL, &device));
}

static PFN_vkVoidFunction VKAPI_PTR nameless_device(VkDevice asked, const char *name) {
    return strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0 ? NULL : vkGetDeviceProcAddr(asked, name);
}

static PFN_vkVoidFunction VKAPI_PTR nameless(VkInstance asked, const char *name) {
    return strcmp(name, "vkGetDeviceProcAddr") == 0 ? (PFN_vkVoidFunction)nameless_device : vkGetInstanceProcAddr(asked, name);
}

static int most_allocations = 1000000;

static void make_antialiaser(void) {
    VkPipelineCacheCreateInfo cache_info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    GpcDevice lent;
    GpcOutcome other;
    memset(&lent, 0, sizeof lent);
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_STRUCT_SIZE, "GpcDevice.size is 0; it can be sizeof(GpcDevice), which is");
    EXPECT(strstr(gpc_last_error(), "as the struct's gpc_init function sets it") != NULL, "a struct of zeros");
    memset(&lent, 0x55, sizeof lent);
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_STRUCT_SIZE, "the struct's gpc_init function was not called");
    MUST((VkResult)gpc_init_outcome(&other, sizeof other));
    MUST((VkResult)gpc_init_device(&lent, sizeof lent));
    lent.type = GPC_STRUCT_TYPE_IMAGES;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_STRUCT_TYPE, "GpcDevice.type is 3; it can be 1");
    lent.type = GPC_STRUCT_TYPE_DEVICE;
    lent.next = &other;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_STRUCT_TYPE, "GpcDevice.next leads to a struct of type 7");
    lent.next = NULL;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_NULL, "get_instance_proc_addr is NULL");
    lent.queue_family = family;
    lent.get_instance_proc_addr = vkGetInstanceProcAddr;
    lent.instance = instance;
    lent.physical_device = physical;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_NULL, "GpcDevice.device is NULL");
    EXPECT(antialiaser == NULL, "what failed gives nothing");
    lent.device = device;
    lent.size += 8;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_STRUCT_SIZE, "compiled with the header of a later version");
    lent.size -= 8;
    lent.queue_family = 99;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_VALUE, "queue family 99 of device");
    lent.queue_family = family;
    lent.conditional_rendering = VK_TRUE;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_UNSUPPORTED, "create the device with VK_EXT_conditional_rendering");
    lent.conditional_rendering = VK_FALSE;
    lent.debug_utils = VK_TRUE;
    lent.get_instance_proc_addr = nameless;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_UNSUPPORTED,
            "GpcDevice.debug_utils is VK_TRUE and there is no vkSetDebugUtilsObjectNameEXT: create the instance with VK_EXT_debug_utils");
    lent.get_instance_proc_addr = counting;
    lent.free = free_of_library;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_NULL, "GpcDevice.allocate is NULL");
    lent.allocate = allocate_for_library;
    lent.free = NULL;
    ANSWERS(gpc_antialiaser_create(&lent, &antialiaser), GPC_RESULT_NULL, "GpcDevice.free is NULL");
    lent.free = free_of_library;
    lent.memory_user = &most_allocations;
    MUST(vkCreatePipelineCache(device, &cache_info, NULL, &cache));
    lent.pipeline_cache = cache;
    MUST((VkResult)gpc_antialiaser_create(&lent, &antialiaser));
}

static void shade_nothing(void *user, VkCommandBuffer commands, const GpcVisibilitySamples *samples) {
    (void)commands;
    (void)samples;
    ++*(int *)user;
}

static void recordings(GpcFrame *frame, GpcImages images) {
    VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandBufferCount = 1};
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    GpcDraw draws[2] = {{.triangle_count = 2, .vertex_count = 3}, {.first_index = 6, .triangle_count = 2, .vertex_count = 3}};
    const GpcImage ids = images.ids, none = {.view = VK_NULL_HANDLE};
    GpcScenery scenery;
    GpcOutcome outcome;
    GpcFrame *grown = NULL;
    int calls = 0;
    MUST((VkResult)gpc_init_outcome(&outcome, sizeof outcome));
    MUST((VkResult)gpc_init_scenery(&scenery, sizeof scenery));
    scenery.draw_count = 2;
    scenery.draws = draws;
    scenery.projection[0][0] = scenery.projection[1][1] = scenery.projection[2][2] = scenery.projection[3][3] = 1;
    MUST(vkCreateCommandPool(device, &pool_info, NULL, &info.commandPool));
    MUST(vkAllocateCommandBuffers(device, &info, &commands));
    MUST(vkBeginCommandBuffer(commands, &begin));
    ANSWERS(gpc_frame_outcome(frame, &outcome), GPC_RESULT_NOT_READY, "nothing was recorded yet");
    outcome.size = 0;

#define RECORD gpc_frame_record(frame, commands, &images, &scenery, shade_nothing, &calls)
    ANSWERS(gpc_frame_record(frame, commands, &images, NULL, shade_nothing, NULL), GPC_RESULT_NULL, "GpcScenery is NULL");
    ANSWERS(gpc_frame_record(frame, commands, NULL, &scenery, shade_nothing, NULL), GPC_RESULT_NULL, "GpcImages is NULL");
    ANSWERS(gpc_frame_record(frame, NULL, &images, &scenery, shade_nothing, NULL), GPC_RESULT_NULL, "commands is NULL");
    ANSWERS(gpc_frame_record(frame, commands, &images, &scenery, NULL, NULL), GPC_RESULT_NULL, "shade is NULL");
    scenery.draws = NULL;
    ANSWERS(RECORD, GPC_RESULT_NULL, "GpcScenery.draws is NULL");
    scenery.draws = draws;
    ANSWERS(RECORD, GPC_RESULT_STRUCT_SIZE, "GpcScenery.draw_stride is 0; it can be sizeof(GpcDraw), which is");
    scenery.draw_stride = sizeof draws[0];
    draws[1].material = 70000;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcDraw.material is 70000; it can be 0 to 65535");
    draws[1].material = 0;
    draws[0].double_sided = 2;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcDraw.double_sided is 2; it can be VK_FALSE (0), VK_TRUE (1)");
    draws[0].double_sided = VK_TRUE;
    draws[1].front_face = (VkFrontFace)2;
    ANSWERS(RECORD, GPC_RESULT_VALUE,
            "draw 1: GpcDraw.front_face is 2; it can be VK_FRONT_FACE_COUNTER_CLOCKWISE (0) or VK_FRONT_FACE_CLOCKWISE (1)");
    draws[1].front_face = VK_FRONT_FACE_CLOCKWISE;
    draws[1].key = 1;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "draw 1: GpcDraw.key is 1; it can be 0 to 0, by GpcGeometry.keys");
    draws[1].key = 0;
    draws[1].mesh = 1;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "draw 1: GpcDraw.mesh is 1; it can be 0 to 0, by GpcGeometry.more_meshes");
    draws[1].mesh = 0;
    draws[1].topology = 3;
    ANSWERS(RECORD, GPC_RESULT_VALUE,
            "GpcDraw.topology is 3; it can be GPC_TOPOLOGY_LIST (0), GPC_TOPOLOGY_STRIP (1), GPC_TOPOLOGY_FAN (2)");
    draws[1].topology = GPC_TOPOLOGY_STRIP;
    draws[1].triangle_count = 5;
    ANSWERS(RECORD, GPC_RESULT_CAPACITY, "draw 1: it reads indices up to 13, and there are 12");
    draws[1].topology = GPC_TOPOLOGY_LIST;
    draws[1].triangle_count = 2;
    draws[1].alpha_map = 70000;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcDraw.alpha_map is 70000; it can be 0 to 65536");
    draws[1].alpha_map = 1;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "draw 1: GpcDraw.alpha_map is 1, and there are 0, from 1");
    draws[1].alpha_map = 0;
    draws[1].blended = 2;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcDraw.blended is 2; it can be VK_FALSE (0), VK_TRUE (1)");
    draws[1].blended = VK_TRUE;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "draw 1: it is blended; make the frame with GpcGeometry.blended");
    draws[1].blended = VK_FALSE;
    draws[1].triangle_count = 3;
    ANSWERS(RECORD, GPC_RESULT_CAPACITY, "draw 1: it reads indices up to 15, and there are 12");
    draws[1].triangle_count = 2;
    draws[1].vertex_offset = 10;
    ANSWERS(RECORD, GPC_RESULT_CAPACITY, "draw 1: it has the vertices from 10 to before 13");
    draws[1].vertex_offset = 6;
    draws[1].vertex_count = 4;
    ANSWERS(RECORD, GPC_RESULT_CAPACITY, "7 vertices; GpcGeometry.position_capacity is 6");
    draws[1].vertex_count = 3;
    draws[1].to_clip[3][1] = 0.0f / (scenery.projection[3][0]);
    ANSWERS(RECORD, GPC_RESULT_VALUE, "draw 1: GpcDraw.to_clip has a number that is not finite");
    draws[1].to_clip[3][1] = 0;
    scenery.projection[2][1] = 0.0f / (scenery.projection[3][0]);
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcScenery.projection has a number that is not finite");
    scenery.projection[2][1] = 0;
    scenery.projection[1][1] = 0;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcScenery.projection has a scale of 0 along y");
    scenery.projection[1][1] = 1;
    scenery.viewport[2] = scenery.viewport[3] = SIDE;
    ANSWERS(RECORD, GPC_RESULT_VALUE,
            "GpcScenery.viewport is 64 x 64 pixels at (0, 0); it needs finite numbers, a positive width, and a height that is negative "
            "as GpcGeometry.y_up is VK_TRUE");
    scenery.viewport[0] = 0.5f;
    scenery.viewport[1] = SIDE;
    scenery.viewport[3] = -SIDE;
    ANSWERS(RECORD, GPC_RESULT_VALUE,
            "GpcScenery.viewport holds the pixels from (0.5, 0) to (64.5, 64), and the frame is of those from (0, 0) to (64, 64)");
    memset(scenery.viewport, 0, sizeof scenery.viewport);
    images.corner[1] = 0xffffffffu;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "the frame's part of the images ends at");
    images.corner[1] = 0;
    images.color.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.color.before.layout is VK_IMAGE_LAYOUT_UNDEFINED");
    images.color.before.layout = VK_IMAGE_LAYOUT_GENERAL;
    images.color.after.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.color.after.layout is VK_IMAGE_LAYOUT_UNDEFINED");
    images.color.after.layout = VK_IMAGE_LAYOUT_GENERAL;
    images.color.aspects = 0;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.color.aspects is 0x0; it can have COLOR");
    images.color.aspects = VK_IMAGE_ASPECT_COLOR_BIT;
    images.depth = ids;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.depth.aspects is 0x1");
    images.depth.aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.depth is lent, and the frame was made without it: set GpcImageKinds.depth");
    images.depth.view = VK_NULL_HANDLE;
    ANSWERS(RECORD, GPC_RESULT_NULL, "GpcImages.depth.view is VK_NULL_HANDLE");
    images.depth = none;
    images.ids.image = VK_NULL_HANDLE;
    ANSWERS(RECORD, GPC_RESULT_NULL, "GpcImages.ids.image is VK_NULL_HANDLE");
    images.ids = none;
    ANSWERS(RECORD, GPC_RESULT_VALUE, "GpcImages.ids is missing: lend the image, or make the frame without GpcImageKinds.ids");
    images.ids = ids;
    EXPECT(calls == 0, "what is refused records nothing");
    EXPECT(RECORD == GPC_RESULT_SUCCESS && calls > 0, "a recording");
    ANSWERS(gpc_frame_outcome(frame, &outcome), GPC_RESULT_STRUCT_SIZE, "GpcOutcome.size is 0");
    outcome.size = sizeof outcome;
    ANSWERS(gpc_frame_outcome(frame, &outcome), GPC_RESULT_NOT_READY, "the commands of the last recording are not done");
    ANSWERS(gpc_frame_grow(frame, &grown), GPC_RESULT_NOT_READY, "the commands of the last recording are not done");
    MUST(vkEndCommandBuffer(commands));
    vkDestroyCommandPool(device, info.commandPool, NULL);
}

static void lists(const GpcGeometry *geometry, const GpcOptions *options) {
    enum { LOCATIONS = 8 };
    VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandBufferCount = 1};
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    VkDeviceMemory memory[2];
    VkBuffer locations = make_buffer(sizeof(GpcLocation) * LOCATIONS, &memory[0]), colors = make_buffer(16 * LOCATIONS, &memory[1]);
    GpcLocationList lent = {.size = 0};
    GpcListScenery scenery;
    GpcDraw draw = {.triangle_count = 2, .vertex_count = 3};
    GpcListOutcome outcome = {.size = 0};
    GpcList *list = (GpcList *)&list;
    int calls = 0;

    MUST(vkCreateCommandPool(device, &pool_info, NULL, &info.commandPool));
    MUST(vkAllocateCommandBuffers(device, &info, &commands));
    MUST(vkBeginCommandBuffer(commands, &begin));
#define CREATE_LIST gpc_list_create(antialiaser, geometry, &lent, options, &list)
    ANSWERS(gpc_list_create(antialiaser, geometry, &lent, options, NULL), GPC_RESULT_NULL, "list is NULL");
    ANSWERS(gpc_list_create(NULL, geometry, &lent, options, &list), GPC_RESULT_NULL, "antialiaser is NULL");
    EXPECT(list == NULL, "what failed gives nothing");
    ANSWERS(CREATE_LIST, GPC_RESULT_STRUCT_SIZE, "GpcLocationList.size is 0");
    MUST((VkResult)gpc_init_location_list(&lent, sizeof lent));
    ANSWERS(CREATE_LIST, GPC_RESULT_NULL, "GpcLocationList.locations is VK_NULL_HANDLE");
    lent.locations = locations;
    ANSWERS(CREATE_LIST, GPC_RESULT_NULL, "GpcLocationList.colors is VK_NULL_HANDLE");
    lent.colors = colors;
    ANSWERS(CREATE_LIST, GPC_RESULT_VALUE, "GpcLocationList.capacity is 0; it can be 1 to");
    lent.capacity = LOCATIONS;
    lent.offset = 8;
    ANSWERS(CREATE_LIST, GPC_RESULT_VALUE, "GpcLocationList.offset is 8 bytes; it can be a multiple of");
    lent.offset = 0;
    lent.colors_offset = 2;
    ANSWERS(CREATE_LIST, GPC_RESULT_VALUE, "GpcLocationList.colors_offset is 2 bytes; it can be a multiple of 4");
    lent.colors_offset = 0;
    MUST((VkResult)CREATE_LIST);
    EXPECT(gpc_list_memory_bytes(list) > 0, "the memory of a list");
    EXPECT(gpc_list_memory_bytes(NULL) == 0, "no list, no memory");
    GpcOptions wrong = *options;
    wrong.growths = 9;
    GpcList *other = NULL;
    ANSWERS(gpc_list_create(antialiaser, geometry, &lent, &wrong, &other), GPC_RESULT_VALUE,
            "GpcOptions.growths is 9; it can be 0 to 8, or GPC_GROWTHS_OF_SAMPLES");
    wrong.growths = options->growths;
    wrong.filter = GPC_FILTER_TENT;
    ANSWERS(gpc_list_create(antialiaser, geometry, &lent, &wrong, &other), GPC_RESULT_VALUE,
            "GpcOptions.filter of a list is 1; it can be GPC_FILTER_BOX (0)");

#define RECORD_LIST(count) (scenery.location_count = (count), gpc_list_record(list, commands, &scenery, shade_nothing, &calls))
    MUST((VkResult)gpc_init_list_scenery(&scenery, sizeof scenery));
    ANSWERS(gpc_list_record(NULL, commands, &scenery, shade_nothing, NULL), GPC_RESULT_NULL, "list is NULL");
    ANSWERS(gpc_list_record(list, NULL, &scenery, shade_nothing, NULL), GPC_RESULT_NULL, "commands is NULL");
    ANSWERS(gpc_list_record(list, commands, NULL, shade_nothing, NULL), GPC_RESULT_NULL, "GpcListScenery is NULL");
    ANSWERS(gpc_list_record(list, commands, &scenery, NULL, NULL), GPC_RESULT_NULL, "shade is NULL");
    scenery.draw_count = 1;
    scenery.draw_stride = sizeof draw;
    ANSWERS(RECORD_LIST(1), GPC_RESULT_NULL, "GpcListScenery.draws is NULL");
    scenery.draws = &draw;
    scenery.reserved = 1;
    ANSWERS(RECORD_LIST(LOCATIONS), GPC_RESULT_VALUE, "GpcListScenery.reserved is 1; it can be 0");
    scenery.reserved = 0;
    ANSWERS(RECORD_LIST(LOCATIONS + 1), GPC_RESULT_CAPACITY, "9 locations; GpcLocationList.capacity is 8");
    draw.key = 1;
    ANSWERS(RECORD_LIST(LOCATIONS), GPC_RESULT_VALUE, "draw 0: GpcDraw.key is 1; it can be 0 to 0");
    draw.key = 0;
    EXPECT(calls == 0, "what is refused records nothing");
    EXPECT(RECORD_LIST(0) == GPC_RESULT_SUCCESS && calls > 0, "a recording of no locations");
    EXPECT(RECORD_LIST(LOCATIONS) == GPC_RESULT_SUCCESS, "a recording");
    ANSWERS(gpc_list_outcome(list, &outcome), GPC_RESULT_STRUCT_SIZE, "GpcListOutcome.size is 0");
    MUST(vkEndCommandBuffer(commands));
    vkDestroyCommandPool(device, info.commandPool, NULL);
    gpc_list_destroy(list);
    gpc_list_destroy(NULL);
    vkDestroyBuffer(device, locations, NULL);
    vkDestroyBuffer(device, colors, NULL);
    for (int i = 0; i < 2; ++i) vkFreeMemory(device, memory[i], NULL);
}

static void frames(void) {
    VkDeviceMemory memory[4];
    VkBuffer positions = make_buffer(16 * VERTICES, &memory[0]), indices = make_buffer(4 * INDICES, &memory[1]);
    GpcImage ids = make_image(VK_FORMAT_R32_UINT, &memory[2]), color = make_image(VK_FORMAT_R8G8B8A8_UNORM, &memory[3]);
    GpcGeometry geometry;
    GpcImageKinds kinds;
    GpcImages images;
    GpcOptions options;
    GpcAlphaMap map = {.width = SIDE, .height = SIDE, .levels = 1, .cutoff = 0.5f};
    float zero = 0;
    GpcFrame *frame = (GpcFrame *)&frame;
    const float locations[2][2] = {{-0.25f, 0.25f}, {0.25f, -0.25f}};

#define CREATE gpc_frame_create(antialiaser, &geometry, &kinds, &options, &frame)
    MUST((VkResult)gpc_init_geometry(&geometry, sizeof geometry));
    MUST((VkResult)gpc_init_image_kinds(&kinds, sizeof kinds));
    MUST((VkResult)gpc_init_images(&images, sizeof images));
    MUST((VkResult)gpc_init_options(&options, sizeof options));
    geometry.vertex_capacity = VERTICES;
    geometry.position_stride = 16;
    geometry.index_type = VK_INDEX_TYPE_UINT32;
    geometry.index_capacity = INDICES;
    geometry.triangle_capacity = 4;
    geometry.draw_capacity = 2;
    kinds.color_format = VK_FORMAT_R8G8B8A8_UINT;
    kinds.ids = VK_TRUE;
    images.ids = ids;
    images.color = color;
    options.width = options.height = SIDE;
    ANSWERS(gpc_frame_create(antialiaser, &geometry, &kinds, &options, NULL), GPC_RESULT_NULL, "frame is NULL");
    ANSWERS(gpc_frame_create(NULL, &geometry, &kinds, &options, &frame), GPC_RESULT_NULL, "antialiaser is NULL");
    EXPECT(frame == NULL, "what failed gives nothing");
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.positions is VK_NULL_HANDLE");
    geometry.positions = positions;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.indices is VK_NULL_HANDLE: lend the index buffer, or set GpcGeometry.index_type");
    geometry.indices = indices;
    geometry.alpha_map_count = 1;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.alpha_maps is NULL");
    geometry.alpha_maps = &map;
    geometry.alpha_map_stride = 4;
    ANSWERS(CREATE, GPC_RESULT_STRUCT_SIZE, "GpcGeometry.alpha_map_stride is 4; it can be sizeof(GpcAlphaMap), which is");
    geometry.alpha_map_stride = sizeof map;
    map.view = VK_NULL_HANDLE;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcAlphaMap.view is VK_NULL_HANDLE");
    map.view = color.view;
    map.width = 0;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcAlphaMap.width is 0; it can be 1 to 65535");
    map.width = SIDE;
    map.levels = 8;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcAlphaMap.levels is 8; it can be 1 to 7");
    map.levels = 1;
    map.reserved = 5;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcAlphaMap.reserved is 5; it can be 0");
    map.reserved = 0;
    map.address_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.alpha_maps[0]: GpcAlphaMap.address_u or address_v is 3; it can be REPEAT (0)");
    map.address_v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    map.mipmap_mode = (VkSamplerMipmapMode)2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.alpha_maps[0]: GpcAlphaMap.mipmap_mode is 2; it can be NEAREST (0) or LINEAR (1)");
    map.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    map.cutoff = 0.0f / zero;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.alpha_maps[0]: GpcAlphaMap.cutoff has a number that is not finite");
    map.cutoff = 0.5f;
    ANSWERS(CREATE, GPC_RESULT_NULL, "there are alpha maps and no texture coordinates: lend GpcGeometry.coordinates");
    geometry.coordinates = positions;
    geometry.coordinates_offset = 6;
    geometry.coordinates_stride = 8;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.coordinates_offset is 6 bytes; it can be a multiple of 4");
    geometry.coordinates_offset = 4;
    geometry.coordinates_stride = 4;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.coordinates_stride is 4 bytes; it can be any multiple of 4 from 8 on");
    GpcAlphaMap *many = calloc(70000, sizeof *many);
    geometry.alpha_maps = many;
    geometry.alpha_map_count = 70000;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.alpha_map_count is 70000; it can be 1 to 65536");
    free(many);
    geometry.alpha_map_count = 0;
    geometry.keys = 0;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.keys is 0");
    geometry.keys = 1;
    geometry.positions_offset = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.positions_offset is 2 bytes; it can be a multiple of 4");
    geometry.positions_offset = 0;
    geometry.position_stride = 12;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_stride is 12 bytes; it can be any multiple of 4 from 16 on");
    geometry.position_space = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_space is 2; it can be GPC_POSITION_SPACE_CLIP (0), GPC_POSITION_SPACE_OBJECT (1)");
    geometry.position_space = GPC_POSITION_SPACE_OBJECT;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_capacity is 0");
    geometry.position_capacity = 6;
    geometry.position_stride = 14;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_stride is 14 bytes; it can be any multiple of 4 from 12 on");
    geometry.position_stride = 16;
    geometry.vertex_capacity = 0xffffffffu;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.positions needs");
    geometry.vertex_capacity = VERTICES;
    geometry.index_type = (VkIndexType)2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.index_type is 2; it can be VK_INDEX_TYPE_UINT16 (0) or VK_INDEX_TYPE_UINT32 (1); set GpcGeometry.index_type to VK_INDEX_TYPE_NONE_KHR (1000165000) if");
    geometry.index_type = VK_INDEX_TYPE_UINT16;
    geometry.indices_offset = 1;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.indices_offset is 1 bytes; it can be a multiple of 2");
    geometry.index_type = VK_INDEX_TYPE_UINT32;
    geometry.indices_offset = 0;
    GpcIndirectDraws list = {.commands = VK_NULL_HANDLE};
    GpcMesh mesh = {.positions = positions, .position_stride = 16, .vertex_capacity = VERTICES, .index_type = VK_INDEX_TYPE_NONE_KHR};
    geometry.more_mesh_count = 1;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.more_meshes is NULL");
    geometry.more_meshes = &mesh;
    ANSWERS(CREATE, GPC_RESULT_STRUCT_SIZE, "GpcGeometry.more_mesh_stride is 0; it can be sizeof(GpcMesh), which is");
    geometry.more_mesh_stride = sizeof mesh;
    mesh.positions = VK_NULL_HANDLE;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.more_meshes[0]: GpcMesh.positions is VK_NULL_HANDLE");
    mesh.positions = positions;
    mesh.reserved = 4;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcMesh.reserved is 4; it can be 0");
    mesh.reserved = 0;
    mesh.position_stride = 8;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.more_meshes[0]: GpcMesh.position_stride is 8 bytes; it can be any multiple of 4 from 12 on");
    geometry.more_mesh_count = 0;
    geometry.position_format = VK_FORMAT_R8G8B8A8_SNORM;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_format is VK_FORMAT_R8G8B8A8_SNORM; it can have 32-bit SFLOAT");
    geometry.position_format = VK_FORMAT_R16G16B16A16_SNORM;
    geometry.position_scale[1] = zero / zero;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_format has a scale or a bias that is not finite");
    geometry.position_scale[1] = 0;
    geometry.position_stride = 5;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_stride is 5 bytes; it can be any multiple of 2 from 6 on");
    geometry.position_stride = 16;
    geometry.position_space = GPC_POSITION_SPACE_CLIP;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.position_format is VK_FORMAT_R16G16B16A16_SNORM or has a scale or a bias; positions in clip space are four floats");
    geometry.position_space = GPC_POSITION_SPACE_OBJECT;
    geometry.position_format = VK_FORMAT_UNDEFINED;
    geometry.indirect_draws_count = 1;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.indirect_draws is NULL");
    geometry.indirect_draws = &list;
    ANSWERS(CREATE, GPC_RESULT_STRUCT_SIZE, "GpcGeometry.indirect_draws_stride is 0; it can be sizeof(GpcIndirectDraws), which is");
    geometry.indirect_draws_stride = sizeof list;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcGeometry.indirect_draws[0]: GpcIndirectDraws.commands is VK_NULL_HANDLE");
    list.commands = list.instances = positions;
    list.mesh = 1;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.indirect_draws[0]: GpcIndirectDraws.mesh is 1; it can be 0 to 0, by GpcGeometry.more_meshes");
    list.mesh = 0;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.indirect_draws[0]: GpcIndirectDraws.command_capacity is 0; it can be 1 to 1048576");
    list.command_capacity = list.instance_capacity = list.draw_capacity = list.triangle_capacity = list.position_capacity = 1;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.indirect_draws[0]: GpcIndirectDraws.command_stride is 0 bytes; it can be any multiple of 4 from 20 on");
    list.command_stride = sizeof(VkDrawIndexedIndirectCommand);
    list.topology = 3;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcIndirectDraws.topology is 3; it can be GPC_TOPOLOGY_LIST (0)");
    list.topology = GPC_TOPOLOGY_LIST;
    geometry.indirect_draws_count = 0;
    geometry.max_depth = 0;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.min_depth and max_depth: 0 and 0 have to be finite numbers that differ");
    geometry.max_depth = 1;
    geometry.y_up = 3;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.y_up is 3");
    geometry.y_up = VK_TRUE;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "set GpcImageKinds.depth and lend GpcImages.depth, the depth image, or set GpcOptions.thin to VK_FALSE");
    options.thin = VK_FALSE;
    geometry.blended = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.blended is 2; it can be VK_FALSE (0), VK_TRUE (1)");
    geometry.blended = VK_TRUE;
    options.shade_all = VK_TRUE;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.blended with GpcOptions.shade_all");
    options.shade_all = VK_FALSE;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcGeometry.blended without GpcOptions.flat_background");
    options.flat_background = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.flat_background is 2");
    options.flat_background = VK_FALSE;
    geometry.blended = VK_FALSE;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcImageKinds.color_format is VK_FORMAT_R8G8B8A8_UINT");
    kinds.color_format = VK_FORMAT_R8G8B8A8_UNORM;
    options.has_background = VK_TRUE;
    options.background[1] = zero / zero;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.background is [0.0, NaN, 0.0]: its light must be finite");
    options.background[1] = 0;
    options.has_background = VK_FALSE;
    kinds.ids = VK_FALSE;
    kinds.depth = VK_TRUE;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcImageKinds.depth is VK_TRUE without GpcImageKinds.ids");
    kinds.ids = VK_TRUE;
    kinds.depth = VK_FALSE;
    kinds.color_encoded = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcImageKinds.color_encoded is 2");
    kinds.color_encoded = VK_FALSE;
    kinds.color_copied = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcImageKinds.color_copied is 2");
    kinds.color_copied = VK_FALSE;
    options.pattern = 7;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.pattern is 7; it can be GPC_PATTERN_SOBOL (0), GPC_PATTERN_LATTICE (1)");
    options.pattern = GPC_PATTERN_LIST;
    ANSWERS(CREATE, GPC_RESULT_NULL, "GpcOptions.locations is NULL");
    options.locations = locations;
    options.location_count = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "64 samples were asked for, but the list holds 2 offsets");
    options.pattern = GPC_PATTERN_LINES;
    options.samples = 2000;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.samples is 2000; it can be 1 to 1024");
    options.pattern = GPC_PATTERN_LIST;
    options.samples = 2;
    options.contrast = 256;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.contrast is 256");
    options.contrast = 10;
    options.growths = 9;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.growths is 9; it can be 0 to 8, or GPC_GROWTHS_OF_SAMPLES");
    options.growths = 300;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.growths is 300; it can be 0 to 8, or GPC_GROWTHS_OF_SAMPLES");
    options.growths = 3;
    options.fixed_memory = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.fixed_memory is 2; it can be VK_FALSE (0), VK_TRUE (1)");
    options.fixed_memory = 0;
    options.keep_alpha = 2;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.keep_alpha is 2; it can be VK_FALSE (0), VK_TRUE (1)");
    options.keep_alpha = VK_FALSE;
    options.reserved = 1;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.reserved is 1; it can be 0");
    options.reserved = 0;
    options.filter = 5;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcOptions.filter is 5; it can be GPC_FILTER_BOX (0), GPC_FILTER_TENT (1), GPC_FILTER_GAUSSIAN (2)");
    options.filter = GPC_FILTER_MITCHELL;
    options.filter_radius = 3.0f;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "a mitchell filter of radius 3: the radius must be from 0.5 to 2.5 pixels");
    options.filter = GPC_FILTER_BOX;
    options.filter_radius = 1.0f;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "a box filter of radius 1");
    options.filter_radius = 0.0f;
    geometry.indirect_draws_count = 1;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "GpcImageKinds.ids with GpcGeometry.indirect_draws: the library has to draw the IDs");
    geometry.indirect_draws_count = 0;
    options.width = 0;
    ANSWERS(CREATE, GPC_RESULT_VALUE, "an image of 0 x 64 pixels");
    options.width = SIDE;
    options.max_memory = 1000;
    ANSWERS(CREATE, GPC_RESULT_OUT_OF_MEMORY, "1000");
    options.max_memory = 0;
    most_allocations = allocated + 3;
    ANSWERS(CREATE, GPC_RESULT_OUT_OF_MEMORY, "out of memory");
    EXPECT(allocated == most_allocations && freed == allocated, "memory of what failed is freed");
    most_allocations = 1000000;
    EXPECT(frame == NULL, "what failed gives nothing");
    MUST((VkResult)CREATE);
    EXPECT(gpc_frame_memory_bytes(frame) > 0, "the memory of a frame");
    EXPECT(gpc_frame_shared_memory_bytes(frame) > 0 && gpc_frame_shared_memory_bytes(NULL) == 0, "the memory that frames share");
    GpcFrame *filtered = NULL;
    options.filter = GPC_FILTER_BLACKMAN_HARRIS;
    MUST((VkResult)gpc_frame_create(antialiaser, &geometry, &kinds, &options, &filtered));
    EXPECT(gpc_frame_memory_bytes(filtered) > gpc_frame_memory_bytes(frame), "a filter takes memory");
    gpc_frame_destroy(filtered);
    options.filter = GPC_FILTER_BOX;
    ANSWERS(gpc_frame_resize(NULL, SIDE, SIDE), GPC_RESULT_NULL, "frame is NULL");
    ANSWERS(gpc_frame_resize(frame, SIDE, 0), GPC_RESULT_VALUE, "an image of 64 x 0 pixels");
    MUST((VkResult)gpc_frame_resize(frame, SIDE, SIDE));
    recordings(frame, images);
    lists(&geometry, &options);

    gpc_antialiaser_destroy(antialiaser); /* before its frame */
    gpc_frame_destroy(frame);
    EXPECT(allocated > 20 && mapped > 0 && freed == allocated, "all memory is the application's, and freed");
    EXPECT(pipelines_named > 10 && buffers_named > 20 && images_named > 0, "what the library makes has names");
    EXPECT(cached > 10 && uncached == 0, "pipelines are made with the application's cache");
    vkDestroyPipelineCache(device, cache, NULL);
    vkDestroyBuffer(device, positions, NULL);
    vkDestroyBuffer(device, indices, NULL);
    vkDestroyImageView(device, ids.view, NULL);
    vkDestroyImageView(device, color.view, NULL);
    vkDestroyImage(device, ids.image, NULL);
    vkDestroyImage(device, color.image, NULL);
    for (int i = 0; i < 4; ++i) vkFreeMemory(device, memory[i], NULL);
}

int main(void) {
    without_a_device();
    old_instances();
    make_device();
    make_antialiaser();
    frames();
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
    return failures != 0;
}
