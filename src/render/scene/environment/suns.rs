//! Small bright parts of an environment, such as the sun or lamps.
//!
//! Averages of a few hundred directions either miss such a part or see it many times, so that reflections of it are ragged.
//! These parts are therefore taken out of the map, and shaders add their reflections in closed form. Parts that touch each other
//! are a group, which counts as one light where a lobe is wide or far away. Elsewhere the group is a tree of lights.

use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::equirectangular::Equirectangular;

/// Light from around a direction: that of a part, or of several that count as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the middle of the light, in the map's space.
    pub direction: DVec3,
    /// Radiance times solid angle.
    pub light: DVec3,
    /// Variance of the directions of the light along one axis.
    pub variance: f64,
    /// Largest distance of the light from [`direction`](Self::direction); 0 for a part.
    pub radius: f64,
    /// Middle of a part in blocks of the map.
    pub place: [f64; 2],
    /// Width and height of a part in radians.
    pub size: [f64; 2],
}

/// Parts that touch each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// All of the parts.
    pub whole: Sun,
    /// Nodes of the group's tree.
    pub nodes: Range<usize>,
}

/// Node of a group's tree. The nodes below it are those from the next one up to `next`; a part has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    pub sun: Sun,
    /// Index of the first node that is not below this one.
    pub next: usize,
}

/// Bright parts of a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Suns {
    /// Number of blocks along the width and the height of the map.
    pub grid: [u32; 2],
    /// Groups of parts, those with the most light first.
    pub groups: Vec<Group>,
    /// Nodes of the groups, each group's in the order of a depth-first walk.
    pub nodes: Vec<Node>,
}

impl Suns {
    /// The parts, which are blocks of the map's texels.
    pub fn parts(&self) -> impl Iterator<Item = &Sun> {
        self.nodes.iter().map(|node| &node.sun).filter(|sun| sun.radius == 0.0)
    }
}

/// Most groups that are taken out; those with the most light come first. Each costs every shading point some time, and shaders have
/// a bit for each.
const GROUPS: usize = 32;
/// Most parts of a group, which are its brightest: enough for a sun of 32 x 32 blocks.
const PER_GROUP: usize = 1 << 10;
/// Most parts of all groups.
const MOST: usize = 1 << 11;
/// Radiance in means of the map, without the parts above it, up to which a block is averaged well enough.
const BRIGHT: f64 = 16.0;
/// Number of blocks along the width of a large map, whose cube has texels of the same size.
const COLUMNS: u32 = 1024;

/// Takes what exceeds the radiance of an ordinary block out of a map. Returns it, and the texels as they were, with their
/// indices.
pub fn take(map: &mut Equirectangular) -> (Suns, Vec<(usize, [f32; 3])>) {
    let grid = Grid::new(map);
    let means = grid.means(map);
    let brightness: Vec<f64> = means.iter().map(|mean| f64::from(mean.iter().copied().fold(0.0, f32::max))).collect();
    let bound = bound(&grid, &brightness);
    let mut groups = grid.groups((0..means.len()).filter(|block| brightness[*block] > bound));
    let light = |group: &Vec<usize>| -> f64 {
        group.iter().map(|&block| (brightness[block] - bound) * grid.solid_angle(block)).sum()
    };
    groups.sort_by_cached_key(|group| (Reverse(light(group).to_bits()), group[0]));
    let mut suns = Suns { grid: [grid.columns, grid.rows], ..Suns::default() };
    let (mut originals, mut left) = (Vec::new(), MOST);
    for mut group in groups.into_iter().take(GROUPS) {
        let room = PER_GROUP.min(left);
        // Of a group with too many parts only what exceeds the others is taken out, so that what is left has no steps.
        let bound = match group.len() > room {
            true => {
                let darker = |a: &usize, b: &usize| brightness[*b].total_cmp(&brightness[*a]);
                brightness[*group.select_nth_unstable_by(room, darker).1]
            }
            false => bound,
        };
        let mut parts = Vec::new();
        for block in group.into_iter().filter(|block| brightness[*block] > bound) {
            let share = 1.0 - bound / brightness[block];
            let (mut place, mut weights) = ([0.0; 2], 0.0);
            let mut color = DVec3::ZERO;
            for index in grid.texels(block) {
                let texel = map.pixels[index];
                originals.push((index, texel));
                let taken = DVec3::from_array(texel.map(f64::from)) * share;
                let weight = taken.element_sum();
                let (x, y) = (index as u32 % map.width, index as u32 / map.width);
                for (place, at) in place.iter_mut().zip([x, y]) {
                    *place += weight * ((f64::from(at) + 0.5) / f64::from(grid.block) - 0.5);
                }
                weights += weight;
                color += taken;
                map.pixels[index] = (DVec3::from_array(texel.map(f64::from)) - taken).as_vec3().to_array();
            }
            let count = f64::from(grid.block * grid.block);
            parts.push(grid.part(block, place.map(|sum| sum / weights), color / count));
        }
        if !parts.is_empty() {
            left -= parts.len();
            let (whole, first) = (together(&parts), suns.nodes.len());
            grow(&mut parts, &mut suns.nodes);
            suns.groups.push(Group { whole, nodes: first..suns.nodes.len() });
        }
    }
    (suns, originals)
}

