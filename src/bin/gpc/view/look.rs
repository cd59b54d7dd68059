//! Antialiasing settings of a picture, which keys and panel change.

use gpc::render::{Detection, Footprint, Method, PixelRect, Settings, Shading};

/// Samples a pixel of a picture at rest, unless another number is asked for.
pub const DEFAULT_SAMPLES: u32 = 1024;

/// Smallest contrast threshold while something moves, in 8-bit sRGB code values.
const DRAFT_CONTRAST: u8 = 16;

/// Settings of a picture that is refined step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Settings of the picture at rest.
    pub settings: Settings,
}

impl Look {
    /// Settings of a step with `samples` samples, for a part of the picture.
    pub fn at(&self, samples: u32, region: Option<PixelRect>) -> Settings {
        Settings {
            samples,
            region,
            ..self.settings.clone()
        }
    }

    /// Settings of a picture while something moves. Superpixels lie along edges only, each triangle in them is shaded
    /// once, and textures are filtered as in other pixels; this takes less than half of the time. With one sample a
    /// pixel, superpixels would cost time without any gain, so that there are none.
    pub fn draft(&self, samples: u32) -> Settings {
        let settings = self.at(samples, None);
        match settings.method {
            Method::Superpixel if samples == 1 => Settings {
                method: Method::None,
                ..settings
            },
            Method::Superpixel => Settings {
                shading: Shading::Triangle,
                footprint: Footprint::Pixel,
                detection: match settings.detection {
                    Detection::Contrast => Detection::Edges,
                    asked => asked,
                },
                contrast: Some(settings.threshold().max(DRAFT_CONTRAST)),
                ..settings
            },
            _ => settings,
        }
    }

    /// Whether method and pattern allow `samples` samples.
    pub fn can_have(&self, samples: u32) -> bool {
        match self.settings.method {
            Method::None => samples == 1,
            Method::Superpixel => self.settings.pattern.offsets(samples).is_ok(),
            Method::Ssaa => samples.isqrt().pow(2) == samples,
            // The number that the device supports is unknown here, so only the number asked for is allowed.
            Method::Msaa => samples == self.settings.samples,
        }
    }

    /// Changes the method, and sets the method's default number of samples.
    pub fn set_method(&mut self, method: Method) {
        self.settings.method = method;
        self.settings.samples = default_samples(method);
    }
}

/// Samples a pixel at rest, unless another number is asked for.
pub fn default_samples(method: Method) -> u32 {
    match method {
        Method::None => 1,
        Method::Msaa => 4,
        Method::Ssaa => 64,
        Method::Superpixel => DEFAULT_SAMPLES,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drafts_of_superpixels_are_cheaper_and_others_are_as_asked_for() {
        let look = Look {
            settings: Settings {
                contrast: Some(40),
                ..Settings::new(10, 10)
            },
        };
        let draft = look.draft(16);
        assert_eq!((draft.method, draft.samples), (Method::Superpixel, 16));
        assert_eq!(
            (draft.detection, draft.contrast),
            (Detection::Edges, Some(40))
        );
        assert_eq!(draft.shading, Shading::Triangle);
        assert_eq!(look.draft(1).method, Method::None);
        let mut other = look;
        other.set_method(Method::Msaa);
        assert_eq!(other.draft(4), other.at(4, None));
    }

    #[test]
    fn the_threshold_is_that_of_the_step_unless_one_is_asked_for() {
        let mut look = Look {
            settings: Settings::new(10, 10),
        };
        for samples in [64, 1024] {
            let expected = Settings::default_contrast(samples);
            assert_eq!(look.at(samples, None).threshold(), expected);
        }
        look.settings.contrast = Some(5);
        assert_eq!(look.at(1024, None).threshold(), 5);
    }
}
