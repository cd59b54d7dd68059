//! sample: finds the nearest triangle of every sample.

use super::arguments::{self, CountedBy};
use super::{sample_lines, scatter};
use crate::engine::data::{Argument, Cells, Content};
use crate::engine::pipelines::{Dispatch, FrameLayout, Pass, Size};
use crate::engine::spirv;
use crate::sampling::Bend;
use crate::vulkan::{Specialized, Teams, VulkanError};

/// Lists into which `enlist` sorts tiles, in the order of `shaders/include/load.glsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum TileList {
    /// Tiles with opaque triangles only.
    Plain = spirv::TILE_LIST_PLAIN,
    /// Tiles that also have alpha-tested triangles.
    Masked = spirv::TILE_LIST_MASKED,
    /// Tiles that also have BLEND triangles.
    Blended = spirv::TILE_LIST_BLENDED,
    /// Tiles with more triangles than a list may have, or whose list outgrew its buffer.
    Unlisted = spirv::TILE_LIST_UNLISTED,
}

impl TileList {
    /// Size of a dispatch of `sample` over the list's entries.
    fn cells(self) -> Size {
        Size::Indirect(Argument::SamplePlain as u32 + self as u32)
    }

    /// Size of a dispatch over the entries of the list that the first run left.
    fn left(self) -> Size {
        Size::Indirect(Argument::PlainLeft as u32 + self as u32)
    }

    /// Size of a dispatch in which a team takes an entry of the list.
    pub(crate) fn entries(self) -> Size {
        Size::Indirect(Argument::ResolvePlain as u32 + self as u32)
    }
}

/// Options of the kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleOptions {
    /// Kind of the cells.
    pub cells: Cells,
    /// Number of samples of a cell; for cells of points, the largest number of points.
    pub samples: u32,
    /// Whether the samples of cells that `sample_lines` can process lie on lines.
    pub lines: bool,
    /// Rate of visibility samples.
    pub fragments: FragmentRate,
    /// Whether a team samples a single cell, however short the lists of candidates are. A GPU runs thousands of teams at
    /// once, and would wait for the fullest tile; on a CPU, the cells share the work of a tile.
    pub one_cell: bool,
    /// How cells with long lists of candidates are sampled.
    pub long_lists: LongLists,
    /// Whether tiles without a list are sampled, with `scatter`. Otherwise they are skipped and counted.
    pub samples_unlisted: bool,
    /// Whether the scene has MASK triangles.
    pub has_mask: bool,
    /// Whether the scene has BLEND triangles.
    pub has_blend: bool,
    /// Whether all cells show a BLEND triangle; then only lists with BLEND triangles are sampled.
    pub always_blends: bool,
    /// For a pixel filter, the function by which the spread of visibility samples over their cells is described; `None` if it is not
    /// stored.
    pub spread: Option<Bend>,
}

/// Sampling of cells with long lists of candidates. Loops over these must stay within the number of iterations that
/// drivers allow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LongLists {
    /// Like other cells.
    #[default]
    SeveralCells,
    /// A team samples a block of a single cell.
    OneCell,
    /// A team samples a block of a single cell, and tiles have no list if loops over it might exceed the
    /// number of iterations.
    Scattered,
}

impl LongLists {
    /// Next option to try if loops over lists exceeded the number of iterations.
    pub(crate) fn shorter(self) -> Self {
        match self {
            Self::SeveralCells => Self::OneCell,
            Self::OneCell | Self::Scattered => Self::Scattered,
        }
    }

    pub(super) fn takes_one_cell(self) -> bool {
        self != Self::SeveralCells
    }

    /// Largest numbers of candidates in the list of a tile: of a tile without BLEND triangles, and of one with them.
    /// Tiles with more candidates have no list.
    pub(crate) fn longest(self) -> [u32; 2] {
        match self {
            Self::SeveralCells | Self::OneCell => [spirv::LONGEST_LIST; 2],
            Self::Scattered => [spirv::SHORT_LIST, spirv::SHORT_LAYERED],
        }
    }
}

/// Number of visibility samples that represent the samples of a block that see the same triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FragmentRate {
    /// One visibility sample.
    Triangle,
    /// One visibility sample for each part of a cell. A part has 1 sample in cells of fewer than 32 samples, and 2 or 4 in
    /// larger ones.
    Part,
    /// One for each sample.
    Sample,
}

