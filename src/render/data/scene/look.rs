//! Materials and lights that change with the moment: the scene's data about them, and a frame's own copies.

use super::light::GpuLight;
use super::material::MaterialRow;
use super::{GpuScene, Slots};
use crate::engine::spirv::frame_set;
use crate::scene::{Moment, Motion};
use crate::vulkan::{BoundDescriptor, Buffer, Descriptor, Memory, MemoryUse, Recorder, TexelBuffer, VulkanError};
use ash::vk;

/// Materials and lights of a scene that change.
pub(super) struct ChangingLook {
    /// For each material that changes: its index, and its texture slots and alpha texture, which stay the same.
    materials: Vec<(usize, MaterialRow)>,
    lights: bool,
}

impl ChangingLook {
    /// Materials and lights that a motion changes; `slots` and `alphas` are those of all materials.
    pub(super) fn new(motion: &Motion, slots: &[Slots], alphas: &[[u32; 4]]) -> Self {
        let row = |&index: &usize| {
            let (slots, alpha) = (slots.get(index)?.clone(), *alphas.get(index)?);
            Some((index, MaterialRow { slots, alpha }))
        };
        Self { materials: motion.materials.iter().filter_map(row).collect(), lights: motion.changes_lights }
    }
}

/// A frame's own copies of the scene's materials and lights, if these change.
#[derive(Default)]
pub struct FrameLook {
    materials: Option<TexelBuffer>,
    lights: Option<Buffer>,
    /// Rows of materials that the next recording writes, each with its first byte in the buffer.
    shown_materials: Vec<(u64, Vec<[u32; 4]>)>,
    /// Lights that the next recording writes; empty if they do not change.
    shown_lights: Vec<GpuLight>,
}

impl FrameLook {
    /// Allocates memory for the materials and lights that change. If nothing changes, the frame uses the scene's
    /// buffers.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(memory: &Memory, scene: &GpuScene) -> Result<Self, VulkanError> {
        let Some(changing) = &scene.changing else {
            return Ok(Self::default());
        };
        let materials = |view: &TexelBuffer| {
            memory.texel_buffer(
                "materials that change",
                view.buffer.size() / 16,
                vk::Format::R32G32B32A32_UINT,
                vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Device,
            )
        };
        let lights = |buffer: &Buffer| {
            memory.storage_buffer(
                "lights that change",
                buffer.size(),
                vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST,
                MemoryUse::Device,
            )
        };
        let has_materials = !changing.materials.is_empty();
        Ok(Self {
            materials: has_materials.then(|| materials(&scene.materials)).transpose()?,
            lights: changing.lights.then(|| lights(&scene.lights)).transpose()?,
            ..Self::default()
        })
    }

    /// Number of bytes for a scene.
    #[must_use]
    pub fn bytes(scene: &GpuScene) -> u64 {
        scene.changing.as_ref().map_or(0, |changing| {
            let materials = !changing.materials.is_empty();
            let of = |buffer: &Buffer, changes| if changes { buffer.size() } else { 0 };
            of(&scene.materials.buffer, materials) + of(&scene.lights, changing.lights)
        })
    }

    /// Bindings that show the materials and lights of the frame, and the environment.
    #[must_use]
    pub fn shown(&self, scene: &GpuScene) -> [BoundDescriptor; 3] {
        let materials = self.materials.as_ref().unwrap_or(&scene.materials);
        let lights = self.lights.as_ref().unwrap_or(&scene.lights);
        let environment = Descriptor::Image(scene.environment.descriptor());
        [
            (frame_set::MATERIALS, materials.texels().into()),
            (frame_set::LIGHTS, lights.into()),
            (frame_set::ENVIRONMENT_MAP, environment),
        ]
    }

    /// Records initial copies of the scene's materials and lights.
    pub(crate) fn record_upload(&self, recorder: &Recorder<'_>, scene: &GpuScene) {
        if let Some(materials) = &self.materials {
            let from = &scene.materials.buffer;
            recorder.copy(from, from.size(), &materials.buffer, 0);
        }
        if let Some(lights) = &self.lights {
            recorder.copy(&scene.lights, scene.lights.size(), lights, 0);
        }
    }

    /// Prepares the updates for a moment, which the next recording writes.
    pub(crate) fn show(&mut self, scene: &GpuScene, moment: &Moment) {
        let Some(changing) = &scene.changing else {
            return;
        };
        let first_byte = |index: usize| 16 * index as u64 * u64::from(scene.material_vectors);
        let changed = changing.materials.iter().zip(&moment.materials);
        self.shown_materials =
            changed.map(|((index, row), (_, material))| (first_byte(*index), row.words(material))).collect();
        if changing.lights {
            let lights = moment.lights.iter();
            self.shown_lights = lights.map(|light| GpuLight::of_scene(light, scene.geometry.origin)).collect();
        }
    }

    /// Records the prepared updates.
    pub(crate) fn record(&self, recorder: &Recorder<'_>) {
        // Updates stay within the buffers: a moment has no more materials and lights than its scene.
        if let Some(materials) = &self.materials {
            for (first_byte, row) in &self.shown_materials {
                recorder.update(&materials.buffer, *first_byte, bytemuck::cast_slice(row));
            }
        }
        if let Some(lights) = self.lights.as_ref().filter(|_| !self.shown_lights.is_empty()) {
            recorder.update(lights, 0, bytemuck::cast_slice(&self.shown_lights));
        }
    }
}
