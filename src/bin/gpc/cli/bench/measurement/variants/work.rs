//! Locations of a camera variant, and runs that sample them.

use super::{Variant, VariantError};
use gpc::camera::panorama::{Panorama, PanoramaProjection};
use gpc::camera::set::{Sample, SamplingSet, SetError};
use gpc::camera::zoom::{Shape, Transition, ZoomError, ZoomMap, ZoomRegion};
use gpc::camera::{Camera, Pinhole, SampleLocation};
use gpc::render::{
    CellOptions, Footprint, Headless, MethodKind, PreparedScene, RenderError, SceneFrame, SceneSettings, Settings,
    Statistics,
};
use gpc::testing::Random;

/// Largest number of samples in a leaf of the quadtree.
const LEAF_SAMPLES: usize = 32;
/// Seed of the random locations, which are the same in every run.
const SEED: u64 = 2010;
/// Multiplicity of the zoom into the middle of the image, which is enlarged by 1 / multiplicity.
const MULTIPLICITY: f64 = 0.3;

/// Camera variant that is ready to run.
pub(super) enum VariantWork {
    /// Frame of the raster pass.
    Frame(Box<SceneFrame>),
    /// One sample at each location of each pinhole.
    Points(Vec<(Pinhole, Vec<SampleLocation>)>, Box<SceneSettings>),
    /// Image at two rates: one sample in each cell, and more in cells that alias.
    TwoRates(Vec<(Pinhole, Vec<SampleLocation>)>, Box<Settings>),
}

/// Result of a run.
pub(super) struct Done {
    pub samples: u64,
    pub gpu_ms: f64,
}

impl VariantWork {
    pub fn new(
        variant: Variant,
        headless: &Headless,
        scene: &PreparedScene,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Self, VariantError> {
        let size = settings.size;
        let with = |method: MethodKind, samples| settings.clone().method(method.with_samples(samples));
        let once = with(MethodKind::None, 1);
        let pinhole = Pinhole::from_camera(camera, size)?;
        let points = |set: SamplingSet| vec![(pinhole, set.locations())];
        let rig = match variant {
            Variant::Raster => {
                return Ok(Self::Frame(Box::new(headless.prepare(scene, &once)?)));
            }
            Variant::Superpixel => {
                let settings = with(MethodKind::Superpixel, CellOptions::DEFAULT_SAMPLES);
                let locations = SamplingSet::planar(size)?.locations();
                return Ok(Self::TwoRates(vec![(pinhole, locations)], Box::new(settings)));
            }
            Variant::Planar => points(SamplingSet::planar(size)?),
            Variant::Offset => points(SamplingSet::mapped(size, &zoom(size)?)?),
            Variant::NoPattern => points(random(size)?),
            Variant::Rig => {
                let around = [size[0], size[0].div_ceil(2)];
                let panorama = Panorama::new(PanoramaProjection::Equirectangular, 360.0, around)?;
                panorama.locations(camera)?.rig().to_vec()
            }
        };
        let settings = once.scene.footprint(Footprint::Pixel);
        Ok(Self::Points(rig, Box::new(settings)))
    }

    pub fn run(
        &mut self,
        headless: &mut Headless,
        scene: &PreparedScene,
        camera: &Camera,
    ) -> Result<Done, RenderError> {
        let done = |samples: u64, statistics: &Statistics| Done { samples, gpu_ms: statistics.gpu_ms() };
        match self {
            Self::Frame(frame) => {
                let rendered = headless.render(frame, camera)?;
                Ok(done(rendered.colors.len() as u64, &rendered.statistics))
            }
            Self::Points(rig, settings) => {
                let mut sum = done(0, &Statistics::default());
                for (pinhole, locations) in rig {
                    let sampled = headless.sample_points(scene, pinhole, locations, settings)?;
                    sum.samples += locations.len() as u64;
                    sum.gpu_ms += sampled.statistics.gpu_ms();
                }
                Ok(sum)
            }
            Self::TwoRates(rig, settings) => {
                let rendered = headless.render_locations(scene, rig, settings)?;
                let pixels = rendered.colors.len() as u64;
                let more = rendered.statistics.superpixels * u64::from(settings.method.samples());
                Ok(done(pixels + more, &rendered.statistics))
            }
        }
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
