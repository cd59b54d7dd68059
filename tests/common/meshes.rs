//! The meshes of the stress suite of `gpc bench`, and the random numbers that they are made from.

// Each test program uses only some of them.
#![allow(dead_code, unused_imports)]

#[path = "../../src/bin/gpc/cli/bench/measurement/stress/meshes.rs"]
mod shapes;

pub use gpc::testing::Random;
pub use shapes::*;
