//! prefilter: the light that surfaces of each roughness reflect from an environment, seen along their normals, so that
//! shading needs one look-up in a cube.
//!
//! Each texel is a sum over directions of the GGX distribution. Each direction reads the level whose texels are as
//! large as the solid angle that it stands for, so that small bright lights neither flicker nor sparkle (Křivánek and
//! Colbert, "Real-time Shading with Filtered Importance Sampling", 2008).
//!
//! It is no [`Pass`](crate::engine::pipelines::Pass), because each of its dispatches has another number of texels.

use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv::{self, prefilter_set};
use crate::vulkan::{Buffer, DescriptorSets, Memory, Recorder, Specialized, VulkanError};
use ash::vk;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Number of levels of the cube, for roughnesses from 0 to 1.
const LEVELS: u32 = 6;
/// Number of directions of the first filtered level; each further level has twice as many. Directions into the surface
/// are left out. Rough levels are small. They need many directions, so that the averages that are read do not blur them
/// further.
const DIRECTIONS: u32 = 64;

/// Filters an environment.
pub struct Prefilter {
    kernel: Kernel<spirv::Prefilter>,
    own: DescriptorSets,
    texels: Buffer,
    _rays: Buffer,
    cubes: Vec<spirv::PrefilterPush>,
}

/// Levels of an environment whose finest cube has faces of `side` texels, a power of two: for each level its side in
/// texels and the index of its first texel. Level 0 is the finest cube itself. The others are stored after all
/// averages, which halve the cube down to one texel a face.
pub fn levels(side: u32) -> impl Iterator<Item = (u32, u32)> {
    // The number of texels of all averages: six times the squares of the sides down to 1.
    let mut first = 8 * side * side - 2;
    let filtered = (1..LEVELS.min(side.ilog2() + 1)).map(move |level| {
        let own = first;
        first += 6 * (side >> level).pow(2);
        (side >> level, own)
    });
    std::iter::once((side, 0)).chain(filtered)
}

impl Prefilter {
    /// Makes the pipeline. `texels` is a storage buffer with texels of four half floats: the finest cube, its averages
    /// down to a texel a face, and room for the [`levels`] after them, to the end of the last.
    ///
    /// # Errors
    /// If the driver refuses it, or memory runs out.
    pub fn new(layout: &FrameLayout, memory: &Memory, texels: Buffer, side: u32) -> Result<Self, VulkanError> {
        let mut rays = Vec::new();
        let mut cubes = Vec::new();
        let steps = levels(side).count() as u32 - 1;
        for (level, (own, first)) in (0..).zip(levels(side)).skip(1) {
            let first_ray = rays.len() as u32;
            rays.extend(lobe(level, steps, side));
            cubes.push(spirv::PrefilterPush {
                finest: side,
                side: own,
                first,
                first_ray,
                ray_count: rays.len() as u32 - first_ray,
            });
        }
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let rays = memory.filled("prefilter rays", bytemuck::cast_slice(&rays), usage)?;
        let shown = [(prefilter_set::TEXELS, (&texels).into()), (prefilter_set::RAYS, (&rays).into())];
        Ok(Self {
            kernel: layout.kernel(&spirv::Prefilter)?,
            // SAFETY: both buffers live as long as the set.
            own: unsafe { layout.own_set(spirv::Prefilter::INTERFACE, &shown) }?,
            texels,
            _rays: rays,
            cubes,
        })
    }

    /// Texels of the averages and the levels.
    #[must_use]
    pub fn texels(&self) -> &Buffer {
        &self.texels
    }

    /// Records the pass; the averages were written before.
    pub fn record(&self, recorder: &Recorder<'_>) {
        recorder.show(&self.own);
        // Each cube writes its own texels, and none reads another's.
        recorder.unordered(|| {
            for cube in &self.cubes {
                let texels = 6 * cube.side * cube.side;
                self.kernel.record(recorder, cube, texels);
            }
        });
    }
}

/// Directions from which a surface with the roughness of level `level` of `steps` reflects light along its normal, +z.
/// Each direction has the same probability under the GGX distribution. The fourth component is the index of an average:
/// the one whose texels are as large as the solid angle for which the direction stands. The finest cube has `side`
/// texels along a face.
#[must_use]
pub fn lobe(level: u32, steps: u32, side: u32) -> Vec<[f32; 4]> {
    let texel = 4.0 * PI / (6.0 * f64::from(side * side));
    let square = (f64::from(level) / f64::from(steps)).powi(4);
    let count = DIRECTIONS << (level - 1);
    let rays = (0..count).filter_map(|i| {
        let u = (f64::from(i) + 0.5) / f64::from(count);
        let (sin_turn, cos_turn) = (TAU * f64::from(i.reverse_bits()) / 2.0_f64.powi(32)).sin_cos();
        let n_h = ((1.0 - u) / (1.0 + (square - 1.0) * u)).sqrt();
        let across = (1.0 - n_h * n_h).sqrt();
        let half = DVec3::new(across * cos_turn, across * sin_turn, n_h);
        let ray = 2.0 * n_h * half - DVec3::Z;
        let bottom = n_h * n_h * (square - 1.0) + 1.0;
        let density = square / (PI * bottom * bottom) / 4.0;
        let stands_for = 1.0 / (f64::from(count) * density);
        // The average is one level coarser than the solid angle alone needs, because directions are not evenly spaced.
        let wide = (0.5 * (stands_for / texel).log2() + 1.0).round();
        let coarsest = f64::from(side.ilog2());
        let vector = ray.extend(wide.clamp(0.0, coarsest)).as_vec4();
        (ray.z > 0.0).then_some(vector.to_array())
    });
    rays.collect()
}
