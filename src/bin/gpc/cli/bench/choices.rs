//! Superpixels with other thresholds of contrast, and with other shadings.

use super::columns::{Cell, Column, Study, clocks, column, times};
use super::measurement::Yardstick;
use super::results::{ChoiceRow, SceneChoices};
use super::subject::{self, Bench};
use clap::ValueEnum;
use gpc::names::name;
use gpc::output::Picture;
use gpc::render::{CellOptions, MethodKind, Shading, SuperpixelOptions};
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
        self.take_turns(&mut contenders, |_, _| {})?;
        let rows =
            measured.into_iter().zip(&contenders).map(|((option, value, superpixel_fraction, accuracy), contender)| {
                ChoiceRow { option, value, superpixel_fraction, accuracy, cost: contender.cost() }
            });
        Ok(SceneChoices { name, textured: subject.is_textured(), rows: rows.collect() })
    }
}

impl Study for SceneChoices {
    type Row = ChoiceRow;
    const FILE: &'static str = "choices.csv";

    fn title(&self) -> String {
        format!("{}, superpixels of {} samples with one option changed", self.name, CellOptions::DEFAULT_SAMPLES)
    }

    fn rows(&self) -> &[ChoiceRow] {
        &self.rows
    }

    fn columns() -> Vec<Column<Self, ChoiceRow>> {
        let keys = [
            column("scene", "", |scene: &Self, _| Cell::text(&scene.name)),
            column("textured", "", |scene: &Self, _| Cell::text(scene.textured)),
            column("option", "option", |_, row: &ChoiceRow| Cell::text(row.option)),
            column("value", "value", |_, row: &ChoiceRow| Cell::text(&row.value)),
            column("samples", "", |_, _| Cell::Count(CellOptions::DEFAULT_SAMPLES.into())),
        ];
        let figures = [
            column("superpixel_fraction", "superpixels", |_, row: &ChoiceRow| {
                Cell::Percent(row.superpixel_fraction, 2)
            }),
            column("rmse", "RMSE", |_, row: &ChoiceRow| Cell::Number(row.accuracy.rmse, 6)),
            column("flip", "FLIP", |_, row: &ChoiceRow| Cell::Number(row.accuracy.flip, 6)),
        ];
        let times = times(|row: &ChoiceRow| clocks(&row.cost));
        keys.into_iter().chain(times).chain(figures).collect()
    }
}
