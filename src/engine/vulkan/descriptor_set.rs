//! Descriptor sets, and lists of the buffers in them.

use super::{Binding, Buffer, Gpu, SetLayout, VulkanError};
use ash::vk;
use std::sync::Arc;

/// View of the texels of a buffer.
#[derive(Clone, Copy, Debug)]
pub struct Texels {
    pub(crate) view: vk::BufferView,
    pub(crate) buffer: vk::Buffer,
}

/// A buffer, the texels of one, or an image, for a descriptor.
#[derive(Clone, Copy, Debug)]
pub enum Descriptor {
    Buffer(vk::DescriptorBufferInfo),
    Texels(Texels),
    Image(vk::DescriptorImageInfo),
}

impl Descriptor {
    /// The buffer; null for an image.
    fn buffer(&self) -> vk::Buffer {
        match self {
            Self::Buffer(info) => info.buffer,
            Self::Texels(texels) => texels.buffer,
            Self::Image(_) => vk::Buffer::null(),
        }
    }
}

impl From<Texels> for Descriptor {
    fn from(texels: Texels) -> Self {
        Self::Texels(texels)
    }
}

impl From<vk::DescriptorBufferInfo> for Descriptor {
    fn from(info: vk::DescriptorBufferInfo) -> Self {
        Self::Buffer(info)
    }
}

impl From<&Buffer> for Descriptor {
    /// The whole buffer.
    fn from(buffer: &Buffer) -> Self {
        Self::Buffer(vk::DescriptorBufferInfo::default().buffer(buffer.raw).range(vk::WHOLE_SIZE))
    }
}

/// Binding with what it shows.
pub type BoundDescriptor = (Binding, Descriptor);

/// Descriptor sets that show the same data to several passes: a set for each layout, with the bindings that passes of
/// this layout use.
///
/// They list which buffers they show, so that a [`Recorder`](super::Recorder) knows what a dispatch reads and writes.
pub(crate) struct DescriptorSets {
    of_frame: bool,
    shown: Arc<ShownSets>,
    pool: Arc<DescriptorPool>,
}

/// Descriptor sets by layout, and the buffers that they show.
#[derive(Clone)]
pub(super) struct ShownSets {
    sets: Vec<(Arc<SetLayout>, vk::DescriptorSet)>,
    /// Buffers by the number of their binding; null for bindings without a buffer.
    buffers: Vec<vk::Buffer>,
}

impl ShownSets {
    /// The set with a layout; `None` if these sets are not for its pass.
    pub fn of(&self, layout: &Arc<SetLayout>) -> Option<vk::DescriptorSet> {
        let mut sets = self.sets.iter();
        let (_, set) = sets.find(|(known, _)| Arc::ptr_eq(known, layout))?;
        Some(*set)
    }

    /// Buffer of a binding, if the binding shows one.
    pub fn buffer(&self, binding: u32) -> Option<vk::Buffer> {
        let buffer = self.buffers.get(binding as usize).copied();
        buffer.filter(|buffer| *buffer != vk::Buffer::null())
    }
}

