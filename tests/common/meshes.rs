//! The meshes of the stress suite.

// Each test program uses only some of them.
#![allow(unused_imports)]

pub use gpc::bench::Random;
pub use gpc::bench::stress::meshes::*;
