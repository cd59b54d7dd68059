//! Calls of the Vulkan loader that one thread makes at a time.

use std::sync::{Mutex, PoisonError};

static CALLS: Mutex<()> = Mutex::new(());

/// Makes a call that creates or destroys a device, finds one of its functions, or names one of its objects.
///
/// Vulkan lets several threads make such calls at once. But loaders up to 1.4.341 look the device up among all devices of the
/// process without a lock, and so read devices that another thread destroys
/// ([issue 2018](https://github.com/KhronosGroup/Vulkan-Loader/issues/2018)). Calls of an application that uses a device of its
/// own are not covered.
pub fn alone<T>(call: impl FnOnce() -> T) -> T {
    let _held = CALLS.lock().unwrap_or_else(PoisonError::into_inner);
    call()
}
