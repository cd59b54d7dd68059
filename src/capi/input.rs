//! Input from C: structs, arrays and objects.
//!
//! Structs may differ in size: an application keeps the struct of the header with which it was compiled, and later
//! versions of the library add members at the end. So every struct begins with its size, and every array has a stride.
//! Members that the application's header lacks have the values that the `gpc_init` function sets.

use super::device::GpcDevice;
use super::error::{Error, GivenSize, GpcResult, answer};
use super::frame::{GpcOutcome, GpcScenery, GpcVisibilitySamples};
use super::geometry::{GpcAlphaMap, GpcDraw, GpcGeometry, GpcIndirectDraws, GpcMesh};
use super::images::{GpcImageKinds, GpcImages};
use super::list::{GpcListOutcome, GpcListScenery, GpcLocationList};
use super::memory::GpcMemoryRequest;
use super::options::GpcOptions;
use std::ffi::c_void;
use std::mem::{MaybeUninit, offset_of};

/// Type of a struct: the value of its member `type`, which its gpc_init function sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum GpcStructType {
    /// A GpcDevice.
    Device = 1,
    /// A GpcGeometry.
    Geometry = 2,
    /// A GpcImages.
    Images = 3,
    /// A GpcOptions.
    Options = 4,
    /// A GpcScenery.
    Scenery = 5,
    /// A GpcVisibilitySamples.
    VisibilitySamples = 6,
    /// A GpcOutcome.
    Outcome = 7,
    /// A GpcLocationList.
    LocationList = 8,
    /// A GpcListScenery.
    ListScenery = 9,
    /// A GpcListOutcome.
    ListOutcome = 10,
    /// A GpcMemoryRequest.
    MemoryRequest = 11,
    /// A GpcImageKinds.
    ImageKinds = 12,
}

/// Struct of the C API with several possible sizes, alone or as the element of an array.
///
/// # Safety
/// The type is `repr(C)`, and any bytes are a value of it.
pub(super) unsafe trait Element: Copy {
    /// Name of the struct in C.
    const NAME: &'static str;
    /// Sizes of the struct in bytes in all versions of the header, the present one last.
    const SIZES: &'static [usize];

    /// The struct whose bytes are all zero.
    fn zeroed() -> Self {
        // SAFETY: any bytes are a value of the struct.
        unsafe { MaybeUninit::zeroed().assume_init() }
    }

    /// Values of members that an application does not set.
    fn defaults() -> Self {
        Self::zeroed()
    }
}

/// Struct of the C API that is passed by pointer, with a size and a type.
///
/// # Safety
/// The struct begins with the members of [`Head`].
pub(super) unsafe trait Struct: Element {
    /// Value of the member `type`.
    const TYPE: GpcStructType;
}

/// First members of every [`Struct`].
#[derive(Clone, Copy)]
#[repr(C)]
struct Head {
    size: u32,
    kind: u32,
    next: *const c_void,
}

