//! Benchmark of camera variants: time per sample, compared with that of the raster pass.
//!
//! All variants of a scene are warmed up once and then run in turns. Only sampling is timed; locations are made once,
//! beforehand.

use super::Contender;
use gpc::camera::panorama::{Panorama, PanoramaProjection};
use gpc::camera::set::{Sample, SamplingSet, SetError};
use gpc::camera::zoom::{Shape, Transition, ZoomError, ZoomMap, ZoomRegion};
use gpc::camera::{Camera, Pinhole};
use gpc::render::{CellOptions, Footprint, Headless, MethodKind, PreparedScene, Rendered, Settings, Statistics};
use gpc::testing::Random;
use serde::Serialize;
use std::fmt;

/// Largest number of samples in a leaf of the quadtree.
const LEAF_SAMPLES: usize = 32;
/// Seed of the random locations, which are the same in every run.
const SEED: u64 = 2010;
/// Multiplicity of the zoom into the middle of the image, which is enlarged by 1 / multiplicity.
const MULTIPLICITY: f64 = 0.3;

/// Camera variant: its locations, and the way in which they are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variant {
    /// Pixels' centres by the raster pass, which the other variants are compared with.
    Raster,
    /// Pixels' centres as a list of locations.
    Planar,
    /// Zoom into the middle of the image.
    Offset,
    /// Pixels' centres, and more samples in pixels that alias.
    Superpixel,
    /// Random locations.
    NoPattern,
    /// Panorama.
    Rig,
}

impl Variant {
    /// All variants, the raster pass first.
    pub const ALL: [Self; 6] = [Self::Raster, Self::Planar, Self::Offset, Self::Superpixel, Self::NoPattern, Self::Rig];

    /// Description of the variant for readers of a table.
    pub fn about(self) -> &'static str {
        match self {
            Self::Raster => {
                "the centre of each pixel by the raster pass: the planar render that the others are held against"
            }
            Self::Planar => "the same centres as locations of the engine that samples any location",
            Self::Offset => "one location a pixel, where a smooth zoom by 1 / 0.3 of the middle of the image sends it",
            Self::Superpixel => "two rates: the centres of pixels, and 64 samples in place of each that aliases",
            Self::NoPattern => "as many random locations as the image has pixels, in random order",
            Self::Rig => {
                "an equirectangular panorama of 360 x 180 degrees, as wide as the image, on the planes of six pinholes"
            }
        }
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Raster => "raster",
            Self::Planar => "planar",
            Self::Offset => "offset",
            Self::Superpixel => "superpixel",
            Self::NoPattern => "no-pattern",
            Self::Rig => "rig",
        })
    }
}

impl Variant {
    /// Makes the locations of the variant for images of the settings' size, and samples them once without timing. The
    /// settings' method is ignored: the variant decides. Returns the number of samples of a run, too.
    ///
    /// # Errors
    /// If the camera has no such locations (an orthographic one has no panorama), or if they can't be sampled.
    pub fn warm_up<'a>(
        self,
        headless: &mut Headless,
        scene: &'a PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> anyhow::Result<(Contender<'a>, u64)> {
        let size = settings.size;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let with = |method: MethodKind, samples| settings.clone().method(method.with_samples(samples));
        let once = with(MethodKind::None, 1);
        let pinhole = Pinhole::from_camera(camera, size)?;
        let points = |set: SamplingSet| vec![(pinhole, set.locations())];
        let rig = match self {
            Self::Raster => {
                let (contender, _) = Contender::warm_up(headless, scene, camera, &once)?;
                return Ok((contender, pixels));
            }
            Self::Superpixel => {
                let settings = with(MethodKind::Superpixel, CellOptions::DEFAULT_SAMPLES);
                let rig = points(SamplingSet::planar(size)?);
                let sample = move |headless: &mut Headless| headless.render_locations(scene, &rig, &settings);
                let superpixels = sample(headless)?.statistics.superpixels;
                let samples = pixels + superpixels * u64::from(CellOptions::DEFAULT_SAMPLES);
                return Ok((Contender::new(sample), samples));
            }
            Self::Planar => points(SamplingSet::planar(size)?),
            Self::Offset => points(SamplingSet::mapped(size, &zoom(size)?)?),
            Self::NoPattern => points(random(size)?),
            Self::Rig => {
                let around = [size[0], size[0].div_ceil(2)];
                let panorama = Panorama::new(PanoramaProjection::Equirectangular, 360.0, around)?;
                panorama.locations(camera)?.rig().to_vec()
            }
        };
        let samples = rig.iter().map(|(_, locations)| locations.len() as u64).sum();
        let settings = once.scene.footprint(Footprint::Pixel);
        let sample = move |headless: &mut Headless| {
            let mut statistics = Statistics::default();
            for (pinhole, locations) in &rig {
                statistics.append(headless.sample_points(scene, pinhole, locations, &settings)?.statistics);
            }
            Ok(Rendered { size, colors: Vec::new(), attributes: Vec::new(), statistics })
        };
        sample(headless)?;
        Ok((Contender::new(sample), samples))
    }
}

/// Zoom into the middle of an image.
fn zoom(size: [u32; 2]) -> Result<ZoomMap, ZoomError> {
    let [width, height] = size.map(f64::from);
    let radius = 0.15 * width.min(height);
    ZoomMap::new(vec![ZoomRegion {
        center: [0.5 * width, 0.5 * height],
        radius: [radius; 2],
        multiplicity: MULTIPLICITY,
        shape: Shape::Circle,
        transition: Transition::Smooth,
    }])
}

/// Random locations anywhere in the image, one for each of its pixels. All belong to one cell of the output, so that
/// none has neighbours and each stands for a pixel.
fn random(size: [u32; 2]) -> Result<SamplingSet, SetError> {
    let [width, height] = size.map(f64::from);
    let count = u64::from(size[0]) * u64::from(size[1]);
    let mut random = Random::new(SEED);
    let sample = |_| Sample { uv: [random.range(0.0, width), random.range(0.0, height)], row: 0, col: 0 };
    SamplingSet::no_pattern([1, 1], (0..count).map(sample).collect(), None, LEAF_SAMPLES)
}
