//! Filtering of textures at shaded places, compared with the CPU. Each mipmap level has noise of its own, so that
//! reading another level, or another number of places, gives another colour.

use gpc::render::{CellOptions, Headless, Shading, SuperpixelOptions};
use gpc::sampling::Pattern;
use gpc::scene::{AlphaMode, Filter, Image, Sampler};
use twins::texture::{MOST_IN_ROW, Probes, probes};

use crate::meshes::Random;
use crate::stage::{Stage, everywhere, on_gpu, once, seen_at, textured};

const SIZE: [u32; 2] = [96, 64];
/// Side of the squares of pixels that have texture coordinates of their own.
const PATCH: u32 = 4;

/// An image in which each mipmap level is independent noise of black and white channels.
fn noise(size: [u32; 2], random: &mut Random) -> Image {
    let mut image = Image { width: size[0], height: size[1], pixels: Vec::new() };
    for level in 0..image.full_levels() {
        let [width, height] = image.level_size(level);
        for _ in 0..width * height {
            let channel = |random: &mut Random| 255 * random.below(2) as u8;
            let [r, g, b] = [0; 3].map(|_| channel(random));
            image.pixels.extend([r, g, b, 255]);
        }
    }
    image
}

/// The light of a level at texture coordinates, by a bilinear filter of the repeated image.
fn bilinear(image: &Image, level: u32, at: [f64; 2]) -> [f64; 3] {
    let size = image.level_size(level);
    let pixels = image.levels().nth(level as usize).unwrap();
    let places = [0, 1].map(|axis| at[axis] * f64::from(size[axis]) - 0.5);
    let mut sum = [0.0; 3];
    for corner in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let mut weight = 1.0;
        let texel = [0, 1].map(|axis| {
            let part = places[axis] - places[axis].floor();
            weight *= if corner[axis] == 1 { part } else { 1.0 - part };
            (places[axis].floor() as i64 + corner[axis]).rem_euclid(i64::from(size[axis])) as usize
        });
        let first = 4 * (texel[1] * size[0] as usize + texel[0]);
        for (sum, channel) in sum.iter_mut().zip(&pixels[first..]) {
            *sum += weight * f64::from(u32::from(*channel) / 255);
        }
    }
    sum
}

/// Mean colour of an image at the probes of a footprint.
fn filtered(image: &Image, found: &Probes) -> [f64; 3] {
    let level = found.level.clamp(0, image.full_levels() as i32 - 1) as u32;
    let mut mean = [0.0; 3];
    for row in 0..found.rows {
        for probe in 0..found.in_row {
            let [probe, row] = [probe, row].map(f64::from);
            let at = [0, 1].map(|axis| found.first[axis] + probe * found.along[axis] + row * found.across[axis]);
            for (mean, channel) in mean.iter_mut().zip(bilinear(image, level, at)) {
                *mean += channel / f64::from(found.in_row * found.rows);
            }
        }
    }
    mean
}

/// Map from pixels to texture coordinates: the coordinates at the first pixel's centre, and their changes from a pixel
/// to the next one on the right and to the next one below.
struct Map {
    origin: [f64; 2],
    sides: [[f64; 2]; 2],
}

impl Map {
    /// Random map, turned and skewed. The geometric mean of its two directions has from an eighth of a texel to 16
    /// texels a pixel; one direction may have up to 16 times as many as the other.
    fn new(image: &Image, random: &mut Random) -> Self {
        let mut unit = || random.below(1 << 20) as f64 / f64::from(1 << 20);
        let texels = (7.0 * unit() - 3.0).exp2();
        let stretch = (8.0 * unit() - 4.0).exp2().sqrt();
        let [turn, skew] = [unit() * std::f64::consts::TAU, unit() - 0.5];
        let sides = [texels * stretch, texels / stretch];
        let directions = [turn, turn + std::f64::consts::FRAC_PI_2 + skew];
        let size = [image.width, image.height].map(f64::from);
        Self {
            origin: [unit(), unit()],
            sides: [0, 1].map(|side| {
                let (sine, cosine) = f64::sin_cos(directions[side]);
                [sides[side] * cosine / size[0], sides[side] * sine / size[1]]
            }),
        }
    }

    /// Texture coordinates at a place in pixels from the first pixel's centre.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.origin[axis] + x * self.sides[0][axis] + y * self.sides[1][axis])
    }
}

/// Numbers of pixels that were compared, by number of places and by level.
type Seen = [[u32; 8]; 2 * MOST_IN_ROW as usize];

