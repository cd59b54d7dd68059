//! Light from all around: an environment map.

mod cube;
mod equirectangular;
mod harmonics;

use glam::{DMat3, DQuat, DVec3};

use cube::Cube;
use equirectangular::Equirectangular;

/// Image that is no environment.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EnvironmentError {
    /// The numbers are not those of an image.
    #[error(
        "{width} x {height} texels with {found} colours; an equirectangular image is at least 2 x 1, with a colour a texel"
    )]
    Size {
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Colours given.
        found: usize,
    },
    /// A colour is not a radiance.
    #[error("texel {x}, {y} is {color}; radiance is finite and not negative")]
    Radiance {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Colour that was found there.
        color: String,
    },
}

/// Environment map, and the light that a matt surface gathers from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Image that the environment was made of, if it was one.
    image: Option<Equirectangular>,
    /// The image as a cube, and ever coarser averages of it down to a texel a face. Where there was none, level `i` of `n` is
    /// what a surface of the perceptual roughness `i / (n - 1)` reflects.
    cubes: Vec<Cube>,
    irradiance: [[f32; 3]; 9],
    /// World space to that of the map.
    rotation: DMat3,
}

impl Environment {
    /// Takes an equirectangular image, rows from the top, linear RGB. Its middle is seen along -z, its top along +y, and what
    /// is right of the middle towards +x.
    ///
    /// # Errors
    /// [`EnvironmentError`] if the size does not fit or a colour is negative or not finite.
    pub fn from_equirectangular(
        width: u32,
        height: u32,
        pixels: Vec<[f32; 3]>,
    ) -> Result<Self, EnvironmentError> {
        let found = pixels.len();
        if width < 2 || height < 1 || found as u64 != u64::from(width) * u64::from(height) {
            return Err(EnvironmentError::Size {
                width,
                height,
                found,
            });
        }
        let is_radiance = |color: &[f32; 3]| color.iter().all(|x| x.is_finite() && *x >= 0.0);
        if let Some(index) = pixels.iter().position(|color| !is_radiance(color)) {
            return Err(EnvironmentError::Radiance {
                x: index as u32 % width,
                y: index as u32 / width,
                color: format!("{:?}", pixels[index]),
            });
        }
        let image = Equirectangular {
            width,
            height,
            pixels,
        };
        let cubes = cube::pyramid(&image);
        Ok(Self {
            image: Some(image),
            irradiance: harmonics::irradiance(&cubes),
            cubes,
            rotation: DMat3::IDENTITY,
        })
    }

    /// Levels that are filtered already, each half as large as the one before: texels along the side of a face, and the colours
    /// of its faces in Vulkan's order, row by row. The irradiance is over pi; `rotation` leads from the map to the world.
    pub(super) fn from_levels(
        levels: Vec<(u32, Vec<[f32; 3]>)>,
        irradiance: [[f32; 3]; 9],
        rotation: DQuat,
    ) -> Self {
        let cube = |(side, texels)| Cube { side, texels };
        Self {
            image: None,
            cubes: levels.into_iter().map(cube).collect(),
            irradiance,
            rotation: DMat3::from_quat(rotation.inverse()),
        }
    }

    /// Turns the environment about the vertical axis by `angle` in radians, counter-clockwise seen from above.
    #[must_use]
    pub fn turned(mut self, angle: f64) -> Self {
        self.rotation *= DMat3::from_rotation_y(-angle);
        self
    }

    /// World space to that of the map.
    #[must_use]
    pub fn rotation(&self) -> DMat3 {
        self.rotation
    }

    /// Whether its cubes are what surfaces reflect, and not averages that the device has still to filter.
    pub(crate) fn is_filtered(&self) -> bool {
        self.image.is_none()
    }

    /// Texels along the side of a face of each cube, and the colours of its faces in Vulkan's order, row by row.
    pub(crate) fn cubes(&self) -> impl ExactSizeIterator<Item = (u32, &[[f32; 3]])> {
        self.cubes.iter().map(|cube| (cube.side, &cube.texels[..]))
    }

    /// Coefficients of the real spherical harmonics of the first three bands, in the map's space: what a surface gathers,
    /// over pi, that faces a direction.
    #[must_use]
    pub fn irradiance(&self) -> [[f32; 3]; 9] {
        self.irradiance
    }

    /// Radiance of the world direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: DVec3) -> DVec3 {
        let towards = self.rotation * towards.normalize();
        match (&self.image, self.cubes.first()) {
            (Some(image), _) => image.towards(towards),
            (None, Some(finest)) => finest.sample(towards).as_dvec3(),
            (None, None) => DVec3::ZERO,
        }
    }

    /// Light that a matt white surface with the normal `normal` in the world reflects.
    #[must_use]
    pub fn irradiance_towards(&self, normal: DVec3) -> DVec3 {
        let basis = harmonics::basis(self.rotation * normal.normalize());
        let terms = self.irradiance.iter().zip(basis);
        let sum: DVec3 = terms
            .map(|(color, weight)| DVec3::from_array(color.map(f64::from)) * weight)
            .sum();
        sum.max(DVec3::ZERO)
    }
}