/// Cells that a kernel processes: those of tiles of one list.
#[derive(Clone, Copy)]
struct ListRun {
    list: TileList,
    /// Whether only cells that `sample_lines` left are processed.
    left_cells: bool,
    /// Whether the list's tiles have MASK triangles.
    masked: bool,
}

/// Division of the samples of cells into blocks, which other passes have to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleBlocks {
    /// Options of the kernels.
    pub options: SampleOptions,
    /// Number of samples of a block, which has one header.
    pub block: u32,
    /// Numbers of teams for an entry of a list: in the first run, for cells that this run left, and for tiles without a list.
    pub teams: [u32; 3],
}

/// Number of blocks of several cells that a team processes, as in `shaders/sample.comp`.
const BLOCKS_AT_ONCE: u32 = 4;

/// Preferred number of samples of a block. A block is larger only if invocations would be idle otherwise.
const BLOCK: u32 = 64;

impl SampleBlocks {
    /// Blocks of kernels that work by these teams.
    #[must_use]
    pub fn new(teams: Teams, options: SampleOptions) -> Self {
        let members = teams.members;
        let block = members * options.samples.min(BLOCK).div_ceil(members).next_power_of_two();
        let one_cell = options.takes_one_cell();
        let blocks_of = |samples: u32| samples.div_ceil(block);
        let taking = |blocks: u32, one_cell: bool| {
            if one_cell { members * blocks } else { blocks.div_ceil(BLOCKS_AT_ONCE) }
        };
        let [left, unlisted] = [one_cell, true].map(|one_cell| taking(blocks_of(options.samples), one_cell));
        let first = if options.by_lines() && one_cell {
            members * options.teams_of_cell(teams)
        } else if options.by_lines() {
            1
        } else {
            left
        };
        Self { options, block, teams: [first, left, unlisted] }
    }

    /// Largest number of visibility samples of a triangle in a block, if all samples of the cell are processed.
    #[must_use]
    pub fn parts(&self) -> u32 {
        match self.options.fragments {
            FragmentRate::Part => (self.block / self.options.part_samples()).max(1),
            FragmentRate::Triangle | FragmentRate::Sample => 1,
        }
    }

    /// Lists of tiles that are sampled.
    pub(crate) fn lists(&self) -> impl Iterator<Item = TileList> {
        self.options.first_runs().into_iter().map(|run| run.list)
    }

    /// Dispatch of the kernel for a run.
    fn kernel(&self, layout: &FrameLayout, scene: &dyn Content, run: &ListRun) -> Result<Dispatch, VulkanError> {
        let ListRun { list, left_cells, masked } = *run;
        let (options, block) = (&self.options, self.block);
        let teams = layout.gpu.limits().teams;
        let shader = spirv::Sample {
            local_size: teams.workgroup(),
            team: teams.members,
            teams: teams.in_workgroup,
            cells_of_entry: teams.members,
            rows: block / teams.members,
            per_sample: options.fragments == FragmentRate::Sample,
            has_mask: masked,
            list: list as u32,
            left_cells,
            by_part: options.by_part(block),
            part: options.part_samples(),
            apart: options.takes_one_cell() || list == TileList::Unlisted,
            long: options.long_lists.takes_one_cell(),
            spread: options.spread_constant(),
            locations: options.cells.are_locations(),
            points: options.cells.are_points(),
            instanced: scene.is_instanced(),
        };
        let size = if left_cells { list.left() } else { list.cells() };
        if list != TileList::Unlisted && !left_cells && options.by_lines() {
            let lines = options.lines_of_cell();
            let kernel = sample_lines::kernel(layout, &shader, block, lines)?;
            Ok(kernel.dispatch((), size))
        } else {
            let code = match list {
                TileList::Plain | TileList::Masked => spirv::SAMPLE,
                TileList::Blended => spirv::SAMPLE_LAYERED,
                TileList::Unlisted if options.has_blend => spirv::SAMPLE_LAYERED_UNLISTED,
                TileList::Unlisted => spirv::SAMPLE_UNLISTED,
            };
            Ok(layout.kernel_variant(code, &shader)?.dispatch((), size))
        }
    }
}

