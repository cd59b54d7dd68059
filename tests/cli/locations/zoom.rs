//! Zoomed images of a scene, and the images that unzooming them restores.

use crate::command::{asset, gpc};
use glam::DVec2;
use gpc::output::{self, DecodedImage};
use gpc::resample::Photograph;

#[test]
fn a_zoomed_region_is_the_ordinary_image_of_what_it_shows() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("spheres.glb");
    for aa in ["none", "superpixel"] {
        let zoom = ["zoom", &scene, "-o", "z.exr", "--size", "120x90", "--aa", aa];
        let regions = ["--center", "60,45", "--radius", "20,15", "--shape", "rectangle"];
        let rest = ["--multiplicity", "0.25", "--steps", "--transition", "smooth"];
        gpc(folder.path(), &[&zoom[..], &regions, &rest].concat()).ok();
        let read = |name: &str| Photograph::from(&output::read(&folder.path().join(name)).unwrap());
        let [zoomed, direct, original] = ["z.exr", "z.direct.png", "z.original.png"].map(read);
        assert_eq!(direct.size(), [40, 30]);
        let at = |image: &Photograph, x: u32, y: u32| image.pixels()[(y * image.size()[0] + x) as usize];
        let differs = |a: [f32; 4], b: [f32; 4]| {
            // An EXR holds light that is not tone-mapped, so that only dark pixels can be compared with a PNG.
            let dark = |color: [f32; 4]| color.iter().take(3).all(|v| *v < 0.5);
            dark(a) && dark(b) && a.iter().zip(b).any(|(a, b)| (a - b).abs() > 0.01)
        };
        // Inside of the border, detection has the same neighbours in both images.
        let inside = (1..29).flat_map(|y| (1..39).map(move |x| (x, y)));
        let wrong = inside.clone().filter(|(x, y)| differs(at(&zoomed, 40 + x, 30 + y), at(&direct, *x, *y)));
        // Locations agree except for rounding, which may move a sample across an edge.
        let wrong = wrong.count();
        assert!(wrong <= 3, "{aa}: {wrong}");
        let moved = inside.filter(|(x, y)| differs(at(&zoomed, 40 + x, 30 + y), at(&original, 40 + x, 30 + y)));
        assert!(moved.count() > 50, "the region shows something else than the original");
    }
}

#[test]
fn unzooming_comes_close_to_a_direct_render() {
    let folder = tempfile::tempdir().unwrap();
    let scene = asset("letters.glb");
    let zoom = ["zoom", &scene, "-o", "z.png", "--size", "240x180", "--background", "0.5,0.5,0.5"];
    let regions = ["--center", "120,90", "--radius", "24", "--multiplicity", "0.4", "--steps"];
    gpc(folder.path(), &[&zoom[..], &regions].concat()).ok();
    let rmse = |image: &str, reference: &str, whole: &[&str]| {
        let unzoom = ["unzoom", image, "-o", "u.png", "--reference", reference];
        let run = gpc(folder.path(), &[&unzoom[..], whole].concat()).ok();
        let said = String::from_utf8(run.stdout).unwrap();
        said.split_whitespace().nth(1).unwrap().parse::<f64>().unwrap()
    };
    let region = rmse("z.png", "z.direct.png", &[]);
    // The zoom must be better than an enlargement of the ordinary image in the same view.
    let stored = output::find_text(&std::fs::read(folder.path().join("z.png")).unwrap(), "gpc zoom");
    let original = output::read(&folder.path().join("z.original.png")).unwrap();
    let enlarged = Photograph::from(&original).resample([48, 48], |place| {
        let step = glam::DMat2::from_diagonal(DVec2::splat(0.4));
        (DVec2::new(110.4, 80.4) + 0.4 * place, step)
    });
    let enlarged = DecodedImage::from(&output::Picture::new([48, 48], &enlarged).unwrap());
    let direct = output::read(&folder.path().join("z.direct.png")).unwrap();
    let blurred = gpc::compare::compare(&direct, &enlarged).unwrap().rmse;
    assert!(stored.is_some());
    assert!(region < 0.5 * blurred, "{region} against {blurred}");
    assert!(rmse("z.png", "z.original.png", &["--whole"]) < 0.1);
}
