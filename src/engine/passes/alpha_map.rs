//! alpha_map: converts a host's alpha maps to the form that the alpha test reads.

use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, alpha_map_set};
use crate::vulkan::{Buffer, Descriptor, DescriptorSets, Specialized, VulkanError, read_image};
use ash::vk;

/// Level of an alpha map: its size in texels, and its first word in the atlas. Bits 0 and 1 of `repeats` say whether
/// the map repeats along u and v.
pub(crate) use spirv::AlphaMapPush as AlphaLevel;

impl AlphaLevel {
    /// Number of words of the level: (width + 1) x (height + 1). Each word belongs to a corner where 2 x 2 texels meet,
    /// including the corners at the border of the image.
    pub fn words(&self) -> u64 {
        let [width, height] = self.size.map(|side| u64::from(side) + 1);
        width * height
    }
}

/// Makes the kernel that reads a level of a host's image. Each level writes its own words.
///
/// # Errors
/// If the driver refuses it.
pub(crate) fn kernel(layout: &FrameLayout) -> Result<Kernel<spirv::AlphaMap>, VulkanError> {
    layout.kernel(&spirv::AlphaMap)
}

/// Makes a set with a host's image and the atlas.
///
/// # Errors
/// If the driver refuses it.
///
/// # Safety
/// The view outlives the use of the set.
pub(crate) unsafe fn set(
    layout: &FrameLayout,
    view: vk::ImageView,
    atlas: &Buffer,
) -> Result<DescriptorSets, VulkanError> {
    let shown = [(alpha_map_set::MAP, Descriptor::Image(read_image(view))), (alpha_map_set::ATLAS, atlas.into())];
    // SAFETY: the caller guarantees the view, and the atlas lives as long as the frame.
    unsafe { layout.own_set(spirv::AlphaMap::INTERFACE, &shown) }
}
