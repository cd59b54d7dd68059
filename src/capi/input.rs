//! Reading what C hands over.
//!
//! A struct that was compiled into an application stays as it was there, while the library grows: later versions of the library
//! add members at the end. So every struct that is handed over says how large it is, arrays say how large their elements are, and
//! what an application does not know of has the value that its `gpc_init` function gives it.

use super::error::{Error, GpcResult, answer};
use std::ffi::c_void;
use std::mem::MaybeUninit;

/// What a struct is: the value of its member `type`, which its gpc_init function sets.
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

/// What C hands over by its size.
///
/// # Safety
/// It is `repr(C)`, and any bytes are a value of it.
pub(super) unsafe trait Element: Copy {
    /// Its name in C.
    const NAME: &'static str;
    /// Its sizes in bytes in all versions of the header, the present one last: made by [`sizes`] of the last member of each.
    const SIZES: &'static [usize];

    /// What members hold that an application does not set.
    fn defaults() -> Self {
        // SAFETY: any bytes are a value of it.
        unsafe { MaybeUninit::zeroed().assume_init() }
    }
}

/// A struct that C hands over alone.
///
/// # Safety
/// It begins with the members of [`Head`].
pub(super) unsafe trait Struct: Element {
    /// The value of its member `type`.
    const TYPE: GpcStructType;
}

/// What every [`Struct`] begins with.
#[derive(Clone, Copy)]
#[repr(C)]
struct Head {
    size: u32,
    kind: u32,
    next: *const c_void,
}

/// The bytes of a struct up to the end of each member named.
macro_rules! sizes {
    ($name:ident, $($last:ident),+) => {
        &[$(std::mem::offset_of!($name, $last) + $crate::capi::input::bytes_of(|of: &$name| &of.$last)),+]
    };
}
pub(super) use sizes;

/// The bytes of a member.
pub(super) const fn bytes_of<T, M>(_: fn(&T) -> &M) -> usize {
    size_of::<M>()
}

/// Refuses a size that the struct has in no version of the header.
fn check_size<T: Element>(found: usize, of: impl Fn(&str) -> String) -> Result<(), Error> {
    const {
        assert!(
            T::SIZES[T::SIZES.len() - 1] == size_of::<T>(),
            "the last member is in no version, or is followed by padding, in which a member could be added unseen"
        );
    }
    if T::SIZES.contains(&found) {
        return Ok(());
    }
    Err(Error::StructSize {
        what: of(T::NAME),
        name: T::NAME,
        found,
        expected: size_of::<T>(),
    })
}

/// The struct that a pointer shows.
///
/// # Safety
/// The pointer is null, or shows a `T` of the size that its first member says.
pub(super) unsafe fn read<T: Struct>(pointer: *const T) -> Result<T, Error> {
    // SAFETY: passed on to the caller; the size is one that the struct has in a version of the header.
    unsafe {
        let head = check(pointer)?;
        Ok(copied(pointer, head.size as usize))
    }
}

/// The first bytes that a pointer shows, and defaults after them.
///
/// # Safety
/// The pointer shows so many bytes, and a `T` has as many or more.
unsafe fn copied<T: Element>(pointer: *const T, bytes: usize) -> T {
    let mut value = T::defaults();
    // SAFETY: passed on to the caller; any bytes are a value.
    unsafe {
        std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), (&raw mut value).cast(), bytes);
    }
    value
}

/// Refuses a struct that is no `T` of a known size, or is extended by one that is not known.
///
/// # Safety
/// As [`read`].
unsafe fn check<T: Struct>(pointer: *const T) -> Result<Head, Error> {
    if pointer.is_null() {
        return Err(Error::Null(T::NAME));
    }
    // SAFETY: the caller's pointer is not null, and the size is the first member.
    let size = unsafe { pointer.cast::<u32>().read() };
    check_size::<T>(size as usize, |name| format!("{name}.size"))?;
    // SAFETY: the smallest struct has a head.
    let head = unsafe { pointer.cast::<Head>().read() };
    if head.kind != T::TYPE as u32 {
        return Err(Error::StructType {
            name: T::NAME,
            found: head.kind,
            expected: T::TYPE as u32,
        });
    }
    if !head.next.is_null() {
        // SAFETY: what is chained begins with a size and a type.
        let found = unsafe { head.next.cast::<[u32; 2]>().read() }[1];
        return Err(Error::Next {
            name: T::NAME,
            found,
        });
    }
    Ok(head)
}

