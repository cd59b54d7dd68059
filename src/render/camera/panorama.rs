//! Panoramas: images whose pixels look all around, each in its own direction.
//!
//! ```text
//!  equirectangular         cylindrical            fisheye            cubemap
//!  ┌──────────────┐      ┌──────────────┐      ┌─────────┐          ┌──┐
//!  │ latitude     │      │ height over  │      │  ╭───╮  │          │up│
//!  │   │          │      │ the ground   │      │ (  ·  ) │       ┌──┼──┼──┬──┐
//!  │   └─ longitude      │   └─ longitude      │  ╰───╯  │       │le│fr│ri│ba│
//!  └──────────────┘      └──────────────┘      └─────────┘       └──┼──┼──┴──┘
//!  angles both ways      a cylinder unrolled   angle from axis      │do│
//! ```
//!
//! Directions are in the camera's axes: x right, y up, and it looks along -z, which is the middle of the panorama (of
//! the front face of a cubemap).

use super::{Camera, Pinhole, Projection, Rig, RigError, SampleLocation};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Projection of directions onto the image of a panorama.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PanoramaProjection {
    /// Longitude along the width and latitude along the height, at the same number of pixels a degree.
    Equirectangular,
    /// Longitude along the width and, along the height, the height on a cylinder around the camera; pixels are square
    /// at the horizon.
    Cylindrical,
    /// Fisheye: the distance from the middle is proportional to the angle from the axis (equidistant). The circle of
    /// the field of view touches the nearer sides of the image; outside of the circle the image is empty.
    Fisheye,
    /// Six squares in a cross, 4 wide and 3 high: left, front, right and back in the middle row, up and down above and
    /// below front.
    Cubemap,
}

/// Panorama with an image size and a field of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panorama {
    projection: PanoramaProjection,
    /// Horizontal field of view in degrees.
    fov: f64,
    size: [u32; 2],
}

/// Error: a panorama that can't exist.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PanoramaError {
    /// Field of view in degrees that is not above 0 and at most 360.
    #[error("a panorama of {0} degrees; it must be above 0 and at most 360")]
    FieldOfView(f64),
    /// Field of view in degrees that was given for a cubemap, which always has 360.
    #[error("a cubemap of {0} degrees; it shows all 360")]
    CubemapFieldOfView(f64),
    /// Equirectangular image that is higher than 180 degrees.
    #[error(
        "{width} x {height} pixels over {fov} degrees are {latitudes} degrees high; there are 180: make the image lower or the field of view smaller"
    )]
    Latitudes {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Horizontal field of view in degrees.
        fov: f64,
        /// Vertical field of view in degrees.
        latitudes: f64,
    },
    /// Image of this width and height that is too small for its layout.
    #[error("a panorama of {} x {} pixels has no room for its layout", .0[0], .0[1])]
    Size([u32; 2]),
    /// Orthographic camera: parallel rays have no centre to look around from.
    #[error("an orthographic camera can't look around; choose a perspective one, or --eye")]
    Orthographic,
    /// Rig that can't be sampled.
    #[error(transparent)]
    Rig(#[from] RigError),
}

/// A face of a cubemap.
struct CubeFace {
    forward: DVec3,
    right: DVec3,
    down: DVec3,
    /// Column and row of the face in the cross.
    cross: [u32; 2],
}

impl CubeFace {
    /// Direction through `place` on the face, as a unit vector: (0, 0) is the face's upper left corner, (1, 1) its
    /// lower right corner.
    fn toward(&self, place: DVec2) -> DVec3 {
        let way = 2.0 * place - DVec2::ONE;
        (self.forward + way.x * self.right + way.y * self.down).normalize()
    }
}

const FACES: [CubeFace; 6] = [
    CubeFace { forward: DVec3::X, right: DVec3::Z, down: DVec3::NEG_Y, cross: [2, 1] },
    CubeFace { forward: DVec3::NEG_X, right: DVec3::NEG_Z, down: DVec3::NEG_Y, cross: [0, 1] },
    CubeFace { forward: DVec3::Y, right: DVec3::X, down: DVec3::NEG_Z, cross: [1, 0] },
    CubeFace { forward: DVec3::NEG_Y, right: DVec3::X, down: DVec3::Z, cross: [1, 2] },
    CubeFace { forward: DVec3::Z, right: DVec3::NEG_X, down: DVec3::NEG_Y, cross: [3, 1] },
    CubeFace { forward: DVec3::NEG_Z, right: DVec3::X, down: DVec3::NEG_Y, cross: [1, 1] },
];

