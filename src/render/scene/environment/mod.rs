//! Environments: light from all directions.

mod cube;
mod equirectangular;
mod harmonics;
mod suns;

use glam::{DMat3, DQuat, DVec3};

use cube::Cube;
use equirectangular::Equirectangular;
pub(crate) use suns::{Sun, Suns};

/// Error: an image that is no environment.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// Number of colours that contradicts the size, or a size that is too small.
    #[error(
        "{width} x {height} texels with {found} colours; an equirectangular image is at least 2 x 1, with a colour a texel"
    )]
    Size {
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
        /// Number of colours given.
        found: usize,
    },
    /// Colour that is negative or not finite.
    #[error("texel {x}, {y} is {color}; radiance is finite and not negative")]
    Radiance {
        /// Column of the texel.
        x: u32,
        /// Row of the texel.
        y: u32,
        /// Colour of the texel.
        color: String,
    },
}

/// Environment map, and the irradiance of matt surfaces in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Image that the environment was made from; `None` if it was made from levels.
    image: Option<Equirectangular>,
    /// The image as a cube without the suns, followed by ever coarser averages down to one texel a face. For an environment made
    /// from levels, cube `i` of `n` is the reflection of surfaces with the perceptual roughness `i / (n - 1)`.
    cubes: Vec<Cube>,
    suns: Suns,
    irradiance: [[f32; 3]; 9],
    /// Rotation from world space to the space of the map.
    rotation: DMat3,
}

impl Environment {
    /// Makes an environment from an equirectangular image, rows from the top, linear RGB. Its middle shows the
    /// direction -z, its top +y, and its right side turns towards +x.
    ///
    /// # Errors
    /// [`EnvironmentError`] if the number of colours contradicts the size or a colour is negative or not finite.
    pub fn from_equirectangular(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self, EnvironmentError> {
        let found = pixels.len();
        if width < 2 || height < 1 || found as u64 != u64::from(width) * u64::from(height) {
            return Err(EnvironmentError::Size { width, height, found });
        }
        let is_radiance = |color: &[f32; 3]| color.iter().all(|x| x.is_finite() && *x >= 0.0);
        if let Some(index) = pixels.iter().position(|color| !is_radiance(color)) {
            return Err(EnvironmentError::Radiance {
                x: index as u32 % width,
                y: index as u32 / width,
                color: format!("{:?}", pixels[index]),
            });
        }
        let mut image = Equirectangular { width, height, pixels };
        let (suns, originals) = suns::take(&mut image);
        let cubes = cube::pyramid(cube::resampled(&image));
        for (index, texel) in originals {
            image.pixels[index] = texel;
        }
        Ok(Self {
            image: Some(image),
            irradiance: harmonics::irradiance(&cubes, &suns),
            cubes,
            suns,
            rotation: DMat3::IDENTITY,
        })
    }

    /// Makes an environment from filtered levels, each half as large as the one before: the side of a face in texels,
    /// and the colours of its faces in Vulkan's order, row by row. `irradiance` is divided by pi; `rotation` leads
    /// from the map to the world.
    pub(super) fn from_levels(levels: Vec<(u32, Vec<[f32; 3]>)>, irradiance: [[f32; 3]; 9], rotation: DQuat) -> Self {
        let cube = |(side, texels)| Cube { side, texels };
        Self {
            image: None,
            suns: Suns::default(),
            cubes: levels.into_iter().map(cube).collect(),
            irradiance,
            rotation: DMat3::from_quat(rotation.inverse()),
        }
    }

    /// This environment, turned about the vertical axis by `angle` in radians, counter-clockwise seen from above.
    #[must_use]
    pub fn turned(mut self, angle: f64) -> Self {
        self.rotation *= DMat3::from_rotation_y(-angle);
        self
    }

    /// Rotation from world space to the space of the map.
    #[must_use]
    pub fn rotation(&self) -> DMat3 {
        self.rotation
    }

    /// Whether the cubes are filtered reflections, rather than averages that the device has to filter.
    pub(crate) fn is_filtered(&self) -> bool {
        self.image.is_none()
    }

    /// Side of a face in texels and colours of each cube, the faces in Vulkan's order, row by row.
    pub(crate) fn cubes(&self) -> impl ExactSizeIterator<Item = (u32, &[[f32; 3]])> {
        self.cubes.iter().map(|cube| (cube.side, &cube.texels[..]))
    }

    /// Small bright parts that the cubes lack.
    pub(crate) fn suns(&self) -> &Suns {
        &self.suns
    }

    /// Coefficients, in the map's space, of the real spherical harmonics of the first three bands. The harmonics of a
    /// surface's normal, weighted by the coefficients, add up to the surface's irradiance / pi.
    #[must_use]
    pub fn irradiance(&self) -> [[f32; 3]; 9] {
        self.irradiance
    }

    /// Radiance from the world direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: DVec3) -> DVec3 {
        let towards = self.rotation * towards.normalize();
        match (&self.image, self.cubes.first()) {
            (Some(image), _) => image.towards(towards),
            (None, Some(finest)) => finest.sample(towards).as_dvec3(),
            (None, None) => DVec3::ZERO,
        }
    }

    /// Light that a matt white surface with the world-space normal `normal` reflects.
    #[must_use]
    pub fn irradiance_towards(&self, normal: DVec3) -> DVec3 {
        let basis = harmonics::basis(self.rotation * normal.normalize());
        let terms = self.irradiance.iter().zip(basis);
        let sum: DVec3 = terms.map(|(color, weight)| DVec3::from_array(color.map(f64::from)) * weight).sum();
        sum.max(DVec3::ZERO)
    }
}
