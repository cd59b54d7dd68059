//! Test of the rows that the host writes and shaders read: `tests/rows/shaders/rows.comp` reads each field by the functions of the
//! shaders' includes.

use super::{FrameGeometry, FrameLook};
use crate::engine::spirv::{self, frame_set};
use crate::render::{Headless, HeadlessOptions, SceneRequest};
use crate::scene::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, DrawClass, DrawRange, Filter, Image, Iridescence, Light,
    LightKind, Lobes, Material, MeshInstance, Pose, PosedGeometry, Sampler, Scene, Sheen, Specular, SpecularGlossiness,
    Texture, TextureTransform, TextureUse, Transmission, VertexStreams, Wrap,
};
use crate::vulkan::{
    Access, Binding, DescriptorSets, Interface, Invocations, Memory, MemoryUse, PassLayout, Recorder, SharedLayout,
    Specialized, Use, compute_pipeline,
};
use ash::vk;
use ash::vk::DescriptorType as Kind;
use glam::{DAffine3, DMat4, DVec3};
use std::sync::Arc;

const FIELDS: Binding = Binding::new(0, "fields", Kind::STORAGE_BUFFER, 1);

const fn read(set: u32, binding: Binding) -> Use {
    let access = Access::Read;
    Use { set, binding, access }
}

static INTERFACE: Interface = Interface {
    name: "rows",
    in_frame: true,
    uses: &[
        read(0, frame_set::FRAME),
        read(1, frame_set::POSITIONS),
        read(1, frame_set::TRIANGLES),
        read(1, frame_set::NORMALS),
        read(1, frame_set::TANGENTS),
        read(1, frame_set::UVS),
        read(1, frame_set::COLORS),
        read(1, frame_set::MATERIALS),
        read(1, frame_set::LIGHTS),
        read(1, frame_set::ALPHA_ATLAS),
        read(1, frame_set::INSTANCE_OF),
        read(1, frame_set::INSTANCES),
        Use { set: 2, binding: FIELDS, access: Access::Write },
    ],
    push_bytes: 12,
    invocations: Invocations::Fixed(1),
    by_teams: false,
};

/// Room for the fields, in words.
const MOST_FIELDS: usize = 256;

/// Different numbers, all exact in 32 bits.
struct Numbers(f32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 += 1.0;
        self.0
    }

    fn several<const N: usize>(&mut self) -> [f32; N] {
        std::array::from_fn(|_| self.next())
    }
}

/// A material with all lobes, and two textures with transforms of their own.
fn material(n: &mut Numbers) -> Material {
    let mut texture =
        |uv_set| Some(TextureUse { texture: 0, uv_set, transform: TextureTransform([n.several(), n.several()]) });
    let (base_color_texture, normal_texture) = (texture(0), texture(1));
    Material {
        base_color: n.several(),
        metallic: n.next(),
        roughness: n.next(),
        emissive: n.several(),
        normal_scale: n.next(),
        occlusion_strength: n.next(),
        alpha_mode: AlphaMode::Mask { cutoff: n.next() },
        double_sided: true,
        base_color_texture,
        normal_texture,
        lobes: Lobes {
            specular: Some(Specular {
                reflectance: 1.0,
                factor: n.next(),
                color: n.several(),
                texture: None,
                color_texture: None,
            }),
            clearcoat: Some(Clearcoat {
                factor: n.next(),
                roughness: n.next(),
                normal_scale: n.next(),
                texture: None,
                roughness_texture: None,
                normal_texture: None,
            }),
            sheen: Some(Sheen {
                color: n.several(),
                roughness: n.next(),
                color_texture: None,
                roughness_texture: None,
            }),
            anisotropy: Some(Anisotropy { strength: n.next(), rotation: 0.5, texture: None }),
            iridescence: Some(Iridescence {
                factor: n.next(),
                ior: n.next(),
                thickness: n.several(),
                texture: None,
                thickness_texture: None,
            }),
            diffuse_transmission: Some(DiffuseTransmission {
                factor: n.next(),
                color: n.several(),
                texture: None,
                color_texture: None,
            }),
            transmission: Some(Transmission {
                factor: n.next(),
                texture: None,
                thickness: n.next(),
                thickness_texture: None,
                absorption: n.several(),
            }),
            specular_glossiness: Some(SpecularGlossiness {
                specular: n.several(),
                glossiness: n.next(),
                texture: None,
            }),
        },
        ..Material::default()
    }
}

