//! A thread that carries out requests, because drivers may take long and the window's thread must not wait.

use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// Thread that carries out requests, one after the other, until this is dropped.
pub struct Requests<T> {
    /// Channel to the thread; `None` only in `Drop`.
    sender: Option<Sender<T>>,
    thread: Option<JoinHandle<()>>,
}

impl<T: Send + 'static> Requests<T> {
    /// Starts the thread.
    pub fn new(carry_out: impl FnMut(T) + Send + 'static) -> Self {
        let (sender, requests) = channel();
        let thread = std::thread::spawn(move || requests.into_iter().for_each(carry_out));
        Self { sender: Some(sender), thread: Some(thread) }
    }

    pub fn send(&self, request: T) {
        if let Some(sender) = &self.sender {
            // Sending can't fail: the thread ends only when this sender is dropped.
            let _ = sender.send(request);
        }
    }
}

impl<T> Drop for Requests<T> {
    fn drop(&mut self) {
        self.sender = None;
        if let Some(thread) = self.thread.take() {
            // The thread has reported its own panic.
            let _ = thread.join();
        }
    }
}
