//! What is said of an image.

use super::session::Shot;
use super::view::View;
use gpc::camera::{Camera, Projection};
use gpc::render::{PassTime, Settings, TriangleCounts};
use serde::Serialize;
use std::collections::BTreeMap;

/// Figures of one image.
#[derive(Serialize)]
pub struct Report {
    /// The file, or `-`.
    output: String,
    device: String,
    driver: String,
    size: [u32; 2],
    camera: CameraReport,
    samples: u32,
    superpixels: Superpixels,
    triangles: Triangles,
    /// Milliseconds on the device: `total`, and each pass; medians over repetitions.
    gpu_ms: BTreeMap<&'static str, f64>,
    /// Wall-clock milliseconds of rendering, from recording to the image in host memory; the median.
    wall_ms: f64,
    memory_bytes: u64,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct CameraReport {
    /// Column by column.
    view: [f64; 16],
    projection: [f64; 16],
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Vertical, in degrees; `null` for an orthographic camera.
    fov: Option<f64>,
}

#[derive(Serialize)]
struct Superpixels {
    count: u64,
    fraction: f64,
    /// Those that the first few of their samples did not settle.
    resampled: u64,
}

#[derive(Serialize)]
struct Triangles {
    total: u64,
    drawn: u64,
    skipped: Skipped,
}

/// Triangles that were no candidates for sub-samples, by reason.
#[derive(Serialize)]
struct Skipped {
    outside: u64,
    backfacing: u64,
    degenerate: u64,
    untouching: u64,
}

/// Where an image comes from and goes to.
pub struct Origin<'a> {
    pub output: String,
    pub device: &'a (String, String),
    pub settings: &'a Settings,
    pub view: &'a View,
    /// The view's camera as it was turned.
    pub camera: &'a Camera,
    pub warnings: Vec<String>,
}

impl Report {
    pub fn new(origin: Origin<'_>, shot: &Shot) -> Self {
        let size = origin.settings.size;
        let [width, height] = size.map(f64::from);
        let statistics = &shot.rendered.statistics;
        Self {
            output: origin.output,
            device: origin.device.0.clone(),
            driver: origin.device.1.clone(),
            size,
            camera: describe(origin.camera, origin.view, width / height),
            samples: origin.settings.samples,
            superpixels: Superpixels {
                count: statistics.superpixels,
                fraction: statistics.superpixels as f64 / (width * height),
                resampled: statistics.resampled,
            },
            triangles: count(&statistics.triangles),
            gpu_ms: medians(&shot.passes),
            wall_ms: median(shot.wall_ms.clone()),
            memory_bytes: statistics.memory_bytes,
            warnings: origin.warnings,
        }
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let [width, height] = self.size;
        let total = self.gpu_ms.get("total").copied().unwrap_or_default();
        format!(
            "{}: {width}x{height}, {} triangles, {} superpixels ({:.1} %) of {} samples, GPU {total:.1} ms, {}",
            self.output,
            self.triangles.total,
            self.superpixels.count,
            100.0 * self.superpixels.fraction,
            self.samples,
            self.device
        )
    }
}

fn describe(camera: &Camera, view: &View, aspect: f64) -> CameraReport {
    let distance = (view.target - view.camera.eye).length();
    CameraReport {
        view: camera.view().to_cols_array(),
        projection: camera.projection_matrix(aspect).to_cols_array(),
        eye: camera.eye.to_array(),
        target: (camera.eye + camera.direction() * distance).to_array(),
        up: camera.axes.y_axis.to_array(),
        fov: match camera.projection {
            Projection::Perspective { fov, .. } => Some(fov.to_degrees()),
            Projection::Orthographic { .. } => None,
        },
    }
}

fn count(counts: &TriangleCounts) -> Triangles {
    Triangles {
        total: counts.total,
        drawn: counts.drawn,
        skipped: Skipped {
            outside: counts.outside,
            backfacing: counts.backfacing,
            degenerate: counts.degenerate,
            untouching: counts.untouching,
        },
    }
}

/// The median of each pass and of the sums of all. A pass that runs several times in a frame counts as one.
fn medians(renderings: &[Vec<PassTime>]) -> BTreeMap<&'static str, f64> {
    let mut times: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for rendering in renderings {
        let mut sums = BTreeMap::from([("total", 0.0)]);
        for time in rendering {
            *sums.entry(time.pass).or_default() += time.ms;
            *sums.entry("total").or_default() += time.ms;
        }
        for (pass, sum) in sums {
            times.entry(pass).or_default().push(sum);
        }
    }
    let median = |(pass, times)| (pass, median(times));
    times.into_iter().map(median).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    let upper = values.get(middle).copied().unwrap_or_default();
    if values.len() % 2 == 1 {
        return upper;
    }
    let lower = values.get(middle.wrapping_sub(1)).copied();
    0.5 * (lower.unwrap_or_default() + upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_sums() {
        let time = |pass, ms| PassTime { pass, ms };
        let rendering = |ms| vec![time("raster", ms), time("shade", 1.0), time("shade", 2.0)];
        let found = medians(&[
            rendering(9.0),
            rendering(1.0),
            rendering(2.0),
            rendering(4.0),
        ]);
        let expected = [("raster", 3.0), ("shade", 3.0), ("total", 6.0)];
        assert_eq!(found, BTreeMap::from(expected));
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
    }
}
