//! Image files, comparisons, resampling, `gpc bench` and its measurements, and the references against which errors are
//! measured.

mod bench;
mod closed_form;
#[path = "../common/command.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod command;
mod compare;
#[path = "../common/difference.rs"]
mod difference;
#[path = "../../src/bin/gpc/cli/bench/measurement/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the command uses the rest")]
mod measurement;
mod output;
mod resample;
mod stress;
#[path = "../common/textured.rs"]
mod textured;
mod truth;
