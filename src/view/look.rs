//! How a picture is antialiased: what keys and panel change.

use gpc::render::{Method, PixelRect, Settings};

/// Most samples a pixel that are shown unless others are asked for.
pub const DEFAULT_SAMPLES: u32 = 1024;

/// Settings of a picture that is refined step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Settings of the picture at rest.
    ///
    /// Its threshold is not used: see [`Self::contrast`].
    pub settings: Settings,
    /// The threshold asked for; otherwise that of the number of samples of each step.
    pub contrast: Option<u8>,
}

impl Look {
    /// With these settings at rest, and a threshold where one is asked for.
    pub fn new(settings: Settings, contrast: Option<u8>) -> Self {
        Self { settings, contrast }
    }

    /// Settings of a step with so many samples, of a part of the picture.
    pub fn at(&self, samples: u32, region: Option<PixelRect>) -> Settings {
        Settings {
            samples,
            region,
            contrast: self.contrast_at(samples),
            ..self.settings.clone()
        }
    }

    /// Settings of a picture while something moves: with one sample of more, superpixels would be all cost and no gain.
    pub fn draft(&self, samples: u32) -> Settings {
        let mut settings = self.at(samples, None);
        if samples == 1 && self.settings.samples > 1 && settings.method == Method::Superpixel {
            settings.method = Method::None;
        }
        settings
    }

    /// The threshold of a step with so many samples.
    pub fn contrast_at(&self, samples: u32) -> u8 {
        self.contrast
            .unwrap_or_else(|| Settings::default_contrast(samples))
    }

    /// Whether method and pattern can have so many samples.
    pub fn can_have(&self, samples: u32) -> bool {
        match self.settings.method {
            Method::None => samples == 1,
            Method::Superpixel => self.settings.pattern.offsets(samples).is_ok(),
            Method::Ssaa => samples.isqrt().pow(2) == samples,
            // What a device has is not known here; the number asked for is all that is shown.
            Method::Msaa => samples == self.settings.samples,
        }
    }

    /// Changes the method, and the samples to the method's usual number.
    pub fn set_method(&mut self, method: Method) {
        self.settings.method = method;
        self.settings.samples = default_samples(method);
    }
}

/// Samples that are shown at rest unless others are asked for.
pub fn default_samples(method: Method) -> u32 {
    match method {
        Method::None => 1,
        Method::Msaa => 4,
        Method::Ssaa => 64,
        Method::Superpixel => DEFAULT_SAMPLES,
    }
}

/// A method's name, as `--aa` has it.
pub fn method_name(method: Method) -> &'static str {
    match method {
        Method::None => "none",
        Method::Superpixel => "superpixel",
        Method::Ssaa => "ssaa",
        Method::Msaa => "msaa",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draft_of_one_sample_has_no_superpixels_unless_that_is_asked_for() {
        let method = |asked: u32, samples: u32| {
            let settings = Settings {
                samples: asked,
                ..Settings::new(10, 10)
            };
            Look::new(settings, None).draft(samples).method
        };
        assert_eq!(method(64, 1), Method::None);
        assert_eq!(method(64, 2), Method::Superpixel);
        assert_eq!(method(1, 1), Method::Superpixel);
    }

    #[test]
    fn the_threshold_is_that_of_the_step_unless_one_is_asked_for() {
        let mut look = Look::new(Settings::new(10, 10), None);
        for samples in [64, 1024] {
            let expected = Settings::default_contrast(samples);
            assert_eq!(look.contrast_at(samples), expected);
        }
        look.contrast = Some(5);
        assert_eq!(look.at(1024, None).contrast, 5);
    }
}
