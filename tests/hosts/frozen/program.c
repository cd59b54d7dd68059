/* A program as it was compiled with gpc.h of the first version of the binary interface: it antialiases a triangle in an image of
 * its own. Its exit status says whether the library still makes of it what it did then.
 *
 *     program SAMPLES.spv
 */

#include <gpc.h>
#include <vulkan/vulkan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MUST(call)                                                  \
    do {                                                            \
        if ((call) != 0) {                                          \
            printf("%s failed: \"%s\"\n", #call, gpc_last_error()); \
            exit(1);                                                \
        }                                                           \
    } while (0)

enum { SIDE = 64, SHADER_BYTES = 1 << 16 };

static VkPhysicalDevice physical;
static VkDevice device;
static uint32_t family;

static VkDeviceMemory allocate(VkMemoryRequirements needs, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties properties;
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size};
    VkDeviceMemory memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &properties);
    while (!(needs.memoryTypeBits >> info.memoryTypeIndex & 1) ||
           (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted) {
        ++info.memoryTypeIndex;
    }
    MUST(vkAllocateMemory(device, &info, NULL, &memory));
    return memory;
}

static VkBuffer make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage, VkDeviceMemory *memory, void **mapped) {
    VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
    VkMemoryRequirements needs;
    VkBuffer buffer;
    MUST(vkCreateBuffer(device, &info, NULL, &buffer));
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    *memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    MUST(vkBindBufferMemory(device, buffer, *memory, 0));
    MUST(vkMapMemory(device, *memory, 0, VK_WHOLE_SIZE, 0, mapped));
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
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    };
    VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    GpcImage image = {
        .aspects = VK_IMAGE_ASPECT_COLOR_BIT,
        .before = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
        .after = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
    };
    VkMemoryRequirements needs;
    MUST(vkCreateImage(device, &info, NULL, &image.image));
    vkGetImageMemoryRequirements(device, image.image, &needs);
    *memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    MUST(vkBindImageMemory(device, image.image, *memory, 0));
    view.image = image.image;
    MUST(vkCreateImageView(device, &view, NULL, &image.view));
    return image;
}

static VkInstance make_instance(void) {
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = GPC_VULKAN_API_VERSION};
    VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
    VkInstance instance;
    MUST(vkCreateInstance(&info, NULL, &instance));
    return instance;
}

static void make_device(VkInstance instance) {
    uint32_t count = 1;
    float priority = 1;
    VkPhysicalDeviceVulkan13Features features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                               .pNext = &features,
                               .queueCreateInfoCount = 1,
                               .pQueueCreateInfos = &queue};
    vkEnumeratePhysicalDevices(instance, &count, &physical);
    MUST(gpc_check_device(vkGetInstanceProcAddr, instance, physical, &family));
    MUST(gpc_require_features(&features));
    queue.queueFamilyIndex = family;
    MUST(vkCreateDevice(physical, &info, NULL, &device));
}

struct materials {
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

static struct materials make_materials(const char *path, VkDescriptorSetLayout samples) {
    static uint32_t code[SHADER_BYTES / 4];
    VkShaderModuleCreateInfo module_info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .pCode = code};
    VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &samples};
    VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                  .pName = "main"}};
    struct materials made;
    FILE *file = fopen(path, "rb");
    if (!file) {
        printf("%s can't be read\n", path);
        exit(1);
    }
    module_info.codeSize = fread(code, 1, sizeof code, file);
    fclose(file);
    MUST(gpc_check_shader(code, module_info.codeSize));
    MUST(vkCreateShaderModule(device, &module_info, NULL, &info.stage.module));
    MUST(vkCreatePipelineLayout(device, &layout, NULL, &made.layout));
    info.layout = made.layout;
    MUST(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &made.pipeline));
    vkDestroyShaderModule(device, info.stage.module, NULL);
    return made;
}

static void shade(void *user, VkCommandBuffer commands, const GpcVisibilitySamples *samples) {
    const struct materials *materials = user;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, materials->pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, materials->layout, 0, 1, &samples->descriptor_set, 0, NULL);
    for (uint32_t key = 0; key < samples->keys; ++key) {
        vkCmdDispatchIndirect(commands, samples->dispatches, samples->dispatch_offset + key * samples->dispatch_stride);
    }
}

/* Half of the image: the triangle above its diagonal, which runs between the centres of pixels. */
static const float CORNERS[3][4] = {{-0.995f, -1, 0.5f, 1}, {1.005f, -1, 0.5f, 1}, {1.005f, 1, 0.5f, 1}};

