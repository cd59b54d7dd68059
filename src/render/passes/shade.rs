//! shade: computes the radiance of visible places, with one dispatch for each material bin.

use crate::engine::data::{Argument, Cells, ColorConstants, Content};
use crate::engine::pipelines::{FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::render::data::GpuScene;
use crate::render::data::MaterialBin;
use crate::vulkan::{Specialized, VulkanError};

/// Places that are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShadeSource {
    /// The centres of a region's pixels; writes their colours.
    Pixels {
        /// Whether to write display codes for detection.
        display_codes: bool,
    },
    /// Visibility samples.
    Fragments {
        /// Kind of the cells to which the visibility samples belong.
        cells: Cells,
        /// Whether they were merged, so that some of them see nothing.
        merged: bool,
    },
}

/// Shades the spans of a region or the visibility samples of a round: each material bin with a pipeline that computes only
/// what its materials and the scene's lights need. Places have `shadow_words` words of shadows; `output` holds the colour
/// constants of `shaders/include/color.glsl`.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(
    layout: &FrameLayout,
    scene: &GpuScene,
    source: ShadeSource,
    shadow_words: u32,
    output: &ColorConstants,
) -> Result<Pass, VulkanError> {
    let lights = scene.light_features;
    let (pixels, cells, merged) = match source {
        ShadeSource::Pixels { .. } => (true, Cells::Pixels, false),
        ShadeSource::Fragments { cells, merged } => (false, cells, merged),
    };
    let display_codes = source == ShadeSource::Pixels { display_codes: true };
    let one_bin = scene.bins.len() <= 1 && !merged;
    let shader = |bin: &MaterialBin| spirv::Shade {
        pixels,
        one_bin,
        display_codes,
        punctual: lights.count > 0,
        local_lights: lights.local,
        blended: !pixels && scene.has_blend(),
        box_filter: output.box_filter,
        tinted: output.tinted,
        environment: scene.has_environment,
        locations: cells.are_locations(),
        instanced: scene.is_instanced(),
        shadow_words,
        tonemap: output.tonemap,
        tonemap_codes: output.tonemap_codes,
        ..bin.shader
    };
    let dispatch = |(number, bin): (u32, &MaterialBin)| {
        let textures = if output.box_filter { &bin.averaged_textures } else { &bin.textures };
        let size = if one_bin && !pixels {
            Size::from(Argument::Fragments)
        } else {
            Size::Indirect(Argument::Shade as u32 + number)
        };
        let kernel = layout.kernel(&shader(bin))?;
        let pushed = spirv::ShadePush { bin: number };
        Ok(kernel.dispatch(pushed, size).with(textures))
    };
    let dispatches: Result<Vec<_>, VulkanError> = (0..).zip(&scene.bins).map(dispatch).collect();
    // Bins write different places.
    Ok(Pass::named(spirv::Shade::INTERFACE).unordered(dispatches?))
}
