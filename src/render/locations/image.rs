//! Images whose pixels are sampled at given locations: once each, and then as superpixels where the image aliases.

use super::sampler::CellSpread;
use super::{LocationError, PinholeLists, PointSample};
use crate::camera::{Pinhole, SampleLocation};
use crate::engine::sampler::color::display_code;
use crate::render::passes::SeenLocation;
use crate::render::{
    Detection, Headless, Method, PixelAttributes, PreparedScene, RenderError, Rendered, Settings, Shading, Statistics,
    SuperpixelOptions,
};
use crate::sampling::Pattern;

/// Surface and colour in each cell of an output, row by row.
pub(super) struct OutputImage {
    pub colors: Vec<[f32; 4]>,
    pub attributes: Vec<PixelAttributes>,
    pub blend_ids: Vec<u32>,
    /// Colour of each location as detection compares it: 8-bit sRGB codes and alpha, red in the lowest byte.
    pub codes: Vec<u32>,
    /// Bits of the lights in whose shadow each location lies.
    pub shadows: Vec<u32>,
    /// How the light of superpixels is spread over their cells, for a pixel filter; otherwise empty.
    pub spreads: Vec<CellSpread>,
}

impl Headless {
    /// Renders an image in which the pixel `row * width + column` is sampled at the location with this output index, on
    /// the plane of the location's pinhole. The pinholes of a rig usually share a
    /// centre of projection, and together see more than one plane can.
    ///
    /// Every location is sampled once. Locations are then sampled as superpixels if neighbours in the *output* alias,
    /// also across pinholes, or if a triangle narrower than their cell crosses it without covering the location.
    /// `ssaa` samples every location by a grid and shades each sample. Pixels without a location show the background.
    /// If several locations belong to a pixel, the last one counts. A pixel filter averages neighbours in the output.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled or has no place in the output,
    /// [`RenderError::LocationMethod`] if the method is `msaa` or accumulates, [`RenderError::LocationRegion`] if the settings have a
    /// region; otherwise as [`Headless::render`].
    pub fn render_locations(
        &mut self,
        scene: &PreparedScene,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        settings: &Settings,
    ) -> Result<Rendered, RenderError> {
        let (size, mut settings) = (settings.size, settings.clone());
        settings.check(self.gpu().limits())?;
        match settings.method {
            Method::Msaa { .. } | Method::Accumulate { .. } => {
                return Err(RenderError::LocationMethod { method: settings.method.kind() });
            }
            // Superpixels with every sample shaded equal supersampling, and read textures as it does.
            Method::Ssaa { samples } => {
                settings.method = SuperpixelOptions::new(samples)
                    .pattern(Pattern::Grid)
                    .detection(Detection::Every)
                    .shading(Shading::Sample)
                    .into();
            }
            Method::None | Method::Superpixel(_) => {}
        }
        if settings.region.is_some() {
            return Err(RenderError::LocationRegion);
        }
        let count = u64::from(size[0]) * u64::from(size[1]);
        for (index, location) in rig.iter().flat_map(|(_, locations)| locations).enumerate() {
            if u64::from(location.output) >= count {
                return Err(LocationError::Output { index, output: location.output, cells: count }.into());
            }
        }
        let samples_cells = settings.method != Method::None;
        let every = samples_cells && settings.superpixels().detection == Detection::Every;
        let mut statistics = Statistics::default();
        let mut image = OutputImage::new(count as usize, &settings);
        if !every || settings.attributes {
            for (pinhole, locations) in rig.iter().filter(|(_, locations)| !locations.is_empty()) {
                let seen =
                    self.sample_filtered_points(scene, pinhole, locations, &settings.scene, settings.filter())?;
                statistics.append(seen.statistics);
                for (location, seen) in locations.iter().zip(&seen.values) {
                    image.put(location.output as usize, seen);
                }
            }
        }
        if every {
            statistics.append(self.sample_cells(scene, rig, &settings, &mut image)?);
        } else if samples_cells {
            statistics.append(self.sample_aliasing(scene, rig, &settings, &mut image)?);
        }
        if !settings.pixel_filter.is_box() {
            statistics.append(self.filter_cells(scene, &settings, &mut image)?);
        }
        Ok(Rendered {
            size,
            colors: image.colors,
            attributes: if settings.attributes { image.attributes } else { Vec::new() },
            statistics,
        })
    }

    /// Samples locations as superpixels, and stores their colours in the image.
    pub(super) fn sample_cells(
        &mut self,
        scene: &PreparedScene,
        rig: PinholeLists<'_>,
        settings: &Settings,
        image: &mut OutputImage,
    ) -> Result<Statistics, RenderError> {
        let cells = settings.superpixels().cells;
        let spread = settings.pixel_filter.spread();
        let mut statistics = Statistics::default();
        for (pinhole, locations) in rig.iter().filter(|(_, locations)| !locations.is_empty()) {
            let (resolved, spreads) =
                self.sample_spread_superpixels(scene, pinhole, locations, &cells, &settings.scene, spread)?;
            statistics.append(resolved.statistics);
            for (location, color) in locations.iter().zip(&resolved.values) {
                image.resolve(location.output as usize, *color, cells.samples);
            }
            for (location, spread) in locations.iter().zip(spreads) {
                image.spreads[location.output as usize] = spread;
            }
        }
        Ok(statistics)
    }
}

impl OutputImage {
    fn new(count: usize, settings: &Settings) -> Self {
        let background = settings.sampler().background_rgba();
        let unseen = PixelAttributes { samples: 1, ..PixelAttributes::default() };
        Self {
            colors: vec![background; count],
            attributes: vec![unseen; count],
            blend_ids: vec![0; count],
            codes: vec![display_code(background); count],
            shadows: vec![0; count],
            spreads: vec![CellSpread::default(); if settings.pixel_filter.is_box() { 0 } else { count }],
        }
    }

    fn put(&mut self, cell: usize, seen: &PointSample) {
        self.colors[cell] = seen.color;
        let PointSample { depth, id, normal, .. } = *seen;
        self.attributes[cell] = PixelAttributes { depth, id, normal, ..self.attributes[cell] };
        self.blend_ids[cell] = seen.blend_id;
        self.codes[cell] = seen.code;
        self.shadows[cell] = seen.shadows;
    }

    fn resolve(&mut self, cell: usize, resolved: [f32; 4], samples: u32) {
        self.colors[cell] = resolved;
        self.attributes[cell] = PixelAttributes { samples, superpixel: 1, ..self.attributes[cell] };
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.colors.len()
    }

    /// Whether a cell has been sampled as a superpixel.
    pub fn is_superpixel(&self, cell: u32) -> bool {
        self.attributes[cell as usize].superpixel == 1
    }

    /// Surface at the location of a cell. The cell's index in the result is relative to `first`.
    pub fn seen_at(&self, cell: u32, first: u32) -> SeenLocation {
        let at = cell as usize;
        SeenLocation {
            distance: self.attributes[at].depth,
            id: self.attributes[at].id,
            blend_id: self.blend_ids[at],
            output: cell - first,
        }
    }
}
