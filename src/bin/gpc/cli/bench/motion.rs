//! Errors and flicker of the methods in motion.

use super::csv;
use super::results::{MotionRow, SceneMotion};
use super::subject::{self, Bench, Subject, Wanted};
use super::summary::Ratio;
use crate::cli::print;
use gpc::bench::{Motion, SequenceErrors};
use gpc::camera::Camera;
use gpc::output::{DecodedImage, Picture};
use gpc::render::{EngineError, MethodKind, RenderError, Settings};
use serde::Serialize;
use std::fmt::Write;
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

impl Bench<'_> {
    /// Measures the scene of a file in motion, in images of `size` = [width, height].
    pub fn motion(&mut self, path: &Path, size: [u32; 2]) -> anyhow::Result<SceneMotion> {
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
pub fn summarize(scenes: &[SceneMotion]) -> Vec<MotionRatio> {
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
    counts.filter_map(at).collect()
}

/// Prints a scene in motion.
pub fn print(scene: &SceneMotion) -> anyhow::Result<()> {
    let [width, height] = scene.size;
    print::line(&format!(
        "\n{}, in motion, {width} x {height}: mean of each frame's RMSE against its own truth, and flicker:",
        scene.name
    ))?;
    for note in &scene.notes {
        print::line(&format!("  {note}"))?;
    }
    print::line("  motion  method       N     RMSE  flicker")?;
    for row in &scene.rows {
        print::line(&format!(
            "  {:<6}  {:<10} {:>4} {:>8.5} {:>8.5}",
            row.motion.to_string(),
            row.method.to_string(),
            row.samples,
            row.steadiness.rmse,
            row.steadiness.flicker,
        ))?;
    }
    Ok(())
}

/// Prints the ratios over all scenes.
pub fn print_summary(summary: &[MotionRatio]) -> anyhow::Result<()> {
    if !summary.is_empty() {
        print::line("\nsuperpixel in motion over ssaa, medians over scenes and motions:")?;
        print::line("     N   RMSE  worst  flicker  worst")?;
    }
    for at in summary {
        print::line(&format!(
            "  {:>4}  {:>5.2}  {:>5.2}  {:>7.2}  {:>5.2}",
            at.samples, at.rmse.median, at.rmse.worst, at.flicker.median, at.flicker.worst,
        ))?;
    }
    Ok(())
}

const COLUMNS: &str = "scene,textured,width,height,motion,method,samples,rmse,flicker";

/// Table of all rows of all scenes as CSV (RFC 4180, but with bare line feeds).
pub fn csv(scenes: &[SceneMotion]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for scene in scenes {
        for row in &scene.rows {
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{}",
                csv::quoted(&scene.name),
                scene.textured,
                scene.size[0],
                scene.size[1],
                row.motion,
                row.method,
                row.samples,
                row.steadiness.rmse,
                row.steadiness.flicker,
            );
        }
    }
    text
}
