//! Reference images: supersampling with thousands of samples a pixel.

use glam::DVec2;
use gpc::camera::Camera;
use gpc::render::{EngineError, Footprint, Headless, Method, PreparedScene, RenderError, Settings};
use gpc::sampling::owen_sobol;

/// Side of the sample grid in each rendering.
const SIDE: u32 = 16;

/// Samples a pixel of each rendering.
pub const GRID_SAMPLES: u32 = SIDE * SIDE;

/// Most samples a pixel of a reference.
pub const MAX_REFERENCE_SAMPLES: u32 = 1024 * GRID_SAMPLES;

/// Side, in output pixels, of the square over which the reference reads textures: the cell of a sample at 4,096
/// samples.
pub const TRUTH_SIDE: f32 = 1.0 / 64.0;

/// Scrambling seed of the grids' shifts. Superpixels have another seed: a reference with their own samples would
/// favour them.
const SEED: u32 = 1;

/// Renders an image at `samples` samples a pixel. The image is the mean of many renderings with 16 x 16 supersampling;
/// in each, the grid is shifted to another point of an Owen-scrambled Sobol set within the grid's cell. A finer grid
/// alone would err on edges along an axis, and favour methods whose samples lie in grids.
///
/// The sampling fields of `settings` are replaced, and [`Footprint::Sample`] becomes a square of [`TRUTH_SIDE`]:
/// textures and the alpha of MASK materials are read so sharply that the image is the mean over each pixel of the
/// unfiltered scene. [`Footprint::Pixel`] stays: that reference filters textures over a whole pixel at every sample,
/// and methods with the same footprint differ from it by geometry alone.
///
/// `progress` is called after each rendering. The result holds colours like those of
/// [`Rendered::colors`](gpc::render::Rendered::colors), rows from the top.
///
/// # Errors
/// [`EngineError::Samples`](gpc::render::EngineError::Samples) unless `samples` is a multiple of [`GRID_SAMPLES`] from it to [`MAX_REFERENCE_SAMPLES`];
/// otherwise as [`Headless::render`].
pub fn brute_force(
    headless: &mut Headless,
    scene: &PreparedScene,
    camera: &Camera,
    settings: &Settings,
    samples: u32,
    progress: impl FnMut(),
) -> Result<Vec<[f32; 4]>, RenderError> {
    if !(GRID_SAMPLES..=MAX_REFERENCE_SAMPLES).contains(&samples) || !samples.is_multiple_of(GRID_SAMPLES) {
        return Err(RenderError::Engine(EngineError::Samples {
            method: "the reference",
            asked: samples,
            possible: format!("the multiples of {GRID_SAMPLES} up to {MAX_REFERENCE_SAMPLES}"),
        }));
    }
    let settings = of_reference(settings, GRID_SAMPLES);
    let mut frame = headless.prepare(scene, &settings)?;
    // The points of the set are in cells of the grid.
    let shifts = owen_sobol(samples / GRID_SAMPLES, SEED);
    let offsets: Vec<_> = shifts.iter().map(|shift| DVec2::from(shift.map(f64::from)) / f64::from(SIDE)).collect();
    Ok(headless.accumulate(&mut frame, camera, &offsets, progress)?.colors)
}

/// Settings of one rendering of a reference, with `samples` samples a pixel.
pub(super) fn of_reference(settings: &Settings, samples: u32) -> Settings {
    settings
        .clone()
        .attributes(false)
        .footprint(match settings.scene.footprint {
            Footprint::Sample => Footprint::Side(TRUTH_SIDE),
            asked => asked,
        })
        .method(Method::Ssaa { samples })
}
