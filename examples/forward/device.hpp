// What every Vulkan program has: a device with one queue, and memory that frees itself.
#pragma once

#include <gpc.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

inline void check(VkResult result, const char *what) {
    if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + ": VkResult " + std::to_string(result));
}

inline void check(GpcResult result) {
    if (result != GPC_RESULT_SUCCESS) throw std::runtime_error(gpc_last_error());
}

// A device. Failures end the program, so that objects that were made before may leak.
struct Device {
    VkInstance instance{};
    VkPhysicalDevice physical{};
    VkDevice raw{};
    VkQueue queue{};
    uint32_t family{};
    VkCommandPool pool{};
    bool conditional_rendering{};
    PFN_vkCmdBeginConditionalRenderingEXT begin_conditional{};
    PFN_vkCmdEndConditionalRenderingEXT end_conditional{};

    Device() {
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = GPC_VULKAN_API_VERSION;
        VkInstanceCreateInfo instance_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        instance_info.pApplicationInfo = &application;
        check(vkCreateInstance(&instance_info, nullptr, &instance), "vkCreateInstance");
        uint32_t count = 0;
        check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
        std::vector<VkPhysicalDevice> found(count);
        check(vkEnumeratePhysicalDevices(instance, &count, found.data()), "vkEnumeratePhysicalDevices");
        for (VkPhysicalDevice candidate : found) {
            if (gpc_check_device(vkGetInstanceProcAddr, instance, candidate, &family) == GPC_RESULT_SUCCESS) {
                physical = candidate;
                break;
            }
        }
        if (!physical) throw std::runtime_error(found.empty() ? "no Vulkan device" : gpc_last_error());

        VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
        check(gpc_require_features(&features13));
        // With conditional rendering, the library skips rounds of superpixels that are not needed.
        VkPhysicalDeviceConditionalRenderingFeaturesEXT conditional{
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CONDITIONAL_RENDERING_FEATURES_EXT};
        const char *extension = VK_EXT_CONDITIONAL_RENDERING_EXTENSION_NAME;
        if (has_extension(extension)) {
            VkPhysicalDeviceFeatures2 features2{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &conditional};
            vkGetPhysicalDeviceFeatures2(physical, &features2);
            conditional_rendering = conditional.conditionalRendering;
        }
        conditional.inheritedConditionalRendering = VK_FALSE;
        VkPhysicalDeviceFeatures features{};
        features.geometryShader = VK_TRUE; // For gl_PrimitiveID in the renderer's own fragment shader.
        const float priority = 1;
        VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue_info.queueFamilyIndex = family;
        queue_info.queueCount = 1;
        queue_info.pQueuePriorities = &priority;
        VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features13};
        device_info.queueCreateInfoCount = 1;
        device_info.pQueueCreateInfos = &queue_info;
        device_info.pEnabledFeatures = &features;
        if (conditional_rendering) {
            features13.pNext = &conditional;
            device_info.enabledExtensionCount = 1;
            device_info.ppEnabledExtensionNames = &extension;
        }
        check(vkCreateDevice(physical, &device_info, nullptr, &raw), "vkCreateDevice");
        if (conditional_rendering) {
            begin_conditional = reinterpret_cast<PFN_vkCmdBeginConditionalRenderingEXT>(
                vkGetDeviceProcAddr(raw, "vkCmdBeginConditionalRenderingEXT"));
            end_conditional = reinterpret_cast<PFN_vkCmdEndConditionalRenderingEXT>(
                vkGetDeviceProcAddr(raw, "vkCmdEndConditionalRenderingEXT"));
        }
        vkGetDeviceQueue(raw, family, 0, &queue);
        VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        pool_info.queueFamilyIndex = family;
        check(vkCreateCommandPool(raw, &pool_info, nullptr, &pool), "vkCreateCommandPool");
    }

    Device(const Device &) = delete;

    ~Device() {
        vkDestroyCommandPool(raw, pool, nullptr);
        vkDestroyDevice(raw, nullptr);
        vkDestroyInstance(instance, nullptr);
    }

    bool has_extension(const char *name) const {
        uint32_t count = 0;
        check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), "vkEnumerateDeviceExtensionProperties");
        std::vector<VkExtensionProperties> found(count);
        check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, found.data()),
              "vkEnumerateDeviceExtensionProperties");
        for (const VkExtensionProperties &extension : found) {
            if (std::strcmp(extension.extensionName, name) == 0) return true;
        }
        return false;
    }

    // The handles that are lent to the library.
    GpcDevice lent() const {
        GpcDevice device;
        check(gpc_init_device(&device, sizeof device));
        device.queue_family = family;
        device.get_instance_proc_addr = vkGetInstanceProcAddr;
        device.instance = instance;
        device.physical_device = physical;
        device.device = raw;
        device.conditional_rendering = conditional_rendering;
        return device;
    }

    VkDeviceMemory allocate(const VkMemoryRequirements &needs, VkMemoryPropertyFlags wanted) const {
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(physical, &properties);
        for (uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
            const bool fits = needs.memoryTypeBits >> type & 1;
            if (!fits || (properties.memoryTypes[type].propertyFlags & wanted) != wanted) continue;
            VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
            info.allocationSize = needs.size;
            info.memoryTypeIndex = type;
            VkDeviceMemory memory;
            check(vkAllocateMemory(raw, &info, nullptr, &memory), "vkAllocateMemory");
            return memory;
        }
        throw std::runtime_error("no memory of the type that is wanted");
    }
};

