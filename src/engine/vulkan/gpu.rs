//! A device in use: its functions, limits and memory.

use super::allocation::{Allocation, MemoryRequest, MemorySource, Source};
use super::instance::Instance;
use super::trace::Trace;
use super::{Missing, Requirements, VulkanError, alone};
use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::ffi::{CStr, CString};
use std::sync::{Arc, Mutex};

/// A queue that several owners use. Whoever uses the queue holds the lock, because Vulkan allows only one thread at a
/// time to submit to a queue, to present with it or to wait for it.
pub type SharedQueue = Arc<Mutex<vk::Queue>>;

/// Vulkan objects of a host, in which the renderer works.
#[non_exhaustive]
pub struct Host {
    /// Instance, created for Vulkan 1.3 or later.
    pub instance: ash::Instance,
    /// Physical device without [missing requirements](Requirements::missing).
    pub physical_device: vk::PhysicalDevice,
    /// Device, created with the features of [`Requirements::features13`].
    pub device: ash::Device,
    /// Index of the family of the queue to which commands will be submitted; it supports graphics and compute.
    pub queue_family: u32,
    /// Source of the memory for buffers and images.
    pub memory: MemorySource,
    /// Pipeline cache for making pipelines, or null. It was not created with `EXTERNALLY_SYNCHRONIZED`.
    pub pipeline_cache: vk::PipelineCache,
    /// Whether the device was created with `VK_EXT_conditional_rendering` and its feature `conditionalRendering`, which
    /// [`Requirements::has_conditional_rendering`] checks. Without the feature, rounds without work take some time.
    pub conditional_rendering: bool,
    /// Whether the instance was created with `VK_EXT_debug_utils`. If so, buffers, images and pipelines get names that
    /// begin with `gpc`, and dispatches get labels.
    pub debug_utils: bool,
}

impl Host {
    /// Describes a device without extensions or a pipeline cache, for which the library makes a separate allocator.
    #[must_use]
    pub fn new(
        instance: ash::Instance,
        physical_device: vk::PhysicalDevice,
        device: ash::Device,
        queue_family: u32,
    ) -> Self {
        Self {
            instance,
            physical_device,
            device,
            queue_family,
            memory: MemorySource::Own,
            pipeline_cache: vk::PipelineCache::null(),
            conditional_rendering: false,
            debug_utils: false,
        }
    }

    /// Checks that the device has the functions that the library calls, as a call of a missing function ends the
    /// program. The check itself calls only functions of Vulkan 1.0.
    ///
    /// # Errors
    /// [`VulkanError::Missing`], [`VulkanError::NoFunction`] or [`VulkanError::NotEnabled`].
    ///
    /// # Safety
    /// The handles are alive and belong together.
    unsafe fn check_functions(&self) -> Result<(), VulkanError> {
        // SAFETY: guaranteed by the caller.
        let lacks = |name: &CStr| unsafe { !Requirements::has_function(&self.instance, self.device.handle(), name) };
        // SAFETY: guaranteed by the caller.
        unsafe {
            let version = Requirements::check_version(&self.instance, self.physical_device);
            version.map_err(|version| VulkanError::Missing {
                device: device_name(&self.instance, self.physical_device),
                missing: vec![version],
            })?;
            Requirements::check_functions(&self.instance, self.device.handle())?;
        }
        for (enabled, member, names, remedy) in [
            (
                self.conditional_rendering,
                "conditional_rendering",
                CONDITIONAL_RENDERING_FUNCTIONS,
                "create the device with VK_EXT_conditional_rendering and its feature conditionalRendering",
            ),
            (self.debug_utils, "debug_utils", DEBUG_UTILS_FUNCTIONS, "create the instance with VK_EXT_debug_utils"),
        ] {
            if let Some(name) = names.iter().find(|name| enabled && lacks(name)) {
                return Err(VulkanError::NotEnabled { member, function: name.to_str().unwrap_or_default(), remedy });
            }
        }
        Ok(())
    }
}

