//! Feeds any bytes to the reader of scenes: the result must be a scene or an error, never a panic.
//!
//! `cargo +nightly fuzz run scene CORPUS` with a folder of small scenes; URIs of files are not followed.

#![no_main]

use gpc::scene::{Edges, PoseRequest, Scene};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = Scene::from_slice(bytes, "fuzz", None) {
        let mut scene = loaded.scene;
        scene.add_edges(&Edges::default());
        let request = PoseRequest { time: 0.5, ..PoseRequest::default() };
        // Errors are fine here as well.
        if let Ok((_, motion)) = scene.pose_in_motion(&request) {
            let _ = motion.at(&scene, 0.25);
        }
    }
});
