//! Small bright parts of an environment, such as the sun.
//!
//! Averages of a few hundred directions either miss such a part or see it many times, so that reflections of it are ragged.
//! These parts are therefore taken out of the map, and shaders add their reflections in closed form.

use glam::DVec3;

use super::cube::{Cube, direction, middle, solid_angle};

/// A texel's light that is taken out of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the middle of the texel, in the map's space.
    pub direction: DVec3,
    /// Solid angle of the texel.
    pub solid_angle: f64,
    /// Radiance times solid angle.
    pub light: DVec3,
}

/// Largest number of texels that are taken out; those with the most light come first.
const MOST: usize = 64;
/// Radiance in means of the map, without the parts above it, up to which a texel is averaged well enough.
const BRIGHT: f32 = 16.0;

/// Takes what exceeds the radiance of an ordinary texel out of the brightest texels of a cube.
pub(super) fn take(cube: &mut Cube) -> Vec<Sun> {
    let side = cube.side;
    let place = |index: usize| {
        let (face, in_face) = (index as u32 / (side * side), index as u32 % (side * side));
        (face, middle(side, in_face % side, in_face / side))
    };
    let brightness = |color: &[f32; 3]| color.iter().copied().fold(0.0, f32::max);
    let bound = bound(cube.texels.iter().map(brightness));
    let excess = |color: &[f32; 3]| (1.0 - bound / brightness(color)).max(0.0);
    let mut bright: Vec<usize> = (0..cube.texels.len()).filter(|index| excess(&cube.texels[*index]) > 0.0).collect();
    // In the middle of a face, a texel's solid angle is its area.
    let solid = |index: usize| solid_angle(place(index).1) * 4.0 / f64::from(side * side);
    let light = |index: usize| {
        let color = DVec3::from_array(cube.texels[index].map(f64::from));
        color * f64::from(excess(&cube.texels[index])) * solid(index)
    };
    bright.sort_by(|a, b| {
        let [a, b] = [*a, *b].map(|index| light(index).max_element());
        b.total_cmp(&a)
    });
    bright.truncate(MOST);
    let sun = |&index: &usize| {
        let (face, at) = place(index);
        Sun { direction: direction(face, at).normalize(), solid_angle: solid(index), light: light(index) }
    };
    let suns = bright.iter().map(sun).collect();
    for index in bright {
        let kept = 1.0 - excess(&cube.texels[index]);
        cube.texels[index] = cube.texels[index].map(|x| x * kept);
    }
    suns
}

/// Brightness up to which texels are ordinary.
fn bound(brightness: impl ExactSizeIterator<Item = f32> + Clone) -> f32 {
    let count = brightness.len() as f64;
    let mut bound = f32::INFINITY;
    // Each round finds the mean without what the round before called bright.
    for _ in 0..4 {
        let sum: f64 = brightness.clone().map(|x| f64::from(x.min(bound))).sum();
        bound = BRIGHT * (sum / count) as f32;
    }
    bound
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A cube of radiance 1 with the texels `bright` at a radiance of 1,000.
    fn cube(bright: &[usize]) -> Cube {
        let mut cube = Cube::new(32, |_, _, _| [1.0; 3]);
        for &index in bright {
            cube.texels[index] = [1000.0, 500.0, 0.0];
        }
        cube
    }

    #[test]
    fn what_is_taken_out_and_what_stays_are_the_map() {
        for index in [0, 16 * 32 + 16, 5 * 1024 + 31] {
            let (whole, mut rest) = (cube(&[index]), cube(&[index]));
            let suns = take(&mut rest);
            let [sun] = suns.as_slice() else {
                panic!("{suns:?}");
            };
            let kept = rest.texels[index];
            assert!((15.9..16.5).contains(&kept[0]) && kept[1] == kept[0] / 2.0, "{kept:?}");
            let taken = sun.light / sun.solid_angle;
            for (channel, taken) in taken.to_array().into_iter().enumerate() {
                let sum = f64::from(kept[channel]) + taken;
                let original = f64::from(whole.texels[index][channel]);
                assert!((sum - original).abs() < 1e-3, "{sum}, not {original}");
            }
        }
    }

    #[test]
    fn texels_fill_the_sphere() {
        let dark = Cube::new(8, |_, _, _| [0.0; 3]);
        let of = |index: usize| {
            let mut cube = dark.clone();
            cube.texels[index] = [1.0; 3];
            take(&mut cube)[0].solid_angle
        };
        let sum: f64 = (0..dark.texels.len()).map(of).sum();
        assert!((sum / (4.0 * PI) - 1.0).abs() < 0.01, "{sum}");
    }

    #[test]
    fn ordinary_maps_have_no_suns() {
        let hemisphere = Cube::new(32, |face, _, _| [if face == 2 { 50.0 } else { 0.0 }; 3]);
        let mut same = hemisphere.clone();
        assert_eq!(take(&mut same), []);
        assert_eq!(same, hemisphere);
        assert_eq!(take(&mut Cube::new(16, |_, _, _| [0.0; 3])), []);
    }

    #[test]
    fn the_brightest_come_first() {
        let bright: Vec<usize> = (0..100).map(|i| 61 * i).collect();
        let mut cube = cube(&bright);
        cube.texels[4_000] = [5e4; 3];
        let suns = take(&mut cube);
        assert_eq!(suns.len(), MOST);
        assert!(suns[0].light.x > 10.0 * suns[1].light.x);
        assert!(suns.is_sorted_by(|a, b| a.light.x >= b.light.x));
    }
}
