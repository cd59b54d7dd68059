//! sample_lines: finds the nearest triangle of samples that lie on straight lines, for many of them at once.

use super::SampleOptions;
use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::vulkan::{Teams, VulkanError};

/// Makes the kernel, with the constants of the general kernel that it takes the place of. A header represents `header`
/// samples, and a cell has `lines` lines.
///
/// # Errors
/// If the driver refuses it.
pub(super) fn kernel(
    layout: &FrameLayout,
    shader: &spirv::Sample,
    header: u32,
    lines: u32,
) -> Result<Kernel<spirv::SampleLines>, VulkanError> {
    let teams = layout.gpu.limits().teams;
    let teams = if shader.apart { teams.larger(members(lines)) } else { teams };
    let shader = spirv::SampleLines {
        local_size: teams.workgroup(),
        team: teams.members,
        teams: teams.in_workgroup,
        cells_of_entry: shader.cells_of_entry,
        has_mask: shader.has_mask,
        list: shader.list,
        by_part: shader.by_part,
        part: shader.part,
        apart: shader.apart,
        spread: shader.spread,
        header,
        lines,
        locations: shader.locations,
        instanced: shader.instanced,
    };
    layout.kernel(&shader)
}

/// Number of members of a team that samples a cell of `lines` lines by itself, on devices whose subgroups have as many. A member
/// then holds the samples of at most two lines in registers.
fn members(lines: u32) -> u32 {
    (lines / 2).clamp(8, 32)
}

impl SampleOptions {
    /// Number of teams of the device's usual size that take as much room in workgroups as one that samples a cell by itself.
    pub(super) fn teams_of_cell(&self, teams: Teams) -> u32 {
        teams.larger(members(self.lines_of_cell())).members / teams.members
    }

    /// Number of lines of a cell, with 64 samples each. If the scene has alpha-tested triangles, alpha is read `samples` times, and the
    /// reads are spread more evenly over 32 lines than over 64.
    pub(super) fn lines_of_cell(&self) -> u32 {
        match self.samples {
            ..=64 => 8,
            samples if samples <= 256 || self.has_mask => 32,
            _ => 64,
        }
    }

    /// Largest number by which a cell's visibility samples may exceed its samples.
    pub(crate) fn more_fragments(&self) -> u32 {
        if self.by_lines() { spirv::MORE_FRAGMENTS } else { 0 }
    }
}