/// Samples the tiles of the round: with one kernel for each kind of tile that the scene can have, followed by those of a second
/// run, over cells that the first run left. If a run [leaves cells](SampleOptions::by_lines), the marks must be cleared
/// before the first round.
///
/// # Errors
/// If the driver refuses a pipeline.
pub(crate) fn pass(layout: &FrameLayout, scene: &dyn Content, blocks: &SampleBlocks) -> Result<Pass, VulkanError> {
    let options = &blocks.options;
    let first = options.first_runs();
    let runs: Vec<_> = first.iter().copied().chain(options.rest()).collect();
    // These kernels take drivers longest to compile, so that threads compile them in parallel.
    let made: Result<Vec<_>, _> = std::thread::scope(|threads| {
        let making: Vec<_> = runs.iter().map(|run| threads.spawn(move || blocks.kernel(layout, scene, run))).collect();
        let join = |thread: std::thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        making.into_iter().map(join).collect()
    });
    let mut kernels = made?;
    let rest = kernels.split_off(first.len());
    let unlisted = options.samples_unlisted.then(|| kernels.pop()).flatten();
    let mut pass = Pass::named(spirv::Sample::INTERFACE);
    for kernel in kernels {
        pass = pass.dispatch(kernel);
    }
    if !rest.is_empty() {
        let sizes = arguments::of_samples(layout, CountedBy::Lines, blocks.teams)?;
        pass = pass.dispatch(sizes);
    }
    for kernel in rest {
        pass = pass.dispatch(kernel);
    }
    // Tiles without a list come last, because `scatter` overwrites the memory of lists.
    if let Some(kernel) = unlisted {
        pass = pass.then(scatter::pass(layout, scene, blocks)?).dispatch(kernel);
    }
    Ok(pass)
}

impl SampleOptions {
    /// Whether a team samples a single cell.
    fn takes_one_cell(&self) -> bool {
        self.one_cell || self.long_lists.takes_one_cell()
    }

    /// Runs over tiles that have a list of candidates.
    fn listed(&self, left_cells: bool) -> impl Iterator<Item = ListRun> {
        let run_of = move |list, masked| ListRun { list, left_cells, masked };
        let plain = (!self.always_blends).then(|| run_of(TileList::Plain, false));
        let has_masked = self.has_mask && !self.always_blends;
        let masked = has_masked.then(|| run_of(TileList::Masked, true));
        let blended = self.has_blend.then(|| run_of(TileList::Blended, self.has_mask));
        plain.into_iter().chain(masked).chain(blended)
    }

    /// First runs, one for each list of tiles; that of tiles without a list is the last.
    fn first_runs(&self) -> Vec<ListRun> {
        let unlisted = ListRun { list: TileList::Unlisted, left_cells: false, masked: self.has_mask };
        self.listed(false).chain(self.samples_unlisted.then_some(unlisted)).collect()
    }

    /// Second runs, over cells that the first runs left.
    fn rest(&self) -> impl Iterator<Item = ListRun> {
        self.by_lines().then(|| self.listed(true)).into_iter().flatten()
    }

    /// Whether cells are shaded by parts, which makes no difference if a part is at least a block.
    fn by_part(&self, block: u32) -> bool {
        self.fragments == FragmentRate::Part && self.part_samples() < block
    }

    /// The constant by which kernels know how spread is described.
    fn spread_constant(&self) -> u32 {
        match self.spread {
            None => spirv::SPREAD_NONE,
            Some(Bend::Square) => spirv::SPREAD_SQUARE,
            Some(Bend::Absolute) => spirv::SPREAD_ABSOLUTE,
        }
    }

    /// Whether `sample_lines` processes cells that no BLEND triangle touches. It leaves the others, and some more, to a second run,
    /// and marks them.
    pub fn by_lines(&self) -> bool {
        !self.cells.are_points()
            && !self.always_blends
            && self.fragments != FragmentRate::Sample
            && self.lines
            && self.samples >= 4
    }

    /// Number of samples of a part: there are 16 parts for 16 samples, 32 for 64, 128 for 256 and 256 for 1,024.
    pub(crate) fn part_samples(&self) -> u32 {
        let few = if self.samples < 32 { 1 } else { 2 };
        (self.samples / 256).max(few).next_power_of_two()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_no_more_parts_than_lines_can_tell_apart() {
        // A part is at least 4 bits wide on lines of 64 bits, so that a cell is cut at most 16 times along them, and as often across.
        const MOST_PARTS: u32 = 256;
        for samples in (0..=10).map(|log| 1 << log) {
            let options = SampleOptions {
                cells: Cells::Pixels,
                samples,
                lines: true,
                fragments: FragmentRate::Part,
                one_cell: false,
                long_lists: LongLists::SeveralCells,
                samples_unlisted: false,
                has_mask: false,
                has_blend: false,
                always_blends: false,
                spread: None,
            };
            assert!(samples / options.part_samples() <= MOST_PARTS, "{samples}");
        }
    }
}