int main(int count, char **arguments) {
    VkDeviceMemory memory[4];
    void *positions, *indices, *pixels;
    if (count != 2) {
        printf("Usage: program SAMPLES.spv\n");
        return 2;
    }
    VkInstance instance = make_instance();
    make_device(instance);
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    VkBuffer position_buffer = make_buffer(sizeof CORNERS, usage, &memory[0], &positions);
    VkBuffer index_buffer = make_buffer(12, usage, &memory[1], &indices);
    VkBuffer pixel_buffer = make_buffer(4 * SIDE * SIDE, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &memory[2], &pixels);
    GpcImage color = make_image(VK_FORMAT_R8G8B8A8_UNORM, &memory[3]);
    memcpy(positions, CORNERS, sizeof CORNERS);
    memcpy(indices, (uint32_t[]){0, 1, 2}, 12);

    GpcDevice lent;
    GpcAntialiaser *antialiaser;
    MUST(gpc_init_device(&lent, sizeof lent));
    lent.queue_family = family;
    lent.get_instance_proc_addr = vkGetInstanceProcAddr;
    lent.instance = instance;
    lent.physical_device = physical;
    lent.device = device;
    MUST(gpc_antialiaser_create(&lent, &antialiaser));

    GpcGeometry geometry;
    MUST(gpc_init_geometry(&geometry, sizeof geometry));
    geometry.positions = position_buffer;
    geometry.position_stride = 16;
    geometry.position_space = GPC_POSITION_SPACE_CLIP;
    geometry.vertex_capacity = 3;
    geometry.indices = index_buffer;
    geometry.index_type = VK_INDEX_TYPE_UINT32;
    geometry.index_capacity = 3;
    geometry.triangle_capacity = 1;
    geometry.draw_capacity = 1;
    GpcImageKinds kinds;
    MUST(gpc_init_image_kinds(&kinds, sizeof kinds));
    kinds.color_format = VK_FORMAT_R8G8B8A8_UNORM;
    GpcOptions options;
    MUST(gpc_init_options(&options, sizeof options));
    options.width = options.height = SIDE;
    options.shade_all = VK_TRUE;
    GpcFrame *frame;
    MUST(gpc_frame_create(antialiaser, &geometry, &kinds, &options, &frame));
    struct materials materials = make_materials(arguments[1], gpc_antialiaser_samples_layout(antialiaser));

    VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
    VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandBufferCount = 1};
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    MUST(vkCreateCommandPool(device, &pool, NULL, &info.commandPool));
    MUST(vkAllocateCommandBuffers(device, &info, &commands));
    MUST(vkBeginCommandBuffer(commands, &begin));
    GpcDraw draw = {.triangle_count = 1, .double_sided = VK_TRUE};
    GpcImages images;
    MUST(gpc_init_images(&images, sizeof images));
    images.color = color;
    GpcScenery scenery;
    MUST(gpc_init_scenery(&scenery, sizeof scenery));
    scenery.draw_count = 1;
    scenery.draw_stride = sizeof draw;
    scenery.draws = &draw;
    for (int i = 0; i < 4; ++i) scenery.projection[i][i] = 1;
    MUST(gpc_frame_record(frame, commands, &images, &scenery, shade, &materials));
    VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, .imageExtent = {SIDE, SIDE, 1}};
    VkMemoryBarrier to_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                               .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                               .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdCopyImageToBuffer(commands, color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixel_buffer, 1, &copy);
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, NULL, 0, NULL);
    MUST(vkEndCommandBuffer(commands));
    VkQueue queue;
    VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    vkGetDeviceQueue(device, family, 0, &queue);
    MUST(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    MUST(vkDeviceWaitIdle(device));

    GpcOutcome outcome;
    MUST(gpc_init_outcome(&outcome, sizeof outcome));
    MUST(gpc_frame_outcome(frame, &outcome));
    /* The shader stores the weights of the corners as linear light: they sum to 1 in the triangle, and alpha is its coverage. */
    int failures = 0, partial = 0;
    double area = 0, right = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const unsigned char *pixel = (const unsigned char *)pixels + 4 * i;
        int x = i % SIDE, y = i / SIDE, sum = pixel[0] + pixel[1] + pixel[2];
        area += pixel[3] / 255.0;
        right += pixel[2] / 255.0;
        if (pixel[3] > 0 && pixel[3] < 255) ++partial;
        if (abs(sum - pixel[3]) > 3 || pixel[3] != (x > y + 1 ? 255 : x < y - 1 ? 0 : pixel[3])) ++failures;
    }
    printf("%d wrong pixels, %d partly covered, area %.3f, weight of the last corner %.3f, %llu superpixels, %llu left over\n", failures,
           partial, area, right, (unsigned long long)outcome.superpixels, (unsigned long long)outcome.left_over);
    /* Of 64 x 64 pixels without the slivers of a hundredth, and a third of it. */
    int good = failures == 0 && partial >= SIDE - 1 && area > 2030 && area < 2070 && right > 670 && right < 700 &&
               outcome.superpixels >= SIDE && outcome.left_over == 0;

    gpc_frame_destroy(frame);
    gpc_antialiaser_destroy(antialiaser);
    vkDestroyPipeline(device, materials.pipeline, NULL);
    vkDestroyPipelineLayout(device, materials.layout, NULL);
    vkDestroyCommandPool(device, info.commandPool, NULL);
    vkDestroyImageView(device, color.view, NULL);
    vkDestroyImage(device, color.image, NULL);
    vkDestroyBuffer(device, position_buffer, NULL);
    vkDestroyBuffer(device, index_buffer, NULL);
    vkDestroyBuffer(device, pixel_buffer, NULL);
    for (int i = 0; i < 4; ++i) vkFreeMemory(device, memory[i], NULL);
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
    return !good;
}