/// Blocks of a map's texels.
struct Grid {
    /// Number of texels along the side of a block.
    block: u32,
    columns: u32,
    rows: u32,
    width: u32,
}

impl Grid {
    fn new(map: &Equirectangular) -> Self {
        let mut block = 1;
        while map.width / (2 * block) >= COLUMNS
            && map.width.is_multiple_of(2 * block)
            && map.height.is_multiple_of(2 * block)
        {
            block *= 2;
        }
        Self { block, columns: map.width / block, rows: map.height / block, width: map.width }
    }

    /// Indices of a block's texels.
    fn texels(&self, block: usize) -> impl Iterator<Item = usize> + use<> {
        let (column, row) = (block % self.columns as usize, block / self.columns as usize);
        let (side, width) = (self.block as usize, self.width as usize);
        (0..side * side).map(move |i| (row * side + i / side) * width + column * side + i % side)
    }

    /// Groups of blocks that touch each other, if only at a corner.
    fn groups(&self, blocks: impl Iterator<Item = usize>) -> Vec<Vec<usize>> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let mut left: BTreeSet<usize> = blocks.collect();
        let mut groups = Vec::new();
        while let Some(first) = left.pop_first() {
            let mut group = vec![first];
            let mut next = 0;
            while let Some(&block) = group.get(next) {
                let (column, row) = (block % columns, block / columns);
                for row in row.saturating_sub(1)..rows.min(row + 2) {
                    for column in [column + columns - 1, column, column + 1] {
                        let beside = row * columns + column % columns;
                        if left.remove(&beside) {
                            group.push(beside);
                        }
                    }
                }
                next += 1;
            }
            groups.push(group);
        }
        groups
    }

    /// Mean colour of each block.
    fn means(&self, map: &Equirectangular) -> Vec<[f32; 3]> {
        if self.block == 1 {
            return map.pixels.clone();
        }
        let count = (self.block * self.block) as f32;
        let mean = |block| {
            let colors = self.texels(block).map(|index| glam::Vec3::from_array(map.pixels[index]));
            (colors.sum::<glam::Vec3>() / count).to_array()
        };
        (0..(self.columns * self.rows) as usize).into_par_iter().map(mean).collect()
    }

    /// Latitude of the middle of a block.
    fn latitude(&self, row: f64) -> f64 {
        (0.5 - (row + 0.5) / f64::from(self.rows)) * PI
    }

    /// Width and height of a block in radians.
    fn size(&self, latitude: f64) -> [f64; 2] {
        [TAU / f64::from(self.columns) * latitude.cos(), PI / f64::from(self.rows)]
    }

    fn solid_angle(&self, block: usize) -> f64 {
        let [width, height] = self.size(self.latitude((block / self.columns as usize) as f64));
        width * height
    }

    /// Part of a block with this middle and colour.
    fn part(&self, block: usize, place: [f64; 2], color: DVec3) -> Sun {
        let latitude = self.latitude(place[1]);
        let longitude = ((place[0] + 0.5) / f64::from(self.columns) - 0.5) * TAU;
        let ((sin, cos), (up, across)) = (longitude.sin_cos(), latitude.sin_cos());
        let size = self.size(latitude);
        Sun {
            direction: DVec3::new(sin * across, up, -cos * across),
            light: color * self.solid_angle(block),
            // The light of a part is interpolated to the parts beside it.
            variance: (size[0] * size[0] + size[1] * size[1]) / 12.0,
            radius: 0.0,
            place,
            size,
        }
    }
}

