//! Memory of one frame: allocated when the frame is prepared, and used again for every region and every recording.

mod descriptors;
mod record;
mod sample_set;
mod scratch;
mod sizes;

pub use descriptors::IdViews;
pub use sample_set::{Offsets, SampleSet};
pub use scratch::Scratch;
pub use sizes::ResourceSizes;

use super::{Content, Counter};
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{BoundDescriptor, Buffer, Memory, MemoryUse, VulkanError};
use ash::vk;
use std::ops::Deref;
use std::sync::Arc;

/// Memory in which the passes of a frame keep their results: scratch memory, which frames may share, and the frame's
/// own buffers.
pub struct Resources {
    sizes: ResourceSizes,
    /// A word for each [`Counter`].
    pub counters: Buffer,
    sets: Vec<SampleSet>,
    scratch: Arc<Scratch>,
}

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    vk::BufferUsageFlags::STORAGE_BUFFER.as_raw()
        | vk::BufferUsageFlags::TRANSFER_DST.as_raw()
        | vk::BufferUsageFlags::TRANSFER_SRC.as_raw(),
);

impl Deref for Resources {
    type Target = Scratch;

    fn deref(&self) -> &Scratch {
        &self.scratch
    }
}

impl Resources {
    /// Allocates a frame's memory, and descriptor sets for each list of sample offsets; `others` are buffers and images
    /// with other owners, which outlive the resources.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        scene: &dyn Content,
        others: &[BoundDescriptor],
        ids: &IdViews,
        sizes: ResourceSizes,
        offset_lists: &[Offsets<'_>],
    ) -> Result<Self, VulkanError> {
        let scratch = Scratch::new(layout, memory, scene.bin_count(), &sizes)?;
        let scratch = Arc::new(scratch);
        let resources = Self::with_scratch(layout, memory, &scratch, others, sizes, offset_lists)?;
        // SAFETY: the sets are new; the images outlive them.
        unsafe { resources.show_ids(ids) };
        Ok(resources)
    }

    /// Makes a frame's resources in scratch memory that [suffices](Scratch::suffices) for `sizes`. [`Self::show_ids`]
    /// sets the images of the descriptor sets later.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn with_scratch(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        scratch: &Arc<Scratch>,
        others: &[BoundDescriptor],
        sizes: ResourceSizes,
        offset_lists: &[Offsets<'_>],
    ) -> Result<Self, VulkanError> {
        let sets = layout.frame_sets(offset_lists.len())?;
        let mut sets = sets
            .into_iter()
            .zip(offset_lists)
            .map(|(set, offsets)| SampleSet::new(memory, set, offsets))
            .collect::<Result<Vec<_>, VulkanError>>()?;
        let mut resources = Self {
            sizes,
            counters: memory.storage_buffer("counters", Counter::BYTES, STORAGE, MemoryUse::Device)?,
            sets: Vec::new(),
            scratch: scratch.clone(),
        };
        for set in &mut sets {
            resources.write_set(set, others);
        }
        resources.sets = sets;
        Ok(resources)
    }

    /// Scratch memory; `None` if another frame uses it too.
    pub(crate) fn own_scratch(&mut self) -> Option<&mut Scratch> {
        Arc::get_mut(&mut self.scratch)
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
