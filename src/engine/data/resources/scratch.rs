//! Scratch memory: in each recording, passes write it before others read it.

use super::ResourceSizes;
use super::table::{Data, Element, Row};
use crate::vulkan::{BoundDescriptor, Buffer, Descriptor, Memory, TexelBuffer, VulkanError};
use ash::vk;

/// Buffers with the results that passes read from earlier passes. Frames whose commands run one after the other may
/// share them.
pub struct Scratch {
    sizes: ResourceSizes,
    /// A buffer for each [`Data`].
    buffers: Vec<Stored>,
}

/// A buffer, with a view of its texels if it has some.
enum Stored {
    Plain(Buffer),
    Texels(TexelBuffer),
}

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    vk::BufferUsageFlags::STORAGE_BUFFER.as_raw()
        | vk::BufferUsageFlags::TRANSFER_DST.as_raw()
        | vk::BufferUsageFlags::TRANSFER_SRC.as_raw(),
);

impl Stored {
    fn new(memory: &Memory, row: &Row) -> Result<Self, VulkanError> {
        row.check(memory.gpu().limits())?;
        let usage = STORAGE | row.usage;
        Ok(match row.element {
            Element::Bytes(_) => Self::Plain(memory.buffer(row.name, row.bytes(), usage, row.memory)?),
            Element::Texel(format, _) => {
                let usage = usage | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER;
                Self::Texels(memory.texel_buffer(row.name, row.count, format, usage, row.memory)?)
            }
        })
    }

    fn buffer(&self) -> &Buffer {
        match self {
            Self::Plain(buffer) | Self::Texels(TexelBuffer { buffer, .. }) => buffer,
        }
    }

    fn buffer_mut(&mut self) -> &mut Buffer {
        match self {
            Self::Plain(buffer) | Self::Texels(TexelBuffer { buffer, .. }) => buffer,
        }
    }

    /// The texels or, without a view of these, the whole buffer.
    fn texels(&self) -> Descriptor {
        match self {
            Self::Plain(buffer) => buffer.into(),
            Self::Texels(texels) => texels.texels().into(),
        }
    }
}

impl Scratch {
    /// Allocates memory of these sizes.
    ///
    /// # Errors
    /// If memory runs out or a buffer exceeds a limit of the device.
    pub(crate) fn new(memory: &Memory, sizes: &ResourceSizes) -> Result<Self, VulkanError> {
        let stored = |data: Data| Stored::new(memory, &data.row(sizes));
        Ok(Self { sizes: *sizes, buffers: Data::ALL.into_iter().map(stored).collect::<Result<_, _>>()? })
    }

    /// Whether the memory has room for a frame of pixels with these sizes. Always false for lists of locations, which share
    /// no memory.
    pub(crate) fn suffices(&self, sizes: &ResourceSizes) -> bool {
        self.sizes.suffice(sizes)
    }

    pub(super) fn buffer(&self, data: Data) -> &Buffer {
        self.buffers[data as usize].buffer()
    }

    pub(super) fn buffer_mut(&mut self, data: Data) -> &mut Buffer {
        self.buffers[data as usize].buffer_mut()
    }

    pub(super) fn texels(&self, data: Data) -> Descriptor {
        self.buffers[data as usize].texels()
    }

    /// What the frame's sets show of the buffers.
    pub(super) fn shown(&self) -> impl Iterator<Item = BoundDescriptor> {
        Data::ALL.into_iter().flat_map(|data| {
            let [texels, whole] = data.row(&self.sizes).bindings;
            let texels = texels.map(|binding| (binding, self.texels(data)));
            let whole = whole.map(|binding| (binding, self.buffer(data).into()));
            texels.into_iter().chain(whole)
        })
    }
}
