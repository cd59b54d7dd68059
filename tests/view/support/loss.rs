//! Simulated loss of devices: a Vulkan layer, compiled from C, that makes submissions fail.

use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The layer, in a folder of its own.
pub struct Loss {
    folder: TempDir,
    cue: PathBuf,
}

impl Loss {
    const LAYER: &str = "VK_LAYER_GPC_lost_device";

    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let library = folder.path().join("liblost_device.so");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/view/support/lost_device.c");
        let status = Command::new("cc")
            .args(["-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", "-o"])
            .arg(&library)
            .arg(source)
            .status()
            .expect("cc can't be started");
        assert!(status.success(), "cc: {status}");
        let manifest = json!({
            "file_format_version": "1.2.0",
            "layer": {
                "name": Self::LAYER,
                "type": "GLOBAL",
                "library_path": library,
                "api_version": "1.3.0",
                "implementation_version": "1",
                "description": "loses devices",
            },
        });
        std::fs::write(folder.path().join("layer.json"), manifest.to_string()).unwrap();
        let cue = folder.path().join("cue");
        Self { folder, cue }
    }

    /// Environment variables that load the layer.
    pub fn variables(&self) -> [(&str, &Path); 3] {
        [
            ("VK_ADD_LAYER_PATH", self.folder.path()),
            ("VK_INSTANCE_LAYERS", Path::new(Self::LAYER)),
            ("GPC_LOSE_DEVICE", &self.cue),
        ]
    }

    /// Makes the next submission lose its device.
    pub fn once(&self) {
        std::fs::write(&self.cue, "").unwrap();
    }

    /// Makes all devices fail as soon as they are used.
    pub fn always(&self) {
        std::fs::create_dir(&self.cue).unwrap();
        // The layer can't remove a folder that is not empty.
        std::fs::write(self.cue.join("kept"), "").unwrap();
    }
}
