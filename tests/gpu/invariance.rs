//! Changes that must not change an image: repetition, the order of triangles and vertices, and memory.

use glam::DMat3;
use gpc::camera::Camera;
use gpc::render::{Detection, Headless, Rendered, SceneRequest, Settings, Shading, Shadows};
use gpc::sampling::Pattern;
use gpc::scene::AlphaMode;

use crate::devices::{few_texel_elements, within};
use crate::meshes::{Depths, Random, delaunay, fan};
use crate::scenes::{ball_over_checker, distant_lamp};
use crate::soup::soup;
use crate::stage::{Stage, camera, everywhere, flat, on_gpu, seen_at};

fn shuffle<T>(items: &mut [T], seed: u64) {
    let mut random = Random::new(seed);
    for last in (1..items.len()).rev() {
        items.swap(last, random.below(last as u64 + 1) as usize);
    }
}

/// Asserts that two images are bit-identical.
fn assert_same(first: &Rendered, second: &Rendered, what: &str) {
    let bits = |r: &Rendered| -> Vec<_> { r.colors.iter().map(|c| c.map(f32::to_bits)).collect() };
    let pairs = bits(first).into_iter().zip(bits(second));
    let different = pairs.filter(|(a, b)| a != b).count();
    assert_eq!(different, 0, "{what}: pixels that differ");
    assert_eq!(first.colors.len(), second.colors.len(), "{what}");
}

/// Repeated runs give the same bytes: with lit surfaces, with shared and separate shading, and with compositing.
#[test]
fn runs_give_the_same_bytes() {
    on_gpu(|gpu| {
        let size = [96, 64];
        for (blend, shading) in [(0, Shading::Triangle), (0, Shading::Sample), (40, Shading::Triangle)] {
            let mut stage = soup(1, size, 300, blend);
            for material in &mut stage.materials {
                material.unlit = false;
                material.roughness = 0.4;
            }
            let settings =
                Settings::new(size[0], size[1]).attributes(true).map_superpixels(|options| options.shading(shading));
            let (scene, pose) = stage.build();
            let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
            let mut frame = gpu.prepare(&prepared, &settings).unwrap();
            let first = gpu.render(&mut frame, &camera()).unwrap();
            assert!(first.statistics.superpixels > 500);
            let again = gpu.render(&mut frame, &camera()).unwrap();
            let anew = stage.render(gpu, &settings);
            for other in [again, anew] {
                assert_same(&first, &other, "another run");
                assert_eq!(first.attributes, other.attributes);
            }
        }
    });
}

/// A camera that looks the other way.
fn away() -> Camera {
    Camera { axes: DMat3::from_rotation_y(std::f64::consts::PI) * camera().axes, ..camera() }
}

/// A frame object shows the same image, which takes several rounds, whether or not it showed an empty scene before.
#[test]
fn earlier_frames_do_not_matter() {
    on_gpu(|gpu| {
        let size = [256, 160];
        let settings = Settings::new(size[0], size[1]).map_superpixels(|options| options.shading(Shading::Sample));
        let (scene, pose) = soup(3, size, 4000, 0).build();
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let expected = {
            let mut frame = gpu.prepare(&prepared, &settings).unwrap();
            gpu.render(&mut frame, &camera()).unwrap()
        };
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        let nothing = gpu.render(&mut frame, &away()).unwrap();
        assert_eq!(nothing.statistics.superpixels, 0);
        let found = gpu.render(&mut frame, &camera()).unwrap();
        // One round for the superpixels and one for their growth would be the minimum.
        assert!(found.statistics.rounds > 2, "{}", found.statistics.rounds);
        assert_same(&expected, &found, "after a frame of less");
    });
}

