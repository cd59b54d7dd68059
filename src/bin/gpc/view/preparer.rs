//! Preparation of frames in a separate thread: drivers take seconds to compile the first kernels of a method, and the
//! window's thread must not wait.

use super::engine::Engine;
use gpc::render::{Encoding, PreparedScene, RenderError, SceneFrame, Settings};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;

/// Identifies the layer that requested a frame. Once the layer's ticket is dropped, its frames are no longer wanted.
pub type Ticket = Arc<()>;

/// A prepared frame, or the error of preparing it.
pub struct Prepared {
    pub ticket: Weak<()>,
    pub settings: Settings,
    pub frame: Result<SceneFrame, RenderError>,
    /// Engine whose device the frame uses; dropped after the frame.
    _engine: Arc<Engine>,
}

struct Request {
    ticket: Weak<()>,
    settings: Settings,
    scene: Arc<PreparedScene>,
    engine: Arc<Engine>,
}

/// Thread that prepares frames until this is dropped.
pub struct Preparer {
    /// Channel to the thread; `None` only in `Drop`.
    requests: Option<Sender<Request>>,
    thread: Option<JoinHandle<()>>,
}

impl Preparer {
    /// Starts the thread, which passes each frame to `deliver`.
    pub fn new(deliver: impl Fn(Prepared) + Send + 'static) -> Self {
        let (requests, received) = channel();
        let thread = std::thread::spawn(move || run(&received, deliver));
        Self { requests: Some(requests), thread: Some(thread) }
    }

    /// Requests a frame of a scene with these settings.
    pub fn ask(&self, ticket: &Ticket, settings: Settings, scene: &Arc<PreparedScene>, engine: &Arc<Engine>) {
        if let Some(requests) = &self.requests {
            // Sending can't fail: the thread ends only when this sender is dropped.
            let _ = requests.send(Request {
                ticket: Arc::downgrade(ticket),
                settings,
                scene: scene.clone(),
                engine: engine.clone(),
            });
        }
    }
}

fn run(requests: &Receiver<Request>, deliver: impl Fn(Prepared)) {
    for request in requests {
        // Variables are dropped in reverse order: the engine after the objects that use it.
        let Request { engine, scene, settings, ticket } = request;
        if ticket.strong_count() == 0 {
            continue;
        }
        let frame = engine.renderer.prepare(&scene, &settings, Some(Encoding::Rgba8));
        drop(scene);
        deliver(Prepared { ticket, settings, frame, _engine: engine });
    }
}

impl Drop for Preparer {
    fn drop(&mut self) {
        self.requests = None;
        if let Some(thread) = self.thread.take() {
            // The thread has reported its own panic.
            let _ = thread.join();
        }
    }
}
