//! Memory of one frame: allocated when the frame is prepared, and used again for every region and every recording.

mod descriptors;
mod record;
mod sample_set;
mod scratch;
mod sizes;

pub use descriptors::{BoundTexels, IdViews};
pub use sample_set::{Offsets, SampleSet};
pub use scratch::Scratch;
pub use sizes::ResourceSizes;

use super::{Content, Counter};
use crate::engine::pipelines::FrameLayout;
use crate::engine::pipelines::pool::DescriptorPool;
use crate::vulkan::{Buffer, Memory, MemoryUse, VulkanError};
use ash::vk;
use std::ops::Deref;
use std::sync::Arc;

/// Memory in which the passes of a frame keep their results: scratch memory, which frames may share, and the frame's
/// own buffers.
pub struct Resources {
    sizes: ResourceSizes,
    /// A word for each [`Counter`].
    pub counters: Buffer,
    layout: Arc<FrameLayout>,
    _pool: DescriptorPool,
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
    /// Allocates a frame's memory, and a descriptor set for each list of sample offsets. `texels_of_others` and
    /// `lights` are buffers with other owners.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub fn new(
        layout: &Arc<FrameLayout>,
        memory: &Memory,
        scene: &dyn Content,
        (texels_of_others, lights): (&[BoundTexels], &Buffer),
        ids: &IdViews,
        sizes: ResourceSizes,
        offset_lists: &[Offsets<'_>],
    ) -> Result<Self, VulkanError> {
        let scratch = Scratch::new(layout, memory, scene.bin_count(), &sizes)?;
        let others = (texels_of_others, lights);
        let resources = Self::with_scratch(
            layout,
            memory,
            &Arc::new(scratch),
            scene,
            others,
            sizes,
            offset_lists,
        )?;
        for set in &resources.sets {
            // SAFETY: the set is new; its images outlive it.
            unsafe { resources.show_ids(set, ids) };
        }
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
        scene: &dyn Content,
        others: (&[BoundTexels], &Buffer),
        sizes: ResourceSizes,
        offset_lists: &[Offsets<'_>],
    ) -> Result<Self, VulkanError> {
        let pool = layout.pool(offset_lists.len() as u32, 0)?;
        let mut sets = offset_lists
            .iter()
            .map(|offsets| SampleSet::new(layout, memory, &pool, offsets))
            .collect::<Result<Vec<_>, VulkanError>>()?;
        let mut resources = Self {
            sizes,
            counters: memory.storage_buffer(
                "counters",
                Counter::BYTES,
                STORAGE,
                MemoryUse::Device,
            )?,
            layout: layout.clone(),
            _pool: pool,
            sets: Vec::new(),
            scratch: scratch.clone(),
        };
        for set in &mut sets {
            resources.write_set(set, scene, others);
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
