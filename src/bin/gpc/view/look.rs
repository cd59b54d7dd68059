//! Antialiasing settings of a picture, which keys and panel change.

use gpc::render::{Detection, Footprint, Method, MethodKind, PixelRect, Settings, Shading, Shadows, SuperpixelOptions};

/// Samples a pixel of a picture at rest, unless another number is asked for.
pub const DEFAULT_SAMPLES: u32 = 1024;

/// Smallest contrast threshold while something moves, in 8-bit sRGB code values.
const DRAFT_CONTRAST: u8 = 16;

/// Settings of a picture that is refined step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Settings of the picture at rest.
    pub settings: Settings,
    /// The options that superpixels get when the method changes to them.
    superpixels: SuperpixelOptions,
}

impl Look {
    /// Look with the settings of the picture at rest. `superpixels` are the options for a later change to superpixels;
    /// if `settings` have superpixels already, their own options replace these.
    pub fn new(settings: Settings, superpixels: SuperpixelOptions) -> Self {
        Self { settings, superpixels }
    }

    /// Method without its options.
    pub fn method(&self) -> MethodKind {
        self.settings.method.kind()
    }

    /// Samples of the picture at rest.
    pub fn samples(&self) -> u32 {
        self.settings.method.samples()
    }

    /// Options of the picture's superpixels, if it has any.
    pub fn superpixels_mut(&mut self) -> Option<&mut SuperpixelOptions> {
        match &mut self.settings.method {
            Method::Superpixel(options) => Some(options),
            _ => None,
        }
    }

    /// Settings of a step with `samples` samples, for a part of the picture.
    pub fn at(&self, samples: u32, region: Option<PixelRect>) -> Settings {
        let settings = self.settings.clone().region(region);
        match &self.settings.method {
            Method::Superpixel(options) => settings.method(options.clone().samples(samples)),
            _ => settings.method(self.method().with_samples(samples)),
        }
    }

    /// Settings of a picture while something moves. There are no shadows. Superpixels lie along edges only, each triangle
    /// in them is shaded once, and textures are filtered as in other pixels; this takes less than half of the time. With
    /// one sample a pixel, superpixels would cost time without any gain, so that there are none.
    pub fn draft(&self, samples: u32) -> Settings {
        let settings = self.at(samples, None).shadows(Shadows::None);
        match settings.method.clone() {
            Method::Superpixel(_) if samples == 1 => settings.method(Method::None),
            Method::Superpixel(options) => {
                let contrast = options.threshold().max(DRAFT_CONTRAST);
                let detection = match options.detection {
                    Detection::Contrast => Detection::Edges,
                    asked => asked,
                };
                settings
                    .footprint(Footprint::Pixel)
                    .method(options.shading(Shading::Triangle).detection(detection).contrast(Some(contrast)))
            }
            _ => settings,
        }
    }

    /// Whether method and pattern allow `samples` samples.
    pub fn can_have(&self, samples: u32) -> bool {
        match &self.settings.method {
            Method::None => samples == 1,
            Method::Superpixel(options) => options.cells.pattern.offsets(samples).is_ok(),
            Method::Ssaa { .. } => samples.isqrt().pow(2) == samples,
            // The number that the device supports is unknown here, so only the number asked for is allowed.
            _ => samples == self.samples(),
        }
    }

    /// Changes the number of samples.
    pub fn set_samples(&mut self, samples: u32) {
        self.settings = self.at(samples, self.settings.region);
    }

    /// Changes the method, and the samples to the method's usual number. Superpixels have the options that they had before.
    pub fn set_method(&mut self, method: MethodKind) {
        let samples = default_samples(method);
        if let Method::Superpixel(options) = &self.settings.method {
            self.superpixels = options.clone();
        }
        self.settings.method = match method {
            MethodKind::Superpixel => self.superpixels.clone().samples(samples).into(),
            method => method.with_samples(samples),
        };
    }
}

/// Samples a pixel at rest, unless another number is asked for.
pub fn default_samples(method: MethodKind) -> u32 {
    match method {
        MethodKind::None => 1,
        MethodKind::Msaa => 4,
        MethodKind::Ssaa => 64,
        _ => DEFAULT_SAMPLES,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(superpixels: SuperpixelOptions) -> Look {
        let settings = Settings::new(10, 10).method(superpixels.clone());
        Look::new(settings, superpixels)
    }

    #[test]
    fn drafts_of_superpixels_are_cheaper_and_others_only_lack_shadows() {
        let mut look = look(SuperpixelOptions::new(64).contrast(Some(40)));
        let Method::Superpixel(draft) = look.draft(16).method else {
            panic!("no superpixels");
        };
        assert_eq!(draft.cells.samples, 16);
        assert_eq!((draft.detection, draft.contrast), (Detection::Edges, Some(40)));
        assert_eq!(draft.cells.shading, Shading::Triangle);
        assert_eq!(look.draft(1).method, Method::None);
        look.set_method(MethodKind::Msaa);
        assert_eq!(look.draft(4), look.at(4, None));
        look.settings = look.settings.clone().shadows(Shadows::Exact);
        assert_eq!(look.draft(4), look.at(4, None).shadows(Shadows::None));
    }

    #[test]
    fn superpixels_keep_their_options_while_another_method_is_shown() {
        let mut look = look(SuperpixelOptions::new(64).contrast(Some(40)));
        look.set_method(MethodKind::None);
        assert_eq!(look.settings.method, Method::None);
        look.set_method(MethodKind::Superpixel);
        let expected = SuperpixelOptions::new(DEFAULT_SAMPLES).contrast(Some(40));
        assert_eq!(look.settings.method, expected.into());
    }

    #[test]
    fn the_threshold_is_that_of_the_step_unless_one_is_asked_for() {
        let threshold = |look: &Look, samples| match look.at(samples, None).method {
            Method::Superpixel(options) => options.threshold(),
            _ => panic!("no superpixels"),
        };
        let mut look = look(SuperpixelOptions::new(64));
        for samples in [64, 1024] {
            let expected = SuperpixelOptions::default_contrast(samples);
            assert_eq!(threshold(&look, samples), expected);
        }
        look.superpixels_mut().unwrap().contrast = Some(5);
        assert_eq!(threshold(&look, 1024), 5);
    }
}
