/* A Vulkan layer that loses devices. If there is a file with the name in GPC_LOSE_DEVICE, the next submission of commands to a
 * device fails, and so do all later ones to that device. The file is then removed. A folder is not removed, so that all devices
 * fail. */

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#define MOST 64

/* The address of the dispatch table, with which all handles of one instance or device begin. */
static void *key_of(void *handle) { return *(void **)handle; }

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static struct {
    void *key;
    VkInstance handle;
    PFN_vkGetInstanceProcAddr next;
} instances[MOST];

static struct device {
    void *key;
    PFN_vkGetDeviceProcAddr next;
    PFN_vkQueueSubmit2 submit;
    int is_lost;
} devices[MOST];

static int find_instance(void *key) {
    for (int i = 0; i < MOST; i++)
        if (instances[i].key == key) return i;
    abort();
}

static struct device *find_device(void *key) {
    for (int i = 0; i < MOST; i++)
        if (devices[i].key == key) return &devices[i];
    abort();
}

static VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo2 *submits, VkFence fence) {
    pthread_mutex_lock(&lock);
    struct device *device = find_device(key_of(queue));
    const char *file = getenv("GPC_LOSE_DEVICE");
    if (file && !device->is_lost) {
        FILE *found = fopen(file, "r");
        if (found) {
            fclose(found);
            remove(file);
            device->is_lost = 1;
        }
    }
    PFN_vkQueueSubmit2 next = device->is_lost ? NULL : device->submit;
    pthread_mutex_unlock(&lock);
    return next ? next(queue, count, submits, fence) : VK_ERROR_DEVICE_LOST;
}

static VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo *info, const VkAllocationCallbacks *allocator,
                                                      VkInstance *instance) {
    VkLayerInstanceCreateInfo *link = (VkLayerInstanceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerInstanceCreateInfo *)link->pNext;
    PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    VkResult result = ((PFN_vkCreateInstance)next(NULL, "vkCreateInstance"))(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    pthread_mutex_lock(&lock);
    int free_place = find_instance(NULL);
    instances[free_place].key = key_of(*instance);
    instances[free_place].handle = *instance;
    instances[free_place].next = next;
    pthread_mutex_unlock(&lock);
    return VK_SUCCESS;
}

static VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance, const VkAllocationCallbacks *allocator) {
    if (!instance) return;
    pthread_mutex_lock(&lock);
    int place = find_instance(key_of(instance));
    PFN_vkGetInstanceProcAddr next = instances[place].next;
    instances[place].key = NULL;
    pthread_mutex_unlock(&lock);
    ((PFN_vkDestroyInstance)next(instance, "vkDestroyInstance"))(instance, allocator);
}

static VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                                                    const VkAllocationCallbacks *allocator, VkDevice *device) {
    VkLayerDeviceCreateInfo *link = (VkLayerDeviceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerDeviceCreateInfo *)link->pNext;
    PFN_vkGetInstanceProcAddr next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    PFN_vkGetDeviceProcAddr next = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    pthread_mutex_lock(&lock);
    VkInstance instance = instances[find_instance(key_of(physical))].handle;
    pthread_mutex_unlock(&lock);
    VkResult result =
        ((PFN_vkCreateDevice)next_instance(instance, "vkCreateDevice"))(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    pthread_mutex_lock(&lock);
    struct device *made = find_device(NULL);
    made->key = key_of(*device);
    made->next = next;
    made->submit = (PFN_vkQueueSubmit2)next(*device, "vkQueueSubmit2");
    made->is_lost = 0;
    pthread_mutex_unlock(&lock);
    return VK_SUCCESS;
}

static VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks *allocator) {
    if (!device) return;
    pthread_mutex_lock(&lock);
    struct device *lost = find_device(key_of(device));
    PFN_vkGetDeviceProcAddr next = lost->next;
    lost->key = NULL;
    pthread_mutex_unlock(&lock);
    ((PFN_vkDestroyDevice)next(device, "vkDestroyDevice"))(device, allocator);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char *name) {
    if (!strcmp(name, "vkGetDeviceProcAddr")) return (PFN_vkVoidFunction)device_function;
    if (!strcmp(name, "vkDestroyDevice")) return (PFN_vkVoidFunction)destroy_device;
    if (!strcmp(name, "vkQueueSubmit2")) return (PFN_vkVoidFunction)submit;
    pthread_mutex_lock(&lock);
    PFN_vkGetDeviceProcAddr next = find_device(key_of(device))->next;
    pthread_mutex_unlock(&lock);
    return next(device, name);
}

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char *name) {
    if (!strcmp(name, "vkGetInstanceProcAddr")) return (PFN_vkVoidFunction)instance_function;
    if (!strcmp(name, "vkCreateInstance")) return (PFN_vkVoidFunction)create_instance;
    if (!strcmp(name, "vkDestroyInstance")) return (PFN_vkVoidFunction)destroy_instance;
    if (!strcmp(name, "vkCreateDevice")) return (PFN_vkVoidFunction)create_device;
    if (!instance) return NULL;
    pthread_mutex_lock(&lock);
    PFN_vkGetInstanceProcAddr next = instances[find_instance(key_of(instance))].next;
    pthread_mutex_unlock(&lock);
    return next(instance, name);
}

VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *version) {
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = instance_function;
    version->pfnGetDeviceProcAddr = device_function;
    version->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}
