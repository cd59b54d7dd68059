//! `gpc zoom` of photographs, and `gpc unzoom`. No test here needs a device.

use crate::command::{files, gpc};
use glam::DVec2;
use gpc::camera::LocationMap;
use gpc::camera::zoom::{Shape, Transition, ZoomMap, ZoomRegion};
use gpc::color::srgb;
use gpc::output::{self, Format, Picture};
use std::path::Path;

const SIZE: [u32; 2] = [320, 240];

const REGION: ZoomRegion = ZoomRegion {
    center: [70.0, 60.0],
    radius: [16.0, 16.0],
    multiplicity: 0.5,
    shape: Shape::Circle,
    transition: Transition::Linear,
};

const OPTIONS: [&str; 6] = ["--center", "70,60", "--radius", "16", "--multiplicity", "0.5"];

/// Writes a test card whose colour is the place: red is u / 512, and green is v / 512.
fn write_card(path: &Path) {
    let pixel = |i: u32| {
        let (u, v) = (i % SIZE[0], i / SIZE[0]);
        [(u as f32 + 0.5) / 512.0, (v as f32 + 0.5) / 512.0, 0.5, 1.0]
    };
    let pixels: Vec<_> = (0..SIZE[0] * SIZE[1]).map(pixel).collect();
    let picture = Picture::new(SIZE, &pixels).unwrap();
    std::fs::write(path, output::encode(Format::Png16, &picture, &[]).unwrap()).unwrap();
}

/// Place of the test card that a pixel shows; `None` for a transparent pixel.
fn sampled(image: &output::DecodedImage, x: u32, y: u32) -> Option<DVec2> {
    let [r, g, _, a] = image.pixels[(y * image.size[0] + x) as usize];
    let decode = |v: f32| 512.0 * srgb::decode(f64::from(v));
    (a > 0.5).then(|| DVec2::new(decode(r), decode(g)))
}

fn pixels(size: [u32; 2]) -> impl Iterator<Item = (u32, u32, DVec2)> {
    (0..size[1])
        .flat_map(move |y| (0..size[0]).map(move |x| (x, y, DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5))))
}

#[test]
fn every_step_of_a_test_card_shows_the_locations_of_the_formulas() {
    let folder = tempfile::tempdir().unwrap();
    write_card(&folder.path().join("card.16.png"));
    let arguments = [&["zoom", "card.16.png", "-o", "a.16.png", "--steps"], &OPTIONS[..]];
    gpc(folder.path(), &arguments.concat()).ok();
    assert_eq!(
        files(folder.path()),
        ["a.16.png", "a.locations.png", "a.original.png", "a.resampled.png", "a.transition.png", "card.16.png"]
    );
    let read = |name: &str| output::read(&folder.path().join(name)).unwrap();
    let map = ZoomMap::new(vec![REGION]).unwrap();
    let [result, resampled, transition] = ["a.16.png", "a.resampled.png", "a.transition.png"].map(read);
    let original = read("a.original.png");
    for (x, y, place) in pixels(SIZE) {
        let expected = map.location(place);
        // The card's colours are clamped half a pixel inside of its border.
        let error = |found: DVec2| (found - expected).abs().max_element();
        assert!(error(sampled(&result, x, y).unwrap()) < 0.1, "{place}");
        let fades = REGION.in_transition(place);
        // With 8 bits, places are known to about 4 pixels.
        for (step, shown) in [(&resampled, !fades), (&transition, fades)] {
            let found = sampled(step, x, y);
            assert_eq!(found.is_some(), shown, "{place}");
            assert!(found.is_none_or(|found| error(found) < 4.0));
        }
        assert!((sampled(&original, x, y).unwrap() - place).abs().max_element() < 2.0);
    }
    // Dots mark the locations; there are most in the middle of the region, where locations are dense.
    let dots = read("a.locations.png");
    let count = |x: std::ops::Range<u32>, y: std::ops::Range<u32>| {
        let white = |(x, y): (u32, u32)| dots.pixels[(y * SIZE[0] + x) as usize][2] > 0.99;
        let all = y.flat_map(|y| x.clone().map(move |x| (x, y)));
        all.filter(|at| white(*at)).count()
    };
    assert_eq!(count(64..76, 54..66), 144);
    assert_eq!(count(0..12, 0..12), 64);
    let fading = count(104..116, 54..66);
    assert!((30..60).contains(&fading), "{fading}");
}

#[test]
fn unzooming_gives_ordinary_views_back() {
    let folder = tempfile::tempdir().unwrap();
    write_card(&folder.path().join("card.16.png"));
    for transition in ["linear", "smooth"] {
        let arguments = [&["zoom", "card.16.png", "-o", "a.16.png", "--transition", transition], &OPTIONS[..]];
        gpc(folder.path(), &arguments.concat()).ok();
        let unzoom = ["unzoom", "a.16.png", "-o"];
        gpc(folder.path(), &[&unzoom[..], &["r.16.png"]].concat()).ok();
        let region = output::read(&folder.path().join("r.16.png")).unwrap();
        assert_eq!(region.size, [32, 32]);
        for (x, y, place) in pixels(region.size) {
            let expected = DVec2::new(62.0, 52.0) + 0.5 * place;
            let found = sampled(&region, x, y).unwrap();
            assert!((found - expected).length() < 0.1, "{found} {expected}");
        }
        let whole = ["w.16.png", "--whole", "--reference", "card.16.png"];
        let run = gpc(folder.path(), &[&unzoom[..], &whole].concat()).ok();
        let said = String::from_utf8(run.stdout).unwrap();
        let rmse: f64 = said.split_whitespace().nth(1).unwrap().parse().unwrap();
        assert!(said.starts_with("rmse ") && rmse < 1e-3, "{said}");
    }
}