/// Brightness up to which blocks are ordinary.
fn bound(grid: &Grid, brightness: &[f64]) -> f64 {
    let rows: Vec<f64> = (0..grid.rows).map(|row| grid.latitude(row.into()).cos()).collect();
    let all = rows.iter().sum::<f64>() * f64::from(grid.columns);
    let mut bound = f64::INFINITY;
    // Each round finds the mean without what the round before called bright.
    for _ in 0..4 {
        let of_row = |row: &[f64]| row.iter().map(|x| x.min(bound)).sum::<f64>();
        let sums = brightness.chunks(grid.columns as usize).zip(&rows).map(|(row, weight)| weight * of_row(row));
        bound = BRIGHT * sums.sum::<f64>() / all;
    }
    bound
}

/// Adds the tree of a group's parts to the nodes.
fn grow(parts: &mut [Sun], nodes: &mut Vec<Node>) {
    let at = nodes.len();
    match parts {
        [] => {}
        [part] => nodes.push(Node { sun: *part, next: at + 1 }),
        _ => {
            nodes.push(Node { sun: together(parts), next: 0 });
            let directions = || parts.iter().map(|part| part.direction);
            let low = directions().fold(DVec3::INFINITY, DVec3::min);
            let high = directions().fold(DVec3::NEG_INFINITY, DVec3::max);
            let axis = (high - low).max_position();
            let middle = parts.len() / 2;
            parts.select_nth_unstable_by(middle, |a, b| a.direction[axis].total_cmp(&b.direction[axis]));
            let (left, right) = parts.split_at_mut(middle);
            grow(left, nodes);
            grow(right, nodes);
            nodes[at].next = nodes.len();
        }
    }
}

