//! The C API: [`crate::host`] for applications in C, C++ and other languages that can call C.
//!
//! cbindgen makes `include/gpc.h` from these files, with their documentation, so comments here address readers of the
//! header. The test `capi` checks that the header matches.
//!
//! The functions are unsafe because pointers and handles can't be checked completely: their contract is their
//! documentation and the header's introduction, in `cbindgen.toml`. Panics end at the boundary, as `GPC_RESULT_PANIC`.

mod device;
mod dialect;
mod error;
mod frame;
mod geometry;
mod images;
mod input;
mod list;
mod memory;
mod options;
mod shader;
mod version;

#[cfg(test)]
mod tests;
