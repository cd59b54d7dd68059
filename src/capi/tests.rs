//! What programs in C can't provoke.

use super::device::{GPC_VERSION_MAJOR, GPC_VERSION_MINOR, GPC_VERSION_PATCH};
use super::error::{Error, GpcResult, answer, last_error};
use crate::host::{Antialiaser, Frame, List};

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

#[test]
fn objects_can_be_used_from_threads_as_the_header_says() {
    fn shared<T: Send + Sync>() {}
    shared::<Antialiaser>();
    shared::<Frame>();
    shared::<List>();
}

#[test]
fn the_header_has_the_version_of_the_package() {
    let version = format!("{GPC_VERSION_MAJOR}.{GPC_VERSION_MINOR}.{GPC_VERSION_PATCH}");
    assert_eq!(version, env!("CARGO_PKG_VERSION"));
}
