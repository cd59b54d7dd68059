//! Superpixels with other thresholds of contrast, and with other shadings.

use super::csv;
use super::results::{ChoiceRow, SceneChoices};
use super::subject::{self, Bench};
use crate::cli::print;
use clap::ValueEnum;
use gpc::bench::{self, Contender, Yardstick};
use gpc::names::name;
use gpc::output::Picture;
use gpc::render::{CellOptions, MethodKind, Shading, SuperpixelOptions};
use std::fmt::Write;
use std::path::Path;

/// Thresholds of contrast.
const CONTRASTS: [u8; 8] = [0, 1, 2, 4, 6, 12, 16, 32];

/// Options of superpixels, with the name and the value of the one that differs from the default.
fn choices() -> impl Iterator<Item = (&'static str, String, SuperpixelOptions)> {
    let default = || SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES);
    let contrasts = CONTRASTS.map(|contrast| {
        let options = default().contrast(Some(contrast));
        ("contrast", contrast.to_string(), options)
    });
    let shadings = Shading::value_variants().iter().map(move |shading| {
        let options = default().shading(*shading);
        ("shading", name(shading), options)
    });
    contrasts.into_iter().chain(shadings)
}

impl Bench<'_> {
    /// Measures superpixels with each of the choices on the scene of a file.
    pub fn choices(&mut self, path: &Path) -> anyhow::Result<SceneChoices> {
        let name = subject::name(path);
        self.progress.begin(&format!("{name}, choices"));
        let subject = self.upload(path, self.args.size)?;
        let plain = self.settings(MethodKind::None, 1);
        let wanted = subject.wanted(&plain, self.args.reference, "its truth");
        let (truth, _) = self.reference(&wanted)?;
        let (_, one_sample) = self.warm_up(&subject, &plain)?;
        let truth = Picture::new(plain.size, &truth)?;
        let yardstick = Yardstick::new(&truth, &Picture::new(plain.size, &one_sample.colors)?)?;
        let mut contenders = Vec::new();
        let mut measured = Vec::new();
        for (option, value, options) in choices() {
            self.progress.say(&format!("{option} {value}, warming up"));
            let settings = plain.clone().method(options);
            let (contender, rendered) = self.warm_up(&subject, &settings)?;
            let superpixels = rendered.statistics.superpixels as f64;
            let fraction = superpixels / rendered.colors.len() as f64;
            let accuracy = yardstick.measure(&Picture::new(rendered.size, &rendered.colors)?)?;
            measured.push((option, value, fraction, accuracy));
            contenders.push(contender);
        }
        self.progress.say("taking turns");
        bench::take_turns(
            &mut self.headless,
            &subject.view.camera,
            &mut contenders,
            self.args.repeat,
            self.args.budget(),
            |_| {},
        )?;
        let measured = measured.into_iter().zip(&contenders);
        let row = |((option, value, superpixel_fraction, accuracy), contender)| ChoiceRow {
            option,
            value,
            superpixel_fraction,
            accuracy,
            cost: Contender::cost(contender),
        };
        Ok(SceneChoices { name, textured: subject.is_textured(), rows: measured.map(row).collect() })
    }
}

/// Prints the choices of a scene.
pub fn print(scene: &SceneChoices) -> anyhow::Result<()> {
    print::line(&format!(
        "\n{}, superpixels of {} samples with one option changed:",
        scene.name,
        CellOptions::DEFAULT_SAMPLES
    ))?;
    print::line("  option    value     superpixels    GPU ms     min      rmse      flip")?;
    for row in &scene.rows {
        print::line(&format!(
            "  {:<9} {:<9} {:>10.2}% {:>9.1} {:>7.1} {:>9.6} {:>9.6}",
            row.option,
            row.value,
            100.0 * row.superpixel_fraction,
            row.cost.gpu_ms.median,
            row.cost.gpu_ms.min,
            row.accuracy.rmse,
            row.accuracy.flip,
        ))?;
    }
    Ok(())
}

const COLUMNS: &str =
    concat!("scene,textured,option,value,samples,frames,", csv::time_columns!(), ",superpixel_fraction,rmse,flip");

/// Table of all rows of all scenes as CSV (RFC 4180, but with bare line feeds).
pub fn csv(scenes: &[SceneChoices]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for scene in scenes {
        for row in &scene.rows {
            let ChoiceRow { cost, accuracy, .. } = row;
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{}",
                csv::quoted(&scene.name),
                scene.textured,
                row.option,
                row.value,
                CellOptions::DEFAULT_SAMPLES,
                cost.gpu_ms.count,
                csv::times(&cost.gpu_ms, &cost.wall_ms),
                row.superpixel_fraction,
                accuracy.rmse,
                accuracy.flip,
            );
        }
    }
    text
}
