//! Stages on one device, and the CPU's view of them.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, PoisonError};

use glam::{DVec3, Vec3};
use gpc::bench::stress::stage;
use gpc::render::{Headless, HeadlessOptions, PreparedScene, Rendered, SceneRequest, Settings};
use gpc::scene::Material;

pub use gpc::bench::stress::stage::{camera, code, everywhere, flat, once, seen_at, textured};

/// One device for all tests; they take turns.
static GPU: Mutex<Option<Headless>> = Mutex::new(None);

/// Runs a test on the device; fails if the validation layer has anything to say about it.
pub fn on_gpu(test: impl FnOnce(&mut Headless)) {
    let mut gpu = GPU.lock().unwrap_or_else(PoisonError::into_inner);
    let gpu = gpu.get_or_insert_with(|| {
        Headless::new(&HeadlessOptions {
            device: None,
            validation: true,
        })
        .unwrap()
    });
    let before = gpu.validation_messages().len();
    test(gpu);
    let messages = gpu.validation_messages().split_off(before);
    assert!(
        messages.is_empty(),
        "{} messages of the validation layer, first: {}",
        messages.len(),
        messages[0]
    );
}

/// A stage that fails the test where it can't be rendered.
#[derive(Clone, Debug, Default)]
pub struct Stage(stage::Stage);

impl Stage {
    /// A stage with these materials and no triangles yet.
    pub fn new(materials: Vec<Material>) -> Self {
        Self(stage::Stage::new(materials))
    }

    /// Puts it on the device.
    pub fn upload(&self, gpu: &mut Headless) -> PreparedScene {
        let (scene, pose) = self.build();
        gpu.upload(SceneRequest::new(&scene, &pose)).unwrap()
    }

    /// Renders it.
    pub fn render(&self, gpu: &mut Headless, settings: &Settings) -> Rendered {
        self.0.render(gpu, settings).unwrap()
    }
}

impl Deref for Stage {
    type Target = stage::Stage;

    fn deref(&self) -> &stage::Stage {
        &self.0
    }
}

impl DerefMut for Stage {
    fn deref_mut(&mut self) -> &mut stage::Stage {
        &mut self.0
    }
}

/// A position in clip space, as the GPU computes it: (pixel x * w, pixel y * w, z, w).
pub fn clip(position: [f32; 3], size: [u32; 2]) -> [f32; 4] {
    let [width, height] = size.map(f64::from);
    let matrix = camera().pixel_matrix(DVec3::ZERO, width, height).as_mat4();
    (matrix * Vec3::from_array(position).extend(1.0)).to_array()
}

/// The IDs of the triangles at the pixels' centres.
pub fn ids(rendered: &Rendered) -> Vec<u32> {
    rendered.attributes.iter().map(|pixel| pixel.id).collect()
}

/// The position of a pixel's centre from the image's.
pub fn centre(pixel: usize, size: [u32; 2]) -> [f64; 2] {
    let at = [pixel % size[0] as usize, pixel / size[0] as usize];
    [0, 1].map(|axis| at[axis] as f64 + 0.5 - f64::from(size[axis]) / 2.0)
}
