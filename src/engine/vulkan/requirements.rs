//! What the renderer needs of a device, known before one is made.

use super::VulkanError;
use ash::vk;

/// What a user does about a missing driver.
pub const MISSING_DRIVER_HELP: &str = "Install a Vulkan 1.3 driver; without a GPU, Mesa's software driver serves (Debian: apt-get install libvulkan1 mesa-vulkan-drivers)";

/// Something that a device lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Missing {
    /// The API version is too low.
    #[error("Vulkan 1.3 (it has {major}.{minor})")]
    Version {
        /// Major version found.
        major: u32,
        /// Minor version found.
        minor: u32,
    },
    /// A feature is absent.
    #[error("the feature {0}")]
    Feature(&'static str),
    /// The instance was created for a version that has no queries of features; a device says nothing of its own through it.
    #[error("an instance created for Vulkan 1.3 (its VkApplicationInfo::apiVersion is 1.0)")]
    Instance,
    /// No queue family does both graphics and compute.
    #[error("a queue family with graphics and compute")]
    Queue,
    /// Subgroups of compute shaders lack an operation.
    #[error("subgroup {0} operations in compute shaders")]
    Subgroup(&'static str),
    /// Subgroups are too small.
    #[error("subgroups of 4 invocations or more (it has {0})")]
    SubgroupSize(u32),
    /// A format can't be used as needed.
    #[error("the format {0} as {1}")]
    Format(&'static str, &'static str),
    /// A limit is too low.
    #[error("{name} of at least {needed} (it has {found})")]
    Limit {
        /// The limit's name in the specification.
        name: &'static str,
        /// The least that will do.
        needed: u64,
        /// What the device has.
        found: u64,
    },
}

/// The version and features that the renderer uses. It needs no extension.
#[derive(Clone, Copy, Debug, Default)]
pub struct Requirements;

/// Formats and what they must do in linear images or texel buffers.
const BUFFER_FORMATS: [(vk::Format, &str, vk::FormatFeatureFlags, &str); 7] = [
    (
        vk::Format::R32G32_UINT,
        "R32G32_UINT",
        vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER,
        "uniform texel buffer",
    ),
    (
        vk::Format::R32G32B32A32_SFLOAT,
        "R32G32B32A32_SFLOAT",
        vk::FormatFeatureFlags::STORAGE_TEXEL_BUFFER,
        "storage texel buffer",
    ),
    (
        vk::Format::R32G32B32A32_UINT,
        "R32G32B32A32_UINT",
        vk::FormatFeatureFlags::STORAGE_TEXEL_BUFFER,
        "storage texel buffer",
    ),
    (
        vk::Format::R32_UINT,
        "R32_UINT",
        vk::FormatFeatureFlags::STORAGE_TEXEL_BUFFER,
        "storage texel buffer",
    ),
    (
        vk::Format::R32G32B32A32_SFLOAT,
        "R32G32B32A32_SFLOAT",
        vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER,
        "uniform texel buffer",
    ),
    (
        vk::Format::R32G32B32A32_UINT,
        "R32G32B32A32_UINT",
        vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER,
        "uniform texel buffer",
    ),
    (
        vk::Format::R32G32_SFLOAT,
        "R32G32_SFLOAT",
        vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER,
        "uniform texel buffer",
    ),
];

impl Requirements {
    /// The API version to create the instance and device with.
    pub const API_VERSION: u32 = vk::API_VERSION_1_3;
    /// Storage buffers that a pipeline's layout shows to a stage.
    pub(crate) const STORAGE_BUFFERS: u32 = 20;
    /// Images and texel buffers that it shows to be read.
    pub(crate) const SAMPLED_IMAGES: u32 = 47;
    /// All that it shows, and an attachment.
    pub(crate) const RESOURCES: u32 = 74;

    /// Features to enable at device creation, as they stand in Vulkan 1.3's structures:
    /// `dynamicRendering`, `synchronization2`, `maintenance4`, `subgroupSizeControl` and
    /// `shaderDemoteToHelperInvocation` (the compiler's form of `discard`).
    pub fn features13() -> vk::PhysicalDeviceVulkan13Features<'static> {
        vk::PhysicalDeviceVulkan13Features::default()
            .dynamic_rendering(true)
            .synchronization2(true)
            .maintenance4(true)
            .subgroup_size_control(true)
            .shader_demote_to_helper_invocation(true)
    }

    /// Whether the physical device has `VK_EXT_conditional_rendering` and its feature `conditionalRendering`. It is not needed. A
    /// device with both enabled skips the rounds of a frame that have nothing to do; see [`Host::conditional_rendering`].
    ///
    /// [`Host::conditional_rendering`]: super::Host::conditional_rendering
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive and was created for [`Self::API_VERSION`] or later.
    #[must_use]
    pub unsafe fn has_conditional_rendering(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
    ) -> bool {
        // SAFETY: passed on to the caller.
        let extensions = unsafe { instance.enumerate_device_extension_properties(device) };
        let name = ash::ext::conditional_rendering::NAME;
        if !extensions
            .unwrap_or_default()
            .iter()
            .any(|extension| extension.extension_name_as_c_str() == Ok(name))
        {
            return false;
        }
        let mut conditional = vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut conditional);
        // SAFETY: as above; the device knows the chained structure, which lives until after the call.
        unsafe { instance.get_physical_device_features2(device, &mut features) };
        conditional.conditional_rendering == vk::TRUE
    }

    /// Refuses a device of an earlier version than Vulkan 1.3. Any instance will do.
    ///
    /// # Errors
    /// [`Missing::Version`].
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    pub(crate) unsafe fn check_version(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
    ) -> Result<(), Missing> {
        // SAFETY: passed on to the caller; a query of Vulkan 1.0.
        let version = unsafe { instance.get_physical_device_properties(device) }.api_version;
        if version < Self::API_VERSION {
            return Err(Missing::Version {
                major: vk::api_version_major(version),
                minor: vk::api_version_minor(version),
            });
        }
        Ok(())
    }

    /// Refuses a device without functions of Vulkan 1.3, as one whose instance was created for an earlier version.
    ///
    /// # Errors
    /// [`VulkanError::NoFunction`].
    ///
    /// # Safety
    /// The device belongs to the instance; both are alive.
    pub(crate) unsafe fn check_functions(
        instance: &ash::Instance,
        device: vk::Device,
    ) -> Result<(), VulkanError> {
        for name in [c"vkCmdPipelineBarrier2", c"vkCmdBeginRendering"] {
            // SAFETY: passed on to the caller; the name ends with a zero.
            let found = unsafe { instance.get_device_proc_addr(device, name.as_ptr()) };
            found.ok_or(VulkanError::NoFunction(name.to_str().unwrap_or_default()))?;
        }
        Ok(())
    }

    /// Refuses an instance that was created for an earlier version than Vulkan 1.3. Loaders don't tell, so that a device is
    /// made and destroyed again.
    ///
    /// # Errors
    /// As [`Self::check_functions`]; [`VulkanError::Call`] if the driver makes no device.
    ///
    /// # Safety
    /// The physical device has the queue family and belongs to the instance, which is alive.
    #[cfg(feature = "capi")]
    pub(crate) unsafe fn check_instance(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
        queue_family: u32,
    ) -> Result<(), VulkanError> {
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(queue_family)
            .queue_priorities(&[1.0])];
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
        // SAFETY: passed on to the caller; nothing is made with the device.
        unsafe {
            let made = instance
                .create_device(device, &info, None)
                .map_err(VulkanError::of("vkCreateDevice"))?;
            let checked = Self::check_functions(instance, made.handle());
            made.destroy_device(None);
            checked
        }
    }

    /// Everything that the physical device lacks; empty if it will do.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive and was created for [`Self::API_VERSION`] or later.
    #[must_use]
    pub unsafe fn missing(instance: &ash::Instance, device: vk::PhysicalDevice) -> Vec<Missing> {
        let mut missing = Vec::new();
        let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
        let mut size_control = vk::PhysicalDeviceSubgroupSizeControlProperties::default();
        // SAFETY: passed on to the caller.
        if let Err(version) = unsafe { Self::check_version(instance, device) } {
            return vec![version];
        }
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties2 = vk::PhysicalDeviceProperties2::default()
            .push_next(&mut driver)
            .push_next(&mut subgroup)
            .push_next(&mut size_control);
        // SAFETY: the device has Vulkan 1.3; the chained structures live until after the call.
        unsafe { instance.get_physical_device_properties2(device, &mut properties2) };
        let limits = properties2.properties.limits;
        // Loaders answer the query themselves for instances of Vulkan 1.0, and leave what is chained to it alone.
        if driver.driver_id.as_raw() == 0 {
            return vec![Missing::Instance];
        }

        let mut found13 = vk::PhysicalDeviceVulkan13Features::default();
        let mut found2 = vk::PhysicalDeviceFeatures2::default().push_next(&mut found13);
        // SAFETY: as above.
        unsafe { instance.get_physical_device_features2(device, &mut found2) };
        for (present, name) in [
            (found13.dynamic_rendering, "dynamicRendering"),
            (found13.synchronization2, "synchronization2"),
            (found13.maintenance4, "maintenance4"),
            (found13.subgroup_size_control, "subgroupSizeControl"),
            (
                found13.shader_demote_to_helper_invocation,
                "shaderDemoteToHelperInvocation",
            ),
        ] {
            if present == vk::FALSE {
                missing.push(Missing::Feature(name));
            }
        }
        // SAFETY: passed on to the caller.
        if unsafe { Self::queue_family(instance, device) }.is_none() {
            missing.push(Missing::Queue);
        }
        for (flag, name) in [
            (vk::SubgroupFeatureFlags::ARITHMETIC, "arithmetic"),
            (vk::SubgroupFeatureFlags::BALLOT, "ballot"),
            (vk::SubgroupFeatureFlags::SHUFFLE, "shuffle"),
            (vk::SubgroupFeatureFlags::VOTE, "vote"),
        ] {
            if !subgroup.supported_operations.contains(flag) {
                missing.push(Missing::Subgroup(name));
            }
        }
        if size_control.max_subgroup_size < 4 {
            missing.push(Missing::SubgroupSize(subgroup.subgroup_size));
        }
        for (format, name, flag, what) in BUFFER_FORMATS {
            // SAFETY: as above.
            let found = unsafe { instance.get_physical_device_format_properties(device, format) };
            if !found.buffer_features.contains(flag) {
                missing.push(Missing::Format(name, what));
            }
        }
        for (name, needed, found) in [
            (
                "maxPerStageDescriptorStorageBuffers",
                Self::STORAGE_BUFFERS,
                limits.max_per_stage_descriptor_storage_buffers,
            ),
            (
                "maxPerStageDescriptorSampledImages",
                Self::SAMPLED_IMAGES,
                limits.max_per_stage_descriptor_sampled_images,
            ),
            (
                "maxPerStageResources",
                Self::RESOURCES,
                limits.max_per_stage_resources,
            ),
        ] {
            if found < needed {
                missing.push(Missing::Limit {
                    name,
                    needed: needed.into(),
                    found: found.into(),
                });
            }
        }
        missing
    }

    /// The first queue family with graphics and compute.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    #[must_use]
    pub unsafe fn queue_family(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
    ) -> Option<u32> {
        // SAFETY: passed on to the caller.
        let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
        families
            .iter()
            .position(is_fit)
            .and_then(|i| u32::try_from(i).ok())
    }

    /// Whether the device has that queue family, with graphics and compute.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    pub(super) unsafe fn is_fit(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
        family: u32,
    ) -> bool {
        // SAFETY: passed on to the caller.
        let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
        families.get(family as usize).is_some_and(is_fit)
    }
}

/// Whether queues of a family take all commands that the crate records.
fn is_fit(family: &vk::QueueFamilyProperties) -> bool {
    let both = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    family.queue_flags.contains(both)
}
