//! Memory that the frames of one antialiaser share.

use crate::engine::data::{ResourceSizes, Scratch};
use crate::engine::passes::RasterTargets;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Memory, VulkanError};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// What the passes of a frame hand to each other. The commands of frames run one after the other on their queue, and each
/// recording begins with a barrier, so that one piece of it serves all frames in flight.
pub(super) struct FrameScratch {
    pub passes: Arc<Scratch>,
    /// What is drawn for hosts that lend no IDs, and its width and height.
    targets: Option<(RasterTargets, [u32; 2])>,
    memory: Memory,
}

/// What a frame needs of it.
pub(super) struct ScratchRequest {
    pub sizes: ResourceSizes,
    pub bin_count: u32,
    /// Whether IDs and depth are drawn into it.
    pub targets: bool,
    /// Most bytes.
    pub allowed: Option<u64>,
}

/// The memory that frames use now.
#[derive(Default)]
pub(super) struct ScratchPool(Mutex<Vec<Weak<FrameScratch>>>);

impl ScratchPool {
    /// Memory that a frame uses already, if that suffices; otherwise memory of its own, which later ones may use.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn get(
        &self,
        layout: &FrameLayout,
        request: &ScratchRequest,
    ) -> Result<Arc<FrameScratch>, VulkanError> {
        // Under the lock, so that frames that are prepared at once share.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.retain(|scratch| scratch.strong_count() > 0);
        let mut used = known.iter().filter_map(Weak::upgrade);
        if let Some(scratch) = used.find(|scratch| scratch.suffices(request)) {
            return Ok(scratch);
        }
        let made = Arc::new(FrameScratch::new(layout, request)?);
        known.push(Arc::downgrade(&made));
        Ok(made)
    }
}

impl FrameScratch {
    fn new(layout: &FrameLayout, request: &ScratchRequest) -> Result<Self, VulkanError> {
        let memory = Memory::new(layout.gpu.clone(), request.allowed);
        let region = request.sizes.region;
        let targets = || {
            let single = vk::SampleCountFlags::TYPE_1;
            let [width, height] = region;
            let made = RasterTargets::new(&memory, width, height, single, false)?;
            Ok::<_, VulkanError>((made, region))
        };
        Ok(Self {
            passes: Arc::new(Scratch::new(
                layout,
                &memory,
                request.bin_count,
                &request.sizes,
            )?),
            targets: request.targets.then(targets).transpose()?,
            memory,
        })
    }

    fn suffices(&self, request: &ScratchRequest) -> bool {
        let holds = |[width, height]: [u32; 2]| {
            width >= request.sizes.region[0] && height >= request.sizes.region[1]
        };
        let has_targets = self.targets.as_ref().is_some_and(|(_, size)| holds(*size));
        self.passes.suffices(&request.sizes, request.bin_count)
            && (has_targets || !request.targets)
            && request.allowed.is_none_or(|most| self.bytes() <= most)
    }

    /// What IDs and depth are drawn into, where a frame asked for it.
    pub fn targets(&self) -> Option<&RasterTargets> {
        self.targets.as_ref().map(|(targets, _)| targets)
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> u64 {
        self.memory.used()
    }
}
