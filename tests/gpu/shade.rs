//! Shaders specialised for a material, compared with shaders that omit nothing.

use gpc::render::{CellOptions, Method, SceneRequest, SuperpixelOptions};
use gpc::scene::{AlphaMode, Image, Material, Sampler, Texture, TextureTransform, TextureUse};

use crate::meshes::Random;
use crate::stage::{Stage, camera, flat, on_gpu, once, seen_at};

const SIZE: [u32; 2] = [48, 32];

fn read(texture: u32, scale: f32) -> Option<TextureUse> {
    Some(TextureUse { texture, uv_set: 0, transform: TextureTransform([[scale, 0.0, 0.0], [0.0, scale, 0.0]]) })
}

/// A surface of a lit material, all of whose textures have the same noise.
fn lit(material: Material) -> Stage {
    let mut random = Random::new(3);
    let mut stage = Stage::new(vec![Material { unlit: false, metallic: 0.7, ..material }]);
    stage.texture = Some((
        Image { width: 16, height: 16, pixels: (0..16 * 16 * 4).map(|_| random.below(256) as u8).collect() },
        Sampler::default(),
    ));
    let corners = [[-50.0, -40.0], [-45.0, 45.0], [50.0, 38.0], [47.0, -43.0]];
    stage.add_quad(0, corners.map(|place| seen_at(place, 1.0, SIZE[1])));
    for triangle in &mut stage.triangles {
        triangle.uvs = triangle.corners.map(|[x, y, _]| [x, y]);
    }
    stage
}

/// Occlusion in the texture of metalness and roughness is read together with them; in a copy of the texture, or with
/// other coordinates, separately.
#[test]
fn packed_occlusion_is_occlusion() {
    on_gpu(|gpu| {
        let material = |occlusion| Material {
            base_color_texture: read(0, 1.0),
            metallic_roughness_texture: read(0, 1.0),
            occlusion_texture: occlusion,
            ..flat([0.9, 0.8, 0.7, 1.0], AlphaMode::Opaque)
        };
        let mut shaded = |occlusion| {
            let stage = lit(material(occlusion));
            let (mut scene, pose) = stage.build();
            let copy = scene.images[0].clone();
            scene.images.push(copy);
            scene.textures.push(Texture { image: 1, sampler: Sampler::default() });
            let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
            let settings = once(SIZE).method(Method::None);
            let mut frame = gpu.prepare(&prepared, &settings).unwrap();
            let rendered = gpu.render(&mut frame, &camera()).unwrap();
            rendered.colors
        };
        let packed = shaded(read(0, 1.0));
        assert_eq!(packed, shaded(read(1, 1.0)));
        let elsewhere = shaded(read(0, 1.5));
        assert_eq!(elsewhere, shaded(read(1, 1.5)));
        assert_ne!(packed, elsewhere);
        assert_ne!(packed, shaded(None));
    });
}

/// Each texture of a material is filtered over its own texels, though the one read first has fewer.
#[test]
fn textures_of_other_sizes_keep_their_own_footprint() {
    on_gpu(|gpu| {
        let mut random = Random::new(4);
        let larger =
            Image { width: 64, height: 64, pixels: (0..64 * 64 * 4).map(|_| random.below(256) as u8).collect() };
        let mut shaded = |base, emissive: Option<TextureUse>| {
            let stage = lit(Material {
                base_color_texture: base,
                emissive: [if emissive.is_some() { 1.0 } else { 0.0 }; 3],
                emissive_texture: emissive,
                ..flat([0.9, 0.8, 0.7, 1.0], AlphaMode::Opaque)
            });
            let (mut scene, pose) = stage.build();
            scene.images.push(larger.clone());
            scene.textures.push(Texture { image: 1, sampler: Sampler::default() });
            let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
            // No pixel contrasts enough to become a superpixel, so that textures are filtered over whole pixels.
            let uniform = SuperpixelOptions::new(CellOptions::DEFAULT_SAMPLES).contrast(Some(u8::MAX));
            let settings = once(SIZE).method(uniform.thin(false));
            let mut frame = gpu.prepare(&prepared, &settings).unwrap();
            gpu.render(&mut frame, &camera()).unwrap().colors
        };
        let [small, large] = [read(0, 1.0), read(1, 1.0)];
        let [plain, base] = [None, small].map(|base| shaded(base, None));
        let [alone, both] = [None, small].map(|base| shaded(base, large));
        let mut most = 0.0_f32;
        for pixel in 0..plain.len() {
            for channel in 0..3 {
                let emitted = alone[pixel][channel] - plain[pixel][channel];
                let apart = both[pixel][channel] - base[pixel][channel] - emitted;
                assert!(apart.abs() < 1e-4, "pixel {pixel}: {emitted} and {apart}");
                most = most.max(emitted);
            }
        }
        assert!(most > 0.3, "{most}");
    });
}
