//! The viewer's own instance, device and queue, made as any host makes them.

use anyhow::{Context, anyhow};
use ash::vk;
use gpc::vulkan::{Host, MemorySource, Requirements, SharedAllocator, SharedQueue, VulkanError};
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use winit::raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::window::Window;

const VALIDATION: &CStr = c"VK_LAYER_KHRONOS_validation";

/// A device that can present pictures in a window.
///
/// Everything that is made from the device holds an [`Arc`] of it, so that the device is destroyed last.
pub struct Device {
    pub handle: ash::Device,
    pub physical: vk::PhysicalDevice,
    pub queue_family: u32,
    conditional_rendering: bool,
    /// Queue for graphics and presentation; one thread uses it at a time.
    pub queue: SharedQueue,
    pub surface: vk::SurfaceKHR,
    pub surfaces: ash::khr::surface::Instance,
    pub swapchains: ash::khr::swapchain::Device,
    /// Allocator of device memory; `None` only in `Drop`, which frees its blocks before the device.
    allocator: Option<SharedAllocator>,
    instance: ash::Instance,
    debug: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    messages: Box<Messages>,
    /// Window of the surface, which must not outlive it.
    _window: Arc<Window>,
    /// Vulkan loader, whose library stays open.
    _entry: ash::Entry,
}

/// Messages of the validation layer.
type Messages = Mutex<Vec<String>>;

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kinds: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: Vulkan passes valid data, and `user` is the `Messages` that the device keeps until its messenger is gone.
    let (text, messages) = unsafe {
        let text = (*data).message_as_c_str().unwrap_or_default();
        (text.to_string_lossy().into_owned(), &*user.cast::<Messages>())
    };
    log::error!("{text}");
    messages.lock().unwrap_or_else(PoisonError::into_inner).push(text);
    vk::FALSE
}

impl Device {
    /// Opens the best device that can present pictures in the window, or one by part of its name.
    pub fn new(window: Arc<Window>, name: Option<&str>, validation: bool) -> anyhow::Result<Self> {
        let display = window.display_handle()?.as_raw();
        let handle = window.window_handle()?.as_raw();
        let mut extensions = ash_window::enumerate_required_extensions(display)
            .map_err(VulkanError::of("finding what the window needs"))?
            .to_vec();
        // SAFETY: plain creations whose structures live until after the call; display and window outlive the surface.
        // Handles that were made before a failure leak, but the program ends then.
        unsafe {
            let entry = ash::Entry::load().map_err(|error| VulkanError::NoLoader(error.to_string()))?;
            let mut layers = Vec::new();
            let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
            let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
            let application =
                vk::ApplicationInfo::default().application_name(c"gpc view").api_version(Requirements::API_VERSION);
            if validation {
                layers.push(VALIDATION.as_ptr());
                extensions.push(ash::ext::debug_utils::NAME.as_ptr());
                extensions.push(ash::ext::validation_features::NAME.as_ptr());
            }
            let mut info = vk::InstanceCreateInfo::default()
                .application_info(&application)
                .enabled_layer_names(&layers)
                .enabled_extension_names(&extensions);
            if validation {
                info = info.push_next(&mut features);
            }
            let instance = entry.create_instance(&info, None).map_err(|result| match result {
                vk::Result::ERROR_LAYER_NOT_PRESENT => VulkanError::NoValidation,
                vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
                    VulkanError::NoDevice { asked: None, found: "no driver was found".to_owned() }
                }
                result => VulkanError::of("vkCreateInstance")(result),
            })?;
            let messages = Box::new(Messages::default());
            let debug = if validation { Some(listen(&entry, &instance, &messages)?) } else { None };
            let surface = ash_window::create_surface(&entry, &instance, display, handle, None)
                .map_err(VulkanError::of("creating the window's surface"))?;
            let surfaces = ash::khr::surface::Instance::new(&entry, &instance);
            let (physical, queue_family) = choose(&instance, &surfaces, surface, name)?;

            let mut features = Requirements::features13();
            // Conditional rendering skips rounds of superpixels that are not needed.
            let conditional_rendering = Requirements::has_conditional_rendering(&instance, physical);
            let mut conditional =
                vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default().conditional_rendering(true);
            let queues =
                [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
            let mut extensions = vec![ash::khr::swapchain::NAME.as_ptr()];
            if conditional_rendering {
                extensions.push(ash::ext::conditional_rendering::NAME.as_ptr());
            }
            let mut info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_extension_names(&extensions)
                .push_next(&mut features);
            if conditional_rendering {
                info = info.push_next(&mut conditional);
            }
            let device = instance.create_device(physical, &info, None).map_err(VulkanError::of("vkCreateDevice"))?;
            let allocator = Allocator::new(&AllocatorCreateDesc {
                instance: instance.clone(),
                device: device.clone(),
                physical_device: physical,
                debug_settings: gpu_allocator::AllocatorDebugSettings::default(),
                buffer_device_address: false,
                allocation_sizes: gpu_allocator::AllocationSizes::default(),
            })
            .context("the allocator of device memory can't start")?;
            Ok(Self {
                queue: Arc::new(Mutex::new(device.get_device_queue(queue_family, 0))),
                swapchains: ash::khr::swapchain::Device::new(&instance, &device),
                handle: device,
                physical,
                queue_family,
                conditional_rendering,
                surface,
                surfaces,
                allocator: Some(Arc::new(Mutex::new(allocator))),
                instance,
                debug,
                messages,
                _window: window,
                _entry: entry,
            })
        }
    }

