//! filter: lists the triangles that may cover a pixel's centre, so that `raster` draws no others.
//!
//! It is no `Pass`: its runs of triangles are known only when a frame is recorded.

use super::RasterRun;
use crate::engine::data::Content;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::{Recorder, Specialized, VulkanError};
use ash::vk;

/// Lists triangles of runs of at least [`FILTER_TRIANGLES`](spirv::FILTER_TRIANGLES) triangles, for `raster`.
pub(super) struct Filter {
    kernel: Kernel<spirv::Filter>,
}

/// Indirect draws of the listed triangles of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FilteredDraws {
    first: u32,
    count: u32,
}

impl FilteredDraws {
    /// Offsets of the draws in the buffer of indirect draws, in bytes.
    pub fn offsets(self) -> impl Iterator<Item = u64> {
        let draws = self.first..self.first + self.count;
        draws.map(|draw| u64::from(draw) * size_of::<vk::DrawIndexedIndirectCommand>() as u64)
    }
}

/// Runs, and the indirect draws of those that are filtered.
pub(super) fn placed(
    runs: impl Iterator<Item = RasterRun>,
    filters: bool,
) -> impl Iterator<Item = (RasterRun, Option<FilteredDraws>)> {
    runs.scan(0, move |first, run| {
        let is_long = run.triangle_count >= spirv::FILTER_TRIANGLES;
        let draws = (filters && is_long)
            .then(|| FilteredDraws { first: *first, count: run.triangle_count.div_ceil(spirv::FILTER_TRIANGLES) });
        *first += draws.map_or(0, |draws| draws.count);
        Some((run, draws))
    })
}

impl Filter {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout, scene: &dyn Content) -> Result<Self, VulkanError> {
        let teams = layout.gpu.limits().teams;
        let kernel = layout.kernel(&spirv::Filter {
            local_size: teams.workgroup(),
            team: teams.members,
            teams: teams.in_workgroup,
            instanced: scene.is_instanced(),
        })?;
        Ok(Self { kernel })
    }

    /// Records the pass.
    pub fn record(&self, recorder: &Recorder<'_>, runs: impl Iterator<Item = (RasterRun, Option<FilteredDraws>)>) {
        recorder.pass(spirv::Filter::INTERFACE, || {
            recorder.unordered(|| {
                for (run, draws) in runs {
                    let Some(draws) = draws else {
                        continue;
                    };
                    let push = spirv::FilterPush {
                        first_triangle: run.first_index,
                        triangle_count: run.triangle_count,
                        first_draw: draws.first,
                        snap: recorder.limits().snap,
                    };
                    self.kernel.record_teams(recorder, &push, draws.count);
                }
            });
        });
    }
}
