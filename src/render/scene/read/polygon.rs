//! Triangles of polygons, which may be concave, touch themselves, and repeat corners where they reach a hole.

use std::collections::HashMap;

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::shape::FileObject;
use crate::scene::error::{Fault, Warnings};

/// Largest number of corners of a polygon that is not convex. The time for such a polygon may grow with the square of
/// this number.
const MOST_CORNERS: usize = 1 << 14;

/// Divides polygons into triangles, and counts those that it can't divide exactly.
#[derive(Default)]
pub struct Triangulator {
    /// Number of corners of a polygon that has too many.
    too_long: Option<usize>,
    earcut: Option<Earcut<f64>>,
    corners: Vec<u32>,
    /// Corners relative to the first.
    spokes: Vec<DVec3>,
    ring: Vec<[f64; 2]>,
    indices: Vec<u32>,
    /// Number of corners without a position.
    unplaced: usize,
    /// Number of polygons whose triangles don't have the area of the polygon.
    crossing: usize,
    /// Number of polygons with fewer than 3 corners.
    short: usize,
}

impl Triangulator {
    /// Adds the triangles of a polygon, whose corners are indices of `positions`, to `triangles`. The triangles have
    /// the winding of the polygon.
    fn add(&mut self, polygon: &[u32], positions: &[[f32; 3]], triangles: &mut Vec<[u32; 3]>) {
        match *polygon {
            [] | [_] | [_, _] => self.short += 1,
            [a, b, c] => triangles.push([a, b, c]),
            _ => self.divide(polygon, positions, triangles),
        }
    }

    /// Adds the triangles of several polygons to a shape. `ends` has the end of each polygon among the corners, which are the
    /// shape's vertices in order, unless `corners` lists them.
    pub fn add_all(&mut self, ends: &[usize], corners: Option<&[u32]>, shape: &mut FileObject) {
        let mut polygon = Vec::new();
        let mut start = 0;
        for &end in ends {
            polygon.clear();
            match corners {
                Some(corners) => polygon.extend(&corners[start..end]),
                None => polygon.extend(start as u32..end as u32),
            }
            self.add(&polygon, &shape.positions, &mut shape.triangles);
            start = end;
        }
    }

    /// Warns of polygons that can't be drawn as they are. Fails if a polygon has too many corners.
    pub fn report(&self, place: &str, warnings: &mut Warnings) -> Result<(), Fault> {
        if let Some(corners) = self.too_long {
            let reason = format!(
                "a polygon that is not convex has {corners} corners, and at most {MOST_CORNERS} are divided into triangles; \
                 divide it in the program that made it"
            );
            return Err(Fault::new(place, reason));
        }
        let mut warn = |count: usize, what: &str| {
            if count > 0 {
                warnings.push(&Fault::new(place, format!("{count} {what}")));
            }
        };
        warn(self.short, "faces have fewer than 3 corners and are left out");
        warn(self.unplaced, "corners of polygons have no position, or an infinite or undefined one, and are left out");
        warn(self.crossing, "polygons cross themselves, and their triangles don't cover them exactly");
        Ok(())
    }

