//! Settings of rendering scenes.

use super::{CellOptions, Footprint, Method, PixelRect, Reference, RenderError, Shading, SuperpixelOptions};
use crate::engine::data::Content;
use crate::engine::sampler::footprint::TextureFilter;
use crate::engine::sampler::{ImageRequest, SamplerSettings};
use crate::sampling::PixelFilter;
use crate::vulkan::Limits;

/// Shadows of the scene's lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shadows {
    /// No shadows: lights shine through everything.
    None,
    /// Exact shadows: every shaded point tests for every light whether another triangle occludes it, by sampling on
    /// the light's image plane, without the aliasing of a shadow map. In superpixels these points are the samples. Those of a
    /// triangle that the same lights reach are then shaded together, as [`CellOptions::shading`] says. With BLEND
    /// materials, or a pixel filter wider than the box, every sample is shaded by itself. The scene has to be prepared for
    /// shadows: see `SceneRequest::shadows`.
    Exact,
}

/// Settings of rendering a scene, whether at the pixels of an image or at sample locations.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SceneSettings {
    /// Linear colour of the background; `None` leaves it transparent.
    pub background: Option<[f32; 3]>,
    /// Exposure in stops: 1 is twice as bright.
    pub exposure: f32,
    /// Meaning of the numbers in the image.
    pub reference: Reference,
    /// Area for which texture levels are chosen.
    pub footprint: Footprint,
    /// Shadows of the scene's lights.
    pub shadows: Shadows,
    /// Width of lines in output pixels, above 0 and at most [`Self::LARGEST_STROKE`]. For sampling locations, these
    /// are pixels of the pinhole's plane.
    pub line_width: f32,
    /// Diameter of points in output pixels, with the same limits.
    pub point_size: f32,
    /// Width of [edges](crate::scene::Scene::add_edges) of meshes in output pixels, with the same limits.
    pub edge_width: f32,
    /// Limit for device memory in bytes, including uploads and read-back; `None` for no limit.
    pub max_memory: Option<u64>,
    /// Whether the passes of all rounds are timed one by one, instead of those of the first round alone and the other
    /// rounds as a whole. It does not change the image. On CPU devices, timestamps take time: a round that has nothing to
    /// do takes ten times as long with them.
    pub time_rounds: bool,
}

/// Settings of an image: everything that determines it besides scene and camera, and how it is timed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Part of the image to render; `None` for the whole image. Its pixels equal those of the whole image, unless
    /// `max_memory` divides the image differently, so that the device may round vertices differently.
    pub region: Option<PixelRect>,
    /// Method of antialiasing.
    pub method: Method,
    /// Filter by which pixels are averaged, also those of images at locations.
    pub pixel_filter: PixelFilter,
    /// Whether to output depth, ID, normal and number of samples of every pixel too.
    pub attributes: bool,
    /// Settings of rendering the scene.
    pub scene: SceneSettings,
}

impl Default for SceneSettings {
    fn default() -> Self {
        Self {
            background: None,
            exposure: 0.0,
            reference: Reference::Display,
            footprint: Footprint::Sample,
            shadows: Shadows::None,
            line_width: 1.0,
            point_size: 3.0,
            edge_width: 1.0,
            max_memory: None,
            time_rounds: false,
        }
    }
}

impl SceneSettings {
    /// Largest width of lines and size of points, in output pixels.
    pub const LARGEST_STROKE: f32 = 1024.0;

    /// Checks the settings as far as that is independent of the scene.
    pub(super) fn check(&self) -> Result<(), RenderError> {
        for size in [self.line_width, self.point_size, self.edge_width] {
            if !(size > 0.0 && size <= Self::LARGEST_STROKE) {
                return Err(RenderError::Stroke(size));
            }
        }
        Ok(self.footprint.check()?)
    }

    /// Options with a visibility sample for each sample if shadows are on.
    pub(super) fn shadowed(&self, cells: CellOptions) -> CellOptions {
        match self.shadows {
            Shadows::None => cells,
            Shadows::Exact => CellOptions { shading: Shading::Sample, ..cells },
        }
    }

    /// Rate at which the samples of cells are merged once it is known which lights reach each of them; `None` if they are shaded one
    /// by one. Lists of layers, and images whose pixels are `filtered`, need the samples themselves.
    pub(super) fn merged(&self, cells: &CellOptions, scene: &dyn Content, filtered: bool) -> Option<Shading> {
        let shaded_alone = self.shadows == Shadows::None || cells.shading == Shading::Sample;
        (!shaded_alone && !scene.has_blend() && !filtered).then_some(cells.shading)
    }

    /// Settings of a sampler of these cells.
    pub(super) fn sampler(&self, cells: CellOptions, filter: TextureFilter) -> SamplerSettings {
        SamplerSettings {
            cells,
            filter,
            background: self.background,
            exposure: self.exposure,
            reference: self.reference,
            merged: None,
        }
    }
}

