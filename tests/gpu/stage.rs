//! Stages on a shared device, and their positions as the CPU computes them.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

use ash::vk;
use glam::{DVec3, Vec3};
use gpc::render::{
    CellOptions, Footprint, Headless, HeadlessOptions, Method, PreparedScene, Rendered, SceneRequest, SceneSettings,
    Settings,
};
use gpc::scene::Material;
use gpc::testing::Random;
use gpc::vulkan::Limits;

use crate::meshes;
#[path = "../../src/bin/gpc/cli/bench/measurement/stress/stage.rs"]
#[allow(dead_code, reason = "the stress suite of `gpc bench` uses the rest")]
mod bench;

#[path = "../common/textured.rs"]
mod textured;

pub use bench::{NEAR, camera, everywhere, flat, once, seen_at};
pub use textured::textured;

/// Settings for one sample at each location, like [`once`] for pixels.
pub fn once_each() -> SceneSettings {
    once([1, 1]).scene.footprint(Footprint::Pixel)
}

/// How the settings sample superpixels.
pub fn cells(settings: &Settings) -> CellOptions {
    match &settings.method {
        Method::Superpixel(options) => options.cells.clone(),
        method => panic!("{} has no superpixels", method.kind()),
    }
}

/// Idle devices. Tests reuse them, because a new device compiles all its pipelines anew. Each device has its own
/// instance, and therefore its own messages of the validation layer.
static IDLE: Mutex<Vec<Headless>> = Mutex::new(Vec::new());

fn idle() -> MutexGuard<'static, Vec<Headless>> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a test on a device that no other test is using. Fails if the validation layer reports a message. A device on
/// which a test failed is not reused.
pub fn on_gpu(test: impl FnOnce(&mut Headless)) {
    let known = idle().pop();
    // Most of the time goes to making pipelines, and many tests use the same ones.
    let mut gpu = known.unwrap_or_else(|| open(|limits| limits.max_unused_pipelines = 256));
    run(&mut gpu, test);
    idle().push(gpu);
}

/// What memory is filled with. Lavapipe allocates device memory on the heap, where large blocks are zero at first. On a GPU they
/// hold anything.
const FILLING: i32 = 0xa5;

/// Fills memory that is allocated or freed from now on; 0 leaves it as it is.
fn fill_memory(byte: i32) {
    // SAFETY: the call takes plain numbers and does its own locking.
    let set = unsafe { libc::mallopt(libc::M_PERTURB, byte) };
    assert_eq!(set, 1, "the heap can't fill memory");
}

static FILLS: Mutex<()> = Mutex::new(());

/// While the guard lives, no other thread changes whether memory is filled.
pub fn hold_filling() -> MutexGuard<'static, ()> {
    FILLS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Opens a device under the validation layer. `GPC_SIMULATE=gpu` in the environment makes it a GPU for the engine.
pub fn open(change: impl FnOnce(&mut Limits)) -> Headless {
    {
        let _held = hold_filling();
        fill_memory(FILLING);
    }
    let options = HeadlessOptions::default().validation(true);
    let simulated = std::env::var("GPC_SIMULATE");
    let change = |limits: &mut Limits| {
        match simulated.as_deref() {
            Err(_) => {}
            Ok("gpu") => as_gpu(limits),
            Ok(other) => panic!("GPC_SIMULATE={other}: only a gpu can be simulated"),
        }
        change(limits);
    };
    // SAFETY: tests only lower limits, change how work is divided, or keep more pipelines, which takes memory alone.
    unsafe { Headless::within(&options, change) }.unwrap()
}

/// Makes a device a GPU with memory of its own, as far as the division into rounds, regions and subgroups depends on it.
pub fn as_gpu(limits: &mut Limits) {
    limits.device_type = vk::PhysicalDeviceType::DISCRETE_GPU;
    limits.local_bytes = limits.local_bytes.max(8 << 30);
    limits.max_submitted_samples = limits.max_submitted_samples.min(1 << 27);
}

