//! Reading what C hands over.

use super::error::{Error, GpcResult, answer};

/// A struct that C fills.
///
/// # Safety
/// It is `repr(C)`, begins with its size as `u32`, and any bytes are a value of it.
pub(super) unsafe trait Struct: Copy {
    const NAME: &'static str;
}

/// The struct that a pointer shows, if it has the size that is known here.
///
/// # Safety
/// The pointer is null, or shows a `T` of the size that its first member says.
pub(super) unsafe fn read<T: Struct>(pointer: *const T) -> Result<T, Error> {
    // SAFETY: the caller's; found to be a `T` by its size, the bytes may be any.
    unsafe {
        check(pointer)?;
        Ok(pointer.read())
    }
}

/// Refuses a struct of another size than is known here.
///
/// # Safety
/// As [`read`].
pub(super) unsafe fn check<T: Struct>(pointer: *const T) -> Result<(), Error> {
    if pointer.is_null() {
        return Err(Error::Null(T::NAME));
    }
    // SAFETY: the caller's pointer is not null, and the size is the first member.
    let found = unsafe { pointer.cast::<u32>().read() };
    let expected = size_of::<T>();
    if found as usize == expected {
        Ok(())
    } else {
        let name = T::NAME;
        Err(Error::StructSize {
            name,
            found,
            expected,
        })
    }
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
