//! The price of a superpixel, relative to that of a pixel of supersampling.

use crate::by_scene;
use crate::data::Measurement;
use crate::text::short;

/// Time that a frame takes longer than one of one sample, for each superpixel; over the time of supersampling with as many
/// samples for each pixel that holds a surface.
fn price(of: &Measurement, scene: &str, samples: u32) -> Option<f64> {
    let fine = of.find(scene, "superpixel", samples)?;
    let plain = of.find(scene, "none", 1)?;
    let brute = of.find(scene, "ssaa", samples)?;
    let superpixel = (fine.ms() - plain.ms()) / fine.number("superpixel_fraction");
    let pixel = brute.ms() / fine.number("surface_fraction");
    Some(superpixel / pixel)
}

/// Share of the pixels that hold a surface.
fn surfaces(of: &Measurement, scene: &str) -> String {
    of.find(scene, "none", 1).map_or_else(String::new, |row| format!("{:.0} %", 100.0 * row.number("surface_fraction")))
}

/// Table of the prices, scene by scene and in the median.
pub fn table() -> String {
    by_scene::tables(&[("surfaces", surfaces)], price, short)
}
