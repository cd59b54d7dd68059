//! Library of the tools: image files, comparisons, resampling, benchmarks, and the references against which errors are
//! measured.

mod bench;
mod closed_form;
#[path = "../common/command.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod command;
mod compare;
#[path = "../common/difference.rs"]
mod difference;
mod output;
mod resample;
mod stress;
mod truth;
