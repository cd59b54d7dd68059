//! Writes the small scenes of `assets/`.
//!
//! ```text
//! cargo run --release --example generate_assets [FOLDER]
//! ```
//!
//! Each scene holds something that aliases at one sample a pixel. The generator has no
//! randomness of its own: the same sources write the same bytes, which `tests/scene/assets.rs` checks.

#[path = "../common/arguments.rs"]
mod arguments;
mod scenes;

use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    let [folder] = arguments::paths("generate_assets [FOLDER]");
    let folder = folder.unwrap_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets"));
    std::fs::create_dir_all(&folder)?;
    for (name, build) in scenes::ALL {
        let bytes = build();
        let path = folder.join(name);
        std::fs::write(&path, &bytes)?;
        println!("{} {} bytes", path.display(), bytes.len());
    }
    Ok(())
}
