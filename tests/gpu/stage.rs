//! Stages on one device, and the CPU's view of them.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::{DVec3, Vec3};
use gpc::bench::stress::stage;
use gpc::render::{Headless, HeadlessOptions, PreparedScene, Rendered, SceneRequest, Settings};
use gpc::scene::Material;
use gpc::vulkan::Limits;

pub use gpc::bench::stress::stage::{camera, code, everywhere, flat, once, seen_at, textured};

/// Devices that no test is using. They are kept, since a new device compiles all its pipelines anew. Each has an instance,
/// and so the messages of the validation layer, to itself.
static IDLE: Mutex<Vec<Headless>> = Mutex::new(Vec::new());

fn idle() -> MutexGuard<'static, Vec<Headless>> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a test on a device that no other test is using. Fails if the validation layer has anything to say about it; a
/// device on which a test failed is not used again.
pub fn on_gpu(test: impl FnOnce(&mut Headless)) {
    let known = idle().pop();
    let mut gpu = known.unwrap_or_else(|| {
        let options = HeadlessOptions {
            device: None,
            validation: true,
        };
        // Most of the tests' time goes to pipelines, and many tests have the same ones.
        let keep = |limits: &mut Limits| limits.max_unused_pipelines = 256;
        // SAFETY: keeping more pipelines takes memory alone.
        unsafe { Headless::within(&options, keep) }.unwrap()
    });
    test(&mut gpu);
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
    idle().push(gpu);
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
