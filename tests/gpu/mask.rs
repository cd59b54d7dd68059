//! MASK surfaces: the alpha test of each sample, compared with a look-up on the CPU.

use gpc::render::Method;
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Filter, Image, Sampler};

use crate::stage::{Stage, centre, everywhere, flat, on_gpu, once, seen_at, textured};

const SIZE: [u32; 2] = [64, 48];
/// Half of the quadrilateral's sides, in pixels.
const HALF: [f64; 2] = [27.3, 19.6];
/// Number of times that the texture repeats over it.
const REPEATS: f64 = 5.0;

/// A repeated 2 x 2 checker whose texels are above and below the cutoff, in front of a blue wall.
pub fn checker() -> Stage {
    let mask = AlphaMode::Mask { cutoff: 0.5 };
    let mut stage = Stage::new(vec![flat([0.0, 0.0, 1.0, 1.0], AlphaMode::Opaque), textured(mask)]);
    let texel = |alpha: u8| [255, 255, 255, alpha];
    stage.texture = Some((
        Image { width: 2, height: 2, pixels: [texel(255), texel(0), texel(100), texel(140)].concat() },
        Sampler { mag: Filter::Nearest, min: Filter::Nearest, mip: None, ..Sampler::default() },
    ));
    let quad = |half: [f64; 2], distance: f64| {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]]
            .map(|[x, y]| seen_at([x * half[0], y * half[1]], distance, SIZE[1]))
    };
    stage.add_quad(0, quad([50.0, 50.0], 2.0));
    stage.add_quad(1, quad(HALF, 1.0));
    let uvs = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]
        .map(|[u, v]: [f32; 2]| [u * REPEATS as f32, v * REPEATS as f32]);
    stage.triangles[2].uvs = [uvs[0], uvs[1], uvs[2]];
    stage.triangles[3].uvs = [uvs[0], uvs[2], uvs[3]];
    stage
}

/// Whether the checker is visible at a place of the image, and whether the place is too close to a texel's border to
/// be certain.
fn shows(place: [f64; 2]) -> (bool, bool) {
    let at = [0, 1].map(|axis| (place[axis] / HALF[axis] + 1.0) / 2.0 * REPEATS * 2.0);
    let doubtful = at.iter().any(|t| (t - t.round()).abs() < 1e-3);
    let inside = at.iter().all(|t| (0.0..2.0 * REPEATS).contains(t));
    let texel = at.map(|t| t.floor() as i64 & 1);
    (inside && [255, 0, 100, 140][(texel[0] + 2 * texel[1]) as usize] >= 128, doubtful)
}

#[test]
fn alpha_is_tested_for_each_sample() {
    on_gpu(|gpu| {
        let stage = checker();
        let none = once(SIZE).method(Method::None);
        for settings in [everywhere(SIZE, Pattern::Sobol, 64), everywhere(SIZE, Pattern::Korobov, 300), none] {
            let rendered = stage.render(gpu, &settings);
            let offsets = match &settings.method {
                Method::Superpixel(options) => {
                    let cells = &options.cells;
                    cells.pattern.offsets(cells.samples).unwrap()
                }
                _ => vec![[0.0, 0.0]],
            };
            let share = 1.0 / offsets.len() as f64;
            let (mut partial, mut doubts) = (0, 0.0);
            for (pixel, found) in rendered.colors.iter().enumerate() {
                let middle = centre(pixel, SIZE);
                let (mut covered, mut doubtful) = (0.0, 0.0);
                for offset in &offsets {
                    let (shown, near_border) = shows([0, 1].map(|axis| middle[axis] + f64::from(offset[axis])));
                    covered += f64::from(u8::from(shown)) * share;
                    doubtful += f64::from(u8::from(near_border)) * share;
                }
                let difference = (f64::from(found[0]) - covered).abs();
                assert!(
                    difference < 1e-5 + doubtful,
                    "{:?}, {} samples, at {middle:?}: {found:?} instead of {covered}",
                    settings.method,
                    offsets.len()
                );
                // The wall is visible wherever the checker is not.
                assert!((found[2] - 1.0).abs() < 1e-5 && (found[3] - 1.0).abs() < 1e-5);
                partial += u32::from((0.01..0.99).contains(&covered));
                doubts += doubtful;
            }
            let pixels = f64::from(SIZE[0] * SIZE[1]);
            assert!(doubts < 0.01 * pixels, "{doubts}");
            assert!(settings.method == Method::None || partial > 400, "{partial}");
        }
    });
}

/// A pane in front of the checker is composited over what each sample sees: alpha decides whether a sample is hit, and
/// is no coverage in addition.
#[test]
fn panes_are_composited_over_what_each_sample_sees() {
    const PANE: [f32; 4] = [0.5, 0.25, 1.0, 0.25];
    on_gpu(|gpu| {
        let open = checker();
        let mut covered = open.clone();
        covered.materials.push(flat(PANE, AlphaMode::Blend));
        let corners = [[-40.0, -40.0], [-40.0, 40.0], [40.0, 40.0], [40.0, -40.0]];
        covered.add_quad(2, corners.map(|place| seen_at(place, 0.5, SIZE[1])));
        for samples in [16, 64, 256] {
            let settings = everywhere(SIZE, Pattern::Sobol, samples);
            let [open, covered] = [&open, &covered].map(|stage| stage.render(gpu, &settings));
            for (pixel, (open, covered)) in open.colors.iter().zip(&covered.colors).enumerate() {
                for (channel, pane) in PANE.iter().take(3).enumerate() {
                    let expected = open[channel] * (1.0 - PANE[3]) + pane * PANE[3];
                    assert!(
                        (covered[channel] - expected).abs() < 2e-5,
                        "{samples} samples, pixel {pixel}: {covered:?} over {open:?}"
                    );
                }
            }
        }
    });
}
