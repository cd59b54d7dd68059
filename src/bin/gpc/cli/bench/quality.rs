//! Columns of the cost and the accuracy of methods.

use super::columns::{Cell, Column, Study, Table, clocks, column, times};
use super::front;
use super::measurement::{Split, Within};
use super::results::{Row, SceneResults};

/// Number of columns that say what a row is about.
const KEYS: usize = 6;

impl Study for SceneResults {
    type Row = Row;
    const FILE: &'static str = "results.csv";

    fn title(&self) -> String {
        let reference =
            self.reference_seconds.map_or_else(String::new, |s| format!(", reference rendered in {s:.0} s"));
        format!("{}: {} triangles{reference}", self.name, self.triangles)
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn columns() -> Vec<Column<Self, Row>> {
        let keys: [_; KEYS] = [
            column("scene", "", |scene: &Self, _| Cell::text(&scene.name)),
            column("triangles", "", |scene: &Self, _| Cell::Count(scene.triangles)),
            column("textured", "", |scene: &Self, _| Cell::text(scene.textured)),
            column("surface_fraction", "", |scene: &Self, _| Cell::Number(scene.surface_fraction, 3)),
            column("method", "method", |_, row: &Row| Cell::text(row.method)),
            column("samples", "N", |_, row: &Row| Cell::Count(row.samples.into())),
        ];
        let accuracy = |name, heading, cell: fn(&Row) -> Cell| column(name, heading, move |_: &Self, row| cell(row));
        let decibels = |psnr: Option<f64>| Cell::Number(psnr.unwrap_or(f64::INFINITY), 2);
        let figures = [
            accuracy("memory_bytes", "MiB", |row| Cell::Bytes(row.memory_bytes)),
            accuracy("superpixel_fraction", "superpixels", |row| Cell::Percent(row.superpixel_fraction, 1)),
            accuracy("candidates", "", |row| Cell::Count(row.candidates)),
            accuracy("rmse_linear", "", |row| Cell::Number(row.accuracy.rmse_linear, 5)),
            column("psnr_linear", "", move |_, row: &Row| decibels(row.accuracy.psnr_linear)),
            accuracy("rmse", "RMSE", |row| Cell::Number(row.accuracy.rmse, 5)),
            column("psnr", "PSNR", move |_, row: &Row| decibels(row.accuracy.psnr)),
            accuracy("max", "max", |row| Cell::Number(row.accuracy.max, 4)),
            accuracy("flip", "FLIP", |row| Cell::Number(row.accuracy.flip, 4)),
            accuracy("removed", "removed", |row| Cell::Percent(row.accuracy.removed, 1)),
            accuracy("needless", "needless", |row| Cell::Percent(row.accuracy.needless, 3)),
            column("", "at equal time", |scene: &Self, row: &Row| {
                Cell::optional(front::ratio_at_equal_time(scene, row), |ratio| Cell::Number(ratio, 2))
            }),
        ];
        keys.into_iter().chain(times(|row: &Row| clocks(&row.cost))).chain(figures).collect()
    }

    fn more() -> (usize, Vec<Table<Self, Row>>) {
        let left = |name, heading, share: fn(&Split) -> f64| {
            column(name, heading, move |_: &Self, row: &Row| {
                Cell::optional(row.left, |left| Cell::Percent(share(&left), 2))
            })
        };
        let within = |name, heading, share: fn(&Within) -> f64| {
            column(name, heading, move |_: &Self, row: &Row| {
                Cell::optional(row.left_within.as_ref(), |within| Cell::Percent(share(within), 2))
            })
        };
        let causes = vec![
            left("left_superpixels", "in superpixels", |left| left.superpixels),
            left("left_below_threshold", "below threshold", |left| left.below_threshold),
            left("left_unseen", "unseen", |left| left.unseen),
            left("left_inside", "one triangle", |left| left.inside),
            within("left_superpixel_edges", "superpixels: edges", |within| within.superpixel_edges),
            within("left_superpixel_texture", "texture", |within| within.superpixel_texture),
            within("left_superpixel_light", "light", |within| within.superpixel_light),
            within("left_inside_texture", "one triangle: texture", |within| within.inside_texture),
            within("left_inside_light", "light", |within| within.inside_light),
        ];
        let geometry = |name, heading, value: fn(&super::measurement::Accuracy) -> Cell| {
            column(name, heading, move |_: &Self, row: &Row| Cell::optional(row.geometry.as_ref(), value))
        };
        let alone = vec![
            geometry("geometry_rmse", "RMSE", |geometry| Cell::Number(geometry.rmse, 5)),
            geometry("geometry_flip", "FLIP", |geometry| Cell::Number(geometry.flip, 4)),
            geometry("", "removed", |geometry| Cell::Percent(geometry.removed, 1)),
        ];
        let tables = vec![
            Table { caption: "squared error that is left, in shares of one sample's", columns: causes },
            Table { caption: "geometry alone, with textures read for a whole pixel in all", columns: alone },
        ];
        (KEYS, tables)
    }
}
