//! Pictures to files, in a thread and a device of their own, so that the window never waits for them.

use super::source::{Source, bounds};
use super::standpoint::Standpoint;
use anyhow::bail;
use gpc::output::{self, Format, Picture};
use gpc::render::{Headless, HeadlessOptions, Settings};
use gpc::scene::{PoseRequest, Scene};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A picture to write.
pub struct Screenshot {
    pub source: Source,
    pub scene: Arc<Scene>,
    pub time: f64,
    pub standpoint: Standpoint,
    pub settings: Settings,
    pub output: PathBuf,
    /// How the device is opened.
    pub options: HeadlessOptions,
}

impl Screenshot {
    /// Renders and writes it as `gpc render` does, to the same bytes.
    pub fn write(&self) -> anyhow::Result<()> {
        let pose = self.scene.pose(&PoseRequest {
            time: self.time,
            ..self.source.request.clone()
        })?;
        let [width, height] = self.settings.size.map(f64::from);
        let camera = self
            .standpoint
            .camera(&pose.cameras, bounds(&pose), width / height)?;
        let mut headless = Headless::new(&self.options)?;
        let prepared = headless.upload(&self.scene, &pose, self.settings.max_memory)?;
        let mut frame = headless.prepare(&prepared, &self.settings)?;
        let rendered = headless.render(&mut frame, &camera)?;
        let picture = Picture::new(rendered.size, &rendered.colors)?;
        let bytes = output::encode(Format::Png8, &picture, &[])?;
        output::write_atomically(&self.output, &bytes)?;
        match headless.validation_messages().first() {
            Some(message) => bail!("the validation layer says: {message}"),
            None => Ok(()),
        }
    }
}

/// The first of STEM.png, STEM-2.png and so on that there is no file of yet.
pub fn free_name(folder: &Path, stem: &str) -> PathBuf {
    let mut path = folder.join(format!("{stem}.png"));
    let mut number = 2;
    while path.exists() {
        path = folder.join(format!("{stem}-{number}.png"));
        number += 1;
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_file_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        for expected in ["a.png", "a-2.png", "a-3.png"] {
            let path = free_name(folder.path(), "a");
            assert_eq!(path, folder.path().join(expected));
            std::fs::write(path, "").unwrap();
        }
    }
}