const CONDITIONAL_RENDERING_FUNCTIONS: [&CStr; 2] =
    [c"vkCmdBeginConditionalRenderingEXT", c"vkCmdEndConditionalRenderingEXT"];
const DEBUG_UTILS_FUNCTIONS: [&CStr; 2] = [c"vkSetDebugUtilsObjectNameEXT", c"vkCmdBeginDebugUtilsLabelEXT"];

/// Largest error of a corner's position in pixels, besides its rounding to the device's steps: positions have 32 bits in images of
/// up to 16,384 pixels.
const POSITION_ERROR: f32 = 1.0 / 64.0;

/// Properties of the device on which the layout of work depends.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Name of the device.
    pub device_name: String,
    /// Name and version of the driver.
    pub driver: String,
    /// Kind of the device.
    pub device_type: vk::PhysicalDeviceType,
    /// Number of bytes of the device's largest heap of local memory.
    pub local_bytes: u64,
    /// Teams of kernels that work by teams: see `shaders/include/team.glsl`.
    pub teams: Teams,
    /// Largest width or height of an image in pixels.
    pub max_image_side: u32,
    /// How far the device may move a corner of a triangle before it draws the triangle, in pixels.
    pub snap: f32,
    /// Largest number of elements of a texel buffer.
    pub max_texel_elements: u64,
    /// Alignment of offsets into storage and texel buffers, in bytes.
    pub buffer_alignment: u64,
    /// Largest number of bytes of a storage buffer binding.
    pub max_storage_bytes: u64,
    /// Nanoseconds per timestamp step; 0 if the queue has no timestamps.
    pub timestamp_period: f32,
    /// Largest number of samples in one submission, for a renderer that submits by itself; every pixel counts as a
    /// superpixel. Operating systems reset a GPU that works on a submission for seconds. CPU drivers have no limit.
    pub max_submitted_samples: u64,
    /// Supported numbers of samples for multisampled 8-bit colour and float depth.
    pub sample_counts: vk::SampleCountFlags,
    /// Whether the device can skip commands depending on a word in its memory.
    pub conditional_rendering: bool,
    /// Largest number of unused pipelines that are kept. A frame has some 25, and a driver may need a megabyte or two
    /// for each.
    pub max_unused_pipelines: usize,
}

impl Limits {
    /// Whether the device computes on the CPU.
    pub(crate) fn is_cpu(&self) -> bool {
        self.device_type == vk::PhysicalDeviceType::CPU
    }
}

/// A device with its limits and allocator.
pub struct Gpu {
    pub(crate) device: ash::Device,
    /// Functions of conditional rendering, if the device supports it.
    pub(super) conditional_rendering: Option<ash::ext::conditional_rendering::Device>,
    /// Functions that label commands and name objects, if the instance has them.
    pub(super) debug_labels: Option<ash::ext::debug_utils::Device>,
    pub(super) trace: Trace,
    pub(crate) queue_family: u32,
    pub(super) pipeline_cache: vk::PipelineCache,
    /// Source of memory; `None` only in `Drop`.
    memory: Option<Source>,
    limits: Limits,
    /// Instance, if the library created the device. The device is then destroyed with the `Gpu`, before the instance.
    owner: Option<Arc<Instance>>,
}

impl Gpu {
    /// Uses the device of a host.
    ///
    /// # Errors
    /// [`VulkanError::Missing`] names everything that the device lacks, [`VulkanError::QueueFamily`] an unsuitable
    /// queue family, [`VulkanError::NoFunction`] and [`VulkanError::NotEnabled`] a missing function.
    ///
    /// # Safety
    /// - All handles are alive, belong together, and outlive the returned value and everything made with it.
    /// - The device was created with the features of [`Requirements::features13`]. [`Host::conditional_rendering`] is
    ///   true only if the device was created with that extension and feature, and [`Host::debug_utils`] only if the
    ///   instance was created with that extension.
    pub unsafe fn new(host: Host) -> Result<Arc<Self>, VulkanError> {
        // SAFETY: guaranteed by the caller.
        unsafe { host.check_functions() }?;
        // SAFETY: guaranteed by the caller; the instance and device were made for Vulkan 1.3.
        let mut limits = unsafe { limits(&host.instance, host.physical_device, host.queue_family) };
        limits.conditional_rendering &= host.conditional_rendering;
        // SAFETY: guaranteed by the caller.
        unsafe { Self::owning(host, None, limits) }
    }