/// Declares structs of the C API. After the name stands the type of a struct that is passed by pointer. The braces have the
/// last member of each version of the header, and a function may follow that makes defaults other than zero.
///
/// The structs are `repr(C)`, and have no members but integers, floats, raw handles, raw pointers and nullable functions.
macro_rules! structs {
    ($($name:ident $(: $kind:ident)? { $($last:ident),+ } $(= $defaults:path)?,)+) => {$(
        // SAFETY: the members, which the macro's documentation names, may have any bytes.
        unsafe impl $crate::capi::input::Element for $name {
            const NAME: &'static str = stringify!($name);
            const SIZES: &'static [usize] =
                &[$(std::mem::offset_of!($name, $last) + $crate::capi::input::bytes_of(|of: &$name| &of.$last)),+];

            $(fn defaults() -> Self {
                $defaults()
            })?
        }

        $(
            const _: () = assert!($crate::capi::input::is_head([
                std::mem::offset_of!($name, size),
                std::mem::offset_of!($name, r#type),
                std::mem::offset_of!($name, next),
            ]));

            // SAFETY: the assertion says that the struct begins with the members of `Head`.
            unsafe impl $crate::capi::input::Struct for $name {
                const TYPE: $crate::capi::input::GpcStructType = $crate::capi::input::GpcStructType::$kind;
            }
        )?
    )+};
}
#[cfg(test)]
pub(super) use structs;

structs! {
    GpcDevice: Device { memory_user },
    GpcGeometry: Geometry { alpha_maps, max_depth, position_bias } = GpcGeometry::initial,
    GpcAlphaMap { reserved },
    GpcMesh { reserved, position_bias },
    GpcIndirectDraws { blended },
    GpcDraw { blended, topology, front_face },
    GpcImages: Images { corner, reserved },
    GpcImageKinds: ImageKinds { color_encoded, reserved },
    GpcOptions: Options { max_memory, fixed_memory, reserved, filter_radius } = GpcOptions::initial,
    GpcScenery: Scenery { projection, viewport },
    GpcVisibilitySamples: VisibilitySamples { condition },
    GpcOutcome: Outcome { gpu_milliseconds, indirect_impossible },
    GpcLocationList: LocationList { colors_offset },
    GpcListScenery: ListScenery { reserved },
    GpcListOutcome: ListOutcome { gpu_milliseconds },
    GpcMemoryRequest: MemoryRequest { linear },
}

/// Whether these are the offsets of the members of [`Head`].
pub(super) const fn is_head(offsets: [usize; 3]) -> bool {
    let [size, kind, next] = offsets;
    size == offset_of!(Head, size) && kind == offset_of!(Head, kind) && next == offset_of!(Head, next)
}

/// Number of bytes of a member.
pub(super) const fn bytes_of<T, M>(_: fn(&T) -> &M) -> usize {
    size_of::<M>()
}

/// Checks that a size is the struct's in some version of the header.
fn check_size<T: Element>(found: usize, given: GivenSize) -> Result<(), Error> {
    const {
        assert!(
            T::SIZES[T::SIZES.len() - 1] == size_of::<T>(),
            "the last member is in no version, or is followed by padding, in which a member could be added unseen"
        );
    }
    if T::SIZES.contains(&found) {
        return Ok(());
    }
    Err(Error::StructSize { given, name: T::NAME, found, expected: size_of::<T>() })
}

/// Reads the struct at a pointer.
///
/// # Safety
/// The pointer is null, or points to a `T` of the size that its first member says.
pub(super) unsafe fn read<T: Struct>(pointer: *const T) -> Result<T, Error> {
    // SAFETY: passed on to the caller; the size is one that the struct has in a version of the header.
    unsafe {
        let head = check(pointer)?;
        Ok(copied(pointer, head.size as usize))
    }
}

/// Copies the first `bytes` bytes at a pointer, followed by defaults.
///
/// # Safety
/// `bytes` bytes at the pointer can be read, and a `T` has at least as many.
unsafe fn copied<T: Element>(pointer: *const T, bytes: usize) -> T {
    let mut value = T::defaults();
    // SAFETY: passed on to the caller; any bytes are a value.
    unsafe {
        std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), (&raw mut value).cast(), bytes);
    }
    value
}

/// Checks that a struct is a `T` of a known size, without unknown extensions.
///
/// # Safety
/// As [`read`].
unsafe fn check<T: Struct>(pointer: *const T) -> Result<Head, Error> {
    if pointer.is_null() {
        return Err(Error::Null(T::NAME));
    }
    // SAFETY: the caller's pointer is not null, and the size is the first member.
    let size = unsafe { pointer.cast::<u32>().read() };
    check_size::<T>(size as usize, GivenSize::Member)?;
    // SAFETY: the smallest struct has a head.
    let head = unsafe { pointer.cast::<Head>().read() };
    if head.kind != T::TYPE as u32 {
        return Err(Error::StructType { name: T::NAME, found: head.kind, expected: T::TYPE as u32 });
    }
    if !head.next.is_null() {
        // SAFETY: a chained struct begins with a size and a type.
        let found = unsafe { head.next.cast::<[u32; 2]>().read() }[1];
        return Err(Error::Next { name: T::NAME, found });
    }
    Ok(head)
}

/// Fills a struct of the application with its size, its type and defaults.
///
/// # Safety
/// The pointer is null, or points to `size` bytes that nobody else uses during the call.
pub(super) unsafe fn init<T: Struct>(pointer: *mut T, size: usize) -> GpcResult {
    answer(|| {
        if pointer.is_null() {
            return Err(Error::Null(T::NAME));
        }
        check_size::<T>(size, GivenSize::Argument)?;
        // SAFETY: passed on to the caller.
        unsafe { put(pointer, T::defaults(), size, std::ptr::null()) };
        Ok(())
    })
}

/// Writes a result to a struct of the application, as far as its version of the struct has the members.
///
/// # Safety
/// As for [`read`]; nobody else uses the struct during the call.
pub(super) unsafe fn write<T: Struct>(pointer: *mut T, make: impl FnOnce() -> Result<T, Error>) -> Result<(), Error> {
    // SAFETY: passed on to the caller.
    unsafe {
        let head = check(pointer)?;
        put(pointer, make()?, head.size as usize, head.next);
    }
    Ok(())
}

