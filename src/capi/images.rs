//! Images that the application lends.

use super::error::{Error, GpcResult};
use super::input::{Element, GpcStructType, Struct, flag, init, sizes};
use crate::host::{ImageKinds, ImageState, Images, LentImage};
use ash::vk;
use std::ffi::c_void;

/// State of an image, as in VkImageMemoryBarrier2.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImageState {
    /// Its layout.
    pub layout: vk::ImageLayout,
    /// Stages that use it.
    pub stage: vk::PipelineStageFlags2,
    /// How they use it.
    pub access: vk::AccessFlags2,
}

/// An image: single-sampled, one level, one layer, of the size in GpcOptions or larger.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImage {
    /// The image.
    pub image: vk::Image,
    /// A two-dimensional view of it, of one aspect.
    pub view: vk::ImageView,
    /// The aspects of the image; of a format with stencil, that too, although it is not read.
    pub aspects: vk::ImageAspectFlags,
    /// Its state when the recording begins.
    pub before: GpcImageState,
    /// Its state when the recording is done.
    pub after: GpcImageState,
}

/// The kinds of images that a frame is recorded with.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImageKinds {
    /// sizeof(GpcImageKinds).
    pub size: u32,
    /// GPC_STRUCT_TYPE_IMAGE_KINDS.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// VK_TRUE if triangle IDs are lent; VK_FALSE if the library draws IDs and depth for itself.
    pub ids: vk::Bool32,
    /// VK_TRUE if depth is lent, which goes with IDs and is needed there by GpcOptions.thin.
    pub depth: vk::Bool32,
    /// The format of the views of colours: 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or B10G11R11_UFLOAT.
    pub color_format: vk::Format,
    /// VK_TRUE if the application's shaders write sRGB codes into a format of plain numbers; VK_FALSE if the image of colours holds
    /// linear light, or encodes it itself.
    pub color_encoded: vk::Bool32,
}

// SAFETY: `repr(C)`; integers and pointers may have any bytes.
unsafe impl Element for GpcImageKinds {
    const NAME: &'static str = "GpcImageKinds";
    const SIZES: &'static [usize] = sizes!(GpcImageKinds, color_encoded);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcImageKinds {
    const TYPE: GpcStructType = GpcStructType::ImageKinds;
}

/// Fills a GpcImageKinds of `size` bytes, which is sizeof(GpcImageKinds): colours alone are lent. Their format is still to be set.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_image_kinds(kinds: *mut GpcImageKinds, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(kinds, size) }
}

impl GpcImageKinds {
    pub(super) fn kinds(&self) -> Result<ImageKinds, Error> {
        Ok(ImageKinds {
            ids: flag("GpcImageKinds.ids", self.ids)?,
            depth: flag("GpcImageKinds.depth", self.depth)?,
            color_format: self.color_format,
            color_encoded: flag("GpcImageKinds.color_encoded", self.color_encoded)?,
        })
    }
}

/// What the application has drawn, one sample a pixel, and where its picture goes: images of the kinds that the frame was created
/// for.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImages {
    /// sizeof(GpcImages).
    pub size: u32,
    /// GPC_STRUCT_TYPE_IMAGES.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Triangle IDs, VK_FORMAT_R32_UINT, made with VK_IMAGE_USAGE_SAMPLED_BIT: 1 + the index of the nearest triangle in the
    /// order of the frame's draws, 0 where there is none. Without GpcImageKinds.ids, image and view are VK_NULL_HANDLE.
    pub ids: GpcImage,
    /// Depth of the nearest triangle, of any depth format, made with VK_IMAGE_USAGE_SAMPLED_BIT; the view shows depth alone.
    /// Without GpcImageKinds.depth, image and view are VK_NULL_HANDLE.
    pub depth: GpcImage,
    /// Colours, made with VK_IMAGE_USAGE_SAMPLED_BIT and VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT: superpixels are drawn into it.
    pub color: GpcImage,
    /// Upper left corner of the part of these images that the frame is of, in pixels. The part has the size in GpcOptions; the
    /// library neither reads nor writes what lies around it.
    pub corner: [u32; 2],
}

// SAFETY: `repr(C)`; integers, raw handles and pointers may have any bytes.
unsafe impl Element for GpcImages {
    const NAME: &'static str = "GpcImages";
    const SIZES: &'static [usize] = sizes!(GpcImages, corner);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcImages {
    const TYPE: GpcStructType = GpcStructType::Images;
}

/// Fills a GpcImages of `size` bytes, which is sizeof(GpcImages): no image is lent.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_images(images: *mut GpcImages, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(images, size) }
}

impl GpcImageState {
    fn state(&self) -> ImageState {
        ImageState {
            layout: self.layout,
            stage: self.stage,
            access: self.access,
        }
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
    pub(super) fn images(&self) -> Images {
        Images {
            ids: self.ids.lent_if_there(),
            depth: self.depth.lent_if_there(),
            color: self.color.lent(),
            corner: self.corner,
        }
    }
}