    /// # Safety
    /// As [`Gpu::new`]. With an `owner`, the returned value destroys the device when it is dropped.
    pub(super) unsafe fn owning(
        host: Host,
        owner: Option<Arc<Instance>>,
        limits: Limits,
    ) -> Result<Arc<Self>, VulkanError> {
        // SAFETY: guaranteed by the caller.
        let missing: Vec<Missing> = unsafe { Requirements::missing(&host.instance, host.physical_device) };
        if !missing.is_empty() {
            return Err(VulkanError::Missing { device: limits.device_name, missing });
        }
        let Host {
            instance,
            physical_device,
            device,
            queue_family,
            memory,
            pipeline_cache,
            conditional_rendering: _,
            debug_utils,
        } = host;
        // SAFETY: guaranteed by the caller.
        let (is_fit, possible) = unsafe {
            (
                Requirements::is_fit(&instance, physical_device, queue_family),
                Requirements::queue_family(&instance, physical_device),
            )
        };
        if !is_fit {
            return Err(VulkanError::QueueFamily { device: limits.device_name, found: queue_family, possible });
        }
        let memory = match memory {
            MemorySource::Shared(shared) => Source::Allocator(shared),
            MemorySource::Host(host) => Source::Host(host),
            MemorySource::Own => Source::Allocator(Arc::new(Mutex::new(
                Allocator::new(&AllocatorCreateDesc {
                    instance: instance.clone(),
                    device: device.clone(),
                    physical_device,
                    debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
                    buffer_device_address: false,
                    allocation_sizes: gpu_allocator::AllocationSizes::default(),
                })
                .map_err(|_| VulkanError::Call {
                    call: "the allocator",
                    result: vk::Result::ERROR_INITIALIZATION_FAILED,
                })?,
            ))),
        };
        let debug_labels = debug_utils.then(|| alone(|| ash::ext::debug_utils::Device::new(&instance, &device)));
        let functions = || alone(|| ash::ext::conditional_rendering::Device::new(&instance, &device));
        Ok(Arc::new(Self {
            conditional_rendering: limits.conditional_rendering.then(functions),
            debug_labels,
            trace: Trace::default(),
            device,
            queue_family,
            pipeline_cache,
            memory: Some(memory),
            limits,
            owner,
        }))
    }

    /// Functions of the device, for the caller's own commands.
    #[must_use]
    pub fn device(&self) -> &ash::Device {
        &self.device
    }

    /// Functions of conditional rendering, if the device [has](Limits::conditional_rendering) them.
    #[must_use]
    pub fn conditional_rendering(&self) -> Option<&ash::ext::conditional_rendering::Device> {
        self.conditional_rendering.as_ref()
    }

    /// Index of the family of the queue to which commands are submitted.
    #[must_use]
    pub fn queue_family(&self) -> u32 {
        self.queue_family
    }

    /// Limits of the device.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Instance of the device, if the library created it.
    #[must_use]
    pub fn instance(&self) -> Option<&Arc<Instance>> {
        self.owner.as_ref()
    }

    /// Allocates memory; `None` if no memory is left.
    pub(super) fn allocate(&self, request: &MemoryRequest<'_>) -> Option<Allocation> {
        self.memory.as_ref()?.allocate(request)
    }

    /// Frees memory that [`Self::allocate`] returned.
    pub(super) fn free(&self, allocation: Allocation) {
        if let Some(memory) = &self.memory {
            memory.free(allocation);
        }
    }

