//! An image whose pixels look where locations say: sampled once, then as superpixels where that aliases.

use super::LocationError;
use crate::camera::{Pinhole, SampleLocation};
use crate::engine::sampler::color::display_code;
use crate::render::passes::LightPlane;
use crate::render::{
    Coverage, Detection, Headless, Method, PixelAttributes, PreparedScene, RenderError, Rendered,
    Settings, Shading, Shadows, Statistics,
};
use crate::sampling::Pattern;

/// One value for each output cell, as detection compares them.
pub(super) struct Cells {
    colors: Vec<[f32; 4]>,
    pub attributes: Vec<PixelAttributes>,
    pub blend_ids: Vec<u32>,
    pub codes: Vec<u32>,
    /// What lights each lies in the shadow of.
    pub shadows: Vec<u32>,
}

impl Headless {
    /// Renders the image of `size` pixels whose pixel `row * width + column` looks where the location of that output index
    /// does, on the plane of its pinhole. The pinholes of a list share a centre of projection as a rule, and together
    /// see what one plane can't.
    ///
    /// Every location is sampled once. Where neighbours in the *output* alias, across pinholes too, locations are then sampled
    /// as superpixels, and so are those that a triangle narrower than their cell crosses unseen. `ssaa` samples every
    /// location by a grid and shades each sample. Pixels without a location show the background; of several locations of a
    /// pixel the last one counts.
    ///
    /// # Errors
    /// [`RenderError::Location`] names the first location that can't be sampled or has no place in the output,
    /// [`RenderError::LocationMethod`] if the method is `msaa`, [`RenderError::LocationRegion`] if the settings have a region;
    /// otherwise as [`Headless::render`].
    pub fn render_locations(
        &mut self,
        scene: &PreparedScene,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<Rendered, RenderError> {
        let mut settings = Settings {
            size,
            ..settings.clone()
        };
        settings.check(self.gpu().limits())?;
        match settings.method {
            Method::Msaa => return Err(RenderError::LocationMethod),
            Method::Ssaa => {
                // Superpixels that are shaded as brute force is read textures as it does.
                settings.method = Method::Superpixel;
                settings.pattern = Pattern::Grid;
                settings.detection = Detection::Every;
                settings.coverage = Coverage::Samples;
                settings.shading = Shading::Sample;
            }
            Method::None | Method::Superpixel => {}
        }
        if settings.region.is_some() {
            return Err(RenderError::LocationRegion);
        }
        let count = u64::from(size[0]) * u64::from(size[1]);
        for (index, location) in rig.iter().flat_map(|(_, locations)| locations).enumerate() {
            if u64::from(location.output) >= count {
                return Err(LocationError::Output {
                    index,
                    output: location.output,
                    cells: count,
                }
                .into());
            }
        }
        let samples_cells = settings.method != Method::None;
        let every = samples_cells && settings.detection == Detection::Every;
        let mut statistics = Statistics::default();
        let mut cells = Cells::new(count as usize, &settings);
        if !every || settings.attributes {
            for (pinhole, locations) in rig.iter().filter(|(_, locations)| !locations.is_empty()) {
                let seen = self.sample_points(scene, pinhole, locations, &settings)?;
                statistics.append(seen.statistics);
                for (location, seen) in locations.iter().zip(&seen.values) {
                    cells.put(location.output as usize, seen);
                }
            }
        }
        if samples_cells {
            let mut marked = if every {
                vec![true; count as usize]
            } else {
                let (aliasing, found) = self.find_aliasing(scene, rig, &settings, &cells)?;
                statistics.append(found);
                aliasing
            };
            if settings.thin && !every && settings.shadows == Shadows::Exact {
                statistics.append(self.mark_shadows(scene, rig, &settings, &cells, &mut marked)?);
            }
            statistics.append(self.sample_marked(scene, rig, &marked, &settings, &mut cells)?);
            for _ in 0..settings.growths() {
                marked = cells.beside(&marked, &settings);
                statistics.append(self.sample_marked(scene, rig, &marked, &settings, &mut cells)?);
            }
        }
        Ok(Rendered {
            size,
            colors: cells.colors,
            attributes: if settings.attributes {
                cells.attributes
            } else {
                Vec::new()
            },
            statistics,
        })
    }

    /// Marks the cells that lights reach elsewhere than at their locations: what is narrower than a cell casts shadows there.
    fn mark_shadows(
        &mut self,
        scene: &PreparedScene,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        settings: &Settings,
        cells: &Cells,
        marked: &mut [bool],
    ) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics::default();
        for (pinhole, locations) in rig.iter().filter(|(_, locations)| !locations.is_empty()) {
            for probe in LightPlane::PROBES {
                let probes: Vec<SampleLocation> = locations
                    .iter()
                    .map(|location| location.at(probe))
                    .collect();
                let seen = self.sample_points(scene, pinhole, &probes, settings)?;
                statistics.append(seen.statistics);
                for (location, seen) in locations.iter().zip(&seen.values) {
                    let cell = location.output as usize;
                    marked[cell] |=
                        cells.attributes[cell].id == seen.id && cells.shadows[cell] != seen.shadows;
                }
            }
        }
        Ok(statistics)
    }

