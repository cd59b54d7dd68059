//! `gpc view`: a window for looking at a scene.
//!
//! The viewer is a host like any other, and uses only the library's public interface: it has its own device and
//! swapchain, records the renderer's passes into its own command buffers, and draws its panel over the result.

mod actions;
mod app;
mod band;
mod canvas;
mod command;
mod compose;
mod cover;
mod device;
mod ending;
mod engine;
mod files;
mod fly;
mod heap;
mod keys;
mod layer;
mod lens;
mod look;
mod losses;
mod mouse;
mod navigate;
mod notes;
mod open;
mod orders;
mod overlay;
mod painter;
mod panel;
mod photo;
mod pick;
mod picture;
mod player;
mod pointer;
mod preparer;
mod presenter;
mod progress;
mod requests;
mod samples;
mod schedule;
mod slot;
mod source;
mod standpoint;
mod stop;
mod swapchain;
mod tint;
mod watch;
mod window;
mod worker;

pub use look::{Look, default_samples};
pub use source::{Appearance, SceneSource};

use crate::cli::render::args::CameraArgs;
use anyhow::bail;
use app::App;
use gpc::render::HeadlessOptions;
use std::path::PathBuf;
use winit::event_loop::EventLoop;

/// Options of the viewer.
#[derive(Clone, Debug)]
pub struct Options {
    /// Source that is opened first: a file, or the scenes of a folder.
    pub source: SceneSource,
    /// Other files and folders that the arrow keys go to.
    pub others: Vec<PathBuf>,
    /// Options for the standpoint at the start, in the first scene.
    pub start: CameraArgs,
    /// Appearance of scenes beyond what their files say.
    pub appearance: Appearance,
    /// Options of the command line for this appearance and the background.
    pub appearance_options: Vec<String>,
    /// Antialiasing, and the size of the window.
    pub look: Look,
    /// Whether the scene's environment is the background while nothing moves.
    pub shows_environment: bool,
    /// Options for opening the device.
    pub device: HeadlessOptions,
}

/// Error: no display to open a window on.
#[derive(Debug, thiserror::Error)]
#[error("no window can be opened: {0}. Without a display, gpc render writes images to files")]
pub struct NoDisplay(String);

impl NoDisplay {
    /// Makes the error from winit's message, without the source line of winit that the message names.
    fn new(error: &dyn std::error::Error) -> Self {
        let said = error.to_string();
        let reason = match said.split_once("os error at ") {
            Some((_, at_line)) => at_line.split_once(": ").map_or(at_line, |(_, reason)| reason),
            None => &said,
        };
        Self(reason.trim_end_matches('.').into())
    }
}

/// Opens the window, and returns when it is closed.
///
/// # Errors
/// [`NoDisplay`] if there is no display, [`gpc::vulkan::VulkanError`] if no device can present pictures in the window;
/// the messages of the validation layer, if it is on.
pub fn run(options: Options) -> anyhow::Result<()> {
    heap::share();
    let events = EventLoop::with_user_event().build().map_err(|error| NoDisplay::new(&error))?;
    let mut app = App::new(options, events.create_proxy());
    events.run_app(&mut app)?;
    match app.close()?.first() {
        Some(message) => bail!("the validation layer says: {message}"),
        None => Ok(()),
    }
}
