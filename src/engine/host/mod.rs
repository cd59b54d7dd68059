//! Antialiasing of an application's own frames: its geometry, its images, its materials.
//!
//! The application draws its frame as usual, with an additional attachment of triangle IDs, or leaves some or all of
//! the drawing to the library. [`Frame::record`] then finds the pixels that alias, and samples the application's triangles
//! there. The application shades the visibility samples ([`ShadeSamples`]). Finally, the resolved pixels are drawn over
//! those that alias.
//!
//! The passes `transform` and `adopt` convert the application's triangles, and `take` reads its colours. From `detect` on, the passes
//! are those of any frame. In each round, the pipelines of the application's materials shade what `sample` found, and `patch` draws
//! the colours into the application's image. `docs/architecture.md` lists the passes.
//!
//! [`List`] samples locations instead of pixels. The application lends the locations, which may lie anywhere on the
//! image plane, in a buffer. `distribute` sorts them into tiles, and the rounds are the same.
//!
//! This module knows no material, light or file. `docs/embedding.md` is the manual.

mod adoption;
mod alignment;
mod alpha;
mod base;
mod content;
mod draw;
mod error;
mod frame;
mod geometry;
mod growth;
mod images;
mod indirect;
mod lending;
mod list;
mod member;
mod mesh;
mod options;
mod sampling;
mod scratch;
mod shader;
mod shading;
mod topology;
mod uniform;
mod vertex_format;
mod viewport;

pub use crate::engine::sampler::{EngineError, ImageState, PassTime, Statistics, TriangleCounts};
pub use alpha::AlphaMap;
pub use draw::Draw;
#[cfg(feature = "capi")]
pub(crate) use error::Dialect;
pub use error::{HostError, Place};
pub use frame::{Frame, Outcome, Scenery};
pub use geometry::{ClipSpace, Geometry, PositionSpace};
pub use images::{ImageKinds, Images, LentImage};
pub use indirect::{IndirectCounts, IndirectDraws, Instance};
pub use list::{List, ListOutcome, Location, LocationList};
pub use member::Member;
pub use mesh::{Coordinates, Indices, Mesh};
pub use options::{ListOptions, Options};
pub use shader::{ShaderError, check_shader};
pub use shading::{SHADER_INCLUDES, ShadeSamples, VisibilitySamples};
pub use topology::Topology;
pub use vertex_format::VertexFormat;
pub use viewport::Viewport;

use crate::engine::data::visibility_layout;
use crate::engine::pipelines::FrameLayout;
use crate::engine::sampler::Capacity;
use crate::vulkan::{Gpu, Host, SetLayout, VulkanError};
use ash::vk;
use scratch::ScratchPool;
use std::sync::Arc;

/// Shared state of frames that are executed on one queue: layouts, a cache of pipelines, and scratch memory for passes.
/// An application with several queues needs an `Antialiaser` for each.
pub struct Antialiaser {
    shared: Arc<Shared>,
}

pub(crate) struct Shared {
    gpu: Arc<Gpu>,
    frame: Arc<FrameLayout>,
    visibility: Arc<SetLayout>,
    scratch: ScratchPool,
}

impl Antialiaser {
    /// Makes an antialiaser on a host's device. [`crate::vulkan::Requirements`] lists what the device must support.
    ///
    /// # Errors
    /// [`VulkanError::Missing`] lists everything that the device lacks.
    ///
    /// # Safety
    /// - The host's handles are alive, belong together, and outlive the antialiaser and everything that it prepares.
    /// - The device was created with [`crate::vulkan::Requirements::features13`] enabled.
    pub unsafe fn new(host: Host) -> Result<Self, VulkanError> {
        // SAFETY: passed on to the caller.
        Self::in_gpu(unsafe { Gpu::new(host) }?)
    }

    /// Makes an antialiaser on a device that another part of the library uses.
    ///
    /// # Errors
    /// If the driver refuses the layouts.
    pub fn in_gpu(gpu: Arc<Gpu>) -> Result<Self, VulkanError> {
        Ok(Self {
            shared: Arc::new(Shared {
                frame: FrameLayout::new(&gpu)?,
                visibility: visibility_layout(&gpu)?,
                scratch: ScratchPool::default(),
                gpu,
            }),
        })
    }

    /// Device of the antialiaser.
    #[must_use]
    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.shared.gpu
    }

    /// Layout of the descriptor set from which shaders read visibility samples, for the host's own pipeline layouts.
    /// The layout lives as long as the antialiaser and all frames.
    #[must_use]
    pub fn samples_layout(&self) -> vk::DescriptorSetLayout {
        self.shared.visibility.raw
    }

    /// Makes the pipelines and memory of a frame. An application has one for each frame in flight, whatever the number
    /// of its swapchain's images, and makes new ones if a buffer changes. Frames share the memory that passes hand to
    /// each other if its size suffices for several, so that many frames take no more of it than one.
    ///
    /// # Errors
    /// [`HostError`] names the invalid argument or the missing resource. No object is left behind.
    ///
    /// # Safety
    /// - The buffers and alpha maps are alive, belong to the device, have the sizes and usage flags that [`Geometry`]
    ///   names, and outlive the frame.
    /// - All recordings of this antialiaser's frames are executed on one queue.
    pub unsafe fn prepare(
        &self,
        geometry: &Geometry,
        images: &ImageKinds,
        options: &Options,
    ) -> Result<Frame, HostError> {
        // SAFETY: passed on to the caller.
        unsafe { Frame::new(&self.shared, geometry, images, options, Capacity::default()) }
    }

    /// Makes the pipelines and memory to sample a list of locations, for one frame in flight. With one sample, each
    /// location is sampled at its own position; with more, as a superpixel around it.
    ///
    /// # Errors
    /// [`HostError`] names the invalid argument or the missing resource. No object is left behind.
    ///
    /// # Safety
    /// - The buffers are alive, belong to the device, have the sizes and usage flags that [`Geometry`] and
    ///   [`LocationList`] name, and outlive the list.
    pub unsafe fn prepare_list(
        &self,
        geometry: &Geometry,
        list: &LocationList,
        options: &ListOptions,
    ) -> Result<List, HostError> {
        // SAFETY: passed on to the caller.
        unsafe { List::new(&self.shared, geometry, list, options, Capacity::default()) }
    }
}
