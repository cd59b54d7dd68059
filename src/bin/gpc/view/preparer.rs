//! Frames are prepared by a thread of their own: drivers take seconds for the first kernels of a method, and the window's
//! thread waits for nothing.

use super::engine::Engine;
use gpc::render::{Encoding, Frame, PreparedScene, RenderError, Settings};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;

/// Tells whose frame it is. Nobody wants it any more once this is gone.
pub type Ticket = Arc<()>;

/// Prepared frame, or the error of preparing it.
pub struct Prepared {
    pub ticket: Weak<()>,
    pub settings: Settings,
    pub frame: Result<Frame, RenderError>,
    /// Engine whose device the frame needs until it is dropped.
    _engine: Arc<Engine>,
}

struct Request {
    ticket: Weak<()>,
    settings: Settings,
    scene: Arc<PreparedScene>,
    engine: Arc<Engine>,
}

/// Prepares frames until it is dropped.
pub struct Preparer {
    /// `None` only while dropping.
    requests: Option<Sender<Request>>,
    thread: Option<JoinHandle<()>>,
}

impl Preparer {
    /// Hands frames to `deliver`, in the thread.
    pub fn new(deliver: impl Fn(Prepared) + Send + 'static) -> Self {
        let (requests, received) = channel();
        let thread = std::thread::spawn(move || run(&received, deliver));
        Self {
            requests: Some(requests),
            thread: Some(thread),
        }
    }

    /// Asks for a frame of a scene.
    pub fn ask(
        &self,
        ticket: &Ticket,
        settings: Settings,
        scene: &Arc<PreparedScene>,
        engine: &Arc<Engine>,
    ) {
        if let Some(requests) = &self.requests {
            // The thread ends with this sender, and not before.
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
        // Dropped in the opposite order: the engine goes after what is its.
        let Request {
            engine,
            scene,
            settings,
            ticket,
        } = request;
        if ticket.strong_count() == 0 {
            continue;
        }
        let frame = engine
            .renderer
            .prepare(&scene, &settings, Some(Encoding::Rgba8));
        drop(scene);
        deliver(Prepared {
            ticket,
            settings,
            frame,
            _engine: engine,
        });
    }
}

impl Drop for Preparer {
    fn drop(&mut self) {
        self.requests = None;
        if let Some(thread) = self.thread.take() {
            // A panic has been reported by the thread itself.
            let _ = thread.join();
        }
    }
}