/// The light of several parts as one.
fn together(parts: &[Sun]) -> Sun {
    let weight = |part: &Sun| part.light.element_sum();
    let light: DVec3 = parts.iter().map(|part| part.light).sum();
    let mean: DVec3 = parts.iter().map(|part| part.direction * weight(part)).sum();
    let direction = mean.normalize_or(DVec3::Y);
    let (mut variance, mut radius) = (0.0, 0.0_f64);
    for part in parts {
        let apart = part.direction.distance(direction);
        variance += weight(part) * (0.5 * apart * apart + part.variance);
        radius = radius.max(apart + 0.5 * part.size[0].hypot(part.size[1]));
    }
    Sun { direction, light, variance: variance / light.element_sum(), radius, ..parts[0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of radiance 1 with bright texels.
    fn map([width, height]: [u32; 2], bright: &[usize]) -> Equirectangular {
        let mut pixels = vec![[1.0; 3]; (width * height) as usize];
        for &index in bright {
            pixels[index] = [1000.0, 500.0, 0.0];
        }
        Equirectangular { width, height, pixels }
    }

    #[test]
    fn what_is_taken_out_and_what_stays_are_the_map() {
        for (size, index) in [([64, 32], 16 * 64 + 20), ([64, 32], 3), ([2048, 1024], 700 * 2048 + 1501)] {
            let whole = map(size, &[index]);
            let mut rest = whole.clone();
            let (suns, originals) = take(&mut rest);
            let [Node { sun, .. }] = suns.nodes.as_slice() else {
                panic!("{suns:?}");
            };
            let block = f64::from(size[0] / suns.grid[0]);
            assert_eq!(block, if size[0] > 1024 { 2.0 } else { 1.0 });
            let taken = sun.light / (sun.size[0] * sun.size[1]) * block * block;
            let (kept, original) = (rest.pixels[index], whole.pixels[index]);
            assert!(kept[0] < original[0] / 10.0 && (kept[1] - kept[0] / 2.0).abs() < 1e-3, "{kept:?}");
            // The other texels of the block have a little of the light.
            let others = block * block - 1.0;
            for channel in 0..3 {
                let sum = f64::from(kept[channel]) + taken[channel];
                let expected = f64::from(original[channel]);
                assert!((sum - expected).abs() <= 1e-3 * expected + others, "{sum}, not {expected}");
            }
            for (index, texel) in originals {
                rest.pixels[index] = texel;
            }
            assert_eq!(rest, whole);
        }
    }

    #[test]
    fn ordinary_maps_have_no_suns() {
        let (width, height) = (64, 32);
        let pixels = (0..width * height).map(|i| [if i % width < 8 { 50.0 } else { 0.0 }; 3]).collect();
        let mut window = Equirectangular { width, height, pixels };
        let same = window.clone();
        assert_eq!(take(&mut window).0.nodes, []);
        assert_eq!(window, same);
        window.pixels.fill([0.0; 3]);
        assert_eq!(take(&mut window).0.nodes, []);
    }

    /// Groups and nodes have the light of their parts within their radius, and the index of a node leads past its parts.
    #[test]
    fn groups_and_nodes_stand_for_their_parts() {
        // Two blocks with a gap between them, one of which crosses the edge of the map.
        let block = |left: usize| (0..30).map(move |i| (12 + i / 6) * 64 + (left + i % 6) % 64);
        let bright: Vec<usize> = block(20).chain(block(61)).collect();
        let (suns, _) = take(&mut map([64, 32], &bright));
        let ranges: Vec<_> = suns.groups.iter().map(|group| group.nodes.clone()).collect();
        assert_eq!(ranges, [0..59, 59..118]);
        let check = |sun: &Sun, below: &[Node]| {
            let parts: Vec<Sun> = below.iter().map(|node| node.sun).filter(|sun| sun.radius == 0.0).collect();
            let light: DVec3 = parts.iter().map(|part| part.light).sum();
            assert!((light - sun.light).length() < 1e-9 * light.length());
            assert!(parts.iter().all(|part| part.direction.distance(sun.direction) <= sun.radius.max(1e-9)));
            assert_eq!(parts.len(), below.len().div_ceil(2));
        };
        for group in &suns.groups {
            check(&group.whole, &suns.nodes[group.nodes.clone()]);
        }
        for (index, node) in suns.nodes.iter().enumerate() {
            check(&node.sun, &suns.nodes[index..node.next]);
        }
    }

    #[test]
    fn the_groups_with_the_most_light_come_first() {
        let bright: Vec<usize> = (0..100).map(|i| (200 + 3 * (i / 20)) * 1024 + 3 * (i % 20)).collect();
        let mut map = map([1024, 512], &bright);
        map.pixels[300 * 1024 + 700] = [5e4; 3];
        let (suns, _) = take(&mut map);
        assert_eq!((suns.groups.len(), suns.parts().count()), (GROUPS, GROUPS));
        assert!(suns.groups[0].whole.light.x > 10.0 * suns.groups[1].whole.light.x);
    }

    /// Only what exceeds the rest of a large group is taken out of its brightest parts.
    #[test]
    fn large_groups_keep_a_smooth_rest() {
        let side = 60;
        let mut map = map([1024, 512], &[]);
        let place = |i: usize| (200 + i / side) * 1024 + 300 + i % side;
        for i in 0..side * side {
            map.pixels[place(i)] = [1000.0 + i as f32; 3];
        }
        let (suns, _) = take(&mut map);
        assert_eq!(suns.parts().count(), PER_GROUP);
        let rest: Vec<f32> = (0..side * side).map(|i| map.pixels[place(i)][0]).collect();
        let highest = 1000.0 + (side * side - PER_GROUP - 1) as f32;
        assert!(rest.iter().all(|x| *x <= highest + 0.1), "{highest}: {rest:?}");
        assert!((rest[side * side - 1] - highest).abs() < 0.1);
    }
}