#[test]
fn a_multiplicity_of_one_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    write_card(&folder.path().join("card.16.png"));
    let zoom = ["zoom", "card.16.png", "-o", "a.16.png", "--center", "3,4"];
    let options = ["--radius", "9,5", "--shape", "rectangle", "--multiplicity", "1"];
    gpc(folder.path(), &[&zoom[..], &options].concat()).ok();
    let compare = ["compare", "card.16.png", "a.16.png", "--max-rmse", "0"];
    gpc(folder.path(), &compare).ok();
}

#[test]
fn a_photograph_may_be_a_jpeg_with_several_regions() {
    let folder = tempfile::tempdir().unwrap();
    let card = folder.path().join("card.16.png");
    write_card(&card);
    image::open(&card).unwrap().to_rgb8().save(folder.path().join("card.jpg")).unwrap();
    let zoom = ["zoom", "card.jpg", "-o", "a.png", "--center", "70,60", "--center", "230,170"];
    let regions = ["--radius", "16", "--radius", "12,20", "--multiplicity", "0.5"];
    let rest = ["--multiplicity", "0.8", "--shape", "circle", "--shape", "rectangle"];
    gpc(folder.path(), &[&zoom[..], &regions, &rest].concat()).ok();
    gpc(folder.path(), &["unzoom", "a.png", "-o", "r.png", "--region", "1"]).ok();
    let region = output::read(&folder.path().join("r.png")).unwrap();
    assert_eq!(region.size, [24, 40]);
    let found = sampled(&region, 12, 20).unwrap();
    // JPEG and 8 bits limit the accuracy.
    assert!(found.distance(DVec2::new(230.4, 170.4)) < 12.0, "{found}");
    let aov = [&zoom[..], &regions, &rest, &["--aov", "depth"]].concat();
    gpc(folder.path(), &aov).exits(2).says(&["photograph"]);
}

#[test]
fn wrong_usage_exits_with_2() {
    let folder = tempfile::tempdir().unwrap();
    write_card(&folder.path().join("card.png"));
    let zoom = ["zoom", "card.png", "-o", "a.png"];
    let cases: [(&[&str], &[&str]); 10] = [
        (&[], &["--center", "--radius", "--multiplicity"]),
        (&["--multiplicity", "1.2"], &["at most 1"]),
        (&["--multiplicity", "0"], &["above 0"]),
        (&["--multiplicity", "-1"], &["above 0"]),
        (&["--multiplicity", "nan"], &["number"]),
        (&["--radius", "0", "--multiplicity", "0.5"], &["above 0"]),
        (&["--center", "1", "--multiplicity", "0.5"], &["X,Y"]),
        (&["--multiplicity", "0.5", "--center", "9,9"], &["2 --center", "1 --radius"]),
        (&["--multiplicity", "0.5", "--shape", "circle", "--shape", "rectangle"], &["1 --center", "2 --shape"]),
        (&["--multiplicity", "0.5", "--shape", "star"], &["rectangle"]),
    ];
    for (options, expected) in cases {
        let place: &[&str] = match options {
            [] => &[],
            ["--radius", ..] => &["--center", "9,9"],
            ["--center", ..] => &["--radius", "3"],
            _ => &["--center", "9,9", "--radius", "3"],
        };
        let arguments = [&zoom[..], place, options].concat();
        gpc(folder.path(), &arguments).exits(2).says(expected);
    }
    let aside = ["--center", "900,9", "--radius", "3", "--multiplicity", "0.5"];
    gpc(folder.path(), &[&zoom[..], &aside].concat()).exits(2).says(&["900,9", "outside of the image"]);
    let to_nowhere = ["zoom", "card.png", "-o", "-", "--steps"];
    gpc(folder.path(), &[&to_nowhere[..], &OPTIONS].concat()).exits(2).says(&["--steps"]);
    assert_eq!(files(folder.path()), ["card.png"]);
}

#[test]
fn images_without_a_zoom_can_not_be_unzoomed() {
    let folder = tempfile::tempdir().unwrap();
    let card = folder.path().join("card.png");
    write_card(&card);
    let unzoom = |name| gpc(folder.path(), &["unzoom", name, "-o", "b.png"]);
    unzoom("card.png").exits(1).says(&["card.png", "gpc zoom wrote"]);
    unzoom("missing.png").exits(1).says(&["missing.png"]);
    gpc(folder.path(), &[&["zoom", "card.png", "-o", "a.png"], &OPTIONS[..]].concat()).ok();
    gpc(folder.path(), &["unzoom", "a.png", "-o", "b.png", "--region", "1"])
        .exits(2)
        .says(&["--region 1", "image has 1"]);
    // The first text is no zoom, the second a zoom with an invalid region.
    let bytes = std::fs::read(&card).unwrap();
    for (text, expected) in [
        ("{", "can't be read"),
        (r#"{"size":[9,9],"regions":[]}"#, "9 x 9"),
        (r#"{"size":[320,240],"regions":[]}"#, "at least one"),
    ] {
        let noted = output::add_text(&bytes, "gpc zoom", text).unwrap();
        std::fs::write(folder.path().join("c.png"), noted).unwrap();
        unzoom("c.png").exits(1).says(&["c.png", expected]);
    }
    assert!(!files(folder.path()).contains(&"b.png".to_owned()));
}
