//! Cube maps of radiance, and their construction from images.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::equirectangular::Equirectangular;

/// Largest side of a face in texels.
const MOST: u32 = 256;
/// Smallest side of a face of the finest level in texels.
const LEAST: u32 = 16;

/// Six faces in Vulkan's order: +x, -x, +y, -y, +z, -z.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cube {
    /// Side of a face in texels.
    pub(super) side: u32,
    /// Texels face by face, row by row.
    pub(super) texels: Vec<[f32; 3]>,
}

impl Cube {
    /// Cube whose texels are a function of face, column and row.
    pub(super) fn new(side: u32, texel: impl Fn(u32, u32, u32) -> [f32; 3] + Sync) -> Self {
        let texels = (0..6 * side * side)
            .into_par_iter()
            .map(|index| {
                let (face, place) = (index / (side * side), index % (side * side));
                texel(face, place % side, place / side)
            })
            .collect();
        Self { side, texels }
    }

    pub(super) fn texel(&self, face: u32, x: u32, y: u32) -> Vec3 {
        let index = (face * self.side + y) * self.side + x;
        Vec3::from_array(self.texels[index as usize])
    }

    /// Radiance in a direction, interpolated between the nearest texels of its face.
    pub(super) fn sample(&self, direction: DVec3) -> Vec3 {
        let (face, [a, b]) = place(direction);
        let along = |v: f64| {
            let at = ((v + 1.0) / 2.0 * f64::from(self.side) - 0.5).clamp(0.0, f64::from(self.side - 1));
            let low = at.floor();
            let next = (low as u32 + 1).min(self.side - 1);
            (low as u32, next, (at - low) as f32)
        };
        let ((x0, x1, u), (y0, y1, v)) = (along(a), along(b));
        let row = |y| self.texel(face, x0, y).lerp(self.texel(face, x1, y), u);
        row(y0).lerp(row(y1), v)
    }

    /// Middle of a texel on its face, from -1 to 1.
    pub(super) fn middle(&self, x: u32, y: u32) -> [f64; 2] {
        middle(self.side, x, y)
    }
}

pub(super) fn middle(side: u32, x: u32, y: u32) -> [f64; 2] {
    [x, y].map(|i| (2.0 * f64::from(i) + 1.0) / f64::from(side) - 1.0)
}

/// Direction of a place on a face, not normalised.
pub(super) fn direction(face: u32, [a, b]: [f64; 2]) -> DVec3 {
    match face {
        0 => DVec3::new(1.0, -b, -a),
        1 => DVec3::new(-1.0, -b, a),
        2 => DVec3::new(a, 1.0, b),
        3 => DVec3::new(a, -1.0, -b),
        4 => DVec3::new(a, -b, 1.0),
        _ => DVec3::new(-a, -b, -1.0),
    }
}

/// Face and place on it of a direction.
fn place(d: DVec3) -> (u32, [f64; 2]) {
    let size = d.abs();
    if size.x >= size.y && size.x >= size.z {
        let face = u32::from(d.x < 0.0);
        (face, [-d.z * d.x.signum() / size.x, -d.y / size.x])
    } else if size.y >= size.z {
        let face = 2 + u32::from(d.y < 0.0);
        (face, [d.x / size.y, d.z * d.y.signum() / size.y])
    } else {
        let face = 4 + u32::from(d.z < 0.0);
        (face, [d.x * d.z.signum() / size.z, -d.y / size.z])
    }
}

/// Ratio of a texel's solid angle at a place of a face to that of a texel in the middle of the face.
pub(super) fn solid_angle([a, b]: [f64; 2]) -> f64 {
    let square = 1.0 + a * a + b * b;
    1.0 / (square * square.sqrt())
}

/// Side of the cube of an image, and number of points along each axis that are averaged for one of its texels. There are enough
/// points to skip no texel of an image that is twice as wide as high. An image of another shape has as many points as such an
/// image of as many texels, so that the time follows from the number of texels.
fn grid(width: u32, height: u32) -> (u32, u32) {
    let width = (2 * u64::from(width) * u64::from(height)).isqrt().min(width.into()) as u32;
    let side = (width / 4).next_power_of_two().clamp(LEAST, MOST);
    (side, (width / 4).div_ceil(side).max(2))
}

/// Cube of an equirectangular image.
pub(super) fn resampled(image: &Equirectangular) -> Cube {
    let (side, points) = grid(image.width, image.height);
    Cube::new(side, |face, x, y| {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for row in 0..points {
            for column in 0..points {
                let at = middle(side * points, x * points + column, y * points + row);
                let weight = solid_angle(at);
                sum += weight * image.towards(direction(face, at).normalize());
                weights += weight;
            }
        }
        (sum / weights).as_vec3().to_array()
    })
}

/// A cube, followed by ever coarser averages of it down to one texel a face.
pub(super) fn pyramid(finest: Cube) -> Vec<Cube> {
    let mut levels = vec![finest];
    while levels[levels.len() - 1].side > 1 {
        let coarser = halve(&levels[levels.len() - 1]);
        levels.push(coarser);
    }
    levels
}

/// Cube of half the side, whose texels are averages.
fn halve(fine: &Cube) -> Cube {
    Cube::new(fine.side / 2, |face, x, y| {
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let (x, y) = (2 * x + dx, 2 * y + dy);
            let weight = solid_angle(fine.middle(x, y)) as f32;
            sum += weight * fine.texel(face, x, y);
            weights += weight;
        }
        (sum / weights).to_array()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_find_their_place_again() {
        for face in 0..6 {
            for at in [[0.0, 0.0], [0.7, -0.3], [-0.9, 0.2]] {
                let (found, [a, b]) = place(direction(face, at) * 3.0);
                assert_eq!(found, face);
                assert!((a - at[0]).abs() < 1e-12 && (b - at[1]).abs() < 1e-12, "{face}");
            }
        }
    }

    #[test]
    fn the_number_of_points_follows_from_the_number_of_texels() {
        for (width, height) in [(1 << 24, 1), (1, 1 << 24), (65_536, 16), (4096, 2048), (8, 4)] {
            let (side, points) = grid(width, height);
            let all = 6 * u64::from(side * points).pow(2);
            let fewest = 6 * u64::from(2 * LEAST).pow(2);
            assert!(all <= 4 * u64::from(width) * u64::from(height) + fewest, "{width} x {height}: {side}, {points}");
        }
        assert_eq!(grid(8192, 4096), (MOST, (8192 / 4_u32).div_ceil(MOST).max(2)));
    }

    /// Each direction shows a colour of its own, on every level that is fine enough.
    #[test]
    fn the_middle_of_the_image_is_ahead() {
        let (width, height) = (64, 32);
        let pixels: Vec<[f32; 3]> =
            (0..width * height).map(|i| [(i % width) as f32, (i / width) as f32, 0.0]).collect();
        let image = Equirectangular { width, height, pixels };
        let cube = resampled(&image);
        for (direction, x, y) in [
            (DVec3::NEG_Z, 31.5, 15.5),
            (DVec3::X, 47.5, 15.5),
            (DVec3::NEG_X, 15.5, 15.5),
            (DVec3::new(0.0, 0.5, -1.0), 31.5, 10.78),
        ] {
            let found = cube.sample(direction);
            let off = (f64::from(found.x) - x).abs() + (f64::from(found.y) - y).abs();
            assert!(off < 0.1, "{direction}: {found}");
        }
    }
}
