//! Cells that a thin triangle crosses unseen: what the pass `thin` finds of an image's pixels, for sites anywhere.
//!
//! 1. The sites of a pinhole are put under a tree of boxes ([`tree`]).
//! 2. Each triangle that faces the pinhole is clipped to what it sees ([`outline`]) and looked up in the tree; parts of
//!    the tree in whose cells it can't be thin are passed over.
//! 3. The cells that it crosses, in their order along the triangle, are marked by a rule ([`rule`]).
//!
//! All of it runs on the host, in 64 bits: the locations come from there and the result goes back there.

mod outline;
mod rule;
mod tree;

use crate::camera::{Pinhole, Site};
use crate::render::PixelAttributes;
use crate::scene::{DrawClass, Geometry};
use glam::DVec3;
use outline::{Outline, View};
use rayon::prelude::*;
use rule::{Crossing, THIN};
use tree::SiteTree;

/// Triangles that one thread takes at a time.
const CHUNK: usize = 1024;

/// The triangles of a posed scene as the host needs them to look for thin ones.
#[derive(Clone, Debug, Default)]
pub(in crate::render) struct Triangles {
    origin: DVec3,
    positions: Vec<[f32; 3]>,
    corners: Vec<[u32; 3]>,
    /// Runs of triangles that are alike: the first one's index, their number, and whether they have two sides.
    runs: Vec<(usize, usize, bool)>,
}

impl Triangles {
    /// The triangles of a pose.
    pub fn new(geometry: &Geometry) -> Self {
        use DrawClass::{BlendDoubleSided, MaskDoubleSided, OpaqueDoubleSided};
        let two = [OpaqueDoubleSided, MaskDoubleSided, BlendDoubleSided];
        let draws = geometry.draws.iter().map(|draw| {
            let [first, count] = [draw.first_triangle, draw.triangle_count].map(|n| n as usize);
            (first, count, two.contains(&draw.class))
        });
        Self {
            origin: geometry.origin,
            positions: geometry.positions.clone(),
            corners: geometry.triangles.clone(),
            runs: draws.collect(),
        }
    }

    /// Runs of up to [`CHUNK`] triangles.
    fn chunks(&self) -> Vec<(usize, &[[u32; 3]], bool)> {
        let runs = self.runs.iter().flat_map(|(first, count, double_sided)| {
            let run = self.corners.get(*first..first + count).unwrap_or(&[]);
            let starts = (*first..).step_by(CHUNK);
            let chunks = starts.zip(run.chunks(CHUNK));
            chunks.map(|(first, corners)| (first, corners, *double_sided))
        });
        runs.collect()
    }

    fn position(&self, corner: u32) -> DVec3 {
        let position = self.positions.get(corner as usize);
        DVec3::from_array(position.copied().unwrap_or_default().map(f64::from))
    }
}

/// What the cells of an output show, row by row.
pub(super) struct Output<'a> {
    pub width: u32,
    pub attributes: &'a [PixelAttributes],
    pub blend_ids: &'a [u32],
    pub codes: &'a [u32],
}

impl Output<'_> {
    fn id(&self, cell: u32) -> u32 {
        let seen = self.attributes.get(cell as usize);
        seen.map_or(0, |seen| seen.id)
    }

    /// Whether a cell and its four neighbours, as far as there are any, show the same triangle.
    fn amid_one(&self, cell: u32) -> bool {
        let (here, column, width) = (self.id(cell), cell % self.width, self.width);
        let neighbours = [
            (column > 0).then(|| cell - 1),
            (column + 1 < width).then(|| cell + 1),
            cell.checked_sub(width),
            cell.checked_add(width)
                .filter(|below| (*below as usize) < self.attributes.len()),
        ];
        here != 0
            && neighbours
                .into_iter()
                .flatten()
                .all(|near| self.id(near) == here)
    }
}

/// The output cells of sites, each of which sees what `output` says of its cell, that thin triangles cross unseen; a
/// cell may come several times. `contrast` is the threshold between two colours in code values, `None` where colours do
/// not count.
pub(super) fn crossed(
    triangles: &Triangles,
    pinhole: &Pinhole,
    sites: &[Site],
    output: &Output<'_>,
    contrast: Option<u8>,
) -> Vec<u32> {
    let tree = SiteTree::new(sites);
    let search = Search {
        view: View::new(pinhole, triangles.origin, tree.bounds()),
        tree,
        sites,
        output,
        contrast,
    };
    let chunks = triangles.chunks();
    let marked =
        chunks
            .par_iter()
            .map_init(Scratch::default, |scratch, (first, chunk, double_sided)| {
                let mut marked = Vec::new();
                for (index, corners) in (*first..).zip(*chunk) {
                    let corners = corners.map(|corner| triangles.position(corner));
                    search.mark(
                        index as u32 + 1,
                        corners,
                        *double_sided,
                        scratch,
                        &mut marked,
                    );
                }
                marked
            });
    marked.collect::<Vec<_>>().concat()
}

/// The sites of one pinhole, among which triangles are looked up.
struct Search<'a> {
    view: View,
    tree: SiteTree,
    sites: &'a [Site],
    output: &'a Output<'a>,
    contrast: Option<u8>,
}

/// Memory that one triangle after another uses.
#[derive(Default)]
struct Scratch {
    outline: Outline,
    corners: Vec<glam::DVec2>,
    /// With the place along the triangle and the site's in its list.
    crossings: Vec<(f64, u32, Crossing)>,
    ordered: Vec<Crossing>,
}

impl Search<'_> {
    /// Adds the cells that a triangle marks.
    fn mark(
        &self,
        id: u32,
        corners: [DVec3; 3],
        double_sided: bool,
        scratch: &mut Scratch,
        marked: &mut Vec<u32>,
    ) {
        let Scratch {
            outline,
            corners: in_cell,
            crossings,
            ordered,
        } = scratch;
        if !self.view.outline(corners, double_sided, outline) {
            return;
        }
        crossings.clear();
        self.tree.search(outline, &mut |place| {
            let site = self.sites.get(place as usize);
            let crossing = site.and_then(|site| {
                let crossing = self.crossing(id, outline, site, in_cell)?;
                Some((outline.along(site.uv), place, crossing))
            });
            crossings.extend(crossing);
        });
        crossings.sort_unstable_by(|(a, first, _), (b, second, _)| {
            a.total_cmp(b).then(first.cmp(second))
        });
        ordered.clear();
        ordered.extend(crossings.iter().map(|(_, _, crossing)| *crossing));
        let amid_one = |cell| self.output.amid_one(cell);
        marked.extend(rule::marked(ordered, self.contrast, amid_one));
    }

    /// How a triangle crosses the cell of a site, if it does and is thin there.
    fn crossing(
        &self,
        id: u32,
        outline: &Outline,
        site: &Site,
        in_cell: &mut Vec<glam::DVec2>,
    ) -> Option<Crossing> {
        let (nearness, height) = outline.across(site, in_cell)?;
        let cell = site.output as usize;
        let shown = self.output.attributes.get(cell)?;
        (height < THIN).then(|| Crossing {
            cell: site.output,
            seen: shown.id == id,
            layer: self.output.blend_ids.get(cell) == Some(&id),
            code: self.output.codes.get(cell).copied().unwrap_or(0),
            nearness,
            behind: self.view.nearness(f64::from(shown.depth)),
            gap: self.view.gap(nearness[0], site),
        })
    }
}
