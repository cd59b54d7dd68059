// A Vulkan layer that lets a program run to its end over a driver without its hardware, and reports what the driver's compiler
// made of each pipeline and which commands were recorded. tools/test-compilers.sh builds and uses it.
//
// The driver gets only the calls for pipelines and what they are made of: shaders, layouts and samplers. The layer answers all
// other calls for the device: they succeed and do nothing, handles are invented, and mapped memory is zero. There may be only
// one instance and one device at a time.
//
// Environment: GPC_LAYER_REPORT is the file to which lines are added, GPC_LAYER_SPIRV the folder of the SPIR-V files that give
// shaders their names. A line has fields between tabs:
//
//   pipeline  NAME  CONSTANTS  MILLISECONDS  STATISTIC=VALUE...     for each part of a pipeline, as the driver reports it
//   refused   NAME  CONSTANTS  VkResult
//   commands  DISPATCHES  BARRIERS  TRANSFERS                       for each command buffer
#define VK_NO_PROTOTYPES
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace {

std::recursive_mutex mutex;  // for all variables below
PFN_vkGetInstanceProcAddr driver_instance_function;
PFN_vkGetDeviceProcAddr driver_device_function;
VkInstance instance;
VkDevice device;

using Guard = std::lock_guard<std::recursive_mutex>;

// The driver's function of the same name as the layer's.
#define DRIVER(name) reinterpret_cast<PFN_##name>(driver_device_function(device, #name))

// Writes one line of the report.
void report(const std::string &line) {
    const char *path = getenv("GPC_LAYER_REPORT");
    std::ofstream(path ? path : "/dev/stderr", std::ios::app) << line + "\n";
}

// --------------------------------------------------------------------------------------------------------------- pipelines

std::map<std::string, std::string> shader_names;  // names of shaders by their SPIR-V
std::map<VkShaderModule, std::string> modules;    // names of modules

void read_shader_names() {
    const char *folder = getenv("GPC_LAYER_SPIRV");
    if (!folder) return;
    for (auto &entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream file(entry.path(), std::ios::binary);
        shader_names[{std::istreambuf_iterator<char>(file), {}}] = entry.path().stem();
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateShaderModule(VkDevice d, const VkShaderModuleCreateInfo *info,
                                                    const VkAllocationCallbacks *a, VkShaderModule *out) {
    Guard guard(mutex);
    auto name = shader_names.find({reinterpret_cast<const char *>(info->pCode), info->codeSize});
    VkResult result = DRIVER(vkCreateShaderModule)(d, info, a, out);
    modules[*out] = name == shader_names.end() ? "unknown" : name->second;
    return result;
}

// The name of a stage's shader, and its specialisation constants.
std::pair<std::string, std::string> described(const VkPipelineShaderStageCreateInfo &stage) {
    std::string constants;
    auto *s = stage.pSpecializationInfo;
    for (uint32_t i = 0; s && i < s->mapEntryCount; i++) {
        uint32_t value;
        memcpy(&value, static_cast<const char *>(s->pData) + s->pMapEntries[i].offset, sizeof value);
        constants += (i ? "," : "") + std::to_string(s->pMapEntries[i].constantID) + "=" + std::to_string(value);
    }
    return {modules[stage.module], constants};
}

std::pair<std::string, std::string> described(const VkComputePipelineCreateInfo &info) { return described(info.stage); }

std::pair<std::string, std::string> described(const VkGraphicsPipelineCreateInfo &info) {
    auto [name, constants] = described(info.pStages[0]);
    for (uint32_t i = 1; i < info.stageCount; i++) name += "+" + described(info.pStages[i]).first;
    return {name, constants};
}

void report_pipeline(VkPipeline pipeline, const std::string &head) {
    VkPipelineInfoKHR info{VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, nullptr, pipeline};
    uint32_t parts = 0;
    DRIVER(vkGetPipelineExecutablePropertiesKHR)(device, &info, &parts, nullptr);
    std::vector<VkPipelineExecutablePropertiesKHR> properties(parts);
    for (auto &one : properties) one.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
    DRIVER(vkGetPipelineExecutablePropertiesKHR)(device, &info, &parts, properties.data());
    for (uint32_t i = 0; i < parts; i++) {
        VkPipelineExecutableInfoKHR part{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr, pipeline, i};
        uint32_t count = 0;
        DRIVER(vkGetPipelineExecutableStatisticsKHR)(device, &part, &count, nullptr);
        std::vector<VkPipelineExecutableStatisticKHR> all(count);
        for (auto &one : all) one.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
        DRIVER(vkGetPipelineExecutableStatisticsKHR)(device, &part, &count, all.data());
        std::string line = head + "\tSubgroup size=" + std::to_string(properties[i].subgroupSize);
        for (auto &one : all) {
            bool is_float = one.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR;
            line += std::string("\t") + one.name + "=" + (is_float ? std::to_string(one.value.f64) : std::to_string(one.value.u64));
        }
        report(line);
    }
}

double milliseconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec * 1e3 + t.tv_nsec * 1e-6;
}

// Makes pipelines one by one, to measure the time of each.
template <class Info, class Create>
VkResult create_pipelines(Create create, VkPipelineCache cache, uint32_t count, const Info *infos, const VkAllocationCallbacks *a,
                          VkPipeline *out) {
    for (uint32_t i = 0; i < count; i++) {
        Info info = infos[i];
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
        double before = milliseconds();
        VkResult result = create(device, cache, 1, &info, a, out + i);
        double taken = milliseconds() - before;
        Guard guard(mutex);
        auto [name, constants] = described(info);
        if (result != VK_SUCCESS) {
            report("refused\t" + name + "\t" + constants + "\t" + std::to_string(result));
            return result;
        }
        report_pipeline(out[i], "pipeline\t" + name + "\t" + constants + "\t" + std::to_string(taken));
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice, VkPipelineCache cache, uint32_t count,
                                                        const VkComputePipelineCreateInfo *infos, const VkAllocationCallbacks *a,
                                                        VkPipeline *out) {
    return create_pipelines(DRIVER(vkCreateComputePipelines), cache, count, infos, a, out);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateGraphicsPipelines(VkDevice, VkPipelineCache cache, uint32_t count,
                                                         const VkGraphicsPipelineCreateInfo *infos,
                                                         const VkAllocationCallbacks *a, VkPipeline *out) {
    return create_pipelines(DRIVER(vkCreateGraphicsPipelines), cache, count, infos, a, out);
}

// ---------------------------------------------------------------------------------------------------------------- commands

struct Commands {
    unsigned dispatches, barriers, transfers;
};
std::map<VkCommandBuffer, Commands> recorded;

VKAPI_ATTR VkResult VKAPI_CALL vkBeginCommandBuffer(VkCommandBuffer c, const VkCommandBufferBeginInfo *) {
    Guard guard(mutex);
    recorded[c] = {};
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkEndCommandBuffer(VkCommandBuffer c) {
    Guard guard(mutex);
    auto [dispatches, barriers, transfers] = recorded[c];
    report("commands\t" + std::to_string(dispatches) + "\t" + std::to_string(barriers) + "\t" + std::to_string(transfers));
    return VK_SUCCESS;
}

// Counts a command, whatever its other parameters.
template <unsigned Commands::*kind> VKAPI_ATTR void VKAPI_CALL count(VkCommandBuffer c) {
    Guard guard(mutex);
    recorded[c].*kind += 1;
}

// ------------------------------------------------------------------------------------------- what needs the hardware

VkDeviceSize invent() {
    static std::atomic<VkDeviceSize> last = 0;
    return ++last;
}

// Stands for any function of the device without output.
VKAPI_ATTR VkResult VKAPI_CALL succeed() { return VK_SUCCESS; }

VKAPI_ATTR VkResult VKAPI_CALL vkGetEventStatus(VkDevice, VkEvent) { return VK_EVENT_SET; }

// Stands for any function that makes one object.
VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice, const void *, const VkAllocationCallbacks *, VkDeviceSize *out) {
    *out = invent();
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateDescriptorSets(VkDevice, const VkDescriptorSetAllocateInfo *info, VkDescriptorSet *out) {
    for (uint32_t i = 0; i < info->descriptorSetCount; i++) out[i] = reinterpret_cast<VkDescriptorSet>(invent());
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetQueryPoolResults(VkDevice, VkQueryPool, uint32_t, uint32_t, size_t bytes, void *data,
                                                     VkDeviceSize, VkQueryResultFlags) {
    memset(data, 0, bytes);
    return VK_SUCCESS;
}

// Reports the memory of a discrete GPU with 8 GiB.
VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties *out) {
    const VkMemoryPropertyFlags mapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    *out = {};
    out->memoryTypeCount = 3;
    out->memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    out->memoryTypes[1].propertyFlags = mapped;
    out->memoryTypes[2].propertyFlags = mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    out->memoryHeapCount = 1;
    out->memoryHeaps[0] = {VkDeviceSize{8} << 30, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties2(VkPhysicalDevice p, VkPhysicalDeviceMemoryProperties2 *out) {
    vkGetPhysicalDeviceMemoryProperties(p, &out->memoryProperties);
}

std::map<VkDeviceSize, VkDeviceSize> sizes;            // sizes of buffers, images and memory, in bytes
std::map<VkDeviceSize, std::vector<char>> mapped;      // memory that was mapped

VKAPI_ATTR VkResult VKAPI_CALL vkCreateBuffer(VkDevice, const VkBufferCreateInfo *info, const VkAllocationCallbacks *,
                                              VkDeviceSize *out) {
    Guard guard(mutex);
    sizes[*out = invent()] = info->size;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateImage(VkDevice, const VkImageCreateInfo *info, const VkAllocationCallbacks *,
                                             VkDeviceSize *out) {
    Guard guard(mutex);
    // 16 bytes for a texel, and as much again for mipmaps.
    const VkExtent3D &extent = info->extent;
    sizes[*out = invent()] = VkDeviceSize{32} * extent.width * extent.height * extent.depth * info->arrayLayers * info->samples;
    return VK_SUCCESS;
}

// Stands for the functions that return the memory requirements of a buffer or an image.
VKAPI_ATTR void VKAPI_CALL memory_requirements(VkDevice, VkDeviceSize object, VkMemoryRequirements *out) {
    Guard guard(mutex);
    *out = {sizes[object], 256, 7};
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateMemory(VkDevice, const VkMemoryAllocateInfo *info, const VkAllocationCallbacks *,
                                                VkDeviceSize *out) {
    Guard guard(mutex);
    sizes[*out = invent()] = info->allocationSize;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkMapMemory(VkDevice, VkDeviceSize memory, VkDeviceSize offset, VkDeviceSize, VkMemoryMapFlags,
                                           void **out) {
    Guard guard(mutex);
    auto &bytes = mapped[memory];
    bytes.resize(sizes[memory]);
    *out = bytes.data() + offset;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkFreeMemory(VkDevice, VkDeviceSize memory, const VkAllocationCallbacks *) {
    Guard guard(mutex);
    mapped.erase(memory);
}

// ----------------------------------------------------------------------------------------------------- the layer in its chain

// The loader's link to the next layer or the driver.
template <class Info> Info *link(const void *chain, VkStructureType type) {
    auto *item = static_cast<const VkBaseInStructure *>(chain);
    while (item->sType != type || reinterpret_cast<const Info *>(item)->function != VK_LAYER_LINK_INFO) item = item->pNext;
    return reinterpret_cast<Info *>(const_cast<VkBaseInStructure *>(item));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo *info, const VkAllocationCallbacks *a, VkInstance *out) {
    auto *below = link<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    driver_instance_function = below->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    below->u.pLayerInfo = below->u.pLayerInfo->pNext;
    read_shader_names();
    auto create = reinterpret_cast<PFN_vkCreateInstance>(driver_instance_function(nullptr, "vkCreateInstance"));
    VkResult result = create(info, a, out);
    instance = *out;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice p, const VkDeviceCreateInfo *info, const VkAllocationCallbacks *a,
                                              VkDevice *out) {
    auto *below = link<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    driver_device_function = below->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    auto next = below->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    below->u.pLayerInfo = below->u.pLayerInfo->pNext;
    std::vector<const char *> extensions(info->ppEnabledExtensionNames,
                                         info->ppEnabledExtensionNames + info->enabledExtensionCount);
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR feature{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR, const_cast<void *>(info->pNext), VK_TRUE};
    VkDeviceCreateInfo more = *info;
    more.pNext = &feature;
    more.enabledExtensionCount = extensions.size();
    more.ppEnabledExtensionNames = extensions.data();
    VkResult result = reinterpret_cast<PFN_vkCreateDevice>(next(instance, "vkCreateDevice"))(p, &more, a, out);
    device = *out;
    return result;
}

#define NAMED(function) {#function, reinterpret_cast<PFN_vkVoidFunction>(function)}
#define COUNTED(function, kind) {#function, reinterpret_cast<PFN_vkVoidFunction>(count<&Commands::kind>)}

// Functions of instances and physical devices that the layer implements.
const std::map<std::string, PFN_vkVoidFunction> instance_functions = {
    NAMED(vkCreateInstance), NAMED(vkCreateDevice), NAMED(vkGetPhysicalDeviceMemoryProperties),
    NAMED(vkGetPhysicalDeviceMemoryProperties2),
};

// Functions of devices that the layer implements.
const std::map<std::string, PFN_vkVoidFunction> device_functions = {
    NAMED(vkCreateShaderModule), NAMED(vkCreateComputePipelines), NAMED(vkCreateGraphicsPipelines), NAMED(vkBeginCommandBuffer),
    NAMED(vkEndCommandBuffer), NAMED(vkAllocateDescriptorSets), NAMED(vkGetQueryPoolResults), NAMED(vkGetEventStatus),
    NAMED(vkCreateBuffer), NAMED(vkCreateImage), NAMED(vkAllocateMemory), NAMED(vkMapMemory), NAMED(vkFreeMemory),
    {"vkGetBufferMemoryRequirements", reinterpret_cast<PFN_vkVoidFunction>(memory_requirements)},
    {"vkGetImageMemoryRequirements", reinterpret_cast<PFN_vkVoidFunction>(memory_requirements)},
    COUNTED(vkCmdDispatch, dispatches), COUNTED(vkCmdDispatchIndirect, dispatches), COUNTED(vkCmdDraw, dispatches),
    COUNTED(vkCmdPipelineBarrier2, barriers), COUNTED(vkCmdCopyBuffer, transfers), COUNTED(vkCmdFillBuffer, transfers),
    COUNTED(vkCmdUpdateBuffer, transfers), COUNTED(vkCmdCopyBufferToImage, transfers), COUNTED(vkCmdCopyImageToBuffer, transfers),
};

// Beginnings of the names of device functions that stay the driver's.
const char *const driver_functions[] = {
    "vkGetDeviceQueue", "vkDestroyDevice", "vkCreateDescriptorSetLayout", "vkDestroyDescriptorSetLayout", "vkCreateSampler",
    "vkDestroySampler", "vkCreatePipeline", "vkDestroyPipeline", "vkMergePipelineCaches", "vkGetPipeline", "vkDestroyShaderModule",
    "vkCreateCommandPool", "vkDestroyCommandPool", "vkResetCommandPool", "vkAllocateCommandBuffers", "vkFreeCommandBuffers",
};

bool begins_with(const char *name, const char *start) { return !strncmp(name, start, strlen(start)); }

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice d, const char *name) {
    if (!strcmp(name, "vkGetDeviceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(device_function);
    auto found = device_functions.find(name);
    if (found != device_functions.end()) return found->second;
    PFN_vkVoidFunction drivers = driver_device_function(d, name);
    for (const char *start : driver_functions)
        if (begins_with(name, start)) return drivers;
    if (!drivers) return nullptr;
    return reinterpret_cast<PFN_vkVoidFunction>(begins_with(name, "vkCreate") ? reinterpret_cast<void *>(create)
                                                                             : reinterpret_cast<void *>(succeed));
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance i, const char *name) {
    if (!strcmp(name, "vkGetInstanceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(instance_function);
    if (!strcmp(name, "vkGetDeviceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(device_function);
    // The loader asks for these device functions through the instance.
    if (strstr(name, "DebugUtils")) return reinterpret_cast<PFN_vkVoidFunction>(succeed);
    auto found = instance_functions.find(name);
    return found == instance_functions.end() ? driver_instance_function(i, name) : found->second;
}

}  // namespace

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *layer) {
    layer->loaderLayerInterfaceVersion = 2;
    layer->pfnGetInstanceProcAddr = instance_function;
    layer->pfnGetDeviceProcAddr = device_function;
    layer->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