// A mapped buffer.
struct Buffer {
    const Device &device;
    VkBuffer raw{};
    VkDeviceMemory memory{};
    void *mapped{};
    VkDeviceSize bytes;

    Buffer(const Device &device, VkDeviceSize bytes, VkBufferUsageFlags usage) : device(device), bytes(bytes) {
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = bytes;
        info.usage = usage;
        check(vkCreateBuffer(device.raw, &info, nullptr, &raw), "vkCreateBuffer");
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device.raw, raw, &needs);
        const auto visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        memory = device.allocate(needs, visible);
        check(vkBindBufferMemory(device.raw, raw, memory, 0), "vkBindBufferMemory");
        check(vkMapMemory(device.raw, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    }

    template <typename T>
    Buffer(const Device &device, const std::vector<T> &values, VkBufferUsageFlags usage)
        : Buffer(device, values.size() * sizeof(T), usage) {
        write(values);
    }

    Buffer(const Buffer &) = delete;

    template <typename T> void write(const std::vector<T> &values) {
        std::memcpy(mapped, values.data(), values.size() * sizeof(T));
    }

    ~Buffer() {
        vkDestroyBuffer(device.raw, raw, nullptr);
        vkFreeMemory(device.raw, memory, nullptr);
    }
};

// An image, and a view of one of its aspects.
struct Image {
    const Device &device;
    VkImageAspectFlags aspects;
    VkImage raw{};
    VkImageView view{};
    VkDeviceMemory memory{};

    Image(const Device &device, VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspects,
          VkImageAspectFlags viewed)
        : device(device), aspects(aspects) {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = usage;
        check(vkCreateImage(device.raw, &info, nullptr, &raw), "vkCreateImage");
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device.raw, raw, &needs);
        memory = device.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        check(vkBindImageMemory(device.raw, raw, memory, 0), "vkBindImageMemory");
        VkImageViewCreateInfo view_info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        view_info.image = raw;
        view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view_info.format = format;
        view_info.subresourceRange = {viewed, 0, 1, 0, 1};
        check(vkCreateImageView(device.raw, &view_info, nullptr, &view), "vkCreateImageView");
    }

    Image(const Image &) = delete;

    ~Image() {
        vkDestroyImageView(device.raw, view, nullptr);
        vkDestroyImage(device.raw, raw, nullptr);
        vkFreeMemory(device.raw, memory, nullptr);
    }
};
