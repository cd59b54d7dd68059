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
use outline::{Outline, View, Window};
use rayon::prelude::*;
use rule::{Crossing, THIN};
use std::ops::Range;
use tree::SiteTree;

/// Triangles that one thread takes at a time.
const CHUNK: usize = 1024;

/// The triangles of a posed scene as the host needs them to look for thin ones.
#[derive(Clone, Debug, Default)]
pub(in crate::render) struct Triangles {
    origin: DVec3,
    positions: Vec<[f32; 3]>,
    corners: Vec<[u32; 3]>,
    chunks: Vec<Chunk>,
}

/// Neighbouring triangles that are alike.
#[derive(Clone, Debug)]
struct Chunk {
    range: Range<usize>,
    double_sided: bool,
    /// Corners of the box around them.
    bounds: [DVec3; 2],
}

impl Triangles {
    /// The triangles of a pose.
    pub fn new(geometry: &Geometry) -> Self {
        use DrawClass::{BlendDoubleSided, MaskDoubleSided, OpaqueDoubleSided};
        let two = [OpaqueDoubleSided, MaskDoubleSided, BlendDoubleSided];
        let mut triangles = Self {
            origin: geometry.origin,
            positions: geometry.positions.clone(),
            corners: geometry.triangles.clone(),
            chunks: Vec::new(),
        };
        for draw in &geometry.draws {
            let first = draw.first_triangle as usize;
            let end = first + draw.triangle_count as usize;
            for start in (first..end).step_by(CHUNK) {
                let range = start..end.min(start + CHUNK);
                let chunk = Chunk {
                    bounds: triangles.bounds(range.clone()),
                    range,
                    double_sided: two.contains(&draw.class),
                };
                triangles.chunks.push(chunk);
            }
        }
        triangles
    }

    /// Corners of the box around a range of triangles.
    fn bounds(&self, range: Range<usize>) -> [DVec3; 2] {
        let corners = self.corners.get(range).unwrap_or(&[]).iter().flatten();
        let places = corners.map(|corner| self.position(*corner));
        places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        })
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
    let view = View::new(pinhole, triangles.origin);
    let tree = SiteTree::new(sites, |site| {
        let shown = output.attributes.get(site.output as usize);
        view.behind(shown.map_or(0.0, |shown| shown.depth))
    });
    let search = Search {
        window: view.window(tree.bounds()),
        view,
        tree,
        sites,
        output,
        contrast,
    };
    let chunks = triangles.chunks.par_iter();
    let shown = chunks.filter(|chunk| search.view.may_show(&search.window, chunk.bounds));
    let marked = shown.map_init(Scratch::default, |scratch, chunk| {
        let mut marked = Vec::new();
        let corners = triangles.corners.get(chunk.range.clone()).unwrap_or(&[]);
        for (index, corners) in chunk.range.clone().zip(corners) {
            let corners = corners.map(|corner| triangles.position(corner));
            search.mark(
                index as u32 + 1,
                corners,
                chunk.double_sided,
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
    window: Window,
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
        if !self
            .view
            .outline(&self.window, corners, double_sided, outline)
        {
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
            behind: self.view.behind(shown.depth),
            gap: self.view.gap(nearness[0], site),
        })
    }
}
