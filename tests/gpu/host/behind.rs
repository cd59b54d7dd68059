//! Colours that a host has drawn behind its triangles.

use super::machine::{Base, Machine};
use super::world::{Drawn, PLACED, SIZE, Way, World};
use crate::difference::rmse;
use crate::stage::on_gpu;
use gpc::host::Options;
use gpc::render::Detection;
use rayon::prelude::*;
use twins::behind::behind;

/// Linear premultiplied colour that the host draws where no triangle is: a sky that changes from pixel to pixel, above
/// a floor with waves.
pub fn backdrop([x, y]: [f64; 2]) -> [f32; 4] {
    let [u, v] = [x / f64::from(SIZE[0]), y / f64::from(SIZE[1])];
    let wave = 0.5 + 0.5 * (0.35 * x).sin() * (0.27 * y).cos();
    let ground = (4.0 * v - 2.0).clamp(0.0, 1.0);
    let alpha = 0.2 + 0.6 * u * v;
    let light = [0.1 + 0.5 * u, 0.4 - 0.3 * v, 0.9 - 0.6 * ground * wave];
    let [r, g, b] = light.map(|channel| (channel * alpha) as f32);
    [r, g, b, alpha as f32]
}

/// Image that the host draws of the world in front of the backdrop.
pub fn drawn_before(world: &World) -> Drawn {
    let mut drawn = world.drawn();
    for (pixel, (color, id)) in drawn.colors.iter_mut().zip(&drawn.ids).enumerate() {
        if *id == 0 {
            *color = backdrop(centre(pixel));
        }
    }
    drawn
}

fn centre(pixel: usize) -> [f64; 2] {
    let width = SIZE[0] as usize;
    [pixel % width, pixel / width].map(|at| at as f64 + 0.5)
}

/// Renders over black and over white; the difference shows how much of a pixel no triangle covers.
#[test]
fn samples_that_see_no_triangle_show_the_twins_colour() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), drawn_before(&world));
        let given = [0.7, 0.1, 0.4];
        let way = Way { corner: [13, 5], ..PLACED };
        let see = |way: &Way, background, flat_background| {
            let options = Options::new(SIZE[0], SIZE[1])
                .background(Some(background))
                .flat_background(flat_background)
                .detection(Detection::Every);
            let lent = world.lent(way);
            let seen = machine.see_lent(way, &lent, Base::All(&drawn), options);
            assert_eq!(seen.outcome.left_over, 0);
            seen.colors
        };
        let black = see(&PLACED, [0.0; 3], true);
        let white = see(&PLACED, [1.0; 3], true);
        let found = see(&PLACED, given, false);
        let part = see(&way, given, false);
        let mut kinds = [0; 3];
        for (pixel, &color) in found.iter().enumerate() {
            let at = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]];
            let row = at[1] + way.corner[1];
            let place = row * way.around(SIZE)[0] + at[0] + way.corner[0];
            assert_eq!(part[place as usize], color, "{at:?}");
            let uncovered = white[pixel][0] - black[pixel][0];
            let given = [given[0], given[1], given[2], 1.0];
            let expected = behind(SIZE[0], &drawn.ids, &drawn.colors, given, at);
            let [r, g, b, _] = black[pixel];
            let covered = [r, g, b, 1.0 - uncovered];
            for channel in 0..4 {
                let expected = covered[channel] + uncovered * expected[channel];
                let apart = (color[channel] - expected).abs();
                assert!(apart < 2e-5, "{at:?}: {color:?}, not {expected}");
            }
            if uncovered > 0.02 {
                let kind = match drawn.ids[pixel] {
                    0 => 0,
                    _ if expected == given => 2,
                    _ => 1,
                };
                kinds[kind] += 1;
            }
        }
        assert!(kinds[0] > 500 && kinds[1] > 200, "{kinds:?}");
    });
}

/// Mean colour of `side` x `side` places in each pixel.
fn brute_force(world: &World, side: u32) -> Vec<[f32; 4]> {
    let surfaces = world.surfaces();
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    let mean = |pixel: usize| {
        let [x, y] = centre(pixel);
        let mut sum = [0.0; 4];
        for place in 0..side * side {
            let within = [place % side, place / side].map(|at| (f64::from(at) + 0.5) / f64::from(side) - 0.5);
            let at = [x + within[0], y + within[1]];
            let color = surfaces.at(at).map_or_else(|| backdrop(at), |(.., [r, g, b])| [r, g, b, 1.0]);
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += f64::from(channel);
            }
        }
        sum.map(|sum| (sum / f64::from(side * side)) as f32)
    };
    (0..pixels).into_par_iter().map(mean).collect()
}

/// Adds what the host draws after the library: a half-transparent interface.
fn with_overlay(mut colors: Vec<[f32; 4]>) -> Vec<[f32; 4]> {
    let rows = colors.len() / SIZE[0] as usize;
    for color in &mut colors[..rows / 8 * SIZE[0] as usize] {
        *color = color.map(|channel| 0.5 * channel + 0.25);
    }
    colors
}

#[test]
fn backdrops_are_antialiased_as_by_brute_force() {
    on_gpu(|gpu| {
        let world = World::new();
        let (machine, drawn) = (Machine::new(gpu, &world), drawn_before(&world));
        let [truth, brute] = [32, 8].map(|side| with_overlay(brute_force(&world, side)));
        let see = |flat_background| {
            let options = Options::new(SIZE[0], SIZE[1]).flat_background(flat_background);
            let lent = world.lent(&PLACED);
            let seen = machine.see_lent(&PLACED, &lent, Base::All(&drawn), options);
            rmse(&with_overlay(seen.colors), &truth)
        };
        let brute = rmse(&brute, &truth);
        let bare = rmse(&with_overlay(drawn.colors.clone()), &truth);
        let (found, flat) = (see(false), see(true));
        println!("one sample {bare}, 8 x 8 {brute}, over the backdrop {found}, over one colour {flat}");
        assert!(found < brute, "{found} of {brute}");
        assert!(flat > 3.0 * brute && bare > 10.0 * brute, "{flat} {bare}");
    });
}
