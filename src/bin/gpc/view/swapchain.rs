//! The window's images.

use super::device::Device;
use anyhow::bail;
use ash::vk;
use gpc::vulkan::VulkanError;
use std::sync::Arc;

/// The window's images, drawn and presented by turns.
pub struct Swapchain {
    device: Arc<Device>,
    handle: vk::SwapchainKHR,
    pub extent: vk::Extent2D,
    pub format: vk::Format,
    images: Vec<SwapchainImage>,
}

/// An image of the window.
struct SwapchainImage {
    image: vk::Image,
    view: vk::ImageView,
    /// Semaphore to signal when the image is drawn.
    drawn: vk::Semaphore,
}

/// An image of the window that may be drawn to.
#[derive(Clone, Copy)]
pub struct Acquired {
    pub swapchain: vk::SwapchainKHR,
    pub index: u32,
    pub image: vk::Image,
    pub view: vk::ImageView,
    /// Semaphore to signal when the image is drawn.
    pub drawn: vk::Semaphore,
    /// Whether the swapchain no longer fits the window.
    pub stale: bool,
}

/// Result of asking for an image.
pub enum Turn {
    Ready(Acquired),
    /// No image is free now.
    Busy,
    /// The swapchain has to be made anew.
    Stale,
}

impl Swapchain {
    /// Makes the images for a window of `size` = [width, height]; they replace the `older` swapchain.
    pub fn new(device: &Arc<Device>, size: [u32; 2], older: Option<Self>) -> anyhow::Result<Self> {
        // SAFETY: queries and creations on a live device and surface. `Drop` destroys what was made before a failure.
        unsafe {
            let capabilities = device
                .surfaces
                .get_physical_device_surface_capabilities(device.physical, device.surface)
                .map_err(VulkanError::of("vkGetPhysicalDeviceSurfaceCapabilitiesKHR"))?;
            let formats = device
                .surfaces
                .get_physical_device_surface_formats(device.physical, device.surface)
                .map_err(VulkanError::of("vkGetPhysicalDeviceSurfaceFormatsKHR"))?;
            // The format must not convert: sRGB codes are copied unchanged.
            let fits = |format: &&vk::SurfaceFormatKHR| {
                let known = [vk::Format::B8G8R8A8_UNORM, vk::Format::R8G8B8A8_UNORM];
                known.contains(&format.format) && format.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR
            };
            let Some(format) = formats.iter().find(fits) else {
                bail!("the window takes no images of 8-bit sRGB colours");
            };
            let usage = vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::COLOR_ATTACHMENT;
            if !capabilities.supported_usage_flags.contains(usage) {
                bail!("the window's images can't be both copied to and drawn to");
            }
            let extent = match capabilities.current_extent {
                vk::Extent2D { width: u32::MAX, .. } => vk::Extent2D {
                    width: size[0].clamp(capabilities.min_image_extent.width, capabilities.max_image_extent.width),
                    height: size[1].clamp(capabilities.min_image_extent.height, capabilities.max_image_extent.height),
                },
                extent => extent,
            };
            let most = match capabilities.max_image_count {
                0 => u32::MAX,
                most => most,
            };
            let alpha = [vk::CompositeAlphaFlagsKHR::OPAQUE, vk::CompositeAlphaFlagsKHR::INHERIT];
            let alpha = alpha.into_iter().find(|alpha| capabilities.supported_composite_alpha.contains(*alpha));
            let info = vk::SwapchainCreateInfoKHR::default()
                .surface(device.surface)
                .min_image_count((capabilities.min_image_count + 1).min(most))
                .image_format(format.format)
                .image_color_space(format.color_space)
                .image_extent(extent)
                .image_array_layers(1)
                .image_usage(usage)
                .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
                .pre_transform(capabilities.current_transform)
                .composite_alpha(alpha.unwrap_or(vk::CompositeAlphaFlagsKHR::OPAQUE))
                .present_mode(vk::PresentModeKHR::FIFO)
                .clipped(true)
                .old_swapchain(older.as_ref().map_or(vk::SwapchainKHR::null(), |old| old.handle));
            let handle =
                device.swapchains.create_swapchain(&info, None).map_err(VulkanError::of("vkCreateSwapchainKHR"))?;
            // The caller waited for all commands that used the older swapchain.
            drop(older);
            let mut swapchain =
                Self { device: device.clone(), handle, extent, format: format.format, images: Vec::new() };
            let images =
                device.swapchains.get_swapchain_images(handle).map_err(VulkanError::of("vkGetSwapchainImagesKHR"))?;
            for image in images {
                let mut shown = SwapchainImage { image, view: vk::ImageView::null(), drawn: vk::Semaphore::null() };
                let info = vk::ImageViewCreateInfo::default()
                    .image(image)
                    .view_type(vk::ImageViewType::TYPE_2D)
                    .format(format.format)
                    .subresource_range(super::picture::COLOR);
                let made = device.handle.create_image_view(&info, None);
                shown.view = made.map_err(VulkanError::of("vkCreateImageView"))?;
                let info = vk::SemaphoreCreateInfo::default();
                let made = device.handle.create_semaphore(&info, None);
                swapchain.images.push(shown);
                if let Some(shown) = swapchain.images.last_mut() {
                    shown.drawn = made.map_err(VulkanError::of("vkCreateSemaphore"))?;
                }
            }
            Ok(swapchain)
        }
    }

    /// Asks for an image to draw to, without waiting. `free` is signalled when it may be drawn to.
    pub fn acquire(&self, free: vk::Semaphore) -> Result<Turn, VulkanError> {
        // SAFETY: the semaphore is unsignalled and not waited for: the last submission of its slot has been executed.
        let acquired = unsafe { self.device.swapchains.acquire_next_image(self.handle, 0, free, vk::Fence::null()) };
        match acquired {
            Ok((index, stale)) => Ok(self.images.get(index as usize).map_or(Turn::Stale, |shown| {
                Turn::Ready(Acquired {
                    swapchain: self.handle,
                    index,
                    image: shown.image,
                    view: shown.view,
                    drawn: shown.drawn,
                    stale,
                })
            })),
            Err(vk::Result::NOT_READY | vk::Result::TIMEOUT) => Ok(Turn::Busy),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => Ok(Turn::Stale),
            Err(result) => Err(VulkanError::of("vkAcquireNextImageKHR")(result)),
        }
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        self.device.wait();
        // SAFETY: the device is idle, and no image of this swapchain is being presented.
        unsafe {
            for shown in &self.images {
                self.device.handle.destroy_image_view(shown.view, None);
                self.device.handle.destroy_semaphore(shown.drawn, None);
            }
            self.device.swapchains.destroy_swapchain(self.handle, None);
        }
    }
}
