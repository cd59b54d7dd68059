//! Work and time that an image took.

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

/// The renderings of one image, from which its effort is computed.
pub struct RenderWork<'a> {
    /// Statistics of the last rendering.
    pub statistics: &'a Statistics,
    /// Number of pixels or locations.
    pub cells: u64,
    /// Times of the passes, a list for each rendering.
    pub passes: &'a [Vec<PassTime>],
    /// Wall-clock milliseconds of each rendering.
    pub wall_ms: &'a [f64],
}

impl Effort {
    pub fn new(settings: &Settings, work: &RenderWork<'_>) -> Self {
        let statistics = work.statistics;
        Self {
            samples: settings.method.samples(),
            superpixels: Superpixels {
                count: statistics.superpixels,
                fraction: statistics.superpixels as f64 / work.cells.max(1) as f64,
                resampled: statistics.resampled,
                visibility_samples: statistics.visibility_samples,
            },
            triangles: count(&statistics.triangles),
            gpu_ms: medians(work.passes),
            wall_ms: median(work.wall_ms.to_vec()),
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
        let rendering = |ms| {
            let [shade, shade_again] = [1.0, 2.0].map(|ms| time("shade", ms));
            vec![time("raster", ms), shade, shade_again, time(PassTime::COPY, 7.0)]
        };
        let found = medians(&[rendering(9.0), rendering(1.0), rendering(2.0), rendering(4.0)]);
        // A copy is no part of the total.
        let expected = [("copy", 7.0), ("raster", 3.0), ("shade", 3.0), ("total", 6.0)];
        assert_eq!(found, BTreeMap::from(expected));
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
    }
}
