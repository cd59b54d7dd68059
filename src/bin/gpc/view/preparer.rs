//! Preparation of frames in a separate thread: drivers take seconds to compile the first kernels of a method.

use super::engine::Engine;
use super::requests::Requests;
use gpc::render::{Encoding, PreparedScene, RenderError, SceneFrame, Settings};
use std::sync::{Arc, Weak};

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
pub struct Preparer(Requests<Request>);

impl Preparer {
    /// Starts the thread, which passes each frame to `deliver`.
    pub fn new(deliver: impl Fn(Prepared) + Send + 'static) -> Self {
        Self(Requests::new(move |request| {
            // Variables are dropped in reverse order: the engine after the objects that use it.
            let Request { engine, scene, settings, ticket } = request;
            if ticket.strong_count() > 0 {
                let frame = engine.renderer.prepare(&scene, &settings, Some(Encoding::Rgba8));
                drop(scene);
                deliver(Prepared { ticket, settings, frame, _engine: engine });
            }
        }))
    }

    /// Requests a frame of a scene with these settings.
    pub fn ask(&self, ticket: &Ticket, settings: Settings, scene: &Arc<PreparedScene>, engine: &Arc<Engine>) {
        self.0.send(Request { ticket: Arc::downgrade(ticket), settings, scene: scene.clone(), engine: engine.clone() });
    }
}
