//! Parts that the CSV files of a benchmark have in common.

use gpc::bench::Spread;

/// Heads of the columns that [`times`] writes.
macro_rules! time_columns {
    () => {
        "gpu_ms_median,gpu_ms_min,gpu_ms_spread,wall_ms_median,wall_ms_min,wall_ms_spread"
    };
}
pub(super) use time_columns;

/// Text as a quoted cell.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// Milliseconds on the device and by the clock, as six cells.
pub fn times(gpu_ms: &Spread, wall_ms: &Spread) -> String {
    let [gpu, wall] = [gpu_ms, wall_ms].map(|ms| format!("{},{},{}", ms.median, ms.min, ms.spread));
    format!("{gpu},{wall}")
}