impl Settings {
    /// Superpixel antialiasing with the default settings, for an image of `width` x `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            size: [width, height],
            region: None,
            method: SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).into(),
            pixel_filter: PixelFilter::BOX,
            attributes: false,
            scene: SceneSettings::default(),
        }
    }

    /// Sets the method of antialiasing.
    #[must_use]
    pub fn method(self, method: impl Into<Method>) -> Self {
        Self { method: method.into(), ..self }
    }

    /// Changes the options of superpixels, if the method has them.
    #[must_use]
    pub fn map_superpixels(self, change: impl FnOnce(SuperpixelOptions) -> SuperpixelOptions) -> Self {
        match self.method {
            Method::Superpixel(options) => Self { method: change(options).into(), ..self },
            _ => self,
        }
    }

    /// Width and height in pixels of the rendered image: the region, or the whole image.
    #[must_use]
    pub fn output_size(&self) -> [u32; 2] {
        self.region.map_or(self.size, |region| region.size)
    }

    /// These settings, with a visibility sample for each sample of superpixels if shadows are on.
    pub(super) fn with_shadowed_samples(self) -> Self {
        let scene = self.scene.clone();
        self.map_superpixels(|options| SuperpixelOptions { cells: scene.shadowed(options.cells), ..options })
    }

    /// Options of superpixels. For other methods, the options of their cells.
    pub(super) fn superpixels(&self) -> SuperpixelOptions {
        match &self.method {
            Method::Superpixel(options) => options.clone(),
            method => {
                let options = SuperpixelOptions::new(method.samples());
                SuperpixelOptions { cells: self.scene.shadowed(options.cells), ..options }
            }
        }
    }

    /// Areas over which textures are filtered.
    pub(super) fn filter(&self) -> TextureFilter {
        let footprint = self.scene.footprint;
        match &self.method {
            Method::Superpixel(options) => TextureFilter::of_cells(footprint, options.cells.shading),
            Method::Accumulate { samples, .. } if footprint == Footprint::Sample => {
                let side = self.pixel_filter.sampled_side() as f32 / (*samples as f32).sqrt();
                TextureFilter::of_pixels(Footprint::Side(side.min(1.0)), 1)
            }
            method => TextureFilter::of_pixels(footprint, method.side()),
        }
    }

    /// Settings of a sampler of the image's cells whose samples may be merged, for settings without
    /// [shadowed samples](Self::with_shadowed_samples).
    pub(super) fn merging_sampler(&self, scene: &dyn Content) -> SamplerSettings {
        let merged = match &self.method {
            Method::Superpixel(options) => self.scene.merged(&options.cells, scene, !self.pixel_filter.is_box()),
            _ => None,
        };
        let shadowed = self.clone().with_shadowed_samples().sampler();
        let filter = if merged.is_some() { self.filter() } else { shadowed.filter };
        SamplerSettings { merged, filter, ..shadowed }
    }

    /// Settings of a sampler of the image's cells.
    pub(super) fn sampler(&self) -> SamplerSettings {
        self.scene.sampler(self.superpixels().cells, self.filter())
    }

    /// The image, for its plan.
    pub(super) fn image(&self) -> ImageRequest<'_> {
        ImageRequest {
            size: self.size,
            region: self.region,
            method: &self.method,
            filter: self.pixel_filter,
            attributes: self.attributes,
            max_memory: self.scene.max_memory,
        }
    }

    /// Checks the settings as far as that is independent of the scene.
    pub(super) fn check(&self, limits: &Limits) -> Result<(), RenderError> {
        self.scene.check()?;
        self.image().check(limits)?;
        Ok(self.sampler().check()?)
    }
}

setters! {
    SceneSettings in Settings.scene {
        background: Option<[f32; 3]> = "the linear colour of the background; `None` for transparent",
        exposure: f32 = "the exposure in stops: 1 is twice as bright",
        reference: Reference = "the meaning of the numbers in the image",
        footprint: Footprint = "the area for which texture levels are chosen",
        shadows: Shadows = "the shadows of the scene's lights",
        line_width: f32 = "the width of lines in output pixels",
        point_size: f32 = "the diameter of points in output pixels",
        edge_width: f32 = "the width of edges of meshes in output pixels",
        max_memory: Option<u64> = "the limit for device memory in bytes; `None` for no limit",
        time_rounds: bool = "whether the passes of all rounds are timed one by one",
    }
}

setters! {
    Settings {
        size: [u32; 2] = "the width and height in pixels",
        region: Option<PixelRect> = "the part of the image to render; `None` for the whole image",
        pixel_filter: PixelFilter = "the filter by which pixels are averaged",
        attributes: bool = "whether depth, ID, normal and number of samples of every pixel are output too",
        scene: SceneSettings = "the settings of rendering the scene",
    }
}
