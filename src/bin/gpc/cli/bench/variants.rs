//! Costs of the camera's variants.

use super::columns::{Cell, Column, Study, Table, column, times};
use super::measurement::{Variant, VariantContender, VariantError};
use super::results::{SceneVariants, VariantRow};
use super::subject::{self, Bench};
use gpc::render::MethodKind;
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

    fn keys() -> Vec<Column<Self, VariantRow>> {
        vec![
            column("scene", "", |scene: &Self, _| Cell::text(&scene.name)),
            column("triangles", "", |scene: &Self, _| Cell::Count(scene.triangles)),
            column("variant", "variant", |_, row: &VariantRow| Cell::text(row.cost.variant)),
            column("samples", "samples", |_, row: &VariantRow| Cell::Count(row.cost.samples)),
        ]
    }

    fn tables() -> Vec<Table<Self, VariantRow>> {
        let columns = times(|row: &VariantRow| [&row.cost.gpu_ms, &row.cost.wall_ms]).into_iter().chain([
            column("gpu_ns", "GPU ns/sample", |_, row: &VariantRow| Cell::Number(row.gpu_ns, 1)),
            column("wall_ns", "wall ns/sample", |_, row: &VariantRow| Cell::Number(row.wall_ns, 1)),
            column("gpu_ratio", "GPU ratio", |_, row: &VariantRow| Cell::Number(row.gpu_ratio, 2)),
            column("wall_ratio", "wall ratio", |_, row: &VariantRow| Cell::Number(row.wall_ratio, 2)),
            column("", "what", |_, row: &VariantRow| Cell::text(row.cost.variant.about())),
        ]);
        vec![Table { caption: "", columns: columns.collect() }]
    }
}
