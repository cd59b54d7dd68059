//! Errors and flicker of the methods in motion.

use super::columns::{Cell, Column, Study, column};
use super::measurement::{Motion, SequenceErrors};
use super::results::{MotionRow, SceneMotion};
use super::subject::{self, Bench, Subject, Wanted};
use super::summary::Ratio;
use gpc::camera::Camera;
use gpc::output::{DecodedImage, Picture};
use gpc::render::{EngineError, MethodKind, RenderError, Settings};
use serde::Serialize;
use std::path::Path;

/// Samples a pixel of each frame's reference.
const TRUTH_SAMPLES: u32 = 1024;

/// The methods to measure, with their samples a pixel.
const CELLS: [(MethodKind, u32); 6] = [
    (MethodKind::None, 1),
    (MethodKind::Msaa, 4),
    (MethodKind::Ssaa, 16),
    (MethodKind::Ssaa, 64),
    (MethodKind::Superpixel, 16),
    (MethodKind::Superpixel, 64),
];

/// Superpixel / supersampling ratios in motion, at equal numbers of samples, over all scenes and both motions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionRatio {
    pub samples: u32,
    /// Ratio of the mean RMSE of the frames.
    pub rmse: Ratio,
    /// Ratio of the flicker.
    pub flicker: Ratio,
}

/// Ratios of all scenes in motion.
#[derive(Serialize)]
pub struct MotionSummary(Vec<MotionRatio>);

impl Bench<'_> {
    /// Measures the scene of a file in motion.
    pub fn motion(&mut self, path: &Path) -> anyhow::Result<SceneMotion> {
        let size = self.args.motion_size;
        let name = subject::name(path);
        self.progress.begin(&format!("{name}, in motion"));
        let subject = self.upload(path, size)?;
        let mut notes = Vec::new();
        let mut rows = Vec::new();
        for motion in Motion::ALL {
            let cameras = motion.cameras(&subject.view.camera, subject.view.target, size);
            let truths = self.truths(&subject, &cameras, size, motion)?;
            for (method, samples) in CELLS {
                self.progress.say(&format!("{motion}, {method} {samples}"));
                let settings = subject::settings(method, samples, size);
                match self.sequence(&subject, &settings, &cameras, &truths) {
                    Ok(sequence) => rows.push(MotionRow { motion, method, samples, steadiness: sequence.steadiness() }),
                    Err(error) => match error.downcast_ref() {
                        Some(RenderError::Engine(EngineError::Samples { possible, .. })) => notes
                            .push(format!("{motion}: {method} left out at {samples} samples: it can have {possible}")),
                        _ => return Err(error),
                    },
                }
            }
        }
        Ok(SceneMotion { name, textured: subject.is_textured(), size, rows, notes })
    }

    /// The reference of each frame.
    fn truths(
        &mut self,
        subject: &Subject,
        cameras: &[Camera],
        size: [u32; 2],
        motion: Motion,
    ) -> anyhow::Result<Vec<DecodedImage>> {
        let settings = subject::settings(MethodKind::None, 1, size);
        let mut truths = Vec::new();
        for (index, camera) in cameras.iter().enumerate() {
            let name = format!("{motion}, truth {} of {}", index + 1, cameras.len());
            let (truth, _) = self.reference(&Wanted { camera, ..subject.wanted(&settings, TRUTH_SAMPLES, &name) })?;
            truths.push(DecodedImage::from(&Picture::new(size, &truth)?));
        }
        Ok(truths)
    }

    /// Measures all frames of a motion with the same settings.
    fn sequence(
        &mut self,
        subject: &Subject,
        settings: &Settings,
        cameras: &[Camera],
        truths: &[DecodedImage],
    ) -> anyhow::Result<SequenceErrors> {
        let mut frame = self.headless.prepare(&subject.prepared, settings)?;
        let mut sequence = SequenceErrors::default();
        for (camera, truth) in cameras.iter().zip(truths) {
            let rendered = self.headless.render(&mut frame, camera)?;
            let picture = Picture::new(rendered.size, &rendered.colors)?;
            sequence.add(truth, &DecodedImage::from(&picture))?;
        }
        Ok(sequence)
    }
}

/// Superpixel / supersampling ratios, one for each number of samples at which both were measured.
pub fn summarize(scenes: &[SceneMotion]) -> MotionSummary {
    let counts = CELLS.iter().filter(|(method, _)| *method == MethodKind::Superpixel);
    let at = |&(_, samples): &(MethodKind, u32)| {
        let pairs = || {
            scenes.iter().flat_map(move |scene| {
                Motion::ALL.into_iter().filter_map(move |motion| {
                    let find = |method| scene.row(motion, method, samples);
                    let superpixel = find(MethodKind::Superpixel)?.steadiness;
                    let ssaa = find(MethodKind::Ssaa)?.steadiness;
                    Some((format!("{}, {motion}", scene.name), superpixel, ssaa))
                })
            })
        };
        Some(MotionRatio {
            samples,
            rmse: Ratio::of(pairs().map(|(name, a, b)| (name, a.rmse, b.rmse)))?,
            flicker: Ratio::of(pairs().map(|(name, a, b)| (name, a.flicker, b.flicker)))?,
        })
    };
    MotionSummary(counts.filter_map(at).collect())
}

impl Study for SceneMotion {
    type Row = MotionRow;
    const FILE: &'static str = "motion.csv";

    fn title(&self) -> String {
        let [width, height] = self.size;
        let what = "mean of each frame's RMSE against its own truth, and flicker";
        format!("{}, in motion, {width} x {height}: {what}", self.name)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn rows(&self) -> &[MotionRow] {
        &self.rows
    }

    fn columns() -> Vec<Column<Self, MotionRow>> {
        vec![
            column("scene", "", |scene: &Self, _| Cell::text(&scene.name)),
            column("textured", "", |scene: &Self, _| Cell::text(scene.textured)),
            column("width", "", |scene: &Self, _| Cell::Count(scene.size[0].into())),
            column("height", "", |scene: &Self, _| Cell::Count(scene.size[1].into())),
            column("motion", "motion", |_, row: &MotionRow| Cell::text(row.motion)),
            column("method", "method", |_, row: &MotionRow| Cell::text(row.method)),
            column("samples", "N", |_, row: &MotionRow| Cell::Count(row.samples.into())),
            column("rmse", "RMSE", |_, row: &MotionRow| Cell::Number(row.steadiness.rmse, 5)),
            column("flicker", "flicker", |_, row: &MotionRow| Cell::Number(row.steadiness.flicker, 5)),
        ]
    }

    fn size(&self) -> Option<[u32; 2]> {
        Some(self.size)
    }
}

impl Study for MotionSummary {
    type Row = MotionRatio;
    const FILE: &'static str = "motion-summary.csv";

    fn title(&self) -> String {
        "superpixel in motion over ssaa, medians over scenes and motions".to_owned()
    }

    fn rows(&self) -> &[MotionRatio] {
        &self.0
    }

    fn columns() -> Vec<Column<Self, MotionRatio>> {
        let number = |name, heading, value: fn(&MotionRatio) -> f64| {
            column(name, heading, move |_: &Self, row| Cell::Number(value(row), 2))
        };
        vec![
            column("samples", "N", |_, row: &MotionRatio| Cell::Count(row.samples.into())),
            number("rmse_ratio", "RMSE", |row| row.rmse.median),
            number("rmse_ratio_worst", "worst", |row| row.rmse.worst),
            number("flicker_ratio", "flicker", |row| row.flicker.median),
            number("flicker_ratio_worst", "worst", |row| row.flicker.worst),
        ]
    }
}
