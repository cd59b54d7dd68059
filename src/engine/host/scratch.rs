//! Scratch memory that the frames of one antialiaser share.

use crate::engine::data::{ResourceSizes, Scratch};
use crate::engine::passes::RasterTargets;
use crate::engine::pipelines::FrameLayout;
use crate::vulkan::{Memory, VulkanError};
use ash::vk;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Scratch memory of a frame's passes. All frames in flight can use the same memory, because their commands run one
/// after the other on one queue, and each recording begins with a barrier.
pub(super) struct FrameScratch {
    pub passes: Arc<Scratch>,
    /// Images of IDs and depth for hosts that lend no IDs, with their width and height.
    targets: Option<(RasterTargets, [u32; 2])>,
    memory: Memory,
}

/// Requirements of a frame for scratch memory.
pub(super) struct ScratchRequest {
    pub sizes: ResourceSizes,
    /// Whether the frame draws IDs and depth.
    pub targets: bool,
    /// Largest number of bytes; `None` for no limit.
    pub allowed: Option<u64>,
}

/// Scratch memory of the frames that exist.
#[derive(Default)]
pub(super) struct ScratchPool(Mutex<Vec<Weak<FrameScratch>>>);

impl ScratchPool {
    /// Returns scratch memory of another frame if it suffices; otherwise allocates memory, which later frames may use.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn get(&self, layout: &FrameLayout, request: &ScratchRequest) -> Result<Arc<FrameScratch>, VulkanError> {
        // The lock is held until the end, so that frames that are prepared at the same time share memory.
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
            passes: Arc::new(Scratch::new(&memory, &request.sizes)?),
            targets: request.targets.then(targets).transpose()?,
            memory,
        })
    }

    fn suffices(&self, request: &ScratchRequest) -> bool {
        let holds = |[width, height]: [u32; 2]| width >= request.sizes.region[0] && height >= request.sizes.region[1];
        let has_targets = self.targets.as_ref().is_some_and(|(_, size)| holds(*size));
        self.passes.suffices(&request.sizes)
            && (has_targets || !request.targets)
            && request.allowed.is_none_or(|most| self.bytes() <= most)
    }

    /// Images into which IDs and depth are drawn, if a frame requested them.
    pub fn targets(&self) -> Option<&RasterTargets> {
        self.targets.as_ref().map(|(targets, _)| targets)
    }

    /// Number of bytes of device memory in use.
    pub fn bytes(&self) -> u64 {
        self.memory.used()
    }
}
