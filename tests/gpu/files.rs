//! Scenes of files, rendered on one device: those in `assets/`, and those in `../shared` if it is there.

use std::path::{Path, PathBuf};

use gpc::camera::{Camera, Orbit};
use gpc::compare::compare;
use gpc::output::{DecodedImage, Picture};
use gpc::render::{Headless, MethodKind, Rendered, SceneRequest, Settings};
use gpc::scene::{PoseRequest, Scene, SceneError};

use crate::shared::{gltf_files, shared};
use crate::stage::on_gpu;

/// Renders a file at a time, through its first camera or around all that it holds, with each of the settings.
fn render(gpu: &mut Headless, path: &Path, time: f64, settings: &[Settings]) -> Result<Vec<Rendered>, SceneError> {
    let loaded = Scene::load(path)?;
    let pose = loaded.scene.pose(&PoseRequest { time, ..PoseRequest::default() })?;
    let prepared = gpu.upload(SceneRequest::new(&loaded.scene, &pose)).unwrap();
    let (low, high) = pose.geometry.bounds().unwrap_or((glam::DVec3::NEG_ONE, glam::DVec3::ONE));
    let [width, height] = settings[0].size.map(f64::from);
    let camera = match pose.cameras.first() {
        Some(camera) => Camera::from_scene(camera),
        None => Orbit::default().frame(low, high, width / height).unwrap(),
    };
    let images = settings.iter().map(|settings| {
        let mut frame = gpu.prepare(&prepared, settings).unwrap();
        gpu.render(&mut frame, &camera).unwrap()
    });
    Ok(images.collect())
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn every_malformed_file_ends_in_an_image_or_an_error() {
    let settings = [Settings::new(32, 18).method(MethodKind::Superpixel.with_samples(4))];
    let (mut images, mut errors) = (0, 0);
    on_gpu(|gpu| {
        for path in gltf_files(&shared("malformed")) {
            match render(gpu, &path, 0.0, &settings) {
                Ok(made) => {
                    images += 1;
                    assert_eq!(made[0].colors.len(), 32 * 18, "{}", path.display());
                }
                Err(error) => {
                    errors += 1;
                    let error = error.to_string();
                    assert!(error.contains(path.to_str().unwrap()), "{error}");
                }
            }
        }
    });
    assert!(images > 30 && errors > 30, "{images} images, {errors} errors");
}

#[test]
#[cfg_attr(not(shared_files), ignore = "../shared is missing")]
fn a_dozen_real_scenes_render() {
    let settings = [Settings::new(160, 90).method(MethodKind::Superpixel.with_samples(16))];
    on_gpu(|gpu| {
        for name in [
            "AlphaBlendModeTest",
            "Box",
            "BoxAnimated",
            "BoxTextured",
            "BoxVertexColors",
            "CampGround",
            "CesiumMan",
            "Fox",
            "MultiUVTest",
            "NegativeScaleTest",
            "SimpleSkin",
            "TextureTransformTest",
            "UnlitTest",
        ] {
            let path = &gltf_files(&shared("scenes").join(name))[0];
            let image = &render(gpu, path, 0.5, &settings).unwrap()[0];
            assert!(image.statistics.superpixels > 0, "{name}");
            let seen = image.colors.iter().filter(|color| color[3] > 0.0).count();
            assert!(seen > 160 * 90 / 50, "{name} shows {seen} pixels");
        }
    });
}

#[test]
fn superpixels_bring_every_scene_nearer_to_brute_force() {
    let methods = [(MethodKind::Ssaa, 64), (MethodKind::None, 1), (MethodKind::Superpixel, 64)];
    let settings = methods.map(|(method, samples)| {
        Settings::new(240, 136).background(Some([0.6, 0.8, 1.0])).method(method.with_samples(samples))
    });
    on_gpu(|gpu| {
        for name in ["checker", "fence", "foliage", "glass", "letters", "spheres"] {
            let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "assets", &format!("{name}.glb")].iter().collect();
            let images = render(gpu, &path, 0.0, &settings).unwrap();
            let [reference, none, ours] = [0, 1, 2].map(|index: usize| {
                DecodedImage::from(&Picture::new(images[index].size, &images[index].colors).unwrap())
            });
            let [none, ours] = [none, ours].map(|image| compare(&reference, &image).unwrap());
            assert!(ours.rmse < 0.6 * none.rmse, "{name}: {ours:?} against {none:?}");
            assert!(none.rmse > 0.01, "{name} shows nothing that aliases");
        }
    });
}