    fn divide(&mut self, polygon: &[u32], positions: &[[f32; 3]], triangles: &mut Vec<[u32; 3]>) {
        self.corners.clear();
        self.spokes.clear();
        let mut first = None;
        for &corner in polygon {
            let position = positions.get(corner as usize);
            let place = position.map(|p| DVec3::from_array(p.map(f64::from)));
            if let Some(place) = place.filter(|place| place.is_finite()) {
                self.corners.push(corner);
                self.spokes.push(place - *first.get_or_insert(place));
            }
        }
        self.unplaced += polygon.len() - self.corners.len();
        // The sum of the fan's triangles is normal to the polygon, with twice its area as its length.
        let fan = || self.spokes.windows(2).map(|edge| edge[0].cross(edge[1]));
        let normal: DVec3 = fan().sum();
        let fan_covers = fan().all(|triangle| triangle.dot(normal) >= 0.0);
        if fan_covers && (normal != DVec3::ZERO || fan().all(|part| part == DVec3::ZERO)) {
            triangles.extend(fan_of(&self.corners));
            return;
        }
        // Parts of a polygon without an area cancel each other.
        if normal == DVec3::ZERO {
            self.crossing += 1;
            triangles.extend(fan_of(&self.corners));
            return;
        }
        if self.corners.len() > MOST_CORNERS {
            // Many corners of a round polygon are rounded to the inner side of their neighbours.
            let outside: f64 = fan().map(|triangle| -triangle.dot(normal).min(0.0)).sum();
            if outside > 1e-6 * normal.length_squared() {
                self.too_long = Some(self.corners.len());
            } else {
                triangles.extend(fan_of(&self.corners));
            }
            return;
        }
        // Coordinates without the largest of the normal, so that they stay exact.
        let largest = normal.abs().max_position();
        let [i, j] = [[1, 2], [2, 0], [0, 1]][largest];
        let is_turned = normal[largest] < 0.0;
        self.ring.clear();
        let flat = |p: &DVec3| {
            if is_turned { [p[j], p[i]] } else { [p[i], p[j]] }
        };
        self.ring.extend(self.spokes.iter().map(flat));
        self.indices.clear();
        let earcut = self.earcut.get_or_insert_with(Earcut::new);
        earcut.earcut_slice(&self.ring, &[], &mut self.indices);
        let signed = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|corner| DVec2::from_array(self.ring[corner as usize]));
            (b - a).perp_dot(c - a)
        };
        let mut covered = 0.0;
        let mut found: Vec<[u32; 3]> = self.indices.as_chunks().0.to_vec();
        for triangle in &mut found {
            let area = signed(*triangle);
            covered += area.abs();
            if area < 0.0 {
                triangle.swap(1, 2);
            }
        }
        let whole = normal[largest].abs();
        if (covered - whole).abs() > 1e-6 * whole {
            self.crossing += 1;
        }
        let whole = with_dropped(found, &self.ring);
        triangles.extend(whole.iter().map(|t| t.map(|corner| self.corners[corner as usize])));
    }
}

/// Triangles from the first corner to each edge.
fn fan_of(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let edges = corners.get(1..).unwrap_or_default().windows(2);
    edges.map(move |edge| [corners[0], edge[0], edge[1]])
}

/// Triangles of a ring, with the corners that the division dropped because they lie on a straight edge. Without these
/// corners, the surface would come apart from its neighbours, which have them.
fn with_dropped(mut triangles: Vec<[u32; 3]>, ring: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let mut is_used = vec![false; ring.len()];
    for corner in triangles.as_flattened() {
        is_used[*corner as usize] = true;
    }
    let Some(start) = is_used.iter().position(|used| *used) else {
        return triangles;
    };
    // Runs of dropped corners, by the edge that they lie on.
    let mut dropped: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    let (mut from, mut run) = (start as u32, Vec::new());
    for step in 1..=ring.len() {
        let corner = (start + step) % ring.len();
        if !is_used[corner] {
            run.push(corner as u32);
            continue;
        }
        let edge = [from, corner as u32];
        if is_ordered(edge, &run, ring) {
            dropped.insert(edge, std::mem::take(&mut run));
        }
        run.clear();
        from = corner as u32;
    }
    if dropped.is_empty() {
        return triangles;
    }
    let mut whole = Vec::with_capacity(ring.len());
    while let Some([a, b, c]) = triangles.pop() {
        let edges = [[a, b, c], [b, c, a], [c, a, b]];
        let split = edges.iter().find_map(|&[from, to, apex]| {
            let run = dropped.remove(&[from, to])?;
            Some((apex, [from].into_iter().chain(run).chain([to])))
        });
        match split {
            // The parts may have another edge with dropped corners.
            Some((apex, ends)) => {
                let ends: Vec<u32> = ends.collect();
                triangles.extend(ends.windows(2).map(|edge| [edge[0], edge[1], apex]));
            }
            None => whole.push([a, b, c]),
        }
    }
    whole
}

/// Whether dropped corners lie between the ends of an edge, in their order.
fn is_ordered([from, to]: [u32; 2], run: &[u32], ring: &[[f64; 2]]) -> bool {
    let at = |corner: u32| DVec2::from_array(ring[corner as usize]);
    let along = |corner: u32| (at(corner) - at(from)).dot(at(to) - at(from));
    let stops = [from].into_iter().chain(run.iter().copied()).chain([to]);
    let stops: Vec<f64> = stops.map(along).collect();
    !run.is_empty() && stops.is_sorted()
}
