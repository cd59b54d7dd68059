//! Names of the library's values in the command: in its options, its reports and the viewer.

use crate::camera::panorama::PanoramaProjection;
use crate::camera::zoom::{Shape, Transition};
use crate::output::{AovKind, VideoFormat};
use crate::render::{Detection, Footprint, MethodKind, Shading, Shadows};
use crate::sampling::FilterShape;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use serde::{Serialize, Serializer};

/// Implements [`ValueEnum`]: gives values a name and, where the name alone is unclear, a help text. Values without a
/// name can't be selected.
macro_rules! names {
    ($($type:ident { $($value:ident $name:literal $($help:literal)?,)* })*) => {
        $(impl ValueEnum for $type {
            fn value_variants<'a>() -> &'a [Self] {
                &[$(Self::$value),*]
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                match self {
                    $(Self::$value => Some(PossibleValue::new($name)$(.help($help))?),)*
                    #[allow(unreachable_patterns)]
                    _ => None,
                }
            }
        })*
    };
}

names! {
    MethodKind {
        None "none" "One sample a pixel",
        Superpixel "superpixel" "Many samples where the image aliases, one elsewhere",
        Ssaa "ssaa" "Brute force: a grid of k x k samples in every pixel",
        Msaa "msaa" "The device's own multisampling",
        Accumulate "accumulate" "The mean of N frames, whose cameras are moved within the pixel by a Sobol sequence",
        Rotated "rotated" "As accumulate, by the points of a rotated grid",
    }
    FilterShape {
        Box "box" "The pixel itself",
        Tent "tent" "Falls linearly to 0",
        Gaussian "gaussian" "The softest; hides patterns best",
        Mitchell "mitchell" "The sharpest; has negative lobes",
        BlackmanHarris "blackman-harris" "A bell, a little sharper than the Gaussian",
    }
    Detection {
        Contrast "contrast" "Pixels that contrast with a neighbour",
        Edges "edges" "Pixels that contrast with a neighbour that shows another triangle",
        Exact "exact" "Pixels with a neighbour that shows another triangle, whatever the colours",
    }
    Footprint {
        Sample "sample" "The part of the pixel that is shaded at once",
        Pixel "pixel" "The whole pixel, as always with none and msaa",
    }
    Shading {
        Triangle "triangle" "Once for each visible triangle",
        Part "part" "Once for each visible triangle, or in up to 256 parts where colours vary",
        Sample "sample" "Once for each sample",
    }
    Shadows {
        None "none",
        Exact "exact",
    }
    VideoFormat {
        Y4m "y4m",
        Raw "raw",
    }
    AovKind {
        Depth "depth",
        Id "id",
        Normal "normal",
        Superpixels "superpixels",
        Samples "samples",
    }
    Shape {
        Circle "circle",
        Rectangle "rectangle",
    }
    Transition {
        Linear "linear" "The enlargement fades out linearly",
        Smooth "smooth" "The sampling rate changes without jumps",
    }
    PanoramaProjection {
        Equirectangular "equirectangular" "Columns are longitudes, rows are latitudes",
        Cylindrical "cylindrical" "An unrolled cylinder",
        Fisheye "fisheye" "A circle; the distance from its middle is the angle from the axis of view",
        Cubemap "cubemap" "The six faces of a cube, as the largest cross of 4 x 3 squares that fits",
    }
}

/// Name of a value in options; empty for a value that can't be selected.
#[must_use]
pub fn name(value: &impl ValueEnum) -> String {
    let named = value.to_possible_value();
    named.map_or_else(String::new, |value| value.get_name().to_owned())
}

impl Serialize for MethodKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
