//! A window's images.

use crate::Failure;
use crate::device::Device;
use crate::slot::Shown;
use ash::vk;
use std::ffi::CStr;
use winit::raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::window::Window;

/// Number of frames in flight.
const IN_FLIGHT: usize = 2;

/// A window's surface.
pub struct Surface<'a> {
    device: &'a Device,
    raw: vk::SurfaceKHR,
    instance: ash::khr::surface::Instance,
    functions: ash::khr::swapchain::Device,
}

impl<'a> Surface<'a> {
    /// Extensions of the instance that a window needs.
    pub fn extensions(window: &Window) -> Result<Vec<&'static CStr>, Failure> {
        let display = window.display_handle()?.as_raw();
        let names = ash_window::enumerate_required_extensions(display)?;
        // SAFETY: the names are constants of the Vulkan bindings.
        Ok(names.iter().map(|name| unsafe { CStr::from_ptr(*name) }).collect())
    }

    /// Makes the surface of a window, which must outlive it.
    pub fn new(device: &'a Device, window: &Window) -> Result<Self, Failure> {
        let (display, handle) = (window.display_handle()?, window.window_handle()?);
        let (display, handle) = (display.as_raw(), handle.as_raw());
        // SAFETY: the device's instance has the extensions; the window outlives this.
        unsafe {
            let (entry, instance) = (&device.entry, &device.instance);
            let raw = ash_window::create_surface(entry, instance, display, handle, None)?;
            let surface = Self {
                device,
                raw,
                instance: ash::khr::surface::Instance::new(entry, instance),
                functions: ash::khr::swapchain::Device::new(instance, &device.raw),
            };
            let (physical, family) = (device.physical, device.family);
            let functions = &surface.instance;
            if !functions.get_physical_device_surface_support(physical, family, raw)? {
                return Err("the device can't show images in this window".into());
            }
            Ok(surface)
        }
    }
}

impl Drop for Surface<'_> {
    fn drop(&mut self) {
        // SAFETY: its swapchains are gone.
        unsafe { self.instance.destroy_surface(self.raw, None) };
    }
}

/// A window's images, in its current size.
pub struct Swapchain<'a> {
    surface: &'a Surface<'a>,
    raw: vk::SwapchainKHR,
    pub size: [u32; 2],
    /// Images, each with a semaphore to signal when it is written.
    images: Vec<(vk::Image, vk::Semaphore)>,
    /// Semaphores of the frames in flight, signalled when a frame's image may be written.
    free: [vk::Semaphore; IN_FLIGHT],
}

impl<'a> Swapchain<'a> {
    /// Makes the images of a window. They replace those of an older swapchain. Handles that were made before a failure
    /// leak, but the program ends then.
    pub fn new(surface: &'a Surface<'a>, size: [u32; 2], older: Option<Self>) -> Result<Self, Failure> {
        let (device, raw) = (surface.device, &surface.device.raw);
        let functions = &surface.instance;
        // SAFETY: queries and creations on a live device and surface.
        unsafe {
            raw.device_wait_idle()?;
            let able = functions.get_physical_device_surface_capabilities(device.physical, surface.raw)?;
            let formats = functions.get_physical_device_surface_formats(device.physical, surface.raw)?;
            // Copies to an sRGB image encode linear light.
            let encodes = |format: &&vk::SurfaceFormatKHR| {
                [vk::Format::B8G8R8A8_SRGB, vk::Format::R8G8B8A8_SRGB].contains(&format.format)
            };
            let format = formats.iter().find(encodes);
            let format = format.ok_or("the window takes no sRGB images")?;
            let extent = match able.current_extent {
                vk::Extent2D { width: u32::MAX, .. } => vk::Extent2D { width: size[0], height: size[1] },
                extent => extent,
            };
            let most = match able.max_image_count {
                0 => u32::MAX,
                most => most,
            };
            let info = vk::SwapchainCreateInfoKHR::default()
                .surface(surface.raw)
                .min_image_count((able.min_image_count + 1).min(most))
                .image_format(format.format)
                .image_color_space(format.color_space)
                .image_extent(extent)
                .image_array_layers(1)
                .image_usage(vk::ImageUsageFlags::TRANSFER_DST)
                .pre_transform(able.current_transform)
                .composite_alpha(vk::CompositeAlphaFlagsKHR::OPAQUE)
                .present_mode(vk::PresentModeKHR::FIFO)
                .clipped(true)
                .old_swapchain(older.as_ref().map_or_else(vk::SwapchainKHR::null, |it| it.raw));
            let made = surface.functions.create_swapchain(&info, None)?;
            drop(older);
            let semaphore = || raw.create_semaphore(&vk::SemaphoreCreateInfo::default(), None);
            let images = surface.functions.get_swapchain_images(made)?;
            let images = images.into_iter().map(|image| Ok((image, semaphore()?)));
            Ok(Self {
                surface,
                raw: made,
                size: [extent.width, extent.height],
                images: images.collect::<Result<_, vk::Result>>()?,
                free: [semaphore()?, semaphore()?],
            })
        }
    }

    /// Acquires the next image for a frame in flight whose commands have run; `None` if the window has another size.
    pub fn acquire(&self, in_flight: usize) -> Result<Option<Shown>, Failure> {
        let (free, none) = (self.free[in_flight], vk::Fence::null());
        let functions = &self.surface.functions;
        // SAFETY: the semaphore's last wait has been executed.
        match unsafe { functions.acquire_next_image(self.raw, u64::MAX, free, none) } {
            Ok((index, _)) => {
                let (image, written) = self.images[index as usize];
                Ok(Some(Shown { image, size: self.size, free, written }))
            }
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Presents an image whose commands were submitted. Returns false if the window has another size.
    pub fn present(&self, shown: &Shown) -> Result<bool, Failure> {
        let index = self.images.iter().position(|(image, _)| *image == shown.image);
        let indices = [index.ok_or("an image of another swapchain")? as u32];
        let (swapchains, written) = ([self.raw], [shown.written]);
        let info =
            vk::PresentInfoKHR::default().wait_semaphores(&written).swapchains(&swapchains).image_indices(&indices);
        let functions = &self.surface.functions;
        // SAFETY: the commands that signal the semaphore are submitted.
        match unsafe { functions.queue_present(self.surface.device.queue, &info) } {
            Ok(is_suboptimal) => Ok(!is_suboptimal),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
}

impl Drop for Swapchain<'_> {
    fn drop(&mut self) {
        let raw = &self.surface.device.raw;
        // SAFETY: the device is idle afterwards.
        unsafe {
            let _ = raw.device_wait_idle();
            self.surface.functions.destroy_swapchain(self.raw, None);
            let written = self.images.iter().map(|(_, written)| *written);
            for semaphore in written.chain(self.free) {
                raw.destroy_semaphore(semaphore, None);
            }
        }
    }
}
