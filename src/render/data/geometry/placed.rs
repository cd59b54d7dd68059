//! Instances as a camera sees them.

use super::GpuGeometry;
use crate::engine::passes::RasterPush;
use crate::vulkan::{Memory, MemoryUse, TexelBuffer, VulkanError};
use ash::vk;
use glam::{DAffine3, DMat4, DVec3, DVec4};

/// Number of vectors of an instance, as in `shaders/include/triangle.glsl`.
const VECTORS: usize = 8;

/// Instances as a frame's camera sees them; the host writes them before each recording.
pub(in crate::render) struct PlacedInstances {
    /// For each instance: its words, the four columns of its matrix to clip space, and three rows of its matrix to the
    /// scene's coordinates. Empty without instances.
    pub(in crate::render) buffer: TexelBuffer,
    draws: Vec<RasterPush>,
    hidden: Vec<bool>,
}

impl PlacedInstances {
    /// Allocates memory for the instances of a geometry.
    pub(in crate::render) fn new(memory: &Memory, geometry: &GpuGeometry) -> Result<Self, VulkanError> {
        let instances = Self::count(geometry);
        let mut placed = Self {
            buffer: memory.texel_buffer(
                "instances",
                (instances * VECTORS) as u64,
                vk::Format::R32G32B32A32_UINT,
                vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER,
                MemoryUse::Upload,
            )?,
            draws: vec![RasterPush::default(); geometry.places.len()],
            hidden: vec![false; geometry.places.len()],
        };
        if placed.vectors(instances).len() < instances {
            return Err(VulkanError::Call { call: "mapping instances", result: vk::Result::ERROR_MEMORY_MAP_FAILED });
        }
        Ok(placed)
    }

    /// Bytes of device memory for the instances of a geometry.
    pub(in crate::render) fn bytes(geometry: &GpuGeometry) -> u64 {
        (Self::count(geometry) * VECTORS * 16) as u64
    }

    fn count(geometry: &GpuGeometry) -> usize {
        if geometry.is_instanced { geometry.places.len() } else { 0 }
    }

    /// Writes the instances for a camera; `to_clip` is the matrix from the scene's coordinates to pixel-scaled clip
    /// space. The device must have finished the previous recording. Products are computed in 64 bits and rounded once.
    /// If `image` is the size of an image in pixels, places outside of that image are not drawn.
    pub(in crate::render) fn write(&mut self, geometry: &GpuGeometry, to_clip: &DMat4, image: Option<[u32; 2]>) {
        let draws = self.draws.iter_mut().zip(&mut self.hidden);
        for ((draw, hidden), place) in draws.zip(&geometry.places) {
            let matrix = *to_clip * DMat4::from(place.transform);
            *draw = RasterPush { matrix: matrix.as_mat4().to_cols_array(), instance: place.words };
            *hidden = geometry.is_instanced && image.is_some_and(|image| is_outside(&matrix, place.bounds, image));
        }
        if !geometry.is_instanced {
            return;
        }
        let draws = std::mem::take(&mut self.draws);
        let mapped = self.vectors(draws.len()).iter_mut();
        for (vectors, (draw, place)) in mapped.zip(draws.iter().zip(&geometry.places)) {
            let [x, y, z] = rows(&place.transform);
            let columns: [[u32; 4]; 4] = bytemuck::cast(draw.matrix);
            let [a, b, c, d] = columns;
            *vectors = [draw.instance, a, b, c, d, x, y, z];
        }
        self.draws = draws;
    }

    /// Mapped vectors of `instances` instances; empty if the driver did not map the memory.
    fn vectors(&mut self, instances: usize) -> &mut [[[u32; 4]; VECTORS]] {
        let mapped = self.buffer.buffer.bytes_mut();
        mapped
            .get_mut(..instances * VECTORS * 16)
            .and_then(|bytes| bytemuck::try_cast_slice_mut(bytes).ok())
            .unwrap_or(&mut [])
    }

    /// Push constants of the vertex shader for a place; `None` if the place is not visible.
    pub(in crate::render) fn draw(&self, place: u32) -> Option<&RasterPush> {
        let is_hidden = self.hidden.get(place as usize).copied()?;
        self.draws.get(place as usize).filter(|_| !is_hidden)
    }
}

/// Whether a box lies entirely outside of one border of an image, in front of its near plane or beyond its far plane.
/// These are half-space tests, which also hold for points behind the eye.
fn is_outside(matrix: &DMat4, [low, high]: [DVec3; 2], image: [u32; 2]) -> bool {
    /// Margin in pixels beyond the border, larger than the distance of any sample of a border pixel.
    const MARGIN: f64 = 2.0;
    let half = image.map(|pixels| 0.5 * f64::from(pixels) + MARGIN);
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| {
        let high_on = |axis: u32| corner >> axis & 1 == 1;
        let at = DVec3::select(glam::BVec3::new(high_on(0), high_on(1), high_on(2)), high, low);
        *matrix * at.extend(1.0)
    });
    let all = |outside: &dyn Fn(&DVec4) -> bool| corners.iter().all(outside);
    all(&|c| c.x < -half[0] * c.w)
        || all(&|c| c.x > half[0] * c.w)
        || all(&|c| c.y < -half[1] * c.w)
        || all(&|c| c.y > half[1] * c.w)
        || all(&|c| c.z > c.w)
        || all(&|c| c.z < 0.0)
}

/// Rows of the transform to the scene's coordinates, as bits of floats.
fn rows(place: &DAffine3) -> [[u32; 4]; 3] {
    let linear = place.matrix3.transpose();
    let row = |axis: glam::DVec3, offset: f64| [axis.x, axis.y, axis.z, offset].map(|value| (value as f32).to_bits());
    let offset = place.translation;
    [row(linear.x_axis, offset.x), row(linear.y_axis, offset.y), row(linear.z_axis, offset.z)]
}
