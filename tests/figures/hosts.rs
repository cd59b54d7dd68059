//! Times and errors of the example `forward`, which antialiases its own frames by the library and by brute force.

use crate::data::{self, Row};
use crate::text::{Table, cells, error, short};

/// Methods and numbers of samples, with the heads of their columns.
const METHODS: [(&str, u32, &str); 5] = [
    ("none", 1, "one sample"),
    ("own", 64, "own 8 x 8"),
    ("superpixel", 64, "`gpc`, 64 samples"),
    ("own", 256, "own 16 x 16"),
    ("superpixel", 256, "`gpc`, 256 samples"),
];

/// Table of sizes, with a line of times and a line of errors for each.
pub fn table() -> String {
    let mut text = String::new();
    for of in &data::load("hosts") {
        let mut head = cells(&["size", "aliased"]);
        head.extend(METHODS.map(|(_, _, name)| name.to_owned()));
        let mut table = Table::new(&head);
        let size = |row: &Row| [row.number("width"), row.number("height")];
        let mut sizes: Vec<_> = of.rows.iter().map(size).collect();
        sizes.dedup();
        for at in sizes {
            let rows = METHODS.map(|(method, samples, _)| {
                let mut rows = of.rows.iter();
                rows.find(|row| size(row) == at && row.text("method") == method && row.samples() == samples)
                    .unwrap_or_else(|| panic!("no {method} with {samples} samples at {at:?}"))
            });
            let aliased = 100.0 * rows[2].number("superpixel_fraction");
            let mut times = vec![format!("{} x {}", at[0], at[1]), format!("{aliased:.0} %")];
            times.extend(rows.map(|row| format!("{} ms", short(row.number("cpu_ms_median")))));
            table.row(&times);
            let mut errors = cells(&["RMSE, x 10^5", ""]);
            errors.extend(rows.map(|row| error(row.number("rmse"))));
            table.row(&errors);
        }
        text += &format!("{}:\n\n{}\n", of.source(), table.finish());
    }
    text
}
