//! Versions of the header, the library and the binary interface between them.

/// Version of the header; gpc_version returns that of the library.
pub const GPC_VERSION_MAJOR: u32 = 0;
/// See GPC_VERSION_MAJOR.
pub const GPC_VERSION_MINOR: u32 = 2;
/// See GPC_VERSION_MAJOR.
pub const GPC_VERSION_PATCH: u32 = 0;
/// Version of the header as one number, larger for later versions, packed as by VK_MAKE_API_VERSION.
pub const GPC_VERSION: u32 = (GPC_VERSION_MAJOR << 22) | (GPC_VERSION_MINOR << 12) | GPC_VERSION_PATCH;
/// Version of the binary interface. A new version requires programs to be compiled again with the new header. The name
/// of the shared library contains it: libgpc.so.1.
pub const GPC_ABI_VERSION: u32 = 1;

/// Version of the library, packed as GPC_VERSION is.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn gpc_version() -> u32 {
    GPC_VERSION
}
