//! Mutated files through all readers: each must give a scene or an error, without a panic or a hang.
//!
//! `cargo test --test fuzz` runs a few thousand executions with fixed seeds. For longer runs, set `FUZZ_SECONDS`;
//! `FUZZ_SEED` selects another sequence, `FUZZ_FORMAT` the seeds of one format by the extension of their names, and
//! `FUZZ_SLOWEST` the most seconds that a file may take; without it there is no limit, since a machine may be busy. Files
//! that fail are written to the temporary folder; each should become a test of its reader. `fuzz/` does the same guided
//! by coverage, which needs a nightly toolchain.

mod mutate;
#[path = "../common/scene_builder.rs"]
mod scene_builder;
mod seeds;
#[path = "../common/shared.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod shared;

use std::{
    panic::catch_unwind,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use gpc::output::{DecodedLight, decode_light};
use gpc::scene::{Edges, Environment, PoseRequest, Scene};
use mutate::Mutator;

/// Loads a file, adds edges, and poses it at a moment and in motion. Returns whether it can be drawn; for a sky,
/// whether it lights a scene.
pub fn exercise(name: &str, bytes: &[u8], base: Option<&Path>) -> bool {
    if name.starts_with("sky") {
        let decoded = decode_light(bytes, "fuzz");
        return decoded.is_ok_and(|DecodedLight { size: [width, height], colors, .. }| {
            // Large images are skipped, because averaging depends on the size alone and takes long.
            colors.len() > 1 << 10 || Environment::from_equirectangular(width, height, colors).is_ok()
        });
    }
    let Ok(loaded) = Scene::from_slice(bytes, "fuzz", base) else {
        return false;
    };
    let mut scene = loaded.scene;
    scene.add_edges(&Edges::default());
    let request = PoseRequest { time: 0.5, ..PoseRequest::default() };
    match scene.pose_in_motion(&request) {
        Ok((_, motion)) => motion.at(&scene, 0.25).is_ok(),
        Err(_) => false,
    }
}

/// A file to mutate, and the folder from which its URIs start.
pub struct Seed {
    pub name: String,
    pub bytes: Vec<u8>,
    pub base: Option<PathBuf>,
    /// A file in that folder that is mutated too, and its original content.
    pub beside: Option<(PathBuf, Vec<u8>)>,
}

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

#[test]
fn mutated_files_end_in_a_scene_or_an_error() {
    // Files are so small that handing parts of them to other threads takes longer than reading them.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.build().unwrap().install(run);
}

fn run() {
    let folder = tempfile::tempdir().unwrap();
    let mut seeds = seeds::all(folder.path());
    if let Ok(format) = std::env::var("FUZZ_FORMAT") {
        seeds.retain(|seed| seed.name.ends_with(&format!(".{format}")));
        assert!(!seeds.is_empty(), "no seed is named *.{format}");
    }
    let formats: Vec<&str> = seeds.iter().map(|seed| seed.name.as_str()).collect();
    let seconds = variable("FUZZ_SECONDS");
    let least = if seconds.is_some() { 0 } else { 200 };
    let mut mutator = Mutator::new(variable("FUZZ_SEED").unwrap_or(1));
    let slowest = Duration::from_secs(variable("FUZZ_SLOWEST").unwrap_or(u64::MAX));
    let start = Instant::now();
    let (mut executions, mut drawn, mut rounds) = (0_u64, 0_u64, 0);
    while rounds < least || seconds.is_some_and(|s| start.elapsed().as_secs() < s) {
        for seed in &seeds {
            let bytes = match seed.name.ends_with(".mtl") {
                true => seed.bytes.clone(),
                false => mutator.mutate(&seed.bytes, &seeds),
            };
            if let Some((path, beside)) = &seed.beside {
                std::fs::write(path, mutator.mutate(beside, &seeds)).unwrap();
            }
            let before = Instant::now();
            let result = catch_unwind(|| exercise(&seed.name, &bytes, seed.base.as_deref()));
            let took = before.elapsed();
            if result.is_err() || took > slowest {
                let path = std::env::temp_dir().join(format!("fuzz-{executions}-{}", seed.name));
                std::fs::write(&path, &bytes).unwrap();
                panic!("{}: panics or takes {took:?}: {}", seed.name, path.display());
            }
            executions += 1;
            drawn += u64::from(result.unwrap());
        }
        rounds += 1;
    }
    println!(
        "{executions} executions of {} seeds in {:?}, {drawn} of them drawable: {formats:?}",
        seeds.len(),
        start.elapsed()
    );
    // A material is never a reason to refuse a scene.
    let is_tolerant = seeds.iter().all(|seed| seed.name.ends_with(".mtl"));
    // A mutator that breaks every file, or none, would test nothing.
    assert!(
        executions == 0 || (drawn > executions / 50 && (drawn < executions * 49 / 50 || is_tolerant)),
        "{drawn} of {executions} are drawable"
    );
}