/// Renders patches of an image, and holds their pixels against the CPU. Pixels are `whole`, or else superpixels of two samples.
fn compare(gpu: &mut Headless, (image, sampler): (&Image, Sampler), whole: bool, random: &mut Random, seen: &mut Seen) {
    let mut stage = Stage::new(vec![textured(AlphaMode::Opaque)]);
    stage.texture = Some((image.clone(), sampler));
    let mut maps = Vec::new();
    for patch in 0..(SIZE[0] / PATCH) * (SIZE[1] / PATCH) {
        let first = [patch % (SIZE[0] / PATCH), patch / (SIZE[0] / PATCH)].map(|column| f64::from(PATCH * column));
        let map = Map::new(image, random);
        let side = f64::from(PATCH);
        let corners = [[0.0, 0.0], [0.0, side], [side, side], [side, 0.0]];
        let centre = SIZE.map(|side| f64::from(side) / 2.0);
        stage.add_quad(
            0,
            corners.map(|[x, y]| {
                let place = [first[0] + x - centre[0], first[1] + y - centre[1]];
                seen_at(place, 1.0, SIZE[1])
            }),
        );
        let uvs = corners.map(|[x, y]| map.at([x - 0.5, y - 0.5]).map(|v| v as f32));
        let [.., a, b] = &mut stage.triangles[..] else {
            unreachable!("a patch has two triangles");
        };
        a.uvs = [uvs[0], uvs[1], uvs[2]];
        b.uvs = [uvs[0], uvs[2], uvs[3]];
        maps.push(map);
    }
    // No pixel contrasts enough to become a superpixel, so that textures are filtered over whole pixels.
    let uniform = SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).contrast(Some(u8::MAX));
    let pair = everywhere(SIZE, Pattern::Sobol, 2).map_superpixels(|options| options.shading(Shading::Triangle));
    let settings = if whole { once(SIZE).method(uniform.thin(false)) } else { pair };
    // Superpixels are shaded in the middle of their samples, which is rounded to 12 bits.
    let offsets = Pattern::Sobol.offsets(2).unwrap();
    let shaded = [0, 1].map(|axis| (f64::from(offsets[0][axis] + offsets[1][axis]) * 2048.0).round() / 4096.0);
    let shaded = if whole { [0.0; 2] } else { shaded };
    let rendered = stage.render(gpu, &settings);
    for (pixel, color) in rendered.colors.iter().enumerate() {
        let [x, y] = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]];
        if !whole && x % PATCH == y % PATCH {
            continue; // Two triangles meet in this pixel.
        }
        let map = &maps[(y / PATCH * (SIZE[0] / PATCH) + x / PATCH) as usize];
        let [column, row] = [x % PATCH, y % PATCH].map(f64::from);
        let at = map.at([column + shaded[0], row + shaded[1]]);
        let found = probes([image.width, image.height], at, map.sides, whole);
        // Where the margin is small, rounding may choose other places or another level.
        if found.margin < 1e-3 {
            continue;
        }
        seen[(found.in_row * found.rows) as usize - 1][found.level.clamp(0, 7) as usize] += 1;
        let expected = filtered(image, &found);
        for channel in 0..3 {
            let apart = (f64::from(color[channel]) - expected[channel]).abs();
            assert!(apart < 0.01, "({x}, {y}): {color:?}, not {expected:?} of {found:?}");
        }
    }
}

#[test]
fn textures_are_averaged_over_footprints() {
    on_gpu(|gpu| {
        let mut random = Random::new(7);
        // A mean over a footprint does not depend on how a sampler reads a single texel of it.
        let nearest = Sampler { min: Filter::Nearest, ..Sampler::default() };
        let without_mipmaps = Sampler { mip: None, ..nearest };
        let samplers = [Sampler::default(), nearest, without_mipmaps];
        // Numbers of places that must occur. The first two must occur at so many of the finest levels.
        for (whole, counts, levels) in [(false, &[1, 2, 3, 4, 5, 6, 7, 8][..], 4), (true, &[4, 8, 1, 2, 6, 12, 16], 2)]
        {
            let mut seen = Seen::default();
            for (size, sampler) in [[64, 64], [128, 32], [60, 33]].into_iter().zip(samplers) {
                let image = noise(size, &mut random);
                compare(gpu, (&image, sampler), whole, &mut random, &mut seen);
            }
            let enough = counts.iter().all(|count| seen[count - 1].iter().sum::<u32>() > 100)
                && counts[..2].iter().all(|count| seen[count - 1][..levels].iter().all(|n| *n > 100));
            assert!(enough, "whole: {whole}: {seen:?}");
        }
    });
}