/// Shadows of an earlier frame do not matter in pixels in which no centre sees a triangle any more.
#[test]
fn shadows_of_earlier_frames_do_not_matter() {
    on_gpu(|gpu| {
        let settings = Settings::new(160, 96).shadows(Shadows::Exact);
        let settings = settings.map_superpixels(|options| options.detection(Detection::Exact));
        let (scene, mut pose) = ball_over_checker().build();
        pose.lights = vec![distant_lamp()];
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose).shadowed(Shadows::Exact)).unwrap();
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        let shadowed = gpu.render(&mut frame, &camera()).unwrap();
        assert!(shadowed.statistics.superpixels > 500);
        let nothing = gpu.render(&mut frame, &away()).unwrap();
        assert_eq!(nothing.statistics.superpixels, 0);
    });
}

/// Cells with about as many triangles as a kernel of masks has room for, all of them equally near, and hidden ones
/// behind them. Some cells are left to another kernel, which measures areas differently; they must always be the same
/// cells.
#[test]
fn crowded_cells_give_the_same_bytes() {
    on_gpu(|gpu| {
        let size = [160, 96];
        for count in [6_000, 12_000, 24_000] {
            let mut random = Random::new(5);
            let mut stage = Stage::new(
                (0..4_u8).map(|shade| flat([0.2 * f32::from(shade), 0.5, 0.9, 1.0], AlphaMode::Opaque)).collect(),
            );
            for triangle in 0..count {
                let middle = size.map(|side| random.range(-0.5, 0.5) * f64::from(side));
                let distance = 3.0 + 0.0003 * f64::from(random.below(4) as u32);
                let corners = [(); 3].map(|()| {
                    let place = middle.map(|middle| middle + random.range(-1.5, 1.5));
                    seen_at(place, distance, size[1])
                });
                stage.add(triangle % 4, corners);
            }
            let settings =
                Settings::new(size[0], size[1]).map_superpixels(|options| options.detection(Detection::Every));
            let first = stage.render(gpu, &settings);
            for _ in 0..6 {
                assert_same(&first, &stage.render(gpu, &settings), "another run");
            }
        }
    });
}

#[test]
fn the_order_of_triangles_does_not_matter() {
    on_gpu(|gpu| {
        let size = [48, 48];
        for (blend, samples) in [(0, 1), (0, 64), (30, 4)] {
            let stage = soup(2, size, 200, blend);
            let settings = everywhere(size, Pattern::Sobol, samples);
            let first = stage.render(gpu, &settings);
            for seed in 0..2 {
                let mut shuffled = stage.clone();
                let (opaque, blended) = shuffled.triangles.split_at_mut(200 - blend);
                shuffle(opaque, seed);
                shuffle(blended, seed);
                let second = shuffled.render(gpu, &settings);
                assert_same(&first, &second, &format!("shuffled, {samples} samples, {blend} BLEND"));
            }
            let mut sorted = stage.clone();
            sorted.triangles.sort_by_key(|triangle| triangle.material);
            assert_same(&first, &sorted.render(gpu, &settings), "sorted by material");
        }
    });
}

#[test]
fn the_order_of_vertices_does_not_matter() {
    on_gpu(|gpu| {
        let size = [64, 64];
        let materials = soup(3, size, 1, 0).materials.clone();
        for mesh in [
            fan(7, 32.0, 48, Depths::Random),
            delaunay(7, 32.0, 12, Depths::Random),
            delaunay(7, 32.0, 12, Depths::Snapped),
        ] {
            let images = [0, 1, 2, 3, 4, 5].map(|permutation| {
                let mut stage = Stage::new(materials.clone());
                stage.add_mesh(0, &mesh, size[1], |_| permutation);
                for (index, triangle) in stage.triangles.iter_mut().enumerate() {
                    triangle.material = index % 16;
                }
                stage.render(gpu, &everywhere(size, Pattern::Sobol, 32))
            });
            for image in &images[1..] {
                assert_same(&images[0], image, &mesh.name);
            }
        }
    });
}

/// Number of bytes of an image with attributes, which are needed however the work is divided.
fn read_back_bytes(settings: &Settings) -> u64 {
    settings.size.map(u64::from).iter().product::<u64>() * 48
}

