//! Memory of the process, which lives for hours where a command lives for seconds.

/// Keeps glibc from giving each thread a heap of its own. Drivers and the renderer compile in many threads that end soon, and
/// heaps keep what their threads let go of: after a while of changing methods and scenes most of the process was such gaps.
/// To be called before threads are started.
pub fn share() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        /// Number of heaps: one for the window's thread and one for all others.
        const HEAPS: libc::c_int = 2;
        // SAFETY: the call takes plain numbers, and has a lock of its own. Where it is refused, memory is as without it.
        let _ = unsafe { libc::mallopt(libc::M_ARENA_MAX, HEAPS) };
    }
}