    /// Names an object of the library for debuggers; does nothing without debug labels.
    pub(super) fn name(&self, object: impl vk::Handle, name: &str) {
        let Some(functions) = &self.debug_labels else {
            return;
        };
        let name = CString::new(format!("gpc {name}")).unwrap_or_default();
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        // SAFETY: this thread just made the object from this device. A debugger that fails to store the name is of no
        // consequence.
        let _ = alone(|| unsafe { functions.set_debug_utils_object_name(&info) });
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        // The allocator frees its blocks while the device is still alive.
        self.memory = None;
        if self.owner.is_some() {
            // SAFETY: the library created the device, and everything made from it held an `Arc` of this value and is
            // gone.
            alone(|| unsafe { self.device.destroy_device(None) });
        }
    }
}

/// Teams of kernels in which invocations work together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Teams {
    /// Number of invocations of a team: 8, or 4 on devices that may run subgroups of fewer than 8.
    pub members: u32,
    /// Number of teams of a workgroup.
    pub in_workgroup: u32,
    /// Size of subgroups that pipelines are made for, if the device lets that be chosen. Kernels work in subgroups of any size
    /// that teams fit into; the smallest size leaves each invocation the most registers.
    pub preferred_subgroup: Option<u32>,
    /// Size of all subgroups, if it is known: the preferred size, or the only one that the device has.
    pub known_subgroup: Option<u32>,
}

impl Teams {
    /// Teams for a device whose subgroups usually have `usual` invocations, at least `least` and at most `most`.
    pub(crate) fn new(usual: u32, [least, most]: [u32; 2], can_choose: bool) -> Self {
        let preferred_subgroup = can_choose.then_some(least.max(8).min(most));
        let subgroup = preferred_subgroup.unwrap_or(usual);
        let members = if preferred_subgroup.unwrap_or(least) < 8 { 4 } else { 8 };
        let known_subgroup = preferred_subgroup.or((least == most).then_some(least));
        Self { members, in_workgroup: (subgroup / members).max(1), preferred_subgroup, known_subgroup }
    }

    /// The largest teams of at most `most` invocations that fit into subgroups of a known size.
    pub(crate) fn larger(self, most: u32) -> Self {
        let members = self.known_subgroup.map_or(self.members, |subgroup| subgroup.min(most)).max(self.members);
        Self { members, in_workgroup: (self.workgroup() / members).max(1), ..self }
    }

    /// Number of invocations of a workgroup.
    pub(crate) fn workgroup(self) -> u32 {
        self.members * self.in_workgroup
    }
}

