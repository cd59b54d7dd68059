//! Memory of one frame: allocated when the frame is prepared, and used again for every region and every recording.

mod descriptors;
mod record;
mod sample_set;
mod scratch;
mod sizes;
mod table;

pub use descriptors::{IdViews, ShownIds};
pub use sample_set::{Offsets, SampleSet};
pub use scratch::Scratch;
pub use sizes::ResourceSizes;
pub use table::Data;

use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{BoundDescriptor, Buffer, Descriptor, Image, Memory, VulkanError};
use std::sync::Arc;

/// Memory in which the passes of a frame keep their results: scratch memory, which frames may share, and the frame's
/// own descriptor sets.
pub struct Resources {
    sizes: ResourceSizes,
    sets: Vec<SampleSet>,
    scratch: Arc<Scratch>,
    /// Image that the sets show if no pass reads images of IDs.
    unread: Option<Image>,
}

/// Request for a frame's memory.
#[derive(Clone, Copy)]
pub struct ResourceRequest<'a> {
    /// Sizes of the memory.
    pub sizes: ResourceSizes,
    /// Buffers and images with other owners that the sets show; they outlive the resources.
    pub others: &'a [BoundDescriptor],
    /// Images of IDs and depth.
    pub ids: ShownIds,
    /// Lists of sample offsets, each of which gets descriptor sets.
    pub offsets: &'a [Offsets<'a>],
    /// Scratch memory that suffices for the sizes; `None` to allocate some.
    pub scratch: Option<&'a Arc<Scratch>>,
}

impl Resources {
    /// Allocates a frame's memory and descriptor sets.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub fn new(layout: &FrameLayout, memory: &Memory, request: &ResourceRequest<'_>) -> Result<Self, VulkanError> {
        let ResourceRequest { sizes, others, ids, offsets, scratch } = *request;
        let made = || Ok::<_, VulkanError>(Arc::new(Scratch::new(memory, &sizes)?));
        let scratch = scratch.map_or_else(made, |shared| Ok(shared.clone()))?;
        let sets = layout.frame_sets(offsets.len())?.into_iter().zip(offsets);
        let mut resources = Self {
            sizes,
            sets: sets.map(|(set, offsets)| SampleSet::new(memory, set, offsets)).collect::<Result<_, _>>()?,
            scratch,
            unread: matches!(ids, ShownIds::Unread).then(|| descriptors::unread(memory)).transpose()?,
        };
        resources.write_sets(others);
        // SAFETY: the sets are new; the caller guarantees drawn images, and the unread one lives as long as the resources.
        unsafe {
            match (ids, &resources.unread) {
                (ShownIds::Drawn(views), _) => resources.show_ids(&views),
                (_, Some(unread)) => resources.show_ids(&IdViews::of_ids(unread.view)),
                (_, None) => {}
            }
        }
        Ok(resources)
    }

    /// A buffer of the memory.
    #[must_use]
    pub fn buffer(&self, data: Data) -> &Buffer {
        self.scratch.buffer(data)
    }

    /// The texels of a buffer or, if it has none, the buffer as a whole.
    pub(crate) fn texels(&self, data: Data) -> Descriptor {
        self.scratch.texels(data)
    }

    /// A buffer to be written by the host; `None` if another frame uses it too.
    pub(crate) fn buffer_mut(&mut self, data: Data) -> Option<&mut Buffer> {
        Some(Arc::get_mut(&mut self.scratch)?.buffer_mut(data))
    }

    /// Sizes with which the resources were made.
    #[must_use]
    pub fn sizes(&self) -> &ResourceSizes {
        &self.sizes
    }

    /// Set of the list of sample offsets with the index `index`.
    #[must_use]
    pub fn set(&self, index: usize) -> Option<&SampleSet> {
        self.sets.get(index)
    }
}
