//! Costs of the camera's variants.

use super::csv;
use super::results::{SceneVariants, VariantRow};
use super::subject::{self, Bench};
use crate::cli::print;
use gpc::bench::{Variant, VariantContender, VariantError};
use gpc::render::MethodKind;
use std::fmt::Write;
use std::path::Path;

impl Bench<'_> {
    /// Times the camera's variants on the scene of a file. Variants that the scene's camera can't have are left out.
    pub fn variants(&mut self, path: &Path) -> anyhow::Result<SceneVariants> {
        let name = subject::name(path);
        self.progress.begin(&format!("{name}, variants"));
        let subject = self.upload(path, self.args.size)?;
        let settings = subject::settings(MethodKind::Superpixel, 64, self.args.size);
        let mut contenders = Vec::new();
        let mut notes = Vec::new();
        for variant in Variant::ALL {
            self.progress.say(&format!("{variant}, warming up"));
            let (scene, camera) = (&subject.prepared, &subject.view.camera);
            match VariantContender::warm_up(variant, &mut self.headless, scene, camera, &settings) {
                Ok(contender) => contenders.push(contender),
                Err(VariantError::Panorama(error)) => {
                    notes.push(format!("{variant} left out: {error}"));
                }
                Err(error) => return Err(error.into()),
            }
        }
        self.progress.say("taking turns");
        VariantContender::take_turns(
            &mut contenders,
            &mut self.headless,
            &subject.prepared,
            &subject.view.camera,
            self.args.repeat,
            self.args.budget(),
        )?;
        let costs: Vec<_> = contenders.iter().map(VariantContender::cost).collect();
        let raster = costs.first();
        let row = |cost: &_| Some(VariantRow::new(*cost, raster?));
        Ok(SceneVariants { name, triangles: subject.triangles(), rows: costs.iter().filter_map(row).collect(), notes })
    }
}

/// Prints the variants of a scene.
pub fn print(scene: &SceneVariants) -> anyhow::Result<()> {
    print::line(&format!(
        "\n{}, variants of the camera; ratios are of the time a sample to the raster pass's:",
        scene.name
    ))?;
    for note in &scene.notes {
        print::line(&format!("  {note}"))?;
    }
    print::line("  variant       samples    GPU ms     min  ns/sample   ratio   wall ms     min  ns/sample   ratio")?;
    for row in &scene.rows {
        let VariantRow { cost, .. } = row;
        print::line(&format!(
            "  {:<10} {:>10} {:>9.1} {:>7.1} {:>10.1} {:>6.2}x {:>9.1} {:>7.1} {:>10.1} {:>6.2}x",
            cost.variant.to_string(),
            cost.samples,
            cost.gpu_ms.median,
            cost.gpu_ms.min,
            row.gpu_ns,
            row.gpu_ratio,
            cost.wall_ms.median,
            cost.wall_ms.min,
            row.wall_ns,
            row.wall_ratio,
        ))?;
    }
    Ok(())
}

const COLUMNS: &str =
    concat!("scene,triangles,variant,samples,runs,", csv::time_columns!(), ",gpu_ns,wall_ns,gpu_ratio,wall_ratio");

/// Table of all rows of all scenes as CSV (RFC 4180, but with bare line feeds).
pub fn csv(scenes: &[SceneVariants]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for scene in scenes {
        for row in &scene.rows {
            let VariantRow { cost, .. } = row;
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{}",
                csv::quoted(&scene.name),
                scene.triangles,
                cost.variant,
                cost.samples,
                cost.wall_ms.count,
                csv::times(&cost.gpu_ms, &cost.wall_ms),
                row.gpu_ns,
                row.wall_ns,
                row.gpu_ratio,
                row.wall_ratio,
            );
        }
    }
    text
}
