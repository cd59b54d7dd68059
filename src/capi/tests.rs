//! Tests of cases that programs in C can't provoke.

use super::dialect::C;
use super::error::{Error, GpcResult, answer, gpc_last_error, last_error};
use super::input::{Element, elements, init, read, structs, write};
use super::options::GpcOptions;
use super::version::{GPC_VERSION_MAJOR, GPC_VERSION_MINOR, GPC_VERSION_PATCH};
use crate::host::{Antialiaser, Frame, List, ListOptions, Member};
use crate::vulkan::VulkanError;
use ash::vk;
use std::ffi::c_void;

#[test]
fn a_panic_ends_at_the_boundary_with_a_message() {
    assert_eq!(answer(|| panic!("tile {}", 7)), GpcResult::Panic);
    assert_eq!(last_error(), "a defect of the library: tile 7");
    assert_eq!(answer(|| panic!("a\0b")), GpcResult::Panic);
    assert_eq!(last_error(), "a defect of the library: a b");
}

#[test]
fn each_thread_has_its_own_message() {
    assert_eq!(answer(|| Err(Error::Null("here"))), GpcResult::Null);
    let other = std::thread::spawn(|| {
        let before = last_error();
        answer(|| Err(Error::Null("there")));
        (before, last_error())
    });
    let expected = (String::new(), "there is NULL".to_owned());
    assert_eq!(other.join().unwrap(), expected);
    assert_eq!(last_error(), "here is NULL");
    assert_eq!(answer(|| Ok(())), GpcResult::Success);
    assert_eq!(last_error(), "here is NULL");
}

/// A program may ask for the message before the call that fails, as in the arguments of a printf.
#[test]
fn the_message_of_a_thread_stays_where_it_is() {
    let text = gpc_last_error();
    let long = format!("{}é", "x".repeat(4094));
    answer(|| panic!("{long}"));
    // SAFETY: the pointer is that of this thread, which lives.
    let found = || unsafe { std::ffi::CStr::from_ptr(text) }.to_str().unwrap();
    assert_eq!(found(), &format!("a defect of the library: {long}")[..4095]);
    answer(|| panic!("{}", &long["a defect of the library: ".len()..]));
    assert_eq!(found().len(), 4094, "a character that does not fit is left out");
    answer(|| Err(Error::Null("it")));
    assert_eq!(found(), "it is NULL");
}

#[test]
fn a_refused_pipeline_is_told_with_the_features_that_it_may_lack() {
    let result = vk::Result::ERROR_FEATURE_NOT_PRESENT;
    let refused = VulkanError::of_pipeline("vkCreateComputePipelines")(result);
    assert_eq!(answer(|| Err(refused.into())), GpcResult::Vulkan);
    let end = "was the device created with the features of gpc_require_features?";
    assert_eq!(last_error(), format!("vkCreateComputePipelines failed: {result}; {end}"));
    let lost = VulkanError::of_pipeline("vkCreateComputePipelines")(vk::Result::ERROR_DEVICE_LOST);
    assert_eq!(answer(|| Err(lost.into())), GpcResult::DeviceLost);
}

#[test]
fn objects_can_be_used_from_threads_as_the_header_says() {
    fn shared<T: Send + Sync>() {}
    shared::<Antialiaser>();
    shared::<Frame>();
    shared::<List>();
}

/// Frames make more memory when they need it, unless the application forbids it.
#[test]
fn memory_is_fixed_if_the_application_says_so() {
    let mut options = GpcOptions::defaults();
    for (found, fixed) in [(0, false), (1, true)] {
        options.fixed_memory = found;
        // SAFETY: the pattern is no list.
        let options = unsafe { options.options() }.unwrap();
        assert_eq!(options.fixed_memory, fixed);
        assert_eq!(ListOptions::from(&options).fixed_memory, fixed);
    }
}

#[test]
fn the_header_has_the_version_of_the_package() {
    let version = format!("{GPC_VERSION_MAJOR}.{GPC_VERSION_MINOR}.{GPC_VERSION_PATCH}");
    assert_eq!(version, env!("CARGO_PKG_VERSION"));
}

/// Struct of three versions of a header; the last version added `third`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Grown {
    size: u32,
    r#type: u32,
    next: *const c_void,
    first: u64,
    second: u64,
    third: u64,
}

