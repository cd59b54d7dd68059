//! Times of the methods while one quantity of the scene or the image grows.

use super::csv;
use super::results::{Point, ScalingCurve, Time};
use super::subject::{Bench, settings};
use crate::cli::print;
use gpc::bench::{self, Contender, Growth, GrowthStep};
use gpc::render::{CellOptions, MethodKind, RenderError, SceneRequest};
use std::fmt::Write;

const COLUMNS: &str =
    "quantity,value,width,height,triangles,superpixel_fraction,method,samples,gpu_ms_median,wall_ms_median";

/// All times of all curves (RFC 4180, but with bare line feeds).
pub fn csv(curves: &[ScalingCurve]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for curve in curves {
        for point in &curve.points {
            let superpixels = point.superpixel_fraction.map(|share| share.to_string());
            for time in &point.times {
                // Writing to a string can't fail.
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},{},{},{},{}",
                    csv::quoted(&curve.quantity),
                    point.value,
                    point.size[0],
                    point.size[1],
                    point.triangles,
                    superpixels.as_deref().unwrap_or_default(),
                    time.method,
                    time.samples,
                    time.gpu_ms.median,
                    time.wall_ms.median,
                );
            }
        }
    }
    text
}

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
        let mut curve = ScalingCurve { quantity: growth.to_string(), points: Vec::new(), notes: Vec::new() };
        let mut methods = METHODS.to_vec();
        for index in 0..growth.steps() {
            self.progress.say(&format!("step {} of {}", index + 1, growth.steps()));
            let Some(step) = growth.step(index, self.args.size) else {
                break;
            };
            match self.point(&step, &mut methods, &mut curve.notes) {
                Ok(point) => {
                    if index + 1 < growth.steps() {
                        self.drop_slow(&point, &mut methods, &mut curve.notes);
                    }
                    curve.points.push(point);
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
    fn drop_slow(&self, point: &Point, methods: &mut Vec<(MethodKind, u32)>, notes: &mut Vec<String>) {
        let budget = self.args.budget;
        methods.retain(|(method, _)| {
            let time = point.times.iter().find(|time| time.method == *method);
            let fits = time.is_some_and(|time| 1e-3 * time.wall_ms.min <= budget);
            if !fits {
                notes.push(format!("{method} ends at {}: a frame takes longer than {budget} s", point.value));
            }
            fits
        });
    }

    /// Measures a scene, and removes the methods that can't go any further.
    fn point(
        &mut self,
        step: &GrowthStep,
        methods: &mut Vec<(MethodKind, u32)>,
        notes: &mut Vec<String>,
    ) -> Result<Point, RenderError> {
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
        bench::take_turns(
            &mut self.headless,
            &step.camera,
            &mut contenders,
            self.args.repeat,
            self.args.budget(),
            |_| {},
        )?;
        let times: Vec<_> = methods
            .iter()
            .zip(&contenders)
            .map(|((method, samples), contender)| {
                let cost = contender.cost();
                Time { method: *method, samples: *samples, gpu_ms: cost.gpu_ms, wall_ms: cost.wall_ms }
            })
            .collect();
        Ok(Point {
            value: step.value,
            size: step.size,
            triangles: step.pose.geometry.triangle_count(),
            superpixel_fraction,
            times,
        })
    }
}

/// Prints a curve.
pub fn print(curve: &ScalingCurve) -> anyhow::Result<()> {
    print::line(&format!("\ngrowth of {}, GPU ms:", curve.quantity))?;
    print::line("         value  triangles        size  superpx      none  superpixel 64    ssaa 64")?;
    let ms = |time: Option<f64>| time.map_or_else(|| "-".to_owned(), |ms| format!("{ms:.1}"));
    for point in &curve.points {
        print::line(&format!(
            "  {:>12} {:>10} {:>11} {:>8} {:>9} {:>14} {:>10}",
            format!("{:.4}", point.value).trim_end_matches('0').trim_end_matches('.'),
            point.triangles,
            format!("{}x{}", point.size[0], point.size[1]),
            point.superpixel_fraction.map_or_else(|| "-".to_owned(), |share| format!("{:.1} %", 100.0 * share)),
            ms(point.ms(MethodKind::None)),
            ms(point.ms(MethodKind::Superpixel)),
            ms(point.ms(MethodKind::Ssaa)),
        ))?;
    }
    for note in &curve.notes {
        print::line(&format!("  {note}"))?;
    }
    Ok(())
}
