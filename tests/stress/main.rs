//! The stress suite, short and under the validation layer.

use gpc::bench::stress::{Check, Finding, Length};
use gpc::render::{Headless, HeadlessOptions};

fn headless() -> Headless {
    Headless::new(&HeadlessOptions {
        device: None,
        validation: true,
    })
    .unwrap()
}

/// Runs a part of the suite, which must have found something to look at, and nothing out of bounds.
fn hold(name: &str) {
    let check = Check::ALL.iter().find(|check| check.name == name).unwrap();
    let mut headless = headless();
    let findings = check.run(&mut headless, Length::Short).unwrap();
    assert!(!findings.is_empty());
    for finding in &findings {
        println!("{finding:?}");
        assert!(finding.checked > 0, "{finding:?}");
    }
    let failed: Vec<_> = findings.iter().filter(|finding| !finding.holds()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert_eq!(headless.validation_messages(), Vec::<String>::new());
}

#[test]
fn every_sample_of_a_tiling_is_hit_once() {
    hold("partition of unity");
}

#[test]
fn surfaces_around_the_camera_are_closed() {
    hold("near plane and fields of view");
}

#[test]
fn size_and_place_do_not_matter() {
    hold("scale, origin and depth");
}

#[test]
fn coincident_surfaces_are_stable() {
    hold("coincident surfaces");
}

#[test]
fn hostile_vertices_do_no_harm() {
    hold("hostile vertices");
}

#[test]
fn attributes_of_slivers_stay_in_range() {
    hold("attributes of slivers");
}

#[test]
fn nothing_else_changes_an_image() {
    hold("invariance");
}

#[test]
fn wires_keep_their_energy() {
    hold("motion");
}

/// Neither what exceeds its bound nor what is no number holds.
#[test]
fn a_finding_can_fail() {
    let finding = |measured, allowed| Finding {
        case: String::new(),
        checked: 1,
        unit: "",
        measured,
        allowed,
    };
    assert!(finding(1.0, Some(1.0)).holds() && finding(9.0, None).holds());
    assert!(!finding(1.1, Some(1.0)).holds() && !finding(f64::NAN, Some(1.0)).holds());
}
