// What the C code of the documents takes for granted: the objects of an application.
#include <gpc.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef struct Vertex {
    float position[3];
    float uv[2];
} Vertex;

struct Application {
    VkPipeline samples_pipeline;
    VkPipelineLayout samples_layout;
    VkDescriptorSet set;
    PFN_vkCmdBeginConditionalRenderingEXT begin_conditional_rendering;
    PFN_vkCmdEndConditionalRenderingEXT end_conditional_rendering;
} application;

VkInstance instance;
VkPhysicalDevice physical_device;
VkDeviceCreateInfo device_info;
VkDevice device;
VkBuffer vertex_buffer, index_buffer;
uint32_t vertex_count, index_count, triangle_count;
VkImage color_image;
VkImageView color_view;
uint32_t width, height;
VkViewport viewport;
VkDescriptorSetLayout my_set_layout;
const uint32_t *samples_spirv;
size_t samples_spirv_size;
VkBuffer command_buffer, count_buffer, instance_buffer;
GpcGeometry geometry;
VkCommandBuffer commands;
float model_view_projection[16], projection[16];
