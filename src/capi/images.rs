//! Images that the application lends.

use super::error::{Error, GpcResult};
use super::input::{flag, init, unused};
use crate::host::{ImageKinds, ImageState, Images, LentImage};
use ash::vk;
use std::ffi::c_void;

/// State of an image, as in VkImageMemoryBarrier2.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImageState {
    /// Layout of the image.
    pub layout: vk::ImageLayout,
    /// Pipeline stages that use the image.
    pub stage: vk::PipelineStageFlags2,
    /// Memory accesses of these stages.
    pub access: vk::AccessFlags2,
}

/// Image of the application: single-sampled, with one level, and at least as large as the size in GpcOptions.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImage {
    /// Handle of the image.
    pub image: vk::Image,
    /// Two-dimensional view of the image, with a single aspect and a single layer.
    pub view: vk::ImageView,
    /// All aspects of the image's format, including stencil, which the library does not read.
    pub aspects: vk::ImageAspectFlags,
    /// State of the image when the recording begins.
    pub before: GpcImageState,
    /// State of the image when the recording is done.
    pub after: GpcImageState,
}

/// Kinds of images with which a frame is recorded.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImageKinds {
    /// sizeof(GpcImageKinds).
    pub size: u32,
    /// GPC_STRUCT_TYPE_IMAGE_KINDS.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// VK_TRUE if the application lends triangle IDs; VK_FALSE if the library draws IDs and depth itself.
    pub ids: vk::Bool32,
    /// VK_TRUE if the application lends depth. This requires `ids`; with `ids`, GpcOptions.thin requires depth.
    pub depth: vk::Bool32,
    /// Format of the views of the colour image: 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or
    /// B10G11R11_UFLOAT.
    pub color_format: vk::Format,
    /// VK_TRUE if the application's shaders write sRGB codes into a format of plain numbers; VK_FALSE if the colour
    /// image holds linear light, or its format encodes the light.
    pub color_encoded: vk::Bool32,
    /// VK_TRUE if the colour image has VK_IMAGE_USAGE_TRANSFER_SRC_BIT in the place of VK_IMAGE_USAGE_SAMPLED_BIT, as the
    /// images of some swapchains. The library then reads a copy of the frame's part, in an image of its own.
    pub color_copied: vk::Bool32,
    /// 0.
    pub reserved: u32,
}

/// Fills a GpcImageKinds of `size` bytes, which is sizeof(GpcImageKinds): with a colour image only, whose format still
/// has to be set.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_image_kinds(kinds: *mut GpcImageKinds, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(kinds, size) }
}

impl GpcImageKinds {
    pub(super) fn kinds(&self) -> Result<ImageKinds, Error> {
        unused("GpcImageKinds.reserved", self.reserved)?;
        Ok(ImageKinds {
            ids: flag("GpcImageKinds.ids", self.ids)?,
            depth: flag("GpcImageKinds.depth", self.depth)?,
            color_format: self.color_format,
            color_encoded: flag("GpcImageKinds.color_encoded", self.color_encoded)?,
            color_copied: flag("GpcImageKinds.color_copied", self.color_copied)?,
        })
    }
}

/// Images that the application has drawn with one sample a pixel. The result is drawn into `color`. The images are of
/// the kinds for which the frame was created.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImages {
    /// sizeof(GpcImages).
    pub size: u32,
    /// GPC_STRUCT_TYPE_IMAGES.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Image of triangle IDs, VK_FORMAT_R32_UINT, created with VK_IMAGE_USAGE_SAMPLED_BIT: 1 + the index of the nearest
    /// triangle in the order of the frame's draws, 0 for no triangle. Without GpcImageKinds.ids, image and view are
    /// VK_NULL_HANDLE.
    pub ids: GpcImage,
    /// Image of the nearest triangle's depth, of any depth format, created with VK_IMAGE_USAGE_SAMPLED_BIT; its view
    /// has the depth aspect only. Without GpcImageKinds.depth, image and view are VK_NULL_HANDLE.
    pub depth: GpcImage,
    /// Colour image, created with VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, and with VK_IMAGE_USAGE_SAMPLED_BIT unless
    /// GpcImageKinds.color_copied says otherwise. Superpixels are drawn into it.
    pub color: GpcImage,
    /// Upper left pixel of the frame's part of these images. The part has the size in GpcOptions; the library neither
    /// reads nor writes pixels outside of it.
    pub corner: [u32; 2],
    /// Array layer of the images that the views show, of which the library changes the layout.
    pub layer: u32,
    /// 0.
    pub reserved: u32,
}

/// Fills a GpcImages of `size` bytes, which is sizeof(GpcImages), without images.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_images(images: *mut GpcImages, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(images, size) }
}

impl GpcImageState {
    fn state(&self) -> ImageState {
        ImageState { layout: self.layout, stage: self.stage, access: self.access }
    }
}

impl GpcImage {
    fn lent(&self) -> LentImage {
        LentImage {
            image: self.image,
            view: self.view,
            aspects: self.aspects,
            before: self.before.state(),
            after: self.after.state(),
        }
    }

    fn lent_if_there(&self) -> Option<LentImage> {
        let absent = self.image == vk::Image::null() && self.view == vk::ImageView::null();
        (!absent).then(|| self.lent())
    }
}

impl GpcImages {
    pub(super) fn images(&self) -> Result<Images, Error> {
        unused("GpcImages.reserved", self.reserved)?;
        Ok(Images {
            ids: self.ids.lent_if_there(),
            depth: self.depth.lent_if_there(),
            color: self.color.lent(),
            corner: self.corner,
            layer: self.layer,
        })
    }
}
