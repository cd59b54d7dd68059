//! The section on the variants of the camera: what each is, and a table for each scene.

use super::{escape, short, tables, thousands, times};
use crate::cli::bench::results::{SceneVariants, VariantRow};
use gpc::bench::Variant;

/// The section; empty where the variants were not timed.
pub fn section(scenes: &[SceneVariants]) -> String {
    if scenes.is_empty() {
        return String::new();
    }
    let meanings: String =
        Variant::ALL.iter().map(|variant| format!("<li><b>{variant}</b>: {}.</li>\n", variant.about())).collect();
    let tables: String = scenes.iter().map(table).collect();
    format!(
        "<section>\n<h2>Variants of the camera</h2>\n<p class=\"note\">Any set of sampling locations on one engine. A \
         run is timed from locations to values in host memory; making the locations is not part of it. The ratio is of \
         the time a sample to that of the raster pass, so that it also says how often as long a million such samples \
         take as a planar render of a million pixels.</p>\n\
         <ul class=\"note\">\n{meanings}</ul>\n{tables}</section>\n"
    )
}

fn table(scene: &SceneVariants) -> String {
    let row = |row: &VariantRow| {
        let VariantRow { cost, .. } = row;
        format!(
            "<tr><th class=\"name\">{}</th><td>{}</td><td class=\"group\">{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td class=\"group\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            cost.variant,
            thousands(cost.samples),
            short(cost.gpu_ms.median),
            short(cost.gpu_ms.min),
            short(row.gpu_ns),
            times(Some(row.gpu_ratio)),
            short(cost.wall_ms.median),
            short(cost.wall_ms.min),
            short(row.wall_ns),
            times(Some(row.wall_ratio)),
        )
    };
    let notes: String = scene.notes.iter().map(|note| format!("<p class=\"note\">{}</p>\n", escape(note))).collect();
    let columns = "<th class=\"group\">ms</th><th>least</th><th>ns a sample</th><th>of raster</th>";
    let head = format!(
        "<th rowspan=\"2\" class=\"name\">variant</th><th rowspan=\"2\">samples</th>\
         <th colspan=\"4\" class=\"group\">device</th><th colspan=\"4\" class=\"group\">wall</th></tr>\
         <tr>{columns}{columns}"
    );
    format!(
        "<h3>{} <small>{} triangles</small></h3>\n{}{notes}",
        escape(&scene.name),
        thousands(scene.triangles),
        tables::table(&head, scene.rows.iter().map(row), ""),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use gpc::bench::{Spread, VariantCost};

    #[test]
    fn ratios_are_of_the_time_a_sample() {
        let cost = |variant, samples, ms| VariantCost {
            variant,
            samples,
            gpu_ms: Spread::of([ms]),
            wall_ms: Spread::of([2.0 * ms]),
        };
        let raster = cost(Variant::Raster, 1_000_000, 10.0);
        let row = VariantRow::new(cost(Variant::NoPattern, 500_000, 40.0), &raster);
        assert_eq!((row.gpu_ns, row.wall_ns), (80.0, 160.0));
        assert_eq!((row.gpu_ratio, row.wall_ratio), (8.0, 8.0));
        let page = section(&[SceneVariants {
            name: "a < b".to_owned(),
            triangles: 1,
            rows: vec![row],
            notes: vec!["rig left out".to_owned()],
        }]);
        for part in ["a &lt; b", "500,000", "8.00×", "rig left out", "panorama"] {
            assert!(page.contains(part), "{part}");
        }
        assert_eq!(section(&[]), "");
    }
}
