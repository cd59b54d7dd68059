//! Instance and device of the library, for callers without their own.

use super::gpu::{Gpu, Host, Limits, limits};
use super::{Missing, Requirements, VulkanError, alone};
use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

const VALIDATION: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Options for creating an [`Instance`].
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct InstanceOptions {
    /// Whether to run under the validation layer with synchronisation validation, and collect its messages.
    pub validation: bool,
}

/// Messages of the validation layer.
#[derive(Default)]
pub(crate) struct Messages {
    count: AtomicUsize,
    texts: Mutex<Vec<String>>,
}

/// A Vulkan instance.
pub struct Instance {
    /// Vulkan loader, whose library stays open.
    _entry: ash::Entry,
    pub(crate) raw: ash::Instance,
    debug: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    has_debug_utils: bool,
    messages: Arc<Messages>,
}

/// Description of a device, with the requirements that it lacks.
#[derive(Clone, Debug)]
pub struct DeviceInfo {
    /// Name of the device.
    pub name: String,
    /// Kind of the device: `discrete`, `integrated`, `virtual`, `cpu` or `other`.
    pub kind: &'static str,
    /// Name and version of the driver.
    pub driver: String,
    /// Vulkan version, such as `1.3.230`.
    pub api: String,
    /// Subgroup size.
    pub subgroup_size: u32,
    /// Size of device-local memory in bytes.
    pub memory_bytes: u64,
    /// Everything that the device lacks; empty if it is suitable.
    pub missing: Vec<String>,
}

unsafe extern "system" fn on_message(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kinds: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: Vulkan passes valid callback data, and `user` is the `Messages` that the instance keeps alive
    // until after the messenger is destroyed.
    let (text, messages) = unsafe {
        let message = (*data).p_message;
        let text =
            if message.is_null() { String::new() } else { CStr::from_ptr(message).to_string_lossy().into_owned() };
        (text, &*user.cast::<Messages>())
    };
    if severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR) {
        log::error!("{text}");
    } else {
        log::warn!("{text}");
    }
    messages.count.fetch_add(1, Ordering::Relaxed);
    if let Ok(mut texts) = messages.texts.lock() {
        texts.push(text);
    }
    vk::FALSE
}

