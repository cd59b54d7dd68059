//! Quadtree over samples without a pattern.

use super::{Sample, SetError};

/// Largest number of splits of the window: samples that are closer than 2^-32 of its side stay together.
const DEEPEST: u32 = 32;

/// Square that holds samples: `low <= (u, v) < low + side`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Upper left corner in pixels.
    pub low: [f64; 2],
    /// Side in pixels.
    pub side: f64,
}

impl Leaf {
    /// Whether the leaf contains a location; its right and lower sides are excluded.
    #[must_use]
    pub fn contains(&self, uv: [f64; 2]) -> bool {
        (0..2).all(|i| uv[i] >= self.low[i] && uv[i] < self.low[i] + self.side)
    }

    fn centre(&self) -> [f64; 2] {
        self.low.map(|v| v + 0.5 * self.side)
    }

    /// Quarter of the square; bit 0 of `which` chooses the right half, bit 1 the lower one.
    fn quarter(&self, which: usize) -> Self {
        let centre = self.centre();
        let corner = |axis: usize| {
            if which >> axis & 1 == 1 { centre[axis] } else { self.low[axis] }
        };
        Self { low: [corner(0), corner(1)], side: 0.5 * self.side }
    }
}

/// Leaves, depth first, and the samples of each. Samples outside of the window follow after the last leaf.
pub(super) struct Tree {
    pub leaves: Vec<Leaf>,
    pub members: Vec<u32>,
    pub starts: Vec<u32>,
}

/// Square that may have to be split; its samples are a range of the members.
struct Branch {
    square: Leaf,
    start: usize,
    end: usize,
    depth: u32,
}

pub(super) fn build(samples: &[Sample], window: Option<[[f64; 2]; 2]>, most: usize) -> Result<Tree, SetError> {
    if most == 0 {
        return Err(SetError::LeafSize);
    }
    let root = match window {
        Some([low, high]) => square(low, high).ok_or(SetError::Window { low, high })?,
        None => around(samples),
    };
    let is_inside = |index: &u32| root.contains(samples[*index as usize].uv);
    let (mut members, outside): (Vec<u32>, Vec<u32>) = (0..samples.len() as u32).partition(is_inside);
    let inside = members.len();
    members.extend(outside);
    let mut tree = Tree { leaves: Vec::new(), members, starts: vec![0] };
    let mut open = vec![Branch { square: root, start: 0, end: inside, depth: 0 }];
    let mut sorted = Vec::new();
    while let Some(branch) = open.pop() {
        let run = &mut tree.members[branch.start..branch.end];
        if run.len() <= most || branch.depth == DEEPEST || coincide(samples, run) {
            tree.leaves.push(branch.square);
            tree.starts.push(branch.end as u32);
            continue;
        }
        let centre = branch.square.centre();
        let quarter_of = |index: u32| {
            let [u, v] = samples[index as usize].uv;
            usize::from(u >= centre[0]) + 2 * usize::from(v >= centre[1])
        };
        // A counting sort keeps the order of samples within each quarter.
        let mut ends = [0; 4];
        sorted.clear();
        for (quarter, end) in ends.iter_mut().enumerate() {
            sorted.extend(run.iter().filter(|index| quarter_of(**index) == quarter));
            *end = branch.start + sorted.len();
        }
        run.copy_from_slice(&sorted);
        for quarter in (0..4).rev() {
            let start = match quarter {
                0 => branch.start,
                _ => ends[quarter - 1],
            };
            open.push(Branch {
                square: branch.square.quarter(quarter),
                start,
                end: ends[quarter],
                depth: branch.depth + 1,
            });
        }
    }
    if inside < samples.len() {
        tree.starts.push(samples.len() as u32);
    }
    Ok(tree)
}

/// Square that holds a window, with the window's longer side as its side.
fn square(low: [f64; 2], high: [f64; 2]) -> Option<Leaf> {
    let sides = [high[0] - low[0], high[1] - low[1]];
    let valid = low.iter().all(|v| v.is_finite()) && sides.iter().all(|v| v.is_finite() && *v > 0.0);
    valid.then(|| Leaf { low, side: sides[0].max(sides[1]) })
}

/// Square that holds all samples. Its corner and side are whole pixels, so that no sample lies on its excluded sides.
fn around(samples: &[Sample]) -> Leaf {
    let extreme = |axis: usize, better: fn(f64, f64) -> f64| {
        let values = samples.iter().map(|sample| sample.uv[axis]);
        values.reduce(better).unwrap_or_default()
    };
    let low = [0, 1].map(|axis| extreme(axis, f64::min).floor());
    let high = [0, 1].map(|axis| extreme(axis, f64::max).floor() + 1.0);
    Leaf { low, side: (high[0] - low[0]).max(high[1] - low[1]) }
}

/// Whether all samples have the same location, so that no split separates them.
fn coincide(samples: &[Sample], members: &[u32]) -> bool {
    let mut places = members.iter().map(|index| samples[*index as usize].uv);
    let first = places.next();
    places.all(|uv| Some(uv) == first)
}