/// Tolerance in radians for directions on the edge of the layout.
const ROUNDING: f64 = 1e-12;

/// Longest side of a rig's planes in pixels.
const LARGEST_PLANE: f64 = 65_536.0;

impl Panorama {
    /// Makes a panorama of `size` = [width, height] pixels. `fov` is its field of view in degrees: of a fisheye across
    /// the circle, of other projections along the width; a cubemap takes only 360. A cubemap uses the largest cross
    /// that fits.
    ///
    /// # Errors
    /// [`PanoramaError`] if the field of view is not above 0 and at most 360, an equirectangular image is higher than
    /// 180 degrees, or the image is too small.
    pub fn new(projection: PanoramaProjection, fov: f64, size: [u32; 2]) -> Result<Self, PanoramaError> {
        if !(fov > 0.0 && fov <= 360.0) {
            return Err(PanoramaError::FieldOfView(fov));
        }
        let [width, height] = size;
        let mut size = size;
        match projection {
            PanoramaProjection::Equirectangular => {
                let latitudes = fov * f64::from(height) / f64::from(width);
                if latitudes > 180.0 {
                    return Err(PanoramaError::Latitudes { width, height, fov, latitudes });
                }
            }
            PanoramaProjection::Cubemap => {
                if fov != 360.0 {
                    return Err(PanoramaError::CubemapFieldOfView(fov));
                }
                let side = (width / 4).min(height / 3);
                size = [4 * side, 3 * side];
            }
            PanoramaProjection::Cylindrical | PanoramaProjection::Fisheye => {}
        }
        if size.contains(&0) {
            return Err(PanoramaError::Size([width, height]));
        }
        Ok(Self { projection, fov, size })
    }

    /// Width and height of the image in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Direction of view at `place`, in pixels of the image, as a unit vector in the camera's axes; `None` where the
    /// image is empty. The longitude continues beyond the left and right sides.
    #[must_use]
    pub fn look(&self, place: DVec2) -> Option<DVec3> {
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let way = place - 0.5 * size;
        let scale = self.radians_per_pixel();
        let around = |longitude: f64| DVec3::new(longitude.sin(), 0.0, -longitude.cos());
        match self.projection {
            PanoramaProjection::Equirectangular => {
                let (longitude, latitude) = (way.x * scale, -way.y * scale);
                let up = DVec3::Y * latitude.sin();
                (latitude.abs() <= FRAC_PI_2 + ROUNDING).then(|| around(longitude) * latitude.cos() + up)
            }
            PanoramaProjection::Cylindrical => Some((around(way.x * scale) - DVec3::Y * (way.y * scale)).normalize()),
            PanoramaProjection::Fisheye => {
                let angle = way.length() * scale;
                let aside = DVec3::new(way.x, -way.y, 0.0).normalize_or_zero();
                let inside = angle <= 0.5 * self.fov.to_radians() + ROUNDING;
                inside.then(|| aside * angle.sin() - DVec3::Z * angle.cos())
            }
            PanoramaProjection::Cubemap => {
                let side = 0.25 * size.x;
                let cell = (place / side).floor();
                let face = FACES.iter().find(|face| face.cross.map(f64::from) == cell.to_array());
                face.map(|face| face.toward(place / side - cell))
            }
        }
    }

