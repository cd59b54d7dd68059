//! The host of `visibility` in a window: two frames in flight, whatever the number of the window's images.
//!
//! ```text
//! cargo run --release --features view --example window
//! ```
//!
//! The program ends when the window is closed, or with the key Escape.

#[allow(dead_code, reason = "pictures in files are of the other example")]
#[path = "../common/device.rs"]
mod device;
mod meshes;
#[allow(unused_imports, reason = "another shader is loaded by the other example")]
mod pipelines;
#[allow(dead_code, reason = "pictures in files are of the other example")]
mod slot;
mod swapchain;
mod textures;
mod view;
#[path = "../common/vulkan.rs"]
mod vulkan;

use device::Device;
use gpc::host::Antialiaser;
use meshes::World;
use pipelines::Pipelines;
use slot::Slot;
use std::time::Duration;
use swapchain::{Surface, Swapchain};
use view::{camera, options, time};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::NamedKey;
use winit::platform::pump_events::{EventLoopExtPumpEvents, PumpStatus};
use winit::window::{Window, WindowId};

type Failure = Box<dyn std::error::Error>;

const SIZE: [u32; 2] = [320, 180];
const IN_FLIGHT: usize = 2;

/// The window, and the events that it got.
#[derive(Default)]
struct Shell {
    window: Option<Window>,
    failure: Option<String>,
    resized: bool,
    closed: bool,
}

impl ApplicationHandler for Shell {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let [width, height] = SIZE;
        let attributes =
            Window::default_attributes().with_title("visibility").with_inner_size(PhysicalSize::new(width, height));
        match events.create_window(attributes) {
            Ok(window) => self.window = Some(window),
            Err(error) => self.failure = Some(error.to_string()),
        }
    }

    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        self.resized |= matches!(event, WindowEvent::Resized(_));
        self.closed |= match event {
            WindowEvent::CloseRequested => true,
            WindowEvent::KeyboardInput { event, .. } => event.logical_key == NamedKey::Escape,
            _ => false,
        };
    }
}

fn main() -> Result<(), Failure> {
    let mut events = EventLoop::new()?;
    let mut shell = Shell::default();
    while shell.window.is_none() {
        events.pump_app_events(Some(Duration::from_millis(10)), &mut shell);
        if let Some(failure) = shell.failure.take() {
            return Err(failure.into());
        }
    }
    let window = shell.window.take().ok_or("no window")?;
    let device = Device::with_extensions(&Surface::extensions(&window)?, &[ash::khr::swapchain::NAME])?;
    let surface = Surface::new(&device, &window)?;
    // SAFETY: the handles belong together, the features are enabled, and the device outlives the antialiaser.
    let antialiaser = unsafe { Antialiaser::new(device.lent()) }?;
    let world = World::new(&device)?;
    let pipelines = Pipelines::new(&device, antialiaser.samples_layout())?;
    let mut swapchain = Swapchain::new(&surface, size_of(&window), None)?;
    let mut slots: Vec<Slot<'_>> = Vec::new();
    let mut frame = 0;
    let mut said = [0, 0];
    while !shell.closed {
        let status = events.pump_app_events(Some(Duration::ZERO), &mut shell);
        if matches!(status, PumpStatus::Exit(_)) {
            break;
        }
        // Drivers may present to a window of another size without an error.
        if std::mem::take(&mut shell.resized) {
            swapchain = Swapchain::new(&surface, size_of(&window), Some(swapchain))?;
        }
        let index = frame % IN_FLIGHT;
        // After the slot's fence, its frame, its set and its semaphore are free again.
        match slots.get_mut(index) {
            Some(slot) => slot.wait()?,
            None => {
                let options = options(swapchain.size);
                let with = Some((&antialiaser, &options));
                slots.push(Slot::new(&device, &world, &pipelines, swapchain.size, with)?);
            }
        }
        let slot = &mut slots[index];
        let Some(shown) = swapchain.acquire(index)? else {
            // The window has another size. A new swapchain waits for all commands before the old images go.
            swapchain = Swapchain::new(&surface, size_of(&window), Some(swapchain))?;
            continue;
        };
        if slot.size() != swapchain.size {
            slot.resize(&pipelines, swapchain.size)?;
        }
        slot.show(&world, time(0) + 0.02 * frame as f32, camera(swapchain.size))?;
        slot.submit_to(&world, &pipelines, Some(shown))?;
        if !swapchain.present(&shown)? {
            swapchain = Swapchain::new(&surface, size_of(&window), Some(swapchain))?;
        }
        frame += 1;
        if said != swapchain.size {
            said = swapchain.size;
            eprintln!("shows {} x {} pixels", said[0], said[1]);
        }
    }
    for slot in &mut slots {
        slot.wait()?;
    }
    if let Some(outcome) = slots.first().and_then(Slot::antialiasing) {
        let outcome = outcome.frame.outcome()?;
        let superpixels = outcome.statistics.superpixels;
        eprintln!("{frame} frames, {superpixels} superpixels, {} left over", outcome.left_over);
    }
    Ok(())
}

fn size_of(window: &Window) -> [u32; 2] {
    let PhysicalSize { width, height } = window.inner_size();
    [width.max(1), height.max(1)]
}
