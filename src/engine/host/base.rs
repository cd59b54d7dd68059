//! One sample a pixel: what the host has drawn, and what is drawn in its stead.

use super::draw::{PlacedDraws, TrianglePart};
use super::{HostError, Shared};
use crate::engine::data::{ColorConstants, Content, FrameUniform, HostImage, Resources};
use crate::engine::passes::{Centres, Raster, RasterPush, RasterRun, RasterTargets, sort, take};
use crate::engine::pipelines::Pass;
use crate::engine::sampler::RecordShading;
use crate::vulkan::Recorder;
use ash::vk;
use std::sync::Arc;

/// Passes that fill triangle IDs, depth and colours of all pixels.
pub(super) struct Base {
    /// Draws IDs and depth; `None` if the host lends IDs.
    raster: Option<Raster>,
    colors: Colors,
}

enum Colors {
    /// Reads the host's image.
    Drawn(Pass),
    /// Has the host's pipelines shade all pixels.
    Shaded { centres: Centres, sort: Pass },
}

impl Base {
    /// Makes the pipelines. `image` is the host's colour image, if it has drawn one. `filters` is `None` if the host lends IDs, else
    /// whether long runs of triangles are filtered before they are drawn. `output` has the colour constants.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub fn new(
        shared: &Shared,
        content: &dyn Content,
        image: Option<&Arc<HostImage>>,
        filters: Option<bool>,
        output: &ColorConstants,
    ) -> Result<Self, HostError> {
        let layout = &shared.frame;
        let single = vk::SampleCountFlags::TYPE_1;
        let raster = |filters| Raster::new(layout, single, content, filters);
        let colors = match image {
            Some(image) => Colors::Drawn(take::pass(layout, image, output)?),
            None => {
                Colors::Shaded { centres: Centres::new(layout, output)?, sort: sort::pass(layout, content, false)? }
            }
        };
        Ok(Self { raster: filters.map(raster).transpose()?, colors })
    }

    /// Records the passes for `placed`, whose uniform block the descriptor set shows. IDs and depth go to `targets` unless the host
    /// lends them.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        resources: &Resources,
        uniform: &FrameUniform,
        placed: &PlacedDraws,
        targets: Option<&RasterTargets>,
        shading: &dyn RecordShading,
    ) {
        let [width, height] = uniform.size;
        if let Some((raster, targets)) = self.raster.as_ref().zip(targets) {
            let runs = runs(placed, &uniform.transform);
            let drawn = [[0, 0], uniform.size];
            raster.record(recorder, runs.iter().copied(), targets, uniform.size, drawn);
        }
        match &self.colors {
            Colors::Drawn(take) => {
                take.record_for(recorder, width * height);
            }
            Colors::Shaded { centres, sort } => {
                centres.record(recorder, resources, width * height, |recorder| {
                    sort.record(recorder);
                    shading.record(recorder, resources);
                });
            }
        }
    }
}

/// Runs of the draws that are not blended. Neighbouring draws with the same culling and alpha test become one run.
fn runs(placed: &PlacedDraws, transform: &[f32; 16]) -> Vec<RasterRun> {
    let push = RasterPush { matrix: *transform, instance: [0, placed.triangles, 0, 0] };
    let mut runs: Vec<RasterRun> = Vec::new();
    for part in placed.parts.iter().filter(|part| part.first_triangle < placed.solid) {
        let &TrianglePart { first_triangle, triangle_count, double_sided } = part;
        let masked = first_triangle >= placed.opaque;
        match runs.last_mut() {
            Some(run) if (run.double_sided, run.masked) == (double_sided, masked) => {
                run.triangle_count += triangle_count;
            }
            _ => runs.push(RasterRun {
                push,
                first_index: first_triangle,
                triangle_count,
                double_sided,
                masked,
                blended: false,
            }),
        }
    }
    runs
}
