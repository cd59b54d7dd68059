//! Costs of the camera's variants.

use super::columns::{Cell, Column, Study, column, times};
use super::measurement::Variant;
use super::results::{SceneVariants, VariantRow};
use super::subject::{self, Bench};
use gpc::camera::panorama::PanoramaError;
use gpc::render::MethodKind;
use std::path::Path;

impl Bench<'_> {
    /// Times the camera's variants on the scene of a file. Variants that the scene's camera can't have are left out.
    pub fn variants(&mut self, path: &Path) -> anyhow::Result<SceneVariants> {
        let name = subject::name(path);
        self.progress.begin(&format!("{name}, variants"));
        let subject = self.upload(path, self.args.size)?;
        let settings = subject::settings(MethodKind::Superpixel, 64, self.args.size);
        let (mut contenders, mut samples) = (Vec::new(), Vec::new());
        let mut notes = Vec::new();
        for variant in Variant::ALL {
            self.progress.say(&format!("{variant}, warming up"));
            match variant.warm_up(&mut self.headless, &subject.prepared, &subject.view.camera, &settings) {
                Ok((contender, count)) => {
                    contenders.push(contender);
                    samples.push((variant, count));
                }
                Err(error) if error.is::<PanoramaError>() => notes.push(format!("{variant} left out: {error}")),
                Err(error) => return Err(error),
            }
        }
        self.progress.say("taking turns");
        self.take_turns(&mut contenders, |_, _| {})?;
        let mut rows: Vec<VariantRow> = Vec::new();
        for ((variant, samples), contender) in samples.into_iter().zip(&contenders) {
            let row = VariantRow::new(variant, samples, &contender.cost(), rows.first());
            rows.push(row);
        }
        Ok(SceneVariants { name, triangles: subject.triangles(), rows, notes })
    }
}

impl Study for SceneVariants {
    type Row = VariantRow;
    const FILE: &'static str = "variants.csv";

    fn title(&self) -> String {
        format!("{}, variants of the camera; ratios are of the time a sample to the raster pass's", self.name)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn rows(&self) -> &[VariantRow] {
        &self.rows
    }

    fn columns() -> Vec<Column<Self, VariantRow>> {
        let keys = [
            column("scene", "", |scene: &Self, _| Cell::text(&scene.name)),
            column("triangles", "", |scene: &Self, _| Cell::Count(scene.triangles)),
            column("variant", "variant", |_, row: &VariantRow| Cell::text(row.variant)),
            column("samples", "samples", |_, row: &VariantRow| Cell::Count(row.samples)),
        ];
        let figures = [
            column("gpu_ns", "GPU ns/sample", |_, row: &VariantRow| Cell::Number(row.gpu_ns, 1)),
            column("wall_ns", "wall ns/sample", |_, row: &VariantRow| Cell::Number(row.wall_ns, 1)),
            column("gpu_ratio", "GPU ratio", |_, row: &VariantRow| Cell::Number(row.gpu_ratio, 2)),
            column("wall_ratio", "wall ratio", |_, row: &VariantRow| Cell::Number(row.wall_ratio, 2)),
            column("", "what", |_, row: &VariantRow| Cell::text(row.variant.about())),
        ];
        let times = times(|row: &VariantRow| [&row.gpu_ms, &row.wall_ms]);
        keys.into_iter().chain(times).chain(figures).collect()
    }
}
