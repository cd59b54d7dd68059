//! Cache of reference images on disk, because rendering one takes minutes.

use super::reference::of_reference;
use gpc::camera::Camera;
use gpc::output::{self, Format, OutputError, Picture};
use gpc::render::{Headless, PreparedScene, RenderError, Settings};
use gpc::scene::PosedGeometry;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

/// Samples a pixel of the probe: a quick image that shows whether shading has changed.
const PROBE_SAMPLES: u32 = 16;

/// Hash of everything that a reference depends on.
///
/// Geometry, camera and footprint enter bit by bit. Materials, textures, lights, shaders and code enter by their
/// effect: every bit of a probe image of 16 samples a pixel that reads textures as the reference does. So a change of
/// a shader or a file invalidates a reference only if it changes the image. Another release of Rust may hash
/// differently; references are then rendered again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint(u64);

impl Fingerprint {
    /// Computes the fingerprint of a reference of `samples` samples a pixel, and renders a probe for it.
    ///
    /// # Errors
    /// As [`Headless::render`].
    pub fn new(
        headless: &mut Headless,
        scene: &PreparedScene,
        geometry: &PosedGeometry,
        camera: &Camera,
        settings: &Settings,
        samples: u32,
    ) -> Result<Self, RenderError> {
        let probe = of_reference(settings, PROBE_SAMPLES);
        let mut frame = headless.prepare(scene, &probe)?;
        let image = headless.render(&mut frame, camera)?;
        let limits = headless.gpu().limits();
        let mut hasher = DefaultHasher::new();
        let [x, y, z] = geometry.origin.to_array().map(f64::to_bits);
        (x, y, z, image.size, samples).hash(&mut hasher);
        (&limits.device_name, &limits.driver).hash(&mut hasher);
        // The debug format of floats loses no bits.
        let places = &geometry.instances;
        let sizes = [probe.scene.line_width, probe.scene.point_size, probe.scene.edge_width];
        let strokes = (&geometry.strokes, &geometry.edges, sizes);
        format!("{camera:?} {:?} {places:?} {strokes:?}", probe.scene.footprint).hash(&mut hasher);
        hasher.write(bytemuck::cast_slice(&geometry.positions));
        hasher.write(bytemuck::cast_slice(&geometry.triangles));
        hasher.write(bytemuck::cast_slice(&image.colors));
        Ok(Self(hasher.finish()))
    }
}

/// Cache of references in a folder.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// Opens a cache in a folder, which need not exist yet.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_path_buf() }
    }

    /// Default folder of the cache: `gpc` in the user's cache folder, `$XDG_CACHE_HOME` or otherwise `~/.cache` (XDG
    /// Base Directory Specification 0.8); `None` for a user without either.
    pub fn default_folder() -> Option<PathBuf> {
        let absolute = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
        absolute("XDG_CACHE_HOME").or_else(|| Some(absolute("HOME")?.join(".cache"))).map(|folder| folder.join("gpc"))
    }

    /// Pixels of the reference with this fingerprint and size, if the cache holds them. An unusable file counts as
    /// absent, with a warning in the log.
    pub fn get(&self, fingerprint: Fingerprint, size: [u32; 2]) -> Option<Vec<[f32; 4]>> {
        let path = self.path(fingerprint);
        let bytes = std::fs::read(&path).ok()?;
        match output::decode_linear(&bytes, &path.display().to_string()) {
            Ok((found, pixels)) if found == size => Some(pixels),
            Ok(_) => {
                log::warn!("{}: its size is wrong; rendering it again", path.display());
                None
            }
            Err(error) => {
                log::warn!("{error}; rendering it again");
                None
            }
        }
    }

    /// Adds a reference to the cache.
    ///
    /// # Errors
    /// [`OutputError`] if its file can't be written.
    pub fn put(&self, fingerprint: Fingerprint, picture: &Picture<'_>) -> Result<(), OutputError> {
        let path = self.path(fingerprint);
        std::fs::create_dir_all(&self.folder).map_err(|source| OutputError::Write { path: path.clone(), source })?;
        output::write_atomically(&path, &output::encode(Format::Exr, picture, &[])?)
    }

    fn path(&self, fingerprint: Fingerprint) -> PathBuf {
        self.folder.join(format!("reference-{:016x}.exr", fingerprint.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_comes_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(&folder.path().join("deep/er"));
        let (kept, other) = (Fingerprint(7), Fingerprint(8));
        let pixels = [[0.1, 0.2, 1.5, 1.0], [1e-9, -0.0, 0.3, 0.25]];
        assert_eq!(cache.get(kept, [2, 1]), None);
        cache.put(kept, &Picture::new([2, 1], &pixels).unwrap()).unwrap();
        assert_eq!(cache.get(kept, [2, 1]).as_deref(), Some(&pixels[..]));
        assert_eq!(cache.get(other, [2, 1]), None);
        assert_eq!(cache.get(kept, [1, 2]), None);
        std::fs::write(cache.path(kept), b"not an image").unwrap();
        assert_eq!(cache.get(kept, [2, 1]), None);
    }
}
