//! indirect: places the draws of a list that the host's device wrote. It is no [`Pass`](crate::engine::pipelines::Pass), because a
//! list's part of the frame's triangles is known only when the frame is recorded.

use crate::engine::data::Draws;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, indirect_set};
use crate::vulkan::{Buffer, Descriptor, DescriptorSets, Memory, MemoryUse, Recorder, Specialized, VulkanError};
use ash::vk;

/// Steps of the shader, in their order.
const STEPS: [u32; 4] = [spirv::INDIRECT_COMMANDS, spirv::INDIRECT_BLOCKS, spirv::INDIRECT_SUMS, spirv::INDIRECT_PLACE];

/// Places the draws of lists.
pub(crate) struct Indirect {
    steps: [Kernel<spirv::Indirect>; 4],
}

/// Capacities of a list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IndirectSizes {
    pub commands: u32,
    pub draws: u32,
}

/// A host's buffers of a list: the commands, their number if the device knows it, and the instances.
pub(crate) struct DrawBuffers {
    pub commands: vk::DescriptorBufferInfo,
    pub count: Option<vk::DescriptorBufferInfo>,
    pub instances: vk::DescriptorBufferInfo,
}

/// A list with the memory that placing its draws takes.
pub(crate) struct BoundDraws {
    set: DescriptorSets,
    sizes: IndirectSizes,
    _first_draws: Buffer,
    _blocks: Buffer,
}

impl BoundDraws {
    /// Makes a set with the list's buffers, and with `draws` and `totals`, which are written.
    ///
    /// # Errors
    /// If memory runs out, or the driver refuses the set.
    ///
    /// # Safety
    /// The host's buffers, `draws` and `totals` outlive the returned value.
    pub unsafe fn new(
        layout: &FrameLayout,
        memory: &Memory,
        sizes: IndirectSizes,
        lent: DrawBuffers,
        draws: &Draws,
        totals: &Buffer,
    ) -> Result<Self, VulkanError> {
        let scratch =
            |name, bytes| memory.storage_buffer(name, bytes, vk::BufferUsageFlags::STORAGE_BUFFER, MemoryUse::Device);
        let first_draws = scratch("first draws of commands", 4 * u64::from(sizes.commands))?;
        let blocks = u64::from(sizes.draws / spirv::INDIRECT_BLOCK) + 1;
        let blocks = scratch("blocks of indirect draws", 8 * blocks)?;
        let buffers: [(_, Descriptor); 8] = [
            (indirect_set::COMMANDS, lent.commands.into()),
            (indirect_set::COUNT, lent.count.unwrap_or(lent.commands).into()),
            (indirect_set::INSTANCES, lent.instances.into()),
            (indirect_set::DRAWS_OUT, (&draws.table).into()),
            // Without matrices, the shader does not write this binding.
            (indirect_set::MATRICES_OUT, draws.matrices.as_ref().unwrap_or(&draws.table).into()),
            (indirect_set::FIRST_DRAWS, (&first_draws).into()),
            (indirect_set::BLOCKS, (&blocks).into()),
            (indirect_set::TOTALS, totals.into()),
        ];
        // SAFETY: the caller guarantees the buffers that are not kept here.
        let set = unsafe { layout.own_set(spirv::Indirect::INTERFACE, &buffers) }?;
        Ok(Self { set, sizes, _first_draws: first_draws, _blocks: blocks })
    }
}

impl Indirect {
    /// Makes the kernels.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        let [commands, blocks, sums, place] = STEPS.map(|step| layout.kernel(&spirv::Indirect { step }));
        Ok(Self { steps: [commands?, blocks?, sums?, place?] })
    }

    /// Records the steps for a list.
    pub fn record(&self, recorder: &Recorder<'_>, list: &BoundDraws, push: &spirv::IndirectPush) {
        let [commands, blocks, sums, place] = &self.steps;
        // One draw more than there is room for ends the list's part.
        let draws = u64::from(list.sizes.draws) + 1;
        recorder.pass(spirv::Indirect::INTERFACE, || {
            recorder.show(&list.set);
            commands.record(recorder, push, 1_u64);
            blocks.record(recorder, push, draws);
            sums.record(recorder, push, 1_u64);
            place.record(recorder, push, draws);
        });
    }
}