/// # Safety
/// The pointer points to `size` bytes, at most the size of a `T`.
unsafe fn put<T: Struct>(pointer: *mut T, mut value: T, size: usize, next: *const c_void) {
    let head = Head { size: size as u32, kind: T::TYPE as u32, next };
    // SAFETY: guaranteed by the caller; a `T` begins with a head.
    unsafe {
        (&raw mut value).cast::<Head>().write(head);
        std::ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), pointer.cast(), size);
    }
}

/// Completes a struct that an application reads: sets its size and type.
pub(super) fn shown<T: Struct>(mut value: T) -> T {
    // SAFETY: the struct is as large as it says.
    unsafe { put(&raw mut value, value, size_of::<T>(), std::ptr::null()) };
    value
}

/// Elements of an array that a struct lends: by the names of the struct and of its members with the array, their number and
/// their stride. Only [`elements`] is called, which is unsafe.
macro_rules! array {
    ($from:expr, $name:ident, $array:ident, $count:ident, $stride:ident) => {
        $crate::capi::input::elements(
            $from.$array,
            $from.$count,
            $from.$stride,
            concat!(stringify!($name), ".", stringify!($array)),
            concat!(stringify!($name), ".", stringify!($stride)),
        )
    };
}
pub(super) use array;

/// Elements of an array at a pointer, `stride` bytes each; none if their number is 0. `array` and `stride_name` are the names
/// of the members that hold pointer and stride.
///
/// # Safety
/// The pointer is null, or points to as many elements of `stride` bytes as the number says.
pub(super) unsafe fn elements<T: Element>(
    pointer: *const T,
    count: u32,
    stride: u32,
    array: &'static str,
    stride_name: &'static str,
) -> Result<Vec<T>, Error> {
    if count == 0 {
        return Ok(Vec::new());
    }
    if pointer.is_null() {
        return Err(Error::Null(array));
    }
    let stride = stride as usize;
    check_size::<T>(stride, GivenSize::Stride(stride_name))?;
    // SAFETY: passed on to the caller; the stride is the size of the element in a version of the header.
    let element = |index| unsafe { copied(pointer.byte_add(index * stride), stride) };
    Ok((0..count as usize).map(element).collect())
}

/// Object at a pointer.
///
/// # Safety
/// The pointer is null, or points to a live `T` that nobody changes as long as the reference is used.
pub(super) unsafe fn object<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Error> {
    // SAFETY: passed on to the caller.
    unsafe { pointer.as_ref() }.ok_or(Error::Null(name))
}

/// Place at a pointer, to which a result is written.
///
/// # Safety
/// The pointer is null, or points to a `T` that nobody else uses as long as the reference is used.
pub(super) unsafe fn place<'a, T>(pointer: *mut T, name: &'static str) -> Result<&'a mut T, Error> {
    // SAFETY: passed on to the caller.
    unsafe { pointer.as_mut() }.ok_or(Error::Null(name))
}

/// Makes an object and stores it in the argument `name`; stores NULL if making it fails.
///
/// # Safety
/// The pointer is null, or points to memory that nobody else uses during the call.
pub(super) unsafe fn hand_over<T>(
    to: *mut *mut T,
    name: &'static str,
    make: impl FnOnce() -> Result<T, Error>,
) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        let to = unsafe { place(to, name) }?;
        *to = std::ptr::null_mut();
        *to = Box::into_raw(Box::new(make()?));
        Ok(())
    })
}

/// Destroys an object that [`hand_over`] stored, if there is one.
///
/// # Safety
/// The pointer is null or came from [`hand_over`], and is not used again.
pub(super) unsafe fn take_back<T>(object: *mut T) {
    answer(|| {
        if !object.is_null() {
            // SAFETY: passed on to the caller.
            drop(unsafe { Box::from_raw(object) });
        }
        Ok(())
    });
}

/// Value of an enumeration for its number in C.
pub(super) fn choice<T: Clone>(name: &'static str, found: u32, values: &[(u32, &'static str, T)]) -> Result<T, Error> {
    let value = values.iter().find(|(number, ..)| *number == found);
    value.map(|(.., value)| value.clone()).ok_or_else(|| {
        let possible = values.iter().map(|(number, value, _)| format!("{value} ({number})"));
        Error::Value { name, found, possible: possible.collect::<Vec<_>>().join(", ") }
    })
}

/// Checks that a member that no version uses yet is 0, so that a later version can use it.
pub(super) fn unused(name: &'static str, found: u32) -> Result<(), Error> {
    choice(name, found, &[(0, "0", ())])
}

/// Value of a VkBool32.
pub(super) fn flag(name: &'static str, found: u32) -> Result<bool, Error> {
    choice(name, found, &[(0, "VK_FALSE", false), (1, "VK_TRUE", true)])
}