/// Two triangles of different materials, each drawn by an instance, the second one mirrored.
fn scene(n: &mut Numbers) -> (Scene, Pose) {
    let mut scene = Scene::from_materials(vec![Material::default(), material(n)]);
    let [width, height] = [4, 2];
    scene.images = vec![Image { width, height, pixels: (0..4 * width * height).map(|byte| byte as u8).collect() }];
    scene.textures = vec![Texture {
        image: 0,
        sampler: Sampler {
            mag: Filter::Nearest,
            wrap_u: Wrap::ClampToEdge,
            wrap_v: Wrap::MirroredRepeat,
            ..Sampler::default()
        },
    }];
    let draw = |triangle: u32| DrawRange {
        first_triangle: triangle,
        triangle_count: 1,
        material: triangle,
        class: DrawClass::of(&scene.materials[triangle as usize]),
    };
    let instance = |triangle: u32, transform| MeshInstance {
        first_triangle: triangle,
        triangle_count: 1,
        first_index: MeshInstance::ALIGNMENT * triangle,
        transform,
    };
    let mut vectors = || -> Vec<[f32; 4]> { (0..6).map(|_| n.several()).collect() };
    let streams = VertexStreams {
        tangents: vectors(),
        uvs: vectors(),
        colors: vectors(),
        normals: (0..6).map(|_| n.several()).collect(),
        scales: (0..6).map(|_| n.next()).collect(),
    };
    let light = |kind| Light {
        kind,
        position: DVec3::new(1.0, 2.0, 3.0),
        direction: DVec3::new(4.0, 5.0, 6.0),
        color: [7.0, 8.0, 9.0],
        range: Some(0.25),
    };
    let pose = Pose {
        geometry: PosedGeometry {
            positions: (0..6).map(|_| n.several()).collect(),
            streams,
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            draws: vec![draw(0), draw(1)],
            instances: vec![instance(0, DAffine3::IDENTITY), instance(1, placed())],
            ..PosedGeometry::default()
        },
        lights: vec![light(LightKind::Point), light(LightKind::Spot { inner_angle: 0.0, outer_angle: 1.0 })],
        ..Pose::default()
    };
    (scene, pose)
}

/// A transform of different whole numbers, which mirrors.
fn placed() -> DAffine3 {
    DAffine3::from_cols_array(&[2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0])
}

/// A matrix of different whole numbers.
fn to_clip() -> DMat4 {
    DMat4::from_cols_array(&std::array::from_fn(|i| i as f64 + 1.0))
}