/// Makes a device a CPU in the same way.
pub fn as_cpu(limits: &mut Limits) {
    limits.device_type = vk::PhysicalDeviceType::CPU;
}

/// Runs a test on a device that divides work into rounds as a CPU does.
pub fn on_cpu(test: impl FnOnce(&mut Headless)) {
    let mut test = Some(test);
    on_gpu(|gpu| {
        if gpu.gpu().limits().device_type == vk::PhysicalDeviceType::CPU
            && let Some(test) = test.take()
        {
            test(gpu);
        }
    });
    if let Some(test) = test {
        run_once(open(as_cpu), test);
    }
}

/// Runs a test on a device. Fails if the validation layer reports a message.
pub fn run(gpu: &mut Headless, test: impl FnOnce(&mut Headless)) {
    test(gpu);
    assert_eq!(gpu.validation_messages(), Vec::<String>::new());
}

/// Runs a test on a device that no other test uses, and closes it. Memory is not filled while it is closed: the validation layer
/// of Debian 12 looks devices up without a lock, so that other tests may read what was just freed.
pub fn run_once(mut gpu: Headless, test: impl FnOnce(&mut Headless)) {
    run(&mut gpu, test);
    let _held = hold_filling();
    fill_memory(0);
    drop(gpu);
    fill_memory(FILLING);
}

/// A stage whose methods panic if it can't be rendered.
#[derive(Clone, Debug, Default)]
pub struct Stage(bench::Stage);

impl Stage {
    /// Makes a stage with these materials and without triangles.
    pub fn new(materials: Vec<Material>) -> Self {
        Self(bench::Stage::new(materials))
    }

    /// Colours each triangle with the [code](code) of its ID.
    pub fn color_by_code(&mut self) {
        for (index, triangle) in self.triangles.iter_mut().enumerate() {
            let [r, g, b] = code(index as u32 + 1);
            triangle.color = [r, g, b, 1.0];
        }
    }

    /// Uploads the stage.
    pub fn upload(&self, gpu: &mut Headless) -> PreparedScene {
        let (scene, pose) = self.build();
        gpu.upload(SceneRequest::new(&scene, &pose)).unwrap()
    }

    /// Renders the stage.
    pub fn render(&self, gpu: &mut Headless, settings: &Settings) -> Rendered {
        self.0.render(gpu, settings).unwrap()
    }
}

impl Deref for Stage {
    type Target = bench::Stage;

    fn deref(&self) -> &bench::Stage {
        &self.0
    }
}

impl DerefMut for Stage {
    fn deref_mut(&mut self) -> &mut bench::Stage {
        &mut self.0
    }
}

/// Code of an ID as an unlit colour: three whole numbers from 1 to 4,095. Sums over up to 1,024 samples still tell
/// triangles apart.
pub fn code(id: u32) -> [f32; 3] {
    let mut random = Random::new(u64::from(id));
    [0; 3].map(|_| (1 + random.below(4095)) as f32)
}

/// Position in clip space as the GPU computes it: (pixel x * w, pixel y * w, z, w).
pub fn clip(position: [f32; 3], size: [u32; 2]) -> [f32; 4] {
    let [width, height] = size.map(f64::from);
    let matrix = camera().pixel_matrix(DVec3::ZERO, width, height).as_mat4();
    (matrix * Vec3::from_array(position).extend(1.0)).to_array()
}

/// IDs of the triangles at the pixels' centres.
pub fn ids(rendered: &Rendered) -> Vec<u32> {
    rendered.attributes.iter().map(|pixel| pixel.id).collect()
}

/// Position of a pixel's centre, relative to the image's centre.
pub fn centre(pixel: usize, size: [u32; 2]) -> [f64; 2] {
    let at = [pixel % size[0] as usize, pixel / size[0] as usize];
    [0, 1].map(|axis| at[axis] as f64 + 0.5 - f64::from(size[axis]) / 2.0)
}
