//! Descriptor sets, and records of the buffers in them.

use super::{Binding, Buffer, Gpu};
use ash::vk;
use std::sync::Arc;

/// View of the texels of a buffer.
#[derive(Clone, Copy, Debug)]
pub struct Texels {
    pub(crate) view: vk::BufferView,
    pub(crate) buffer: vk::Buffer,
}

/// A buffer, or the texels of one, for a descriptor.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shown {
    Buffer(vk::DescriptorBufferInfo),
    Texels(Texels),
}

impl Shown {
    fn buffer(&self) -> vk::Buffer {
        match self {
            Self::Buffer(info) => info.buffer,
            Self::Texels(texels) => texels.buffer,
        }
    }
}

impl From<Texels> for Shown {
    fn from(texels: Texels) -> Self {
        Self::Texels(texels)
    }
}

impl From<vk::DescriptorBufferInfo> for Shown {
    fn from(info: vk::DescriptorBufferInfo) -> Self {
        Self::Buffer(info)
    }
}

impl From<&Buffer> for Shown {
    /// The whole buffer.
    fn from(buffer: &Buffer) -> Self {
        Self::Buffer(
            vk::DescriptorBufferInfo::default()
                .buffer(buffer.raw)
                .range(vk::WHOLE_SIZE),
        )
    }
}

/// Binding with the buffer or texels that it shows.
pub(crate) type ShownBinding = (Binding, Shown);

/// Descriptor set that records which buffers it shows, so that a [`Recorder`](super::Recorder) knows what a dispatch
/// reads and writes.
pub(crate) struct DescriptorSet {
    gpu: Arc<Gpu>,
    pub(crate) raw: vk::DescriptorSet,
    buffers: ShownBuffers,
}

/// Buffers of a set by binding number; null for bindings without a buffer.
#[derive(Clone, Default)]
pub(super) struct ShownBuffers(Arc<Vec<vk::Buffer>>);

impl ShownBuffers {
    /// Buffer of a binding, if the binding shows one.
    pub fn get(&self, binding: u32) -> Option<vk::Buffer> {
        let buffer = self.0.get(binding as usize).copied();
        buffer.filter(|buffer| *buffer != vk::Buffer::null())
    }
}

impl DescriptorSet {
    /// Wraps a set that was just allocated and shows nothing.
    pub(crate) fn new(gpu: &Arc<Gpu>, raw: vk::DescriptorSet) -> Self {
        Self {
            gpu: gpu.clone(),
            raw,
            buffers: ShownBuffers::default(),
        }
    }

    pub(super) fn buffers(&self) -> &ShownBuffers {
        &self.buffers
    }

    /// Writes buffers to the set.
    ///
    /// # Safety
    /// No pending commands use the set, the descriptor types of the bindings match, and the buffers outlive the use of
    /// the set.
    pub unsafe fn write(&mut self, shown: &[ShownBinding]) {
        let writes: Vec<_> = shown
            .iter()
            .map(|(binding, shown)| match shown {
                Shown::Buffer(info) => self.at(binding).buffer_info(std::slice::from_ref(info)),
                Shown::Texels(texels) => self
                    .at(binding)
                    .texel_buffer_view(std::slice::from_ref(&texels.view)),
            })
            .collect();
        // SAFETY: guaranteed by the caller.
        unsafe { self.gpu.device.update_descriptor_sets(&writes, &[]) };
        let buffers = Arc::make_mut(&mut self.buffers.0);
        for (binding, shown) in shown {
            let place = binding.number as usize;
            buffers.resize(buffers.len().max(place + 1), vk::Buffer::null());
            buffers[place] = shown.buffer();
        }
    }

    /// Writes the images of a binding to the set. The caller is responsible for the images' layouts and barriers.
    ///
    /// # Safety
    /// No pending commands use the set, the descriptor type of the binding matches, and the images outlive the use of
    /// the set.
    pub unsafe fn write_images(&self, binding: Binding, images: &[vk::DescriptorImageInfo]) {
        let writes = [self.at(&binding).image_info(images)];
        // SAFETY: guaranteed by the caller.
        unsafe { self.gpu.device.update_descriptor_sets(&writes, &[]) };
    }

    fn at(&self, binding: &Binding) -> vk::WriteDescriptorSet<'static> {
        vk::WriteDescriptorSet::default()
            .dst_set(self.raw)
            .dst_binding(binding.number)
            .descriptor_type(binding.kind)
    }
}

/// Descriptor of an image in the layout `SHADER_READ_ONLY_OPTIMAL`.
pub(crate) fn read_image(view: vk::ImageView) -> vk::DescriptorImageInfo {
    vk::DescriptorImageInfo::default()
        .image_view(view)
        .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL)
}