impl DescriptorSets {
    /// Allocates a set for each of `layouts`, `count` times. The sets are a frame's, or a pass's own besides these, and
    /// show nothing yet.
    ///
    /// # Errors
    /// If the driver refuses them.
    pub fn new(
        gpu: &Arc<Gpu>,
        of_frame: bool,
        layouts: &[Arc<SetLayout>],
        count: usize,
    ) -> Result<Vec<Self>, VulkanError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let pool = Arc::new(DescriptorPool::new(gpu, layouts, count as u32)?);
        let raw_layouts: Vec<_> = layouts.iter().map(|layout| layout.raw).collect();
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool.raw).set_layouts(&raw_layouts);
        let allocate = |_| {
            // SAFETY: the pool and the layouts are alive.
            let sets = unsafe { gpu.device.allocate_descriptor_sets(&info) }
                .map_err(VulkanError::of("vkAllocateDescriptorSets"))?;
            Ok(Self {
                of_frame,
                shown: Arc::new(ShownSets { sets: layouts.iter().cloned().zip(sets).collect(), buffers: Vec::new() }),
                pool: pool.clone(),
            })
        };
        (0..count).map(allocate).collect()
    }

    /// Whether the sets are a frame's, and not a pass's own besides these.
    pub(super) fn are_of_frame(&self) -> bool {
        self.of_frame
    }

    pub(super) fn shown(&self) -> &Arc<ShownSets> {
        &self.shown
    }

    /// The set of the first layout.
    pub fn first(&self) -> vk::DescriptorSet {
        let first = self.shown.sets.first();
        first.map_or(vk::DescriptorSet::null(), |(_, set)| *set)
    }

    /// Writes what bindings show to all sets that have them.
    ///
    /// # Safety
    /// No pending commands use the sets, the descriptor types of the bindings match, and buffers and images outlive the
    /// use of the sets. The caller is responsible for the images' layouts and barriers.
    pub unsafe fn write(&mut self, shown: &[BoundDescriptor]) {
        let writes = shown.iter().flat_map(|(binding, shown)| {
            self.at(*binding).map(move |write| match shown {
                Descriptor::Buffer(info) => write.buffer_info(std::slice::from_ref(info)),
                Descriptor::Texels(texels) => write.texel_buffer_view(std::slice::from_ref(&texels.view)),
                Descriptor::Image(info) => write.image_info(std::slice::from_ref(info)),
            })
        });
        // SAFETY: guaranteed by the caller.
        unsafe { self.update(&writes.collect::<Vec<_>>()) };
        let buffers = &mut Arc::make_mut(&mut self.shown).buffers;
        for (binding, shown) in shown {
            let place = binding.number as usize;
            buffers.resize(buffers.len().max(place + 1), vk::Buffer::null());
            buffers[place] = shown.buffer();
        }
    }

    /// Writes the images of a binding to all sets that have it.
    ///
    /// # Safety
    /// As [`Self::write`].
    pub unsafe fn write_images(&self, binding: Binding, images: &[vk::DescriptorImageInfo]) {
        let writes = self.at(binding).map(|write| write.image_info(images));
        // SAFETY: guaranteed by the caller.
        unsafe { self.update(&writes.collect::<Vec<_>>()) };
    }

    /// A write for each set that has a binding.
    fn at<'a>(&self, binding: Binding) -> impl Iterator<Item = vk::WriteDescriptorSet<'a>> + use<'a, '_> {
        let has = move |(layout, _): &&(Arc<SetLayout>, _)| layout.bindings.contains(&binding);
        self.shown.sets.iter().filter(has).map(move |(_, set)| {
            vk::WriteDescriptorSet::default().dst_set(*set).dst_binding(binding.number).descriptor_type(binding.kind)
        })
    }

    /// # Safety
    /// As [`Self::write`].
    unsafe fn update(&self, writes: &[vk::WriteDescriptorSet<'_>]) {
        // SAFETY: guaranteed by the caller.
        unsafe { self.pool.gpu.device.update_descriptor_sets(writes, &[]) };
    }
}

/// A pool of descriptor sets, which are freed with it.
struct DescriptorPool {
    gpu: Arc<Gpu>,
    raw: vk::DescriptorPool,
}

impl DescriptorPool {
    /// Makes a pool for `count` sets of each layout.
    fn new(gpu: &Arc<Gpu>, layouts: &[Arc<SetLayout>], count: u32) -> Result<Self, VulkanError> {
        let mut sizes: Vec<vk::DescriptorPoolSize> = Vec::new();
        for binding in layouts.iter().flat_map(|layout| &layout.bindings) {
            let descriptors = count * binding.count;
            match sizes.iter_mut().find(|size| size.ty == binding.kind) {
                Some(size) => size.descriptor_count += descriptors,
                None => sizes.push(vk::DescriptorPoolSize { ty: binding.kind, descriptor_count: descriptors }),
            }
        }
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(count * layouts.len() as u32).pool_sizes(&sizes);
        // SAFETY: plain creation on a live device.
        let raw = unsafe { gpu.device.create_descriptor_pool(&info, None) }
            .map_err(VulkanError::of("vkCreateDescriptorPool"))?;
        Ok(Self { gpu: gpu.clone(), raw })
    }
}

impl Drop for DescriptorPool {
    fn drop(&mut self) {
        // SAFETY: owners drop their sets, and with them the pool, after the frames that use them.
        unsafe { self.gpu.device.destroy_descriptor_pool(self.raw, None) };
    }
}

/// Descriptor of an image in the layout `SHADER_READ_ONLY_OPTIMAL`.
pub(crate) fn read_image(view: vk::ImageView) -> vk::DescriptorImageInfo {
    vk::DescriptorImageInfo::default().image_view(view).image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
}
