//! Memory and rounds of a host's first frame, by the size of the image and the number of samples.

use crate::data::{self, Row};
use crate::text::{Table, cells, grouped};

/// Devices, with the heads of their columns.
const DEVICES: [(&str, [&str; 2]); 2] = [("gpu", ["GPU: bytes", "rounds"]), ("cpu", ["CPU: bytes", "rounds"])];

/// Table of sizes and numbers of samples.
pub fn table() -> String {
    let mut text = String::new();
    for of in &data::load("room") {
        let mut head = cells(&["size", "samples"]);
        head.extend(DEVICES.iter().flat_map(|(_, heads)| cells(heads)));
        let mut table = Table::new(&head);
        let key = |row: &Row| ["width", "height", "samples"].map(|name| row.number(name) as u64);
        for first in of.rows.iter().filter(|row| row.text("device") == "gpu") {
            let [width, height, samples] = key(first);
            let mut line = vec![format!("{width} x {height}"), grouped(samples)];
            for (device, _) in DEVICES {
                let mut rows = of.rows.iter();
                let row = rows
                    .find(|row| row.text("device") == device && key(row) == key(first))
                    .unwrap_or_else(|| panic!("no {device} at {:?}", key(first)));
                line.extend(["bytes", "rounds"].map(|name| grouped(row.number(name) as u64)));
            }
            table.row(&line);
        }
        text += &format!("{}:\n\n{}\n", of.source(), table.finish());
    }
    text
}
