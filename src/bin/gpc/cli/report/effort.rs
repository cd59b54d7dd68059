//! Work and time that an image took.

use crate::cli::bench::Spread;
use gpc::render::{PassTime, Settings, Statistics, TriangleCounts};
use serde::Serialize;
use std::collections::BTreeMap;

/// Work that an image took, and its times.
#[derive(Serialize)]
pub struct Effort {
    /// Samples of a superpixel; samples of every pixel for methods without superpixels.
    pub samples: u32,
    pub superpixels: Superpixels,
    pub triangles: Triangles,
    /// Device milliseconds of each pass, and of all but `encode` and `copy` together as `total`; medians over repetitions.
    pub gpu_ms: BTreeMap<&'static str, f64>,
    /// Wall-clock milliseconds from recording to the image in host memory; the median.
    pub wall_ms: f64,
    pub memory_bytes: u64,
}

#[derive(Serialize)]
pub struct Superpixels {
    pub count: u64,
    /// Superpixels / pixels, or superpixels / locations.
    pub fraction: f64,
    /// Superpixels that are sampled by points, although samples of others lie on lines.
    resampled: u64,
    /// Number of visibility samples: the shaded places, and the links of BLEND layers.
    visibility_samples: u64,
}

#[derive(Serialize)]
pub struct Triangles {
    pub total: u64,
    drawn: u64,
    skipped: SkippedTriangles,
}

/// Triangles that were left out of the search for samples, by reason.
#[derive(Serialize)]
struct SkippedTriangles {
    outside: u64,
    backfacing: u64,
    degenerate: u64,
    untouching: u64,
}

impl Effort {
    /// Effort of an image of `cells` pixels or locations: statistics of its last rendering, and for each rendering the times of
    /// the passes and the wall-clock milliseconds.
    pub fn new(
        settings: &Settings,
        statistics: &Statistics,
        cells: usize,
        passes: &[Vec<PassTime>],
        wall_ms: &[f64],
    ) -> Self {
        Self {
            samples: settings.method.samples(),
            superpixels: Superpixels {
                count: statistics.superpixels,
                fraction: statistics.superpixels as f64 / cells.max(1) as f64,
                resampled: statistics.resampled,
                visibility_samples: statistics.visibility_samples,
            },
            triangles: count(&statistics.triangles),
            gpu_ms: medians(passes),
            wall_ms: Spread::of(wall_ms.iter().copied()).median,
            memory_bytes: statistics.memory_bytes,
        }
    }

    /// Device milliseconds of all passes together, without the output of the image.
    pub fn total_gpu_ms(&self) -> f64 {
        self.gpu_ms.get("total").copied().unwrap_or_default()
    }
}

fn count(counts: &TriangleCounts) -> Triangles {
    Triangles {
        total: counts.total,
        drawn: counts.drawn,
        skipped: SkippedTriangles {
            outside: counts.outside,
            backfacing: counts.backfacing,
            degenerate: counts.degenerate,
            untouching: counts.untouching,
        },
    }
}

/// The median time of each pass and of their sum without output, over the renderings. A pass that runs several times in a frame
/// counts once, with its total.
fn medians(renderings: &[Vec<PassTime>]) -> BTreeMap<&'static str, f64> {
    let mut times: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for rendering in renderings {
        let mut sums = BTreeMap::from([("total", PassTime::total(rendering))]);
        for time in rendering {
            *sums.entry(time.pass).or_default() += time.ms;
        }
        for (pass, sum) in sums {
            times.entry(pass).or_default().push(sum);
        }
    }
    times.into_iter().map(|(pass, times)| (pass, Spread::of(times).median)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_sums() {
        let time = |pass, ms| PassTime { pass, ms };
        let rendering = |ms| {
            let [shade, shade_again] = [1.0, 2.0].map(|ms| time("shade", ms));
            vec![time("raster", ms), shade, shade_again, time(PassTime::COPY, 7.0)]
        };
        let found = medians(&[rendering(9.0), rendering(1.0), rendering(2.0), rendering(4.0)]);
        // A copy is no part of the total.
        let expected = [("copy", 7.0), ("raster", 3.0), ("shade", 3.0), ("total", 6.0)];
        assert_eq!(found, BTreeMap::from(expected));
    }
}