structs! {
    Grown: Scenery { first, second, third } = Grown::initial,
}

impl Grown {
    fn initial() -> Self {
        Self { size: 0, r#type: 0, next: std::ptr::null(), first: 1, second: 2, third: 3 }
    }
}

/// Memory of an application whose header has a `Grown` of `size` bytes: the struct, and the bytes after it.
fn compiled_with(size: usize) -> Grown {
    let mut grown = Grown { size: 0, r#type: 0, next: std::ptr::null(), first: 70, second: 80, third: 90 };
    // SAFETY: the struct has as many bytes or more.
    assert_eq!(unsafe { init(&raw mut grown, size) }, GpcResult::Success);
    grown
}

#[test]
fn a_struct_of_an_earlier_header_is_read_with_defaults_for_what_it_lacks() {
    for (size, third) in [(24, 90), (32, 90), (40, 3)] {
        let mut grown = compiled_with(size);
        let second = if size < 32 { 80 } else { 2 };
        assert_eq!((grown.first, grown.second, grown.third), (1, second, third));
        grown.first = 5;
        // SAFETY: the struct has as many bytes as it says, or more.
        let found = unsafe { read(&raw const grown) }.unwrap();
        assert_eq!((found.first, found.second, found.third), (5, 2, 3));
        let answered = Grown { first: 6, second: 7, third: 8, ..found };
        // SAFETY: as above.
        unsafe { write(&raw mut grown, || Ok(answered)) }.unwrap();
        let second = if size < 32 { 80 } else { 7 };
        let third = if size < 40 { 90 } else { 8 };
        assert_eq!((grown.first, grown.second, grown.third), (6, second, third));
        assert_eq!(grown.size as usize, size);
    }
}

#[test]
fn a_struct_of_a_later_header_and_one_of_another_size_are_refused() {
    for (size, message) in [
        (
            48,
            "Grown.size is 48; a Grown of this library, version 0.2.0, binary interface 1, has 40 bytes: either the struct's gpc_init function was not called, or the program was compiled with the header of a later version; then link the library of that version",
        ),
        (36, "Grown.size is 36; it can be sizeof(Grown), which is 40, as the struct's gpc_init function sets it"),
        (0, "Grown.size is 0; it can be sizeof(Grown), which is 40, as the struct's gpc_init function sets it"),
    ] {
        let mut grown = compiled_with(40);
        grown.size = size;
        // SAFETY: at most the first 40 bytes are read.
        let error = unsafe { read(&raw const grown) }.unwrap_err();
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn elements_of_an_earlier_header_are_read_by_their_stride() {
    let bytes: Vec<u64> = (0..8).collect();
    let pointer = bytes.as_ptr().cast::<Grown>();
    // SAFETY: there are two elements of 32 bytes.
    let found = unsafe { elements(pointer, 2, 32, "array", "array_stride") }.unwrap();
    let members: Vec<_> = found.iter().map(|g| (g.first, g.second, g.third)).collect();
    assert_eq!(members, [(2, 3, 3), (6, 7, 3)]);
    // SAFETY: the stride is refused before anything is read.
    let error = unsafe { elements(pointer, 2, 33, "array", "array_stride") }.unwrap_err();
    assert!(error.to_string().starts_with("array_stride is 33; it can"));
}

/// Each member that an error is about has the name of a member in the header.
#[test]
fn the_names_in_errors_are_those_of_the_header() {
    let header = include_str!("../../include/gpc.h");
    for member in Member::ALL {
        let (name, members) = C::GEOMETRY.parts(*member);
        let start = header.find(&format!("typedef struct {name} {{")).unwrap_or_else(|| panic!("no struct {name}"));
        let length = header[start..].find(&format!("}} {name};")).unwrap();
        let declared: Vec<_> = header[start..start + length]
            .lines()
            .filter_map(|line| line.trim().strip_suffix(';')?.split('[').next()?.rsplit([' ', '*']).next())
            .collect();
        for each in members.split(" and ").flat_map(|names| names.split(" or ")).flat_map(|names| names.split(" x ")) {
            assert!(declared.contains(&each), "{member:?}: {name} has no {each}");
        }
    }
}
