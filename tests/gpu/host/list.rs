//! Lists of locations that a host lends, instead of an image's pixels.

use super::farthest;
use super::machine::{Base, Machine};
use super::world::{PLACED, SIZE, SKY, Way, World};
use crate::meshes::Random;
use crate::stage::on_gpu;
use gpc::host::{Location, Options};
use gpc::render::{Detection, Shading};
use gpc::sampling::Pattern;

/// Number of samples of a superpixel.
const SAMPLES: u32 = 16;

/// Locations of the pixels of the picture.
pub fn pixels() -> Vec<Location> {
    let rows = 0..SIZE[1] as i32;
    let pixels = rows.flat_map(|row| (0..SIZE[0] as i32).map(move |column| [column, row]));
    let location = |pixel| Location { pixel, within: [0.5, 0.5], jacobian: [[1.0, 0.0], [0.0, 1.0]] };
    pixels.map(location).collect()
}

fn options(samples: u32) -> Options {
    Options::new(SIZE[0], SIZE[1]).samples(samples).detection(Detection::Every)
}

/// A list of all pixels equals a picture of the library in which all pixels are superpixels. Shading in parts gives
/// slightly different colours, because lists choose the number of parts differently.
#[test]
fn a_list_of_all_pixels_is_the_picture() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&PLACED);
        let (once, _) = machine.see_list(&PLACED, &pixels(), options(1));
        for (shading, most) in [(Shading::Sample, 1e-5), (Shading::Part, 3e-2)] {
            // Frames and lists may differ in whether a cell has rows or columns.
            let options = options(SAMPLES).shading(shading).pattern(Pattern::Sobol);
            let picture = machine.see_lent(&PLACED, &lent, Base::Nothing, options.clone());
            let (seen, outcome) = machine.see_list(&PLACED, &pixels(), options);
            assert_eq!((outcome.left_over, outcome.left_out), (0, 0));
            assert_eq!(outcome.statistics.superpixels, pixels().len() as u64);
            let error = farthest(&seen, &picture.colors);
            assert!(error < most, "{shading:?}: {error}");
            assert!(farthest(&once, &seen) > 0.1);
        }
    });
}

/// Points show the same as the centres of pixels.
#[test]
fn a_list_of_points_is_the_picture_of_one_sample() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let lent = world.lent(&PLACED);
        let (seen, outcome) = machine.see_list(&PLACED, &pixels(), options(1));
        assert_eq!((outcome.left_over, outcome.left_out), (0, 0));
        let once = Options::new(SIZE[0], SIZE[1])
            // No two codes differ by more than this threshold.
            .contrast(Some(u8::MAX))
            .thin(false);
        let picture = machine.see_lent(&PLACED, &lent, Base::Nothing, once);
        let differs = (seen.iter().zip(&picture.colors)).filter(|(a, b)| farthest(&[**a], &[**b]) > 1e-5);
        // Rasterizers round vertices to a fraction of a pixel, which sampling does not.
        let differs = differs.count();
        assert!(differs * 500 < seen.len(), "{differs} of {}", seen.len());
    });
}

/// The result does not depend on the order of the list, nor on the way in which positions are lent.
#[test]
fn every_order_of_a_list_sees_the_same() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let mut random = Random::new(7);
        let mut listed = Vec::new();
        for _ in 0..5_000 {
            let mut number = |low: f64, high: f64| random.range(low, high) as f32;
            listed.push(Location {
                pixel: [0, 1].map(|axis| number(0.0, f64::from(SIZE[axis])) as i32),
                within: [number(0.0, 1.0), number(0.0, 1.0)],
                jacobian: [[number(-2.0, 2.0), number(-2.0, 2.0)], [number(-2.0, 2.0), number(-2.0, 2.0)]],
            });
        }
        for samples in [1, SAMPLES] {
            let (seen, _) = machine.see_list(&PLACED, &listed, options(samples));
            let mut shuffled: Vec<usize> = (0..listed.len()).collect();
            for last in (1..shuffled.len()).rev() {
                shuffled.swap(last, random.below(last as u64 + 1) as usize);
            }
            let others: Vec<_> = shuffled.iter().map(|index| listed[*index]).collect();
            let object_space = Way { object_space: true, stride: 12, ..PLACED };
            let (again, outcome) = machine.see_list(&object_space, &others, options(samples));
            assert_eq!((outcome.left_over, outcome.left_out), (0, 0));
            let expected: Vec<_> = shuffled.iter().map(|index| seen[*index]).collect();
            let bits = |colors: &[[f32; 4]]| colors.as_flattened().iter().map(|c| c.to_bits()).collect::<Vec<_>>();
            assert!(bits(&again) == bits(&expected), "{samples} samples");
        }
    });
}

/// Locations that can't be sampled are counted, get the background colour, and do not affect other locations.
#[test]
fn locations_off_the_image_and_no_numbers_are_left_out() {
    on_gpu(|gpu| {
        let world = World::new();
        let machine = Machine::new(gpu, &world);
        let all = pixels();
        let (seen, _) = machine.see_list(&PLACED, &all, options(SAMPLES));
        let mut spoilt = all.clone();
        let spoil: [fn(&mut Location); 8] = [
            |l| l.pixel = [-1, 0],
            |l| l.pixel = [0, i32::MAX],
            |l| l.pixel = [i32::MIN, i32::MIN],
            |l| l.within[0] = f32::NAN,
            |l| l.within[1] = 1.5,
            |l| l.within[0] = -1e-3,
            |l| l.jacobian[0][1] = f32::INFINITY,
            |l| l.jacobian[1][0] = f32::NAN,
        ];
        let places: Vec<usize> = (0..spoil.len()).map(|i| 301 * i + 17).collect();
        for (place, spoil) in places.iter().zip(spoil) {
            spoil(&mut spoilt[*place]);
        }
        let (found, outcome) = machine.see_list(&PLACED, &spoilt, options(SAMPLES));
        assert_eq!((outcome.left_over, outcome.left_out), (0, spoil.len() as u32));
        for (place, (found, seen)) in found.iter().zip(&seen).enumerate() {
            let expected = if places.contains(&place) { [SKY[0], SKY[1], SKY[2], 1.0] } else { *seen };
            assert_eq!(found, &expected, "location {place}");
        }
    });
}