impl Instance {
    /// Loads Vulkan and creates an instance.
    ///
    /// # Errors
    /// [`VulkanError::NoLoader`] without a loader, [`VulkanError::NoValidation`] if the validation layer is asked for
    /// and not installed, otherwise [`VulkanError::Call`].
    pub fn new(options: InstanceOptions) -> Result<Arc<Self>, VulkanError> {
        // SAFETY: loading the Vulkan loader runs its initialisers, as in any Vulkan program.
        let entry = unsafe { ash::Entry::load() }.map_err(|e| VulkanError::NoLoader(e.to_string()))?;
        let application = vk::ApplicationInfo::default()
            .application_name(c"gpc")
            .engine_name(c"gpc")
            .api_version(Requirements::API_VERSION);
        let messages = Arc::new(Messages::default());
        let mut layers = Vec::new();
        let mut extensions = Vec::new();
        let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
        if options.validation {
            // SAFETY: a global query.
            let found = unsafe { entry.enumerate_instance_layer_properties() }
                .map_err(VulkanError::of("vkEnumerateInstanceLayerProperties"))?;
            if !found.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION)) {
                return Err(VulkanError::NoValidation);
            }
            layers.push(VALIDATION.as_ptr());
            extensions.push(ash::ext::validation_features::NAME.as_ptr());
        }
        // SAFETY: a global query.
        let has = unsafe { entry.enumerate_instance_extension_properties(None) }
            .map_err(VulkanError::of("vkEnumerateInstanceExtensionProperties"))?;
        let name = ash::ext::debug_utils::NAME;
        let listed = has.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name));
        // If no driver has the extension, the layer has it.
        let has_debug_utils = listed || options.validation;
        if has_debug_utils {
            extensions.push(name.as_ptr());
        }
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        if options.validation {
            info = info.push_next(&mut features);
        }
        // SAFETY: `info` and everything to which it points live until after the call.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(|e| match e {
            // The loader returns this error if it finds no driver.
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
                VulkanError::NoDevice { asked: None, found: "no driver was found".to_owned() }
            }
            e => VulkanError::of("vkCreateInstance")(e),
        })?;
        let debug = if options.validation {
            let loader = ash::ext::debug_utils::Instance::new(&entry, &raw);
            let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
                .message_severity(
                    vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
                )
                .message_type(
                    vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
                )
                .pfn_user_callback(Some(on_message))
                .user_data(Arc::as_ptr(&messages).cast_mut().cast());
            // SAFETY: the messages outlive the messenger, which `Drop` destroys first.
            let messenger = unsafe { loader.create_debug_utils_messenger(&info, None) }
                .map_err(VulkanError::of("vkCreateDebugUtilsMessengerEXT"))?;
            Some((loader, messenger))
        } else {
            None
        };
        Ok(Arc::new(Self { _entry: entry, raw, debug, has_debug_utils, messages }))
    }

    /// Messages of the validation layer so far.
    #[must_use]
    pub fn validation_messages(&self) -> Vec<String> {
        self.messages.texts.lock().map(|texts| texts.clone()).unwrap_or_default()
    }

    /// Descriptions of all devices, suitable or not.
    ///
    /// # Errors
    /// [`VulkanError::Call`] if devices can't be enumerated.
    pub fn devices(&self) -> Result<Vec<DeviceInfo>, VulkanError> {
        Ok(self.physical_devices()?.into_iter().map(|device| self.describe(device)).collect())
    }

    fn physical_devices(&self) -> Result<Vec<vk::PhysicalDevice>, VulkanError> {
        // SAFETY: the instance is alive.
        match unsafe { self.raw.enumerate_physical_devices() } {
            Ok(devices) => Ok(devices),
            // The loader returns this error if it finds no driver.
            Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Ok(Vec::new()),
            Err(e) => Err(VulkanError::of("vkEnumeratePhysicalDevices")(e)),
        }
    }

    fn describe(&self, device: vk::PhysicalDevice) -> DeviceInfo {
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut subgroup = vk::PhysicalDeviceSubgroupProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver).push_next(&mut subgroup);
        // SAFETY: the device belongs to this instance, which was created for Vulkan 1.3; chained structures that the
        // device does not know keep their defaults.
        let memory = unsafe {
            self.raw.get_physical_device_properties2(device, &mut properties);
            self.raw.get_physical_device_memory_properties(device)
        };
        let basic = properties.properties;
        let text = |name: Result<&CStr, _>| name.map(|n: &CStr| n.to_string_lossy().into_owned()).unwrap_or_default();
        DeviceInfo {
            name: text(basic.device_name_as_c_str()),
            kind: match basic.device_type {
                vk::PhysicalDeviceType::DISCRETE_GPU => "discrete",
                vk::PhysicalDeviceType::INTEGRATED_GPU => "integrated",
                vk::PhysicalDeviceType::VIRTUAL_GPU => "virtual",
                vk::PhysicalDeviceType::CPU => "cpu",
                _ => "other",
            },
            driver: format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str())),
            api: format!(
                "{}.{}.{}",
                vk::api_version_major(basic.api_version),
                vk::api_version_minor(basic.api_version),
                vk::api_version_patch(basic.api_version)
            ),
            subgroup_size: subgroup.subgroup_size,
            memory_bytes: memory
                .memory_heaps_as_slice()
                .iter()
                .filter(|heap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL))
                .map(|heap| heap.size)
                .sum(),
            // SAFETY: the device belongs to this instance.
            missing: unsafe { Requirements::missing(&self.raw, device) }.iter().map(ToString::to_string).collect(),
        }
    }

    /// Creates a device: the first suitable one whose name contains `name` (ignoring case), or, without a name, the
    /// best by kind: discrete, integrated, virtual, CPU.
    ///
    /// # Errors
    /// [`VulkanError::NoDevice`] lists every device and what it lacks; [`VulkanError::Call`] if creation fails.
    pub fn create_gpu(self: &Arc<Self>, name: Option<&str>) -> Result<Arc<Gpu>, VulkanError> {
        // SAFETY: the function changes no limit.
        unsafe { self.create_gpu_within(name, |_| ()) }
    }

    /// Creates a device as [`Instance::create_gpu`] does, with limits that `lower` reduces, to simulate weaker
    /// devices.
    ///
    /// # Errors
    /// As [`Instance::create_gpu`].
    ///
    /// # Safety
    /// `lower` raises no limit and adds no feature.
    pub(crate) unsafe fn create_gpu_within(
        self: &Arc<Self>,
        name: Option<&str>,
        lower: impl FnOnce(&mut Limits),
    ) -> Result<Arc<Gpu>, VulkanError> {
        let mut found = Vec::new();
        let mut suitable = Vec::new();
        for device in self.physical_devices()? {
            let info = self.describe(device);
            let named = name.is_none_or(|name| info.name.to_lowercase().contains(&name.to_lowercase()));
            let lacks =
                if info.missing.is_empty() { String::new() } else { format!(" lacks {}", info.missing.join(", ")) };
            found.push(format!("\"{}\"{lacks}", info.name));
            if named && info.missing.is_empty() {
                let rank =
                    ["discrete", "integrated", "virtual", "cpu", "other"].iter().position(|kind| *kind == info.kind);
                suitable.push((rank, device));
            }
        }
        let Some((_, physical_device)) = suitable.into_iter().min_by_key(|(rank, _)| *rank) else {
            let found =
                if found.is_empty() { "no device was found".to_owned() } else { format!("found {}", found.join("; ")) };
            return Err(VulkanError::NoDevice { asked: name.map(str::to_owned), found });
        };
        let queue_family =
            // SAFETY: the device belongs to this instance.
            unsafe { Requirements::queue_family(&self.raw, physical_device) }.ok_or_else(|| {
                VulkanError::Missing {
                    device: found.join(", "),
                    missing: vec![Missing::Queue],
                }
            })?;
        let priorities = [1.0];
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&priorities)];
        // SAFETY: the device belongs to this instance.
        let mut limits = unsafe { limits(&self.raw, physical_device, queue_family) };
        lower(&mut limits);
        let mut features = Requirements::features13();
        let mut conditional = vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default().conditional_rendering(true);
        let extensions = [ash::ext::conditional_rendering::NAME.as_ptr()];
        let mut info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut features);
        if limits.conditional_rendering {
            info = info.enabled_extension_names(&extensions).push_next(&mut conditional);
        }
        // SAFETY: the physical device has all requested features, as checked above.
        let device = alone(|| unsafe { self.raw.create_device(physical_device, &info, None) })
            .map_err(VulkanError::of("vkCreateDevice"))?;
        let mut host = Host::new(self.raw.clone(), physical_device, device, queue_family);
        host.conditional_rendering = limits.conditional_rendering;
        host.debug_utils = self.has_debug_utils;
        // SAFETY: the handles are alive and belong together; the Gpu keeps the instance and owns the device.
        unsafe { Gpu::owning(host, Some(self.clone()), limits) }
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: devices hold an `Arc` of the instance, so that none is left; the messenger is destroyed before the
        // instance.
        unsafe {
            if let Some((loader, messenger)) = self.debug.take() {
                loader.destroy_debug_utils_messenger(messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}
