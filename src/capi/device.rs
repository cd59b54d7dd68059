//! A lent device, and what its frames share.

use super::error::{Error, GpcResult, answer};
use super::input::{flag, hand_over, init, place, read, take_back};
use super::memory::{Functions, GpcAllocate, GpcFree};
use crate::host::Antialiaser;
use crate::vulkan::{Host, MemorySource, Missing, Requirements, VulkanError, alone};
use ash::vk;
use std::ffi::{CStr, c_char, c_void};
use std::sync::Arc;

/// Vulkan's own type.
///
/// cbindgen:ignore
pub type GetInstanceProcAddr = Option<unsafe extern "system" fn(vk::Instance, *const c_char) -> vk::PFN_vkVoidFunction>;

/// The version of Vulkan that instance and device are created for: 1.3, as in VkApplicationInfo.apiVersion. No extension is
/// needed; GpcDevice.conditional_rendering names one that saves time.
pub const GPC_VULKAN_API_VERSION: u32 = (1 << 22) | (3 << 12);
const _: () = assert!(GPC_VULKAN_API_VERSION == Requirements::API_VERSION);

/// A device that the application lends; gpc_init_device fills it.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcDevice {
    /// sizeof(GpcDevice).
    pub size: u32,
    /// GPC_STRUCT_TYPE_DEVICE.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// The family, with graphics and compute, of the queue that commands will be submitted to.
    pub queue_family: u32,
    /// VK_TRUE if the device was created with VK_EXT_conditional_rendering and its feature conditionalRendering, which is not
    /// needed: without it, rounds of a frame that have nothing to do take some time.
    pub conditional_rendering: vk::Bool32,
    /// VK_TRUE if the instance was created with VK_EXT_debug_utils: buffers, images and pipelines of the library then have names,
    /// which begin with "gpc", and dispatches have labels.
    pub debug_utils: vk::Bool32,
    /// All functions of Vulkan are taken from it: of the loader that made the instance.
    pub get_instance_proc_addr: GetInstanceProcAddr,
    /// The instance, created for GPC_VULKAN_API_VERSION or later.
    pub instance: vk::Instance,
    /// The physical device; see gpc_check_device.
    pub physical_device: vk::PhysicalDevice,
    /// The device, created with the features that gpc_require_features sets.
    pub device: vk::Device,
    /// A cache that pipelines are made with, which outlives the antialiaser and its frames; it was not created with
    /// VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT. VK_NULL_HANDLE for none.
    pub pipeline_cache: vk::PipelineCache,
    /// Functions for device memory, both or none. Without them, the library has an allocator of its own.
    pub allocate: GpcAllocate,
    /// See `allocate`.
    pub free: GpcFree,
    /// Handed to both.
    pub memory_user: *mut c_void,
}

/// Fills a GpcDevice of `size` bytes, which is sizeof(GpcDevice): its handles are null, and nothing is enabled.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_device(device: *mut GpcDevice, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(device, size) }
}

/// What frames of one device share: layouts, and the pipelines made so far.
pub struct GpcAntialiaser {
    pub(super) inner: Antialiaser,
}

/// Sets the features that the library needs to VK_TRUE, and leaves all else in the struct as it is: chain it to
/// VkDeviceCreateInfo. Set its sType before.
///
/// Threads: any. Errors: GPC_RESULT_NULL; GPC_RESULT_VALUE for another sType.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_require_features(features: *mut vk::PhysicalDeviceVulkan13Features<'static>) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        let features = unsafe { place(features, "features") }?;
        if features.s_type != vk::StructureType::PHYSICAL_DEVICE_VULKAN_1_3_FEATURES {
            return Err(Error::FeaturesType(features.s_type.as_raw()));
        }
        let needed = Requirements::features13();
        for (feature, needed) in [
            (&mut features.dynamic_rendering, needed.dynamic_rendering),
            (&mut features.synchronization2, needed.synchronization2),
            (&mut features.maintenance4, needed.maintenance4),
            (&mut features.subgroup_size_control, needed.subgroup_size_control),
            (&mut features.shader_demote_to_helper_invocation, needed.shader_demote_to_helper_invocation),
        ] {
            *feature |= needed;
        }
        Ok(())
    })
}

/// Whether a physical device has all that the library needs, and the instance was created for GPC_VULKAN_API_VERSION or later; to
/// find that out, it makes a device and destroys it again. `queue_family`, if not NULL, becomes the first family with graphics and
/// compute.
///
/// Threads: any.
/// Errors: GPC_RESULT_UNSUPPORTED, with gpc_last_error listing all that is missing; GPC_RESULT_NULL; GPC_RESULT_VULKAN if the driver
/// makes no device.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_check_device(
    get_instance_proc_addr: GetInstanceProcAddr,
    instance: vk::Instance,
    physical_device: vk::PhysicalDevice,
    queue_family: *mut u32,
) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        let instance = unsafe { load_instance(get_instance_proc_addr, instance) }?;
        if physical_device == vk::PhysicalDevice::null() {
            return Err(Error::Null("physical_device"));
        }
        // SAFETY: passed on to the caller. Until the instance is known to be made for Vulkan 1.3, nothing newer than 1.0 is called.
        unsafe {
            Requirements::check_version(&instance, physical_device).map_err(|version| Error::Missing(vec![version]))?;
            let family =
                Requirements::queue_family(&instance, physical_device).ok_or(Error::Missing(vec![Missing::Queue]))?;
            check_instance(&instance, physical_device, family)?;
            let missing = Requirements::missing(&instance, physical_device);
            if !missing.is_empty() {
                return Err(Error::Missing(missing));
            }
            if let Some(answer) = queue_family.as_mut() {
                *answer = family;
            }
        }
        Ok(())
    })
}

