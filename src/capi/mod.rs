//! The C API: [`crate::host`] for applications in C, C++ and whatever calls C.
//!
//! `include/gpc.h` is made of these files by cbindgen, documentation included, so that what is written here is written for
//! readers of the header. The test `capi` holds the two together.
//!
//! The functions are unsafe for what can't be checked of pointers and handles: their contract is their documentation and the
//! header's introduction, in `cbindgen.toml`. Panics end at the boundary, as `GPC_RESULT_PANIC`.

mod device;
mod error;
mod frame;
mod geometry;
mod images;
mod input;
mod list;
mod memory;
mod names;
mod options;
mod shader;
mod version;

#[cfg(test)]
mod tests;