/// Fields in the order in which the shader reads them, as words.
#[derive(Default)]
struct Fields(Vec<(&'static str, u32)>);

impl Fields {
    fn words(&mut self, name: &'static str, words: &[u32]) {
        self.0.extend(words.iter().map(|word| (name, *word)));
    }

    fn floats(&mut self, name: &'static str, floats: &[f32]) {
        self.0.extend(floats.iter().map(|x| (name, x.to_bits())));
    }

    /// The second triangle, which lies at `matrix` of its first vertex.
    fn triangle(&mut self, vertices: [u32; 3], matrix: DMat4, geometry: &PosedGeometry) {
        self.words("exists", &[1]);
        self.words("vertices", &vertices);
        self.words("material, bin, high frequency, single-sided", &[1, 1, 1, 0]);
        let first = geometry.positions[vertices[0] as usize].map(f64::from);
        let clip = matrix * DVec3::from_array(first).extend(1.0);
        self.floats("position in clip space", &clip.as_vec4().to_array());
    }

    fn attributes(&mut self, geometry: &PosedGeometry) {
        let (streams, first) = (&geometry.streams, 3);
        self.floats("position", &geometry.positions[first]);
        self.floats("normal", &streams.normals[first]);
        self.floats("scale", &[streams.scales[first]]);
        self.floats("tangent", &streams.tangents[first]);
        self.floats("texture coordinates", &streams.uvs[first]);
        self.floats("vertex colour", &streams.colors[first]);
    }

    fn material(&mut self, material: &Material) -> Option<()> {
        let AlphaMode::Mask { cutoff } = material.alpha_mode else {
            return None;
        };
        let lobes = &material.lobes;
        self.floats("base colour", &material.base_color);
        self.floats("emissive", &material.emissive);
        self.floats("metallic", &[material.metallic]);
        self.floats("roughness", &[material.roughness]);
        self.floats("normal scale", &[material.normal_scale]);
        self.floats("occlusion strength", &[material.occlusion_strength]);
        self.floats("cutoff", &[cutoff]);
        let lobe = lobes.specular?;
        self.floats("specular colour", &lobe.color);
        self.floats("specular factor", &[lobe.factor]);
        let lobe = lobes.clearcoat?;
        self.floats("coat", &[lobe.factor, lobe.roughness, lobe.normal_scale]);
        let lobe = lobes.sheen?;
        self.floats("sheen colour", &lobe.color);
        self.floats("sheen roughness", &[lobe.roughness]);
        let lobe = lobes.anisotropy?;
        self.floats("anisotropy", &[lobe.strength]);
        let (sine, cosine) = lobe.rotation.sin_cos();
        self.floats("cosine and sine of the rotation", &[cosine, sine]);
        let lobe = lobes.iridescence?;
        self.floats("iridescence", &[lobe.factor, lobe.ior]);
        self.floats("least and greatest thickness", &lobe.thickness);
        let lobe = lobes.diffuse_transmission?;
        self.floats("colour of diffuse transmission", &lobe.color);
        self.floats("factor of diffuse transmission", &[lobe.factor]);
        let lobe = lobes.transmission?;
        self.floats("transmission", &[lobe.factor, lobe.thickness]);
        self.floats("absorption", &lobe.absorption);
        let lobe = lobes.specular_glossiness?;
        self.floats("specular", &lobe.specular);
        self.floats("glossiness", &[lobe.glossiness]);
        let slots = [material.base_color_texture?, material.normal_texture?];
        for used in slots {
            self.floats("transform of texture coordinates", used.transform.0.as_flattened());
            self.words("set of texture coordinates", &[used.uv_set]);
        }
        Some(())
    }

    fn alpha_map(&mut self) {
        self.words("width, height and levels of the alpha map", &[4, 2, 3]);
        let flags = spirv::ALPHA_TEXTURED | spirv::ALPHA_NEAREST_MAG;
        let wrap = spirv::WRAP_CLAMP_TO_EDGE << 8 | spirv::WRAP_MIRRORED_REPEAT << 10;
        self.words("flags of the alpha map", &[flags | wrap]);
        self.words("alpha of the last texel", &[4 * 4 * 2 - 1]);
    }

    fn light(&mut self, light: &Light) {
        self.floats("position of the light", &light.position.as_vec3().to_array());
        self.floats("1 / range^2", &[16.0]);
        let direction = light.direction.as_vec3();
        self.floats("direction of the light", &direction.to_array());
        self.floats("spot", &[2.0]);
        self.floats("colour of the light", &light.color);
        let scale = 1.0 / (1.0 - 1.0_f32.cos());
        self.floats("scale of the spot", &[scale]);
        self.floats("offset of the spot", &[-1.0_f32.cos() * scale]);
    }
}

/// What the shader reads of the second triangle, instance, material and light.
fn read_by_shader(headless: &mut Headless, scene: &Scene, pose: &Pose, instanced: bool) -> Vec<u32> {
    let prepared = headless.upload(SceneRequest::new(scene, pose)).unwrap();
    let (gpu, scene) = (headless.gpu().clone(), &prepared.gpu_scene);
    let memory = Memory::new(gpu.clone(), None);
    let mut geometry = FrameGeometry::new(&memory, scene, false).unwrap();
    geometry.place(scene, &to_clip(), None);
    let look = FrameLook::new(&memory, scene).unwrap();
    let frame = spirv::Frame {
        transform: to_clip().as_mat4().to_cols_array(),
        material_vectors: scene.material_vectors,
        ..spirv::Frame::default()
    };
    let usage = vk::BufferUsageFlags::UNIFORM_BUFFER;
    let frame = memory.filled("frame", bytemuck::bytes_of(&frame), usage).unwrap();
    let (bytes, usage) = (4 * MOST_FIELDS as u64, vk::BufferUsageFlags::STORAGE_BUFFER);
    let fields = memory.buffer("fields", bytes, usage, MemoryUse::Readback).unwrap();

    let shared = SharedLayout::new(&gpu, &[&INTERFACE]).unwrap();
    let layout = Arc::new(PassLayout::new(&gpu, &[&INTERFACE], Some(&shared)).unwrap());
    let sets = |of_frame, sets: &[_]| DescriptorSets::new(&gpu, of_frame, sets, 1).unwrap().remove(0);
    let mut of_frame = sets(true, &layout.sets[..2]);
    let mut own = sets(false, &layout.sets[2..]);
    let mut shown = geometry.shown(scene);
    shown.extend(look.shown(scene));
    shown.push((frame_set::FRAME, (&frame).into()));
    // SAFETY: the sets are new, and all buffers live until the commands have run.
    unsafe {
        of_frame.write(&shown);
        own.write(&[(FIELDS, (&fields).into())]);
    }
    // The shader's only constant is one of `bin`, too. Vulkan ignores the other one.
    let constants = spirv::Bin { step: spirv::BIN_SMALL, instanced }.constants();
    let code = include_bytes!("../../../tests/rows/shaders/spirv/rows.spv");
    let pipeline = compute_pipeline(&layout, code, &INTERFACE, &constants, None).unwrap();
    let triangle = if instanced { MeshInstance::ALIGNMENT } else { 1 };
    headless
        .submit(|commands| {
            // SAFETY: `submit` waits for the commands, and everything belongs to its device.
            let recorder = unsafe { Recorder::new(&gpu, commands, None) };
            recorder.show(&of_frame);
            recorder.show(&own);
            recorder.push(&pipeline, bytemuck::bytes_of(&[triangle, 1, 1]));
            recorder.dispatch(&pipeline, 1);
        })
        .unwrap();
    fields.read(MOST_FIELDS).unwrap().to_vec()
}

#[test]
fn shaders_read_the_fields_that_the_host_wrote() {
    let (scene, pose) = scene(&mut Numbers(0.0));
    let geometry = &pose.geometry;
    let mut direct = Fields::default();
    direct.triangle([3, 4, 5], to_clip(), geometry);
    direct.attributes(geometry);
    direct.material(&scene.materials[1]).unwrap();
    direct.alpha_map();
    direct.light(&pose.lights[1]);
    let mut instanced = Fields::default();
    let matrix = to_clip() * DMat4::from(placed());
    // The instance mirrors, which exchanges two vertices.
    instanced.triangle([3, 5, 4], matrix, geometry);
    let rows = DMat4::from(placed()).transpose().as_mat4().to_cols_array();
    instanced.floats("rows of the instance", &rows[..12]);

    let options = HeadlessOptions::default().validation(true);
    let mut headless = Headless::new(&options).unwrap();
    for (fields, is_instanced) in [(direct.0, false), (instanced.0, true)] {
        let read = read_by_shader(&mut headless, &scene, &pose, is_instanced);
        let names = fields.iter().map(|(name, _)| *name);
        let found: Vec<_> = names.zip(read).collect();
        assert_eq!(found, fields, "with instances: {is_instanced}");
    }
    assert_eq!(headless.validation_messages(), [""; 0]);
}
