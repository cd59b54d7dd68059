//! shade: computes the radiance of visible places, with one dispatch for each material bin.

use crate::engine::data::{Argument, Cells, ColorConstants, Content};
use crate::engine::passes::spirv;
use crate::engine::pipelines::{FrameLayout, Kernel, Size};
use crate::render::data::GpuScene;
use crate::render::data::ShadeFeatures;
use crate::vulkan::{Recorder, Specialized, VulkanError};
use std::collections::HashMap;

/// Places that are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadeSource {
    /// The centres of a region's pixels; writes their colours.
    Pixels {
        /// Whether to write display codes for detection.
        display_codes: bool,
    },
    /// Visibility samples.
    Records {
        /// Kind of the cells to which the visibility samples belong.
        cells: Cells,
    },
}

/// Shades each material bin with a pipeline that computes only what its materials and the scene's lights need.
pub struct Shade {
    source: ShadeSource,
    /// Whether textures are averaged over footprints.
    box_filter: bool,
    kernels: Vec<Kernel<spirv::Shade>>,
    /// Index of each bin's kernel.
    bins: Vec<usize>,
}

impl Shade {
    /// Makes a pipeline for each set of features in the scene. Places have `shadow_words` words of shadows; `output`
    /// holds the colour constants of `shaders/include/color.glsl`.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        layout: &FrameLayout,
        scene: &GpuScene,
        (source, shadow_words): (ShadeSource, u32),
        output: &ColorConstants,
    ) -> Result<Self, VulkanError> {
        let lights = scene.light_features();
        let (pixels, cells) = match source {
            ShadeSource::Pixels { .. } => (true, Cells::Pixels),
            ShadeSource::Records { cells } => (false, cells),
        };
        let display_codes = source
            == ShadeSource::Pixels {
                display_codes: true,
            };
        let common = spirv::Shade {
            pixels,
            one_bin: scene.bins.len() <= 1,
            display_codes,
            punctual: lights.count > 0,
            local_lights: lights.local,
            blended: !pixels && scene.has_blend(),
            box_filter: output.box_filter,
            tinted: output.tinted,
            environment: scene.has_environment(),
            locations: cells.are_locations(),
            occluders: cells.are_occluders(),
            instanced: scene.is_instanced(),
            shadow_words,
            tonemap: output.tonemap,
            tonemap_codes: output.tonemap_codes,
            ..spirv::Shade::default()
        };
        let mut known: HashMap<ShadeFeatures, usize> = HashMap::new();
        let mut kernels = Vec::new();
        let mut bins = Vec::new();
        for bin in &scene.bins {
            let features = bin.features;
            if let Some(index) = known.get(&features) {
                bins.push(*index);
                continue;
            }
            kernels.push(layout.kernel(&features.shader(common))?);
            known.insert(features, kernels.len() - 1);
            bins.push(kernels.len() - 1);
        }
        Ok(Self {
            source,
            box_filter: output.box_filter,
            kernels,
            bins,
        })
    }

    /// Records the pass over the spans of a region or the visibility samples of a round.
    pub fn record(&self, recorder: &Recorder<'_>, scene: &GpuScene) {
        let every_record =
            matches!(self.source, ShadeSource::Records { .. }) && self.bins.len() == 1;
        recorder.pass(spirv::Shade::INTERFACE, || {
            // Bins write different places.
            recorder.unordered(|| {
                for (bin, (material_bin, kernel)) in (0..).zip(scene.bins.iter().zip(&self.bins)) {
                    let Some(kernel) = self.kernels.get(*kernel) else {
                        continue;
                    };
                    let textures = if self.box_filter {
                        &material_bin.averaged_textures
                    } else {
                        &material_bin.textures
                    };
                    recorder.show(textures);
                    let size = if every_record {
                        Size::from(Argument::Sort)
                    } else {
                        Size::Indirect(Argument::Shade as u32 + bin)
                    };
                    let dispatch = kernel.dispatch(spirv::ShadePush { bin }, size);
                    dispatch.record(recorder, 0);
                }
            });
        });
    }
}