/// Checks that an instance was created for Vulkan 1.3 or later. A loader does not tell the version, so the function creates a
/// device, checks its functions and destroys it.
///
/// # Errors
/// [`VulkanError::NoFunction`] for an earlier version; [`VulkanError::Call`] if the driver creates no device.
///
/// # Safety
/// The physical device has the queue family and belongs to the instance, which is alive.
unsafe fn check_instance(
    instance: &ash::Instance,
    device: vk::PhysicalDevice,
    queue_family: u32,
) -> Result<(), VulkanError> {
    let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
    let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
    // SAFETY: guaranteed by the caller; nothing is made with the device.
    unsafe {
        let made = alone(|| instance.create_device(device, &info, None)).map_err(VulkanError::of("vkCreateDevice"))?;
        let checked = Requirements::check_functions(instance, made.handle());
        alone(|| made.destroy_device(None));
        checked
    }
}

/// Makes an antialiaser in a lent device.
///
/// Threads: any. An antialiaser may be used by several threads at once.
/// Lifetime: instance, device and the loader's library outlive the antialiaser and all frames created with it.
/// Errors: GPC_RESULT_UNSUPPORTED lists what is missing; GPC_RESULT_VALUE is a flag or a queue family that is not possible;
/// GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_VULKAN.
/// `*antialiaser` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_antialiaser_create(
    device: *const GpcDevice,
    antialiaser: *mut *mut GpcAntialiaser,
) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe {
            let host = load_host(&read(device)?)?;
            Antialiaser::new(host)
        }?;
        Ok(GpcAntialiaser { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(antialiaser, "antialiaser", make) }
}

/// The layout of the descriptor set that shaders read visibility samples from, for the layouts of the application's own
/// pipelines. VK_NULL_HANDLE for NULL.
///
/// Threads: any. Lifetime: that of the antialiaser and all its frames; it is the library's to destroy.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_antialiaser_samples_layout(antialiaser: *const GpcAntialiaser) -> vk::DescriptorSetLayout {
    // SAFETY: passed on to the caller.
    let antialiaser = unsafe { antialiaser.as_ref() };
    antialiaser.map_or(vk::DescriptorSetLayout::null(), |found| found.inner.samples_layout())
}

/// Destroys an antialiaser; frames created with it go on. NULL does nothing.
///
/// Threads: no other call uses the antialiaser at the time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_antialiaser_destroy(antialiaser: *mut GpcAntialiaser) {
    // SAFETY: passed on to the caller.
    unsafe { take_back(antialiaser) };
}

/// Functions that are looked up before any is called, since calling one that is absent ends the program.
const OF_INSTANCE: [&CStr; 3] =
    [c"vkGetPhysicalDeviceProperties2", c"vkGetPhysicalDeviceFeatures2", c"vkGetDeviceProcAddr"];

/// # Safety
/// The function and the instance are null or alive and belong together.
unsafe fn load_instance(
    get_instance_proc_addr: GetInstanceProcAddr,
    instance: vk::Instance,
) -> Result<ash::Instance, Error> {
    let get_instance_proc_addr = get_instance_proc_addr.ok_or(Error::Null("get_instance_proc_addr"))?;
    if instance == vk::Instance::null() {
        return Err(Error::Null("instance"));
    }
    for name in OF_INSTANCE {
        // SAFETY: passed on to the caller; the name ends with a zero.
        let found = unsafe { get_instance_proc_addr(instance, name.as_ptr()) };
        found.ok_or(Error::Function(name.to_str().unwrap_or_default()))?;
    }
    let functions = ash::StaticFn { get_instance_proc_addr };
    // SAFETY: passed on to the caller.
    Ok(unsafe { ash::Instance::load(&functions, instance) })
}

/// # Safety
/// As [`gpc_antialiaser_create`].
unsafe fn load_host(lent: &GpcDevice) -> Result<Host, Error> {
    // SAFETY: passed on to the caller.
    let instance = unsafe { load_instance(lent.get_instance_proc_addr, lent.instance) }?;
    if lent.physical_device == vk::PhysicalDevice::null() {
        return Err(Error::Null("GpcDevice.physical_device"));
    }
    if lent.device == vk::Device::null() {
        return Err(Error::Null("GpcDevice.device"));
    }
    // SAFETY: passed on to the caller.
    let device = unsafe { ash::Device::load(instance.fp_v1_0(), lent.device) };
    let mut host = Host::new(instance, lent.physical_device, device, lent.queue_family);
    host.conditional_rendering = flag("GpcDevice.conditional_rendering", lent.conditional_rendering)?;
    host.debug_utils = flag("GpcDevice.debug_utils", lent.debug_utils)?;
    host.pipeline_cache = lent.pipeline_cache;
    host.memory = match (lent.allocate, lent.free) {
        (None, None) => MemorySource::Own,
        (None, Some(_)) => return Err(Error::Null("GpcDevice.allocate")),
        (Some(_), None) => return Err(Error::Null("GpcDevice.free")),
        (Some(allocate), Some(free)) => {
            MemorySource::Host(Arc::new(Functions { allocate, free, user: lent.memory_user }))
        }
    };
    Ok(host)
}