/// Fills a struct of an application's with its size, its type and defaults.
///
/// # Safety
/// The pointer is null, or shows `size` bytes that nobody else uses meanwhile.
pub(super) unsafe fn init<T: Struct>(pointer: *mut T, size: usize) -> GpcResult {
    answer(|| {
        if pointer.is_null() {
            return Err(Error::Null(T::NAME));
        }
        check_size::<T>(size, |name| format!("the size of a {name}"))?;
        // SAFETY: passed on to the caller.
        unsafe { put(pointer, T::defaults(), size, std::ptr::null()) };
        Ok(())
    })
}

/// Answers in a struct of an application's, as far as it is known there.
///
/// # Safety
/// As [`read`]; nobody else uses the struct meanwhile.
pub(super) unsafe fn write<T: Struct>(
    pointer: *mut T,
    make: impl FnOnce() -> Result<T, Error>,
) -> Result<(), Error> {
    // SAFETY: passed on to the caller.
    unsafe {
        let head = check(pointer)?;
        put(pointer, make()?, head.size as usize, head.next);
    }
    Ok(())
}

/// # Safety
/// The pointer shows `size` bytes, which is at most those of a `T`.
unsafe fn put<T: Struct>(pointer: *mut T, mut value: T, size: usize, next: *const c_void) {
    let head = Head {
        size: size as u32,
        kind: T::TYPE as u32,
        next,
    };
    // SAFETY: passed on to the caller; a `T` begins with a head.
    unsafe {
        (&raw mut value).cast::<Head>().write(head);
        std::ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), pointer.cast(), size);
    }
}

/// A struct for an application to read.
pub(super) fn shown<T: Struct>(mut value: T) -> T {
    // SAFETY: the struct is as large as it says.
    unsafe { put(&raw mut value, value, size_of::<T>(), std::ptr::null()) };
    value
}

/// The elements that a pointer shows, `stride` bytes each; none where their number is 0. `array` is the argument or member that
/// the pointer is, its number and its stride have the endings `_count` and `_stride` of it.
///
/// # Safety
/// The pointer is null, or shows so many elements of so many bytes.
pub(super) unsafe fn elements<T: Element>(
    pointer: *const T,
    (count, stride): (u32, u32),
    (array, stride_name): (&'static str, &'static str),
) -> Result<Vec<T>, Error> {
    if count == 0 {
        return Ok(Vec::new());
    }
    if pointer.is_null() {
        return Err(Error::Null(array));
    }
    let stride = stride as usize;
    check_size::<T>(stride, |_| stride_name.to_owned())?;
    // SAFETY: passed on to the caller; the stride is the size of the element in a version of the header.
    let element = |index| unsafe { copied(pointer.byte_add(index * stride), stride) };
    Ok((0..count as usize).map(element).collect())
}

/// The object that a pointer shows.
///
/// # Safety
/// The pointer is null, or shows a live `T` that nobody changes for as long as the reference is used.
pub(super) unsafe fn object<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Error> {
    // SAFETY: passed on to the caller.
    unsafe { pointer.as_ref() }.ok_or(Error::Null(name))
}

/// Where an answer goes.
///
/// # Safety
/// The pointer is null, or shows a `T` that nobody else uses for as long as the reference is used.
pub(super) unsafe fn place<'a, T>(pointer: *mut T, name: &'static str) -> Result<&'a mut T, Error> {
    // SAFETY: passed on to the caller.
    unsafe { pointer.as_mut() }.ok_or(Error::Null(name))
}

/// Hands over an object that is made, the argument `name`; NULL where it can't be.
///
/// # Safety
/// The pointer is null, or shows a place that nobody else uses meanwhile.
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

/// Destroys an object that was handed over, if there is one.
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

/// A number of C's for one of a few values, which have names in C.
pub(super) fn choice<T: Clone>(
    name: &'static str,
    found: u32,
    values: &[(u32, &'static str, T)],
) -> Result<T, Error> {
    let value = values.iter().find(|(number, ..)| *number == found);
    value.map(|(.., value)| value.clone()).ok_or_else(|| {
        let possible = values
            .iter()
            .map(|(number, value, _)| format!("{value} ({number})"));
        Error::Value {
            name,
            found,
            possible: possible.collect::<Vec<_>>().join(", "),
        }
    })
}

/// VK_TRUE or VK_FALSE.
pub(super) fn flag(name: &'static str, found: u32) -> Result<bool, Error> {
    choice(name, found, &[(0, "VK_FALSE", false), (1, "VK_TRUE", true)])
}