/// Renders with less and less memory, until it is too little.
fn with_less(gpu: &mut Headless, stage: &Stage, settings: &Settings) -> Vec<Rendered> {
    let (scene, pose) = stage.build();
    let read_back = read_back_bytes(settings);
    let mut images: Vec<Rendered> = Vec::new();
    let mut limit = None;
    loop {
        let settings = settings.clone().max_memory(limit);
        let rendered = gpu.upload(SceneRequest::new(&scene, &pose).within(limit)).and_then(|prepared| {
            let mut frame = gpu.prepare(&prepared, &settings)?;
            gpu.render(&mut frame, &camera())
        });
        match rendered {
            Ok(image) => {
                let used = image.statistics.memory_bytes;
                assert!(limit.is_none_or(|limit| used <= limit), "{used} of {limit:?}");
                limit = Some(read_back + (used - read_back) * 3 / 4);
                images.push(image);
            }
            Err(error) => {
                assert!(error.is_device_failure(), "{error}");
                return images;
            }
        }
    }
}

/// Less memory means more rounds, and then more regions. Neither changes a superpixel. Regions may change the IDs of
/// `raster`, because the device rounds vertices to 2^-8 pixel after moving them into the region.
#[test]
fn memory_does_not_matter() {
    on_gpu(|gpu| {
        let size = [256, 192];
        let stage = soup(4, size, 500, 0);
        for (detection, shading) in [(Detection::Every, Shading::Sample), (Detection::Contrast, Shading::Triangle)] {
            let settings = everywhere(size, Pattern::Sobol, 64)
                .attributes(true)
                .map_superpixels(|options| options.detection(detection).shading(shading));
            let images = with_less(gpu, &stage, &settings);
            let [first, .., last] = &images[..] else {
                panic!("{} images", images.len());
            };
            let [most, least] = [first, last].map(|image| &image.statistics);
            let [most_bytes, least_bytes] = [most, least].map(|s| s.memory_bytes - read_back_bytes(&settings));
            assert!(least_bytes * 3 < most_bytes, "{least:?}");
            assert!(least.regions > 1 && least.rounds > most.rounds, "{least:?}");
            for image in &images[1..] {
                let regions = image.statistics.regions;
                if detection == Detection::Every || regions == 1 {
                    assert_same(first, image, "less memory");
                }
                let mut others = 0;
                for pixel in 0..first.colors.len() {
                    let [a, b] = [first, image].map(|image| &image.attributes[pixel]);
                    if a.id != b.id || a.superpixel != b.superpixel {
                        others += 1;
                    } else {
                        assert_eq!(first.colors[pixel], image.colors[pixel], "pixel {pixel}");
                    }
                }
                assert!(others == 0 || regions > 1 && others <= 8, "{others} pixels, {regions} regions");
            }
        }
    });
}

/// Lists that outgrow their memory leave tiles without one. The frame is then made again with longer lists. Where the device has
/// no room for these, every triangle is tried in such tiles. Neither changes the image.
#[test]
fn tiles_without_a_list_are_sampled_all_the_same() {
    let test = |gpu: &mut Headless, small: &mut Headless| {
        let size = [96, 64];
        for blend in [0, 8] {
            let mut stage = soup(5, size, 1, 0);
            let mut random = Random::new(6);
            for index in 0..3000 {
                let corners = [0; 3].map(|_| {
                    let place = [0; 2].map(|_| random.range(-90.0, 90.0));
                    seen_at(place, random.range(1.0, 9.0), size[1])
                });
                let material = if index + blend < 3000 { index % 16 } else { 16 };
                stage.add(material, corners);
            }
            let settings = everywhere(size, Pattern::Sobol, 16);
            let listed = stage.render(gpu, &settings);
            let unlisted = stage.render(small, &settings);
            assert_eq!(listed.statistics.unlisted_tiles, 0, "{blend} BLEND");
            assert!(unlisted.statistics.unlisted_tiles > 0, "{blend} BLEND");
            assert_same(&listed, &unlisted, "every triangle is tried");
        }
    };
    on_gpu(|gpu| within(few_texel_elements, |small| test(gpu, small)));
}