    /// Samples the locations of marked cells as superpixels.
    fn sample_marked(
        &mut self,
        scene: &PreparedScene,
        rig: &[(Pinhole, Vec<SampleLocation>)],
        marked: &[bool],
        settings: &Settings,
        cells: &mut Cells,
    ) -> Result<Statistics, RenderError> {
        let mut statistics = Statistics::default();
        for (pinhole, locations) in rig {
            let chosen: Vec<SampleLocation> = locations
                .iter()
                .filter(|location| {
                    marked
                        .get(location.output as usize)
                        .copied()
                        .unwrap_or(false)
                })
                .copied()
                .collect();
            if chosen.is_empty() {
                continue;
            }
            let resolved = self.sample_superpixels(scene, pinhole, &chosen, settings)?;
            statistics.append(resolved.statistics);
            for (location, color) in chosen.iter().zip(&resolved.values) {
                cells.resolve(location.output as usize, *color, settings.samples);
            }
        }
        Ok(statistics)
    }
}

impl Cells {
    fn new(count: usize, settings: &Settings) -> Self {
        let background = settings.background_rgba();
        let unseen = PixelAttributes {
            samples: 1,
            ..PixelAttributes::default()
        };
        Self {
            colors: vec![background; count],
            attributes: vec![unseen; count],
            blend_ids: vec![0; count],
            codes: vec![display_code(background); count],
            shadows: vec![0; count],
        }
    }

    fn put(&mut self, cell: usize, seen: &super::PointSample) {
        if let (Some(color), Some(attributes), Some(blend_id), Some(code), Some(shadows)) = (
            self.colors.get_mut(cell),
            self.attributes.get_mut(cell),
            self.blend_ids.get_mut(cell),
            self.codes.get_mut(cell),
            self.shadows.get_mut(cell),
        ) {
            *color = seen.color;
            attributes.depth = seen.depth;
            attributes.id = seen.id;
            attributes.normal = seen.normal;
            *blend_id = seen.blend_id;
            *code = seen.code;
            *shadows = seen.shadows;
        }
    }

    fn resolve(&mut self, cell: usize, resolved: [f32; 4], samples: u32) {
        if let (Some(color), Some(attributes)) =
            (self.colors.get_mut(cell), self.attributes.get_mut(cell))
        {
            *color = resolved;
            attributes.samples = samples;
            attributes.superpixel = 1;
        }
    }

    /// Whether each cell grows beside others: it is no superpixel, and contrasts with what one of those `resolved` last was
    /// found to show.
    fn beside(&self, resolved: &[bool], settings: &Settings) -> Vec<bool> {
        let [width, height] = settings.size.map(|side| side as usize);
        let mut grows = vec![false; width * height];
        for cell in (0..resolved.len()).filter(|cell| resolved[*cell]) {
            let shown = settings.output_code(self.colors[cell]).to_le_bytes();
            let (x, y) = (cell % width, cell / width);
            for row in y.saturating_sub(1)..(y + 2).min(height) {
                for column in x.saturating_sub(1)..(x + 2).min(width) {
                    let near = row * width + column;
                    let own = self.codes[near].to_le_bytes();
                    let mut channels = own.into_iter().zip(shown);
                    grows[near] |= self.attributes[near].superpixel == 0
                        && channels.any(|(a, b)| a.abs_diff(b) > settings.threshold());
                }
            }
        }
        grows
    }
}
