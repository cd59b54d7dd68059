//! Programs that use the library, in Rust and by its C API.

mod capi;
mod culling;
#[path = "../common/difference.rs"]
mod difference;
mod embed;
mod example;
mod layout;
mod visibility;