    /// Makes the sampling locations of the panorama of a camera. Each pixel is sampled exactly in its direction, on
    /// the plane of the rig to which the direction belongs.
    ///
    /// # Errors
    /// [`PanoramaError`] if the camera is orthographic or not finite.
    pub fn locations(&self, camera: &Camera) -> Result<PanoramaLocations, PanoramaError> {
        let Projection::Perspective { near, .. } = camera.projection else {
            return Err(PanoramaError::Orthographic);
        };
        // The middle of each plane has the resolution of the panorama.
        let side = (2.0 / self.radians_per_pixel()).ceil().min(LARGEST_PLANE);
        let rig = Rig::cube(camera.eye, camera.axes, side as u32, near)?;
        let layout = PanoramaLayout::of(self);
        let size = layout.size(self.size);
        let sets = rig.sets(size, |place| {
            let direction = match layout {
                PanoramaLayout::Plain => self.look(place),
                PanoramaLayout::Around => self.look(place - DVec2::X),
                PanoramaLayout::Faces { side } => {
                    let pitch = f64::from(side + 2);
                    let index = (place.x / pitch).floor();
                    let local = DVec2::new(place.x - index * pitch, place.y) - DVec2::ONE;
                    let face = FACES.get(index as usize);
                    face.map(|face| face.toward(local / f64::from(side)))
                }
            };
            direction.map(|direction| camera.axes * direction)
        })?;
        let rig =
            rig.pinholes().iter().zip(sets).filter_map(|(pinhole, set)| Some((*pinhole, set?.locations()))).collect();
        Ok(PanoramaLocations { panorama: *self, layout, size, rig })
    }

    /// Radians per pixel in the middle of the image; for a cubemap, in the middle of a face.
    fn radians_per_pixel(&self) -> f64 {
        let [width, height] = self.size.map(f64::from);
        let fov = self.fov.to_radians();
        match self.projection {
            PanoramaProjection::Equirectangular | PanoramaProjection::Cylindrical => fov / width,
            PanoramaProjection::Fisheye => fov / width.min(height),
            PanoramaProjection::Cubemap => 8.0 / width,
        }
    }
}

/// Arrangement of the sampled cells. At a seam, a pixel's neighbours are at another place of the image; a border of one
/// pixel repeats them beside the pixel, so that seams are antialiased like everything else.
#[derive(Clone, Copy, Debug, PartialEq)]
enum PanoramaLayout {
    /// The image's pixels, without a border.
    Plain,
    /// The image's columns, preceded by a copy of the last column and followed by a copy of the first.
    Around,
    /// Faces of `side` x `side` pixels beside each other, each with a border.
    Faces { side: u32 },
}

impl PanoramaLayout {
    fn of(panorama: &Panorama) -> Self {
        match panorama.projection {
            PanoramaProjection::Cubemap => Self::Faces { side: panorama.size[0] / 4 },
            PanoramaProjection::Equirectangular | PanoramaProjection::Cylindrical if panorama.fov == 360.0 => {
                Self::Around
            }
            _ => Self::Plain,
        }
    }

    fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Plain => [width, height],
            Self::Around => [width + 2, height],
            Self::Faces { side } => [6 * (side + 2), side + 2],
        }
    }

    /// Sampled column and row for a pixel of the image; `None` where the image is empty.
    fn sampled(self, col: u32, row: u32) -> Option<(u32, u32)> {
        match self {
            Self::Plain => Some((col, row)),
            Self::Around => Some((col + 1, row)),
            Self::Faces { side } => {
                let cross = [col / side, row / side];
                let index = FACES.iter().position(|face| face.cross == cross)? as u32;
                Some((index * (side + 2) + col % side + 1, row % side + 1))
            }
        }
    }
}

/// Sampling locations of a panorama.
#[derive(Clone, Debug, PartialEq)]
pub struct PanoramaLocations {
    panorama: Panorama,
    layout: PanoramaLayout,
    size: [u32; 2],
    rig: Vec<(Pinhole, Vec<SampleLocation>)>,
}

impl PanoramaLocations {
    /// Number of sampled columns and rows. Every pixel is sampled beside its neighbours; the sampled area is therefore
    /// larger than the image, and a cubemap has its faces in another order. [`PanoramaLocations::crop`] makes the
    /// image.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Pinholes, each with the locations that are sampled on its plane.
    #[must_use]
    pub fn rig(&self) -> &[(Pinhole, Vec<SampleLocation>)] {
        &self.rig
    }

    /// Crops sampled values to the image, row by row; pixels in which the image is empty get `empty`.
    #[must_use]
    pub fn crop<T: Copy>(&self, sampled: &[T], empty: T) -> Vec<T> {
        let [width, height] = self.panorama.size;
        let places = (0..height).flat_map(|row| (0..width).map(move |col| (col, row)));
        let value = |(col, row)| {
            let (col, row) = self.layout.sampled(col, row)?;
            sampled.get(row as usize * self.size[0] as usize + col as usize)
        };
        places.map(|place| value(place).copied().unwrap_or(empty)).collect()
    }
}
