//! Heap settings of the process, which may run for hours, unlike other commands.

/// Keeps glibc from giving each thread a heap of its own. Drivers and the renderer compile in many short-lived
/// threads, and such heaps keep the memory that their threads freed: after a while of changing methods and scenes,
/// most of the process's memory was unused. Call it before any thread is started.
pub fn share() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        /// Number of heaps: one for the main thread and one for all others.
        const HEAPS: libc::c_int = 2;
        // SAFETY: the call takes plain numbers and does its own locking. If it fails, the heaps stay as they are.
        let _ = unsafe { libc::mallopt(libc::M_ARENA_MAX, HEAPS) };
    }
}