    /// The device's handles, as a host lends them to the renderer.
    pub fn host(&self) -> Host {
        let mut host = Host::new(self.instance.clone(), self.physical, self.handle.clone(), self.queue_family);
        host.memory = self.allocator.clone().map_or(MemorySource::Own, MemorySource::Shared);
        host.conditional_rendering = self.conditional_rendering;
        host
    }

    /// The allocator, shared by the renderer and the panel's painter.
    pub fn allocator(&self) -> anyhow::Result<SharedAllocator> {
        let allocator = self.allocator.clone();
        allocator.ok_or_else(|| anyhow!("the allocator is gone"))
    }

    /// Messages of the validation layer, if it runs.
    pub fn validation_messages(&self) -> Vec<String> {
        let messages = self.messages.lock();
        messages.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The queue, for as long as the caller holds it.
    pub fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the device has done all submitted work.
    pub fn wait(&self) {
        let _queue = self.queue();
        // SAFETY: the device is alive, and no other thread uses its queue meanwhile. An error can be ignored: a lost
        // device is idle.
        let _ = unsafe { self.handle.device_wait_idle() };
    }
}

/// Creates a messenger that collects the messages of the validation layer.
///
/// # Safety
/// The messages outlive the messenger.
unsafe fn listen(
    entry: &ash::Entry,
    instance: &ash::Instance,
    messages: &Messages,
) -> Result<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT), VulkanError> {
    let loader = ash::ext::debug_utils::Instance::new(entry, instance);
    let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR)
        .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
        .pfn_user_callback(Some(on_message))
        .user_data(std::ptr::from_ref(messages).cast_mut().cast());
    // SAFETY: guaranteed by the caller.
    let messenger = unsafe { loader.create_debug_utils_messenger(&info, None) }
        .map_err(VulkanError::of("vkCreateDebugUtilsMessengerEXT"))?;
    Ok((loader, messenger))
}

/// The best suitable device whose name contains `name`, and its queue family.
///
/// # Safety
/// The surface belongs to the instance.
unsafe fn choose(
    instance: &ash::Instance,
    surfaces: &ash::khr::surface::Instance,
    surface: vk::SurfaceKHR,
    name: Option<&str>,
) -> Result<(vk::PhysicalDevice, u32), VulkanError> {
    let name = name.map(str::to_lowercase);
    let mut found = Vec::new();
    let mut suitable = Vec::new();
    // SAFETY: queries of a live instance and its devices.
    unsafe {
        let devices = instance.enumerate_physical_devices().map_err(VulkanError::of("vkEnumeratePhysicalDevices"))?;
        for device in devices {
            let properties = instance.get_physical_device_properties(device);
            let label = properties.device_name_as_c_str().unwrap_or_default();
            let label = label.to_string_lossy();
            let mut lacks: Vec<_> = Requirements::missing(instance, device).iter().map(ToString::to_string).collect();
            let family = Requirements::queue_family(instance, device);
            let shows = family.is_some_and(|family| {
                surfaces.get_physical_device_surface_support(device, family, surface).unwrap_or(false)
            });
            let extensions = instance.enumerate_device_extension_properties(device).unwrap_or_default();
            let swaps =
                extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(ash::khr::swapchain::NAME));
            if !(shows && swaps) {
                lacks.push("a way to show pictures in this window".to_owned());
            }
            let named = name.as_ref().is_none_or(|name| label.to_lowercase().contains(name));
            match family.filter(|_| lacks.is_empty()) {
                Some(family) if named => {
                    suitable.push((rank(properties.device_type), device, family));
                }
                _ if lacks.is_empty() => found.push(format!("\"{label}\"")),
                _ => found.push(format!("\"{label}\" lacks {}", lacks.join(", "))),
            }
        }
    }
    match suitable.into_iter().min_by_key(|(rank, ..)| *rank) {
        Some((_, device, family)) => Ok((device, family)),
        None => Err(VulkanError::NoDevice {
            asked: name,
            found: if found.is_empty() {
                "no device was found".to_owned()
            } else {
                format!("found {}", found.join("; "))
            },
        }),
    }
}

/// Order of preference of a type of device; the lowest is the best.
fn rank(kind: vk::PhysicalDeviceType) -> u32 {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => 0,
        vk::PhysicalDeviceType::INTEGRATED_GPU => 1,
        vk::PhysicalDeviceType::VIRTUAL_GPU => 2,
        vk::PhysicalDeviceType::CPU => 3,
        _ => 4,
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.wait();
        self.allocator = None;
        // SAFETY: the device is idle, and everything made from device and surface held an `Arc` of `self` and is gone.
        unsafe {
            self.handle.destroy_device(None);
            self.surfaces.destroy_surface(self.surface, None);
            if let Some((loader, messenger)) = self.debug.take() {
                loader.destroy_debug_utils_messenger(messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}
