//! Effort of rendering an image.

use gpc::render::{PassTime, Settings, Statistics, TriangleCounts};
use serde::Serialize;
use std::collections::BTreeMap;

/// Work that was done for an image, and its times.
#[derive(Serialize)]
pub struct Effort {
    /// Samples of a superpixel; of every pixel under methods without superpixels.
    pub samples: u32,
    pub superpixels: Superpixels,
    pub triangles: Triangles,
    /// Milliseconds on the device: `total`, and each pass; medians over repetitions.
    pub gpu_ms: BTreeMap<&'static str, f64>,
    /// Wall-clock milliseconds of rendering, from recording to the image in host memory; the median.
    pub wall_ms: f64,
    pub memory_bytes: u64,
}

#[derive(Serialize)]
pub struct Superpixels {
    pub count: u64,
    /// Share of the pixels or locations.
    pub fraction: f64,
    /// Superpixels that the first few of their samples did not settle.
    resampled: u64,
    /// Visibility samples: the places that are shaded, and the links of BLEND layers.
    records: u64,
}

#[derive(Serialize)]
pub struct Triangles {
    pub total: u64,
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

/// Renderings of one image.
pub struct RenderWork<'a> {
    /// Statistics of the last rendering.
    pub statistics: &'a Statistics,
    /// Pixels or locations.
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
            samples: settings.samples,
            superpixels: Superpixels {
                count: statistics.superpixels,
                fraction: statistics.superpixels as f64 / work.cells.max(1) as f64,
                resampled: statistics.resampled,
                records: statistics.records,
            },
            triangles: count(&statistics.triangles),
            gpu_ms: medians(work.passes),
            wall_ms: median(work.wall_ms.to_vec()),
            memory_bytes: statistics.memory_bytes,
        }
    }

    /// Milliseconds on the device of all passes together.
    pub fn total_gpu_ms(&self) -> f64 {
        self.gpu_ms.get("total").copied().unwrap_or_default()
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
