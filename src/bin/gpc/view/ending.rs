//! The end of the process.

use std::time::Duration;

/// Time that unfinished work gets after the window is closed.
const PATIENCE: Duration = Duration::from_millis(500);

/// Ends the process successfully after [`PATIENCE`], unless it has ended by then. A driver that compiles or a file
/// that is being read can't be stopped, and would keep a process without a window alive.
pub fn end_soon() {
    std::thread::spawn(|| {
        std::thread::sleep(PATIENCE);
        log::debug!("ends in the middle of work that can't be stopped");
        // SAFETY: no code of this process runs afterwards. `_exit` runs no destructors of drivers, which would tear
        // down what other threads still use.
        unsafe { libc::_exit(0) };
    });
}
