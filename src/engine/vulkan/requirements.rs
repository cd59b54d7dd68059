//! Requirements for a device, which can be checked before one is made.

use super::{VulkanError, alone};
use ash::vk;
use std::ffi::CStr;

/// Advice for a user without a suitable driver.
pub const MISSING_DRIVER_HELP: &str = "Install a Vulkan 1.3 driver; without a GPU, Mesa's software driver serves (Debian: apt-get install libvulkan1 mesa-vulkan-drivers)";

/// A requirement that a device lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Missing {
    /// API version that is too low.
    #[error("Vulkan 1.3 (it has {major}.{minor})")]
    Version {
        /// Major version of the device.
        major: u32,
        /// Minor version of the device.
        minor: u32,
    },
    /// Name of a missing feature.
    #[error("the feature {0}")]
    Feature(&'static str),
    /// Instance that was created for a version without queries of features, so that the device can't be checked.
    #[error("an instance created for Vulkan 1.3 (its VkApplicationInfo::apiVersion is 1.0)")]
    Instance,
    /// Queue family with both graphics and compute.
    #[error("a queue family with graphics and compute")]
    Queue,
    /// Name of a subgroup operation that compute shaders lack.
    #[error("subgroup {0} operations in compute shaders")]
    Subgroup(&'static str),
    /// Subgroup size that is too small.
    #[error("subgroups of 4 invocations or more (it has {0})")]
    SubgroupSize(u32),
    /// Name of a format, and the use that it does not support.
    #[error("the format {0} as {1}")]
    Format(&'static str, &'static str),
    /// Limit that is too low.
    #[error("{name} of at least {needed} (it has {found})")]
    Limit {
        /// Name of the limit in the specification.
        name: &'static str,
        /// Smallest value that suffices.
        needed: u64,
        /// Value of the device.
        found: u64,
    },
}

/// Version and features that the renderer needs. It needs no extension.
#[derive(Clone, Copy, Debug, Default)]
pub struct Requirements;

/// Formats, and the features that they need for linear images or texel buffers.
const BUFFER_FORMATS: [(vk::Format, &str, vk::FormatFeatureFlags, &str); 7] = [
    (vk::Format::R32G32_UINT, "R32G32_UINT", vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER, "uniform texel buffer"),
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
    (vk::Format::R32_UINT, "R32_UINT", vk::FormatFeatureFlags::STORAGE_TEXEL_BUFFER, "storage texel buffer"),
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
    (vk::Format::R32G32_SFLOAT, "R32G32_SFLOAT", vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER, "uniform texel buffer"),
];

impl Requirements {
    /// API version for which to create instance and device.
    pub const API_VERSION: u32 = vk::API_VERSION_1_3;
    /// Largest number of storage buffers of a stage: of hosts' shaders, without those of the host's own.
    pub(crate) const STORAGE_BUFFERS: u32 = 9;
    /// Largest number of sampled images and texel buffers of a stage: of `shade`.
    pub(crate) const SAMPLED_IMAGES: u32 = 29;

    /// Features to enable when creating a device, in Vulkan 1.3's structure: `dynamicRendering`, `synchronization2`,
    /// `maintenance4`, `subgroupSizeControl` and `shaderDemoteToHelperInvocation` (to which the compiler translates
    /// `discard`).
    pub fn features13() -> vk::PhysicalDeviceVulkan13Features<'static> {
        vk::PhysicalDeviceVulkan13Features::default()
            .dynamic_rendering(true)
            .synchronization2(true)
            .maintenance4(true)
            .subgroup_size_control(true)
            .shader_demote_to_helper_invocation(true)
    }

    /// Whether the physical device has `VK_EXT_conditional_rendering` and its feature `conditionalRendering`, which
    /// are optional. A device with both enabled skips the rounds of a frame that have nothing to do; see
    /// [`Host::conditional_rendering`].
    ///
    /// [`Host::conditional_rendering`]: super::Host::conditional_rendering
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive and was created for [`Self::API_VERSION`] or later.
    #[must_use]
    pub unsafe fn has_conditional_rendering(instance: &ash::Instance, device: vk::PhysicalDevice) -> bool {
        // SAFETY: guaranteed by the caller.
        let extensions = unsafe { instance.enumerate_device_extension_properties(device) };
        let name = ash::ext::conditional_rendering::NAME;
        if !extensions.unwrap_or_default().iter().any(|extension| extension.extension_name_as_c_str() == Ok(name)) {
            return false;
        }
        let mut conditional = vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut conditional);
        // SAFETY: guaranteed by the caller; the device knows the chained structure, which lives until after the call.
        unsafe { instance.get_physical_device_features2(device, &mut features) };
        conditional.conditional_rendering == vk::TRUE
    }

    /// Checks that the version of the device is at least Vulkan 1.3. The instance may have any version.
    ///
    /// # Errors
    /// [`Missing::Version`] for an earlier version.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    pub(crate) unsafe fn check_version(instance: &ash::Instance, device: vk::PhysicalDevice) -> Result<(), Missing> {
        // SAFETY: guaranteed by the caller; the function is of Vulkan 1.0.
        let version = unsafe { instance.get_physical_device_properties(device) }.api_version;
        if version < Self::API_VERSION {
            return Err(Missing::Version {
                major: vk::api_version_major(version),
                minor: vk::api_version_minor(version),
            });
        }
        Ok(())
    }

    /// Checks that the device has functions of Vulkan 1.3; if its instance was created for an earlier version, it has
    /// none.
    ///
    /// # Errors
    /// [`VulkanError::NoFunction`] for a missing function.
    ///
    /// # Safety
    /// The device belongs to the instance; both are alive.
    pub(crate) unsafe fn check_functions(instance: &ash::Instance, device: vk::Device) -> Result<(), VulkanError> {
        for name in [c"vkCmdPipelineBarrier2", c"vkCmdBeginRendering"] {
            // SAFETY: guaranteed by the caller.
            if !unsafe { Self::has_function(instance, device, name) } {
                return Err(VulkanError::NoFunction(name.to_str().unwrap_or_default()));
            }
        }
        Ok(())
    }

    /// Whether a device has a function.
    ///
    /// # Safety
    /// The device belongs to the instance; both are alive.
    pub(super) unsafe fn has_function(instance: &ash::Instance, device: vk::Device, name: &CStr) -> bool {
        // SAFETY: guaranteed by the caller; the name ends with a zero.
        alone(|| unsafe { instance.get_device_proc_addr(device, name.as_ptr()) }).is_some()
    }

    /// Everything that the physical device lacks; empty if it is suitable.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive and was created for [`Self::API_VERSION`] or later.
    #[must_use]
    pub unsafe fn missing(instance: &ash::Instance, device: vk::PhysicalDevice) -> Vec<Missing> {
        let mut missing = Vec::new();
        let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
        let mut size_control = vk::PhysicalDeviceSubgroupSizeControlProperties::default();
        // SAFETY: guaranteed by the caller.
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
        // For instances of Vulkan 1.0, loaders answer the query themselves and ignore chained structures.
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
            (found13.shader_demote_to_helper_invocation, "shaderDemoteToHelperInvocation"),
        ] {
            if present == vk::FALSE {
                missing.push(Missing::Feature(name));
            }
        }
        // SAFETY: guaranteed by the caller.
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
        let can_choose = size_control.required_subgroup_size_stages.contains(vk::ShaderStageFlags::COMPUTE);
        let smallest = if can_choose { size_control.max_subgroup_size } else { size_control.min_subgroup_size };
        if smallest < 4 {
            missing.push(Missing::SubgroupSize(smallest));
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
        ] {
            if found < needed {
                missing.push(Missing::Limit { name, needed: needed.into(), found: found.into() });
            }
        }
        missing
    }

    /// Index of the first queue family with graphics and compute.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    #[must_use]
    pub unsafe fn queue_family(instance: &ash::Instance, device: vk::PhysicalDevice) -> Option<u32> {
        // SAFETY: guaranteed by the caller.
        let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
        families.iter().position(is_fit).and_then(|i| u32::try_from(i).ok())
    }

    /// Whether the device has a queue family with this index, with graphics and compute.
    ///
    /// # Safety
    /// The device belongs to the instance, which is alive.
    pub(super) unsafe fn is_fit(instance: &ash::Instance, device: vk::PhysicalDevice, family: u32) -> bool {
        // SAFETY: guaranteed by the caller.
        let families = unsafe { instance.get_physical_device_queue_family_properties(device) };
        families.get(family as usize).is_some_and(is_fit)
    }
}

/// Whether queues of a family support all commands that the crate records.
fn is_fit(family: &vk::QueueFamilyProperties) -> bool {
    let both = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    family.queue_flags.contains(both)
}
