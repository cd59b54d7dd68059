//! Times of the methods while one quantity of the scene or the image grows.

use super::columns::{Cell, Column, Study, clocks, column, times};
use super::measurement::{Contender, Growth, GrowthStep};
use super::results::{GrowthRow, ScalingCurve};
use super::subject::{Bench, settings};
use gpc::render::{CellOptions, MethodKind, RenderError, SceneRequest};

/// The methods to compare, with their samples a pixel.
const METHODS: [(MethodKind, u32); 3] = [
    (MethodKind::None, 1),
    (MethodKind::Superpixel, CellOptions::DEFAULT_SAMPLES),
    (MethodKind::Ssaa, CellOptions::DEFAULT_SAMPLES),
];

impl Bench<'_> {
    /// Measures a curve. A method whose next frame would take longer than the time limit is dropped. The curve ends
    /// where the device runs out of memory.
    pub fn grow(&mut self, growth: Growth) -> anyhow::Result<ScalingCurve> {
        self.progress.begin(&growth.to_string());
        let mut curve = ScalingCurve { quantity: growth.to_string(), rows: Vec::new(), notes: Vec::new() };
        let mut methods = METHODS.to_vec();
        for index in 0..growth.steps() {
            self.progress.say(&format!("step {} of {}", index + 1, growth.steps()));
            let Some(step) = growth.step(index, self.args.size) else {
                break;
            };
            match self.step(&step, &mut methods, &mut curve.notes) {
                Ok(rows) => {
                    if index + 1 < growth.steps() {
                        self.drop_slow(&step, &rows, &mut methods, &mut curve.notes);
                    }
                    curve.rows.extend(rows);
                }
                Err(error) => {
                    curve.notes.push(format!("ends before {}: {error}", step.value));
                    break;
                }
            }
        }
        Ok(curve)
    }

    /// Removes the methods that would take too long for the next scene.
    fn drop_slow(
        &self,
        step: &GrowthStep,
        rows: &[GrowthRow],
        methods: &mut Vec<(MethodKind, u32)>,
        notes: &mut Vec<String>,
    ) {
        let budget = self.args.budget;
        methods.retain(|(method, _)| {
            let row = rows.iter().find(|row| row.method == *method);
            let fits = row.is_some_and(|row| 1e-3 * row.cost.wall_ms.min <= budget);
            if !fits {
                notes.push(format!("{method} ends at {}: a frame takes longer than {budget} s", step.value));
            }
            fits
        });
    }

    /// Measures a scene, and removes the methods that can't go any further.
    fn step(
        &mut self,
        step: &GrowthStep,
        methods: &mut Vec<(MethodKind, u32)>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<GrowthRow>, RenderError> {
        let prepared = self.headless.upload(SceneRequest::new(&step.scene, &step.pose))?;
        let pixels = f64::from(step.size[0]) * f64::from(step.size[1]);
        let mut contenders = Vec::new();
        let mut superpixel_fraction = None;
        methods.retain(|(method, samples)| {
            let settings = settings(*method, *samples, step.size);
            let headless = &mut self.headless;
            match Contender::warm_up(headless, &prepared, &step.camera, &settings) {
                Ok((contender, rendered)) => {
                    if *method == MethodKind::Superpixel {
                        superpixel_fraction = Some(rendered.statistics.superpixels as f64 / pixels);
                    }
                    contenders.push(contender);
                    true
                }
                Err(error) => {
                    notes.push(format!("{method} ends before {}: {error}", step.value));
                    false
                }
            }
        });
        self.take_turns(&mut contenders, |_, _| {})?;
        let rows = methods.iter().zip(&contenders).map(|((method, samples), contender)| GrowthRow {
            value: step.value,
            size: step.size,
            triangles: step.pose.geometry.triangle_count(),
            superpixel_fraction,
            method: *method,
            samples: *samples,
            cost: contender.cost(),
        });
        Ok(rows.collect())
    }
}

impl Study for ScalingCurve {
    type Row = GrowthRow;
    const FILE: &'static str = "growth.csv";

    fn title(&self) -> String {
        format!("growth of {}", self.quantity)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn rows(&self) -> &[GrowthRow] {
        &self.rows
    }

    fn columns() -> Vec<Column<Self, GrowthRow>> {
        let keys = [
            column("quantity", "", |curve: &Self, _| Cell::text(&curve.quantity)),
            column("value", "value", |_, row: &GrowthRow| Cell::text(row.value)),
            column("width", "width", |_, row: &GrowthRow| Cell::Count(row.size[0].into())),
            column("height", "height", |_, row: &GrowthRow| Cell::Count(row.size[1].into())),
            column("triangles", "triangles", |_, row: &GrowthRow| Cell::Count(row.triangles)),
            column("superpixel_fraction", "superpixels", |_, row: &GrowthRow| {
                Cell::optional(row.superpixel_fraction, |share| Cell::Percent(share, 1))
            }),
            column("method", "method", |_, row: &GrowthRow| Cell::text(row.method)),
            column("samples", "N", |_, row: &GrowthRow| Cell::Count(row.samples.into())),
        ];
        keys.into_iter().chain(times(|row: &GrowthRow| clocks(&row.cost))).collect()
    }
}
