//! prefilter: what surfaces of each roughness reflect of an environment, seen along their normals, so that shading reads one
//! place of a cube: sums over directions of GGX, each of which reads the level whose texels are as large as what it stands
//! for, so that small bright lights neither flicker nor sparkle (Křivánek and Colbert, "Real-time Shading with Filtered
//! Importance Sampling", 2008).

use crate::passes::own_layout::{OwnSet, PipelineLayout, SetLayout, whole};
use crate::passes::spirv::{self, prefilter_set};
use crate::vulkan::{
    Buffer, Compiled, Memory, Pipeline, Recorder, Specialized, VulkanError, compute_pipeline,
};
use ash::vk;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Roughnesses from 0 to 1, where the cube has as many levels.
const LEVELS: u32 = 6;
/// Directions of the first level that is filtered, twice as many of the next and so on; those that point into the surface are
/// left out. So rough levels, which are small, are not blurred by what they read.
const DIRECTIONS: u32 = 64;

/// Filters one environment.
pub struct Prefilter {
    layout: PipelineLayout,
    _set_layout: SetLayout,
    pipeline: Pipeline,
    set: OwnSet,
    texels: Buffer,
    _rays: Buffer,
    cubes: Vec<spirv::PrefilterPush>,
}

/// The levels of an environment whose finest cube has faces of `side` texels, a power of two: texels along the side of each,
/// and the first of its texels. The first is the finest cube itself; the others come after all averages, which are as many
/// cubes as can be halved.
pub fn levels(side: u32) -> impl Iterator<Item = (u32, u32)> {
    // Six times the squares of the sides down to 1.
    let mut first = 8 * side * side - 2;
    let filtered = (1..LEVELS.min(side.ilog2() + 1)).map(move |level| {
        let own = first;
        first += 6 * (side >> level).pow(2);
        (side >> level, own)
    });
    std::iter::once((side, 0)).chain(filtered)
}

impl Prefilter {
    /// Makes the pipeline, for texels of four half floats: the finest cube and ever coarser averages of it down to a texel a
    /// face, and room for the [`levels`] after them, `texels` being a storage buffer of as many as these end with.
    ///
    /// # Errors
    /// If the driver refuses it, or memory runs out.
    pub fn new(memory: &Memory, texels: Buffer, side: u32) -> Result<Self, VulkanError> {
        let gpu = memory.gpu();
        let set_layout = SetLayout::new(gpu, &prefilter_set::ALL)?;
        let layout = PipelineLayout::new(
            gpu,
            &[set_layout.raw],
            spirv::Prefilter::INTERFACE.push_bytes,
        )?;
        let (code, constants) = (spirv::Prefilter::code(), spirv::Prefilter.constants());
        let pipeline = compute_pipeline(gpu, layout.raw, code, &constants, None)?
            .of(spirv::Prefilter::INTERFACE);
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
        let set = set_layout.allocate()?;
        let shown = [
            (prefilter_set::TEXELS, whole(&texels)),
            (prefilter_set::RAYS, whole(&rays)),
        ];
        // SAFETY: the set is new, and both buffers go with it.
        unsafe { set.write_buffers(&shown) };
        Ok(Self {
            layout,
            _set_layout: set_layout,
            pipeline,
            set,
            texels,
            _rays: rays,
            cubes,
        })
    }

    /// The averages and the levels.
    #[must_use]
    pub fn texels(&self) -> &Buffer {
        &self.texels
    }

    /// Records it; the averages have been written before.
    pub fn record(&self, recorder: &Recorder<'_>) {
        for cube in &self.cubes {
            self.layout.bind(recorder, &[self.set.raw], cube);
            let groups = (6 * cube.side * cube.side).div_ceil(64);
            // Cubes have texels of their own, and none is read.
            recorder.dispatch_unordered(&self.pipeline, u64::from(groups));
        }
        recorder.barrier();
    }
}

/// Where light comes from that the surface of a level, of `steps`, reflects along its normal, which is +z: directions, each as
/// likely as GGX has it, and which average of a cube of `side` texels has texels as large as what it stands for.
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
        // Twice as wide as it needs to be on average, for those between which more lies.
        let wide = (0.5 * (stands_for / texel).log2() + 1.0).round();
        let coarsest = f64::from(side.ilog2());
        let vector = ray.extend(wide.clamp(0.0, coarsest)).as_vec4();
        (ray.z > 0.0).then_some(vector.to_array())
    });
    rays.collect()
}
