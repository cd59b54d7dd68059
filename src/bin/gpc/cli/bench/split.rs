//! Split of an image's error by cause and by fault.

use super::measurement::{self, Cause, Fault, PixelTriangles, Split, Stripped, Within, Yardstick};
use super::subject::{Bench, Subject, Wanted};
use gpc::output::{DecodedImage, Picture};
use gpc::render::{MethodKind, PreparedScene, SceneRequest};

/// Most samples a pixel of the references of stripped scenes. These references only tell which of two errors is larger.
const MOST_SAMPLES: u32 = 1024;

/// Images and scenes that tell the causes and faults of errors.
pub(super) struct Splitter<'a> {
    looks: PixelTriangles<'a>,
    /// The scene stripped to its paint and stripped to its light, each with its reference.
    halves: [(PreparedScene, DecodedImage); 2],
    /// Number of samples of the superpixels by which the errors of methods without superpixels are split.
    shown: u32,
}

/// An image's error, split.
pub struct Pieces {
    pub split: Split,
    /// Split by fault of the error in superpixels and in pixels of one triangle; superpixel antialiasing only.
    pub within: Option<Within>,
    /// Causes of the errors, one for each pixel.
    pub causes: Vec<Cause>,
    /// Faults of the errors, one for each pixel; empty for methods without superpixels.
    pub faults: Vec<Option<Fault>>,
}

impl<'a> Splitter<'a> {
    /// Looks up the triangles in each pixel, and renders the references of the scene's paint alone and light alone.
    pub fn new(bench: &mut Bench<'_>, subject: &'a Subject, shown: u32) -> anyhow::Result<Self> {
        let settings = bench.settings(MethodKind::None, 1);
        let progress = &bench.progress;
        let mut done = 0;
        let (scene, camera) = (&subject.prepared, &subject.view.camera);
        let looks = PixelTriangles::new(&mut bench.headless, scene, camera, &settings, || {
            done += 1;
            progress.say(&format!("what pixels hold, {done} of {}", measurement::LOOKS));
        })?;
        let mut half = |stripped: Stripped, name: &str| -> anyhow::Result<_> {
            let scene = stripped.of(&subject.scene);
            let prepared = bench.headless.upload(SceneRequest::new(&scene, &subject.pose))?;
            let (truth, _) = bench.reference(&Wanted {
                prepared: &prepared,
                ..subject.wanted(&settings, bench.args.reference.min(MOST_SAMPLES), name)
            })?;
            let truth = DecodedImage::from(&Picture::new(settings.size, &truth)?);
            Ok((prepared, truth))
        };
        Ok(Self {
            looks,
            halves: [
                half(Stripped::Paint, "the truth of its paint")?,
                half(Stripped::Light, "the truth of its light")?,
            ],
            shown,
        })
    }

    /// Splits the error of a method's image. Methods without superpixels use the superpixels with `shown` samples
    /// each.
    pub fn split(
        &self,
        bench: &mut Bench<'_>,
        yardstick: &Yardstick,
        picture: &Picture<'_>,
        method: MethodKind,
        samples: u32,
    ) -> anyhow::Result<Pieces> {
        let superpixels = method == MethodKind::Superpixel;
        let samples = if superpixels { samples } else { self.shown };
        let settings = bench.settings(MethodKind::Superpixel, samples);
        let causes = self.looks.causes(&mut bench.headless, &settings)?;
        let faults = if superpixels {
            self.looks.faults(&mut bench.headless, &self.halves, &settings, yardstick, picture, &causes)?
        } else {
            Vec::new()
        };
        Ok(Pieces {
            split: yardstick.split(picture, &causes)?,
            within: if superpixels { Some(yardstick.split_within(picture, &causes, &faults)?) } else { None },
            causes,
            faults,
        })
    }
}

/// A cause and a fault as a phrase for captions.
pub fn reason(cause: Option<Cause>, fault: Option<Fault>) -> &'static str {
    match (cause, fault) {
        (Some(Cause::Superpixel), Some(Fault::Edges)) => "edges in superpixels",
        (Some(Cause::Superpixel), Some(Fault::Texture)) => "texture in superpixels",
        (Some(Cause::Superpixel), Some(Fault::Light)) => "light in superpixels",
        (Some(Cause::Inside), Some(Fault::Light)) => "light amid one triangle",
        (Some(Cause::Inside), Some(_)) => "texture amid one triangle",
        (Some(Cause::BelowThreshold), _) => "edges below the threshold",
        (Some(Cause::Unseen), _) => "features no centre saw",
        (Some(Cause::Superpixel | Cause::Inside) | None, _) => "unknown",
    }
}