/// # Safety
/// The device belongs to the instance, which is alive.
unsafe fn device_name(instance: &ash::Instance, device: vk::PhysicalDevice) -> String {
    // SAFETY: guaranteed by the caller.
    let properties = unsafe { instance.get_physical_device_properties(device) };
    let name = properties.device_name_as_c_str();
    name.map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Limits of a physical device.
///
/// # Safety
/// The device belongs to the instance, which is alive.
pub(super) unsafe fn limits(instance: &ash::Instance, device: vk::PhysicalDevice, queue_family: u32) -> Limits {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
    let mut control = vk::PhysicalDeviceSubgroupSizeControlProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default()
        .push_next(&mut driver)
        .push_next(&mut subgroup)
        .push_next(&mut control);
    // SAFETY: guaranteed by the caller.
    let (families, memory) = unsafe {
        instance.get_physical_device_properties2(device, &mut properties);
        (
            instance.get_physical_device_queue_family_properties(device),
            instance.get_physical_device_memory_properties(device),
        )
    };
    let local = memory.memory_heaps_as_slice().iter().filter(|heap| {
        let local = vk::MemoryHeapFlags::DEVICE_LOCAL;
        heap.flags.contains(local)
    });
    let basic = properties.properties;
    let can_choose_subgroup_size = control.required_subgroup_size_stages.contains(vk::ShaderStageFlags::COMPUTE);
    let teams = Teams::new(
        subgroup.subgroup_size,
        [control.min_subgroup_size, control.max_subgroup_size],
        can_choose_subgroup_size,
    );
    let timestamps = families.get(queue_family as usize).is_some_and(|family| family.timestamp_valid_bits > 0);
    let text = |name: Result<&std::ffi::CStr, _>| {
        name.map(|n: &std::ffi::CStr| n.to_string_lossy().into_owned()).unwrap_or_default()
    };
    Limits {
        device_name: text(basic.device_name_as_c_str()),
        driver: format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str())),
        device_type: basic.device_type,
        local_bytes: local.map(|heap| heap.size).max().unwrap_or(0),
        teams,
        max_image_side: basic.limits.max_image_dimension2_d,
        snap: (-(basic.limits.sub_pixel_precision_bits as f32)).exp2() + POSITION_ERROR,
        max_texel_elements: u64::from(basic.limits.max_texel_buffer_elements),
        buffer_alignment: basic
            .limits
            .min_storage_buffer_offset_alignment
            .max(basic.limits.min_texel_buffer_offset_alignment),
        max_storage_bytes: u64::from(basic.limits.max_storage_buffer_range),
        timestamp_period: if timestamps { basic.limits.timestamp_period } else { 0.0 },
        max_submitted_samples: match basic.device_type {
            vk::PhysicalDeviceType::CPU => u64::MAX,
            _ => 1 << 27,
        },
        sample_counts: basic.limits.framebuffer_color_sample_counts
            & basic.limits.framebuffer_depth_sample_counts
            & basic.limits.sampled_image_color_sample_counts,
        // SAFETY: guaranteed by the caller.
        conditional_rendering: unsafe { Requirements::has_conditional_rendering(instance, device) },
        max_unused_pipelines: 64,
    }
}

#[cfg(test)]
mod tests {
    use super::Teams;

    #[test]
    fn teams_fit_in_the_subgroups_that_come() {
        let of = |usual, range, can_choose| {
            let teams = Teams::new(usual, range, can_choose);
            (teams.members, teams.in_workgroup, teams.preferred_subgroup, teams.known_subgroup)
        };
        assert_eq!(of(8, [8, 8], true), (8, 1, Some(8), Some(8)));
        assert_eq!(of(4, [4, 4], true), (4, 1, Some(4), Some(4)));
        assert_eq!(of(32, [8, 32], true), (8, 1, Some(8), Some(8)));
        assert_eq!(of(16, [4, 16], true), (8, 1, Some(8), Some(8)));
        assert_eq!(of(16, [16, 32], true), (8, 2, Some(16), Some(16)));
        assert_eq!(of(64, [32, 64], true), (8, 4, Some(32), Some(32)));
        assert_eq!(of(64, [64, 64], true), (8, 8, Some(64), Some(64)));
        assert_eq!(of(32, [8, 32], false), (8, 4, None, None));
        assert_eq!(of(64, [64, 64], false), (8, 8, None, Some(64)));
        assert_eq!(of(16, [4, 16], false), (4, 4, None, None));
    }

    #[test]
    fn larger_teams_fit_in_subgroups_of_a_known_size() {
        let of = |usual, range, can_choose, most| {
            let teams = Teams::new(usual, range, can_choose).larger(most);
            (teams.members, teams.in_workgroup)
        };
        assert_eq!(of(8, [8, 8], true, 32), (8, 1));
        assert_eq!(of(32, [32, 32], true, 32), (32, 1));
        assert_eq!(of(32, [32, 32], false, 32), (32, 1));
        assert_eq!(of(32, [32, 32], false, 16), (16, 2));
        assert_eq!(of(64, [64, 64], false, 32), (32, 2));
        assert_eq!(of(32, [8, 32], false, 32), (8, 4));
    }
}
