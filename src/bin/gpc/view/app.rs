//! The viewer as the handler of the event loop.

use super::Options;
use super::losses::{Losses, is_lost};
use super::preparer::Prepared;
use super::source::Opened;
use super::window::Viewer;
use super::worker::Made;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::WindowId;

/// Message from another thread.
pub enum Event {
    /// A file was loaded, or could not be; the number is that of the request.
    Opened(u64, Box<anyhow::Result<Opened>>),
    /// The scene's file has changed.
    Changed,
    /// A frame was prepared.
    Prepared(Box<Prepared>),
    /// A picture that frames can't show was made.
    Made(Made),
}

/// The viewer as the event loop runs it.
pub struct App {
    options: Options,
    proxy: EventLoopProxy<Event>,
    view: Option<Viewer>,
    losses: Losses,
    outcome: anyhow::Result<Vec<String>>,
}

impl App {
    pub fn new(options: Options, proxy: EventLoopProxy<Event>) -> Self {
        Self { options, proxy, view: None, losses: Losses::default(), outcome: Ok(Vec::new()) }
    }

    /// Ends the viewer; returns all messages of the validation layer.
    pub fn close(self) -> anyhow::Result<Vec<String>> {
        self.outcome
    }

    /// Ends the event loop after an error that the viewer can't recover from.
    fn check(&mut self, events: &ActiveEventLoop, outcome: anyhow::Result<()>) {
        if let Err(error) = outcome.or_else(|error| self.recover(error)) {
            self.outcome = Err(error);
            events.exit();
        }
    }

    /// Opens another device and makes everything anew if the error is a lost device. Any other error is returned.
    fn recover(&mut self, error: anyhow::Error) -> anyhow::Result<()> {
        if !is_lost(&error) || !self.losses.book(Instant::now()) {
            return Err(error);
        }
        if let Some(view) = self.view.take() {
            log::error!("{error:#}; everything is made again");
            self.view = Some(view.reopened()?);
        }
        Ok(())
    }
}

impl ApplicationHandler<Event> for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.view.is_some() {
            return;
        }
        match Viewer::new(events, self.options.clone(), self.proxy.clone()) {
            Ok(view) => self.view = Some(view),
            Err(error) => self.check(events, Err(error)),
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(view) = &mut self.view else {
            return;
        };
        let outcome = view.on_event(&event);
        if view.wants_to_quit {
            events.exit();
        }
        self.check(events, outcome);
    }

    fn user_event(&mut self, events: &ActiveEventLoop, event: Event) {
        let Some(view) = &mut self.view else {
            return;
        };
        let outcome = view.on_done(event);
        self.check(events, outcome);
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let Some(view) = &mut self.view else {
            return;
        };
        match view.advance(Instant::now()) {
            Ok(flow) => events.set_control_flow(flow),
            Err(error) => self.check(events, Err(error)),
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        if let Some(view) = self.view.take() {
            let messages = view.close();
            if let Ok(said) = &mut self.outcome {
                said.extend(messages);
            }
        }
    }
}
