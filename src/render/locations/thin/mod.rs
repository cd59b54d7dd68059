//! Cells that a thin triangle crosses unseen: what the pass `thin` finds of an image's pixels, for locations anywhere.
//!
//! 1. The locations of a pinhole are put under a tree of boxes ([`tree`]).
//! 2. Each triangle that faces the pinhole is clipped to what it sees ([`outline`]) and looked up in the tree; parts of
//!    the tree in whose cells it can't be thin are passed over.
//! 3. The cells that it crosses are marked by a rule ([`rule`]).
//!
//! All of it runs on the host, in 64 bits: the locations come from there and the result goes back there.

mod outline;
mod rule;
mod tree;

use crate::camera::{Pinhole, SampleLocation};
use crate::render::PixelAttributes;
use crate::render::locations::Triangles;
use glam::{DVec2, DVec3};
use outline::{Outline, View, Window};
use rayon::prelude::*;
use rule::{Crossing, THIN};
use tree::LocationTree;

/// What triangles are clipped to, beyond the locations on each side, in extents of these: so far out that what is left of a
/// wide triangle, of which locations see the edge, is not thin.
const MARGIN: f64 = 2.0;

/// What the cells of an output show, row by row.
pub(super) struct Output<'a> {
    pub width: u32,
    pub attributes: &'a [PixelAttributes],
    pub blend_ids: &'a [u32],
}

impl Output<'_> {
    /// Whether a cell lies amid a triangle other than `id`: it and both its neighbours to the sides, or above and below,
    /// show the same one. Beyond the border everything is as it is there.
    fn amid_another(&self, cell: u32, id: u32) -> bool {
        let shown = |cell: u32| self.attributes.get(cell as usize).map(|seen| seen.id);
        let (here, column) = (shown(cell), cell % self.width);
        let same = |near: Option<u32>| near.and_then(shown).is_none_or(|near| Some(near) == here);
        let beside = || {
            let right = (column + 1 < self.width).then(|| cell + 1);
            same((column > 0).then(|| cell - 1)) && same(right)
        };
        let above = || same(cell.checked_sub(self.width)) && same(cell.checked_add(self.width));
        here.is_some_and(|here| here != 0 && here != id) && (beside() || above())
    }
}

/// The output cells of locations, each of which sees what `output` says of its cell, that thin triangles cross unseen; a
/// cell may come several times.
pub(super) fn crossed(
    triangles: &Triangles,
    pinhole: &Pinhole,
    locations: &[SampleLocation],
    output: &Output<'_>,
) -> Vec<u32> {
    let view = View::new(pinhole, triangles.origin);
    let tree = LocationTree::new(locations, |location| {
        let shown = output.attributes.get(location.output as usize);
        view.behind(shown.map_or(0.0, |shown| shown.depth))
    });
    let [low, high] = tree.bounds();
    let window = view.window([low, high]);
    let around = MARGIN * (high - low);
    let search = Search {
        window: view.window([low - around, high + around]),
        view,
        tree,
        locations,
        output,
    };
    let chunks = triangles.chunks.par_iter();
    let shown = chunks.filter(|chunk| search.view.may_show(&window, chunk.bounds));
    let marked = shown.map_init(Scratch::default, |scratch, chunk| {
        let mut marked = Vec::new();
        for index in chunk.range.clone() {
            let Some(corners) = triangles.get(index) else {
                continue;
            };
            let triangle = Triangle {
                id: index as u32 + 1,
                corners,
                double_sided: chunk.double_sided,
            };
            search.mark(&triangle, scratch, &mut marked);
        }
        marked
    });
    marked.collect::<Vec<_>>().concat()
}

/// The locations of one pinhole, among which triangles are looked up.
struct Search<'a> {
    view: View,
    window: Window,
    tree: LocationTree,
    locations: &'a [SampleLocation],
    output: &'a Output<'a>,
}

/// What is looked up.
struct Triangle {
    id: u32,
    corners: [DVec3; 3],
    double_sided: bool,
}

/// Memory that one triangle after another uses.
#[derive(Default)]
struct Scratch {
    outline: Outline,
    in_cell: Vec<DVec2>,
}

impl Search<'_> {
    /// Adds the cells that a triangle marks.
    fn mark(&self, triangle: &Triangle, scratch: &mut Scratch, marked: &mut Vec<u32>) {
        let Scratch { outline, in_cell } = scratch;
        let Triangle { id, .. } = *triangle;
        let corners = triangle.corners;
        if !self
            .view
            .outline(&self.window, corners, triangle.double_sided, outline)
        {
            return;
        }
        self.tree.search(outline, &mut |place| {
            let location = self.locations.get(place as usize);
            let cell = location.and_then(|location| {
                let crossing = self.crossing(id, outline, location, in_cell)?;
                let marks = crossing.marks(|| self.output.amid_another(location.output, id));
                marks.then_some(location.output)
            });
            marked.extend(cell);
        });
    }

    /// How a triangle crosses the cell of a location, if it does and is thin there.
    fn crossing(
        &self,
        id: u32,
        outline: &Outline,
        location: &SampleLocation,
        in_cell: &mut Vec<DVec2>,
    ) -> Option<Crossing> {
        let (nearness, height) = outline.across(location, in_cell)?;
        let cell = location.output as usize;
        let shown = self.output.attributes.get(cell)?;
        (height < THIN).then(|| Crossing {
            nearness,
            behind: self.view.behind(shown.depth),
            gap: self.view.gap(nearness[0], location),
            layer: self.output.blend_ids.get(cell) == Some(&id),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three by three cells show these triangles; does the one at `cell` lie amid another than triangle 9?
    fn amid(ids: [u32; 9], cell: u32) -> bool {
        let attributes = ids.map(|id| PixelAttributes {
            id,
            ..PixelAttributes::default()
        });
        let output = Output {
            width: 3,
            attributes: &attributes,
            blend_ids: &[],
        };
        output.amid_another(cell, 9)
    }

    #[test]
    fn amid_is_between_two_that_show_the_same() {
        assert!(amid([0, 0, 0, 1, 1, 1, 0, 0, 0], 4));
        assert!(amid([0, 1, 0, 0, 1, 0, 0, 1, 0], 4));
        assert!(!amid([1, 0, 1, 0, 1, 1, 1, 1, 1], 4));
        assert!(!amid([9; 9], 4), "the triangle itself");
        assert!(!amid([0; 9], 4), "background");
        // A cell of a border has its own like beyond it, and none of the row before or after.
        assert!(amid([0, 1, 1, 0, 0, 0, 0, 0, 0], 2));
        assert!(!amid([0, 0, 1, 1, 0, 0, 0, 0, 0], 3));
        assert!(amid([0, 0, 0, 1, 0, 0, 1, 0, 0], 6));
    }
}
