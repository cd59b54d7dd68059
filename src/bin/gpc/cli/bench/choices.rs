//! Superpixels with other thresholds of contrast, and with other shadings.

use super::results::{ChoiceRow, SceneChoices};
use super::subject::{self, Bench};
use crate::cli::print;
use gpc::bench::{self, Yardstick};
use gpc::output::Picture;
use gpc::render::{MethodKind, Settings, Shading, SuperpixelOptions};
use std::fmt::Write;
use std::path::Path;

/// Thresholds of contrast.
const CONTRASTS: [u8; 8] = [0, 1, 2, 4, 6, 12, 16, 32];
/// Shadings, with their names in the command.
const SHADINGS: [(&str, Shading); 3] = [
    ("triangle", Shading::Triangle),
    ("part", Shading::Part),
    ("sample", Shading::Sample),
];

/// Options of superpixels, with the name and the value of the one that differs from the default.
fn choices() -> impl Iterator<Item = (&'static str, String, SuperpixelOptions)> {
    let default = || SuperpixelOptions::new(Settings::DEFAULT_SAMPLES);
    let contrasts = CONTRASTS.map(|contrast| {
        let options = default().contrast(Some(contrast));
        ("contrast", contrast.to_string(), options)
    });
    let shadings = SHADINGS.map(|(name, shading)| {
        let options = default().shading(shading);
        ("shading", name.to_owned(), options)
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
        let mut rows = Vec::new();
        for (option, value, options) in choices() {
            self.progress.say(&format!("{option} {value}, warming up"));
            let settings = plain.clone().method(options);
            let (contender, rendered) = self.warm_up(&subject, &settings)?;
            let superpixels = rendered.statistics.superpixels as f64;
            rows.push(ChoiceRow {
                option,
                value,
                superpixel_fraction: superpixels / rendered.colors.len() as f64,
                accuracy: yardstick.measure(&Picture::new(rendered.size, &rendered.colors)?)?,
                cost: contender.cost(),
            });
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
        for (row, contender) in rows.iter_mut().zip(&contenders) {
            row.cost = contender.cost();
        }
        Ok(SceneChoices {
            name,
            textured: subject.is_textured(),
            rows,
        })
    }
}

/// Prints the choices of a scene.
pub fn print(scene: &SceneChoices) -> anyhow::Result<()> {
    print::line(&format!(
        "\n{}, superpixels of {} samples with one option changed:",
        scene.name,
        Settings::DEFAULT_SAMPLES
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

const COLUMNS: &str = "scene,textured,option,value,samples,frames,gpu_ms_median,gpu_ms_min,gpu_ms_spread,wall_ms_median,\
    wall_ms_min,wall_ms_spread,superpixel_fraction,rmse,flip";

/// Table of all rows of all scenes as CSV (RFC 4180, but with bare line feeds).
pub fn csv(scenes: &[SceneChoices]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for scene in scenes {
        for row in &scene.rows {
            let ChoiceRow { cost, accuracy, .. } = row;
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                scene.name.replace('"', "\"\""),
                scene.textured,
                row.option,
                row.value,
                Settings::DEFAULT_SAMPLES,
                cost.gpu_ms.count,
                cost.gpu_ms.median,
                cost.gpu_ms.min,
                cost.gpu_ms.spread,
                cost.wall_ms.median,
                cost.wall_ms.min,
                cost.wall_ms.spread,
                row.superpixel_fraction,
                accuracy.rmse,
                accuracy.flip,
            );
        }
    }
    text
}
