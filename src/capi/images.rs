//! Images that the application lends.

use super::error::Error;
use super::input::{Struct, flag};
use crate::host::{ColorImage, ImageState, Images, LentImage};
use ash::vk;

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

/// What the application has drawn, one sample a pixel, and where its picture goes.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcImages {
    /// sizeof(GpcImages).
    pub size: u32,
    /// The format of color.view: 8, 10, 16 or 32 bits a channel as UNORM, SRGB or SFLOAT, or B10G11R11_UFLOAT.
    pub color_format: vk::Format,
    /// VK_TRUE if the application's shaders write sRGB codes into a format of plain numbers; VK_FALSE if the image holds
    /// linear light, or encodes it itself.
    pub color_encoded: vk::Bool32,
    /// Triangle IDs, VK_FORMAT_R32_UINT, made with VK_IMAGE_USAGE_SAMPLED_BIT: 1 + the index of the nearest triangle in the
    /// order of the frame's draws, 0 where there is none. Where image and view are VK_NULL_HANDLE, here and of depth, the
    /// library draws both for itself.
    pub ids: GpcImage,
    /// Depth of the nearest triangle, of any depth format, made with VK_IMAGE_USAGE_SAMPLED_BIT; the view shows depth alone.
    /// Without GpcOptions.thin, image and view may be VK_NULL_HANDLE.
    pub depth: GpcImage,
    /// Colours, made with VK_IMAGE_USAGE_SAMPLED_BIT and VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT.
    pub color: GpcImage,
    /// Upper left corner of the part of these images that the frame is of, in pixels. The part has the size in GpcOptions; the
    /// library neither reads nor writes what lies around it.
    pub corner: [u32; 2],
}

// SAFETY: `repr(C)`, its size first; integers and raw handles may have any bytes.
unsafe impl Struct for GpcImages {
    const NAME: &'static str = "GpcImages";
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
    pub(super) fn images(&self) -> Result<Images, Error> {
        Ok(Images {
            ids: self.ids.lent_if_there(),
            depth: self.depth.lent_if_there(),
            color: ColorImage {
                lent: self.color.lent(),
                format: self.color_format,
                encoded: flag("GpcImages.color_encoded", self.color_encoded)?,
            },
            corner: self.corner,
        })
    }
}
