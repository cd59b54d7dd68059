//! `gpc zoom`, `sample`, `panorama` and `project` of scenes, compared with ordinary images, closed forms and each
//! other.

mod panorama;
mod project;
mod sample;
mod zoom;

use glam::DVec2;
use gpc::output;
use std::path::Path;

fn linear(path: &Path) -> ([u32; 2], Vec<[f32; 4]>) {
    output::decode_linear(&std::fs::read(path).unwrap(), "image").unwrap()
}

fn places(size: [u32; 2]) -> impl Iterator<Item = (usize, DVec2)> {
    (0..size[0] * size[1]).map(move |i| {
        let place = DVec2::new(f64::from(i % size[0]) + 0.5, f64::from(i / size[0]) + 0.5);
        (i as usize, place)
    })
}
