//! Misuse that safe code must not be able to turn into undefined behaviour: dropping in the wrong order, mixing
//! objects of two devices, contradictory arguments.

use crate::stage::{Stage, camera, flat, on_gpu, once, textured};
use crate::submit::{discard, submit};
use gpc::render::{
    EngineError, Headless, HeadlessOptions, RenderError, Renderer, SceneFrame, SceneRequest, Settings, Target,
};
use gpc::scene::{AlphaMode, DrawClass, GeometryError, Image, PosedGeometry, Sampler};
use gpc::testing::{MemoryUse, memory};
use gpc::vulkan::VulkanError;

const SIZE: [u32; 2] = [40, 30];

fn stage() -> Stage {
    crate::scenes::ball_over_checker()
}

#[test]
fn a_frame_keeps_its_scene_alive() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]);
        let prepared = stage().upload(gpu);
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        let before = gpu.render(&mut frame, &camera()).unwrap();
        drop(prepared);
        // This scene takes the place of the dropped one in memory.
        let _other = stage().upload(gpu);
        let after = gpu.render(&mut frame, &camera()).unwrap();
        assert_eq!(before.colors, after.colors);
    });
}

#[test]
fn scenes_and_frames_stay_on_their_device() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]);
        let prepared = stage().upload(gpu);
        let mut frame = gpu.prepare(&prepared, &settings).unwrap();
        let mut other = Headless::new(&HeadlessOptions::default()).unwrap();
        let refused = other.prepare(&prepared, &settings).err();
        assert!(matches!(refused, Some(RenderError::OtherDevice)));
        let refused = other.render(&mut frame, &camera()).err();
        assert!(matches!(refused, Some(RenderError::OtherDevice)));
    });
}

/// Loaders look a device up among all devices of the process, also those that another thread destroys at that time. As these tests
/// fill freed memory, a look at one of them ends the process. The other devices have no validation layer, which has the same defect.
#[test]
fn devices_are_opened_and_dropped_beside_others() {
    on_gpu(|gpu| {
        // SAFETY: no commands use objects made from it.
        let memory = unsafe { memory(gpu.gpu(), None) };
        let usage = ash::vk::BufferUsageFlags::TRANSFER_DST;
        std::thread::scope(|scope| {
            let others =
                scope.spawn(|| (0..40).for_each(|_| drop(Headless::new(&HeadlessOptions::default()).unwrap())));
            while !others.is_finished() {
                memory.buffer("named", 4, usage, MemoryUse::Device).unwrap();
            }
        });
    });
}

#[test]
fn a_scene_is_uploaded_before_it_is_shown() {
    on_gpu(|gpu| {
        let (scene, pose) = stage().build();
        let renderer = Renderer::in_gpu(gpu.gpu().clone()).unwrap();
        let prepared = renderer.prepare_scene(SceneRequest::new(&scene, &pose)).unwrap();
        let refused = gpu.prepare(&prepared, &once(SIZE)).err();
        assert!(matches!(refused, Some(RenderError::NotUploaded)));
    });
}

/// Uploads that were recorded but never submitted are recorded again, and such a recording has no results.
#[test]
fn discarded_recordings_change_nothing() {
    on_gpu(|gpu| {
        let settings = Settings::new(SIZE[0], SIZE[1]);
        let uploaded = stage().upload(gpu);
        let mut frame = gpu.prepare(&uploaded, &settings).unwrap();
        let expected = gpu.render(&mut frame, &camera()).unwrap();

        let device = gpu.gpu().clone();
        let renderer = Renderer::in_gpu(device.clone()).unwrap();
        let (scene, pose) = stage().build();
        let prepared = renderer.prepare_scene(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = renderer.prepare(&prepared, &settings, None).unwrap();
        // SAFETY: buffers made from it are read once the commands have run.
        let memory = unsafe { memory(&device, None) };
        let usage = ash::vk::BufferUsageFlags::TRANSFER_DST;
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let colors = memory.buffer("colours", 16 * pixels as u64, usage, MemoryUse::Readback).unwrap();
        let target = Target::Buffer { colors: colors.handle(), attributes: None };
        let refusal = |frame: &SceneFrame| match frame.statistics() {
            Err(RenderError::Engine(EngineError::Vulkan(error))) => error,
            other => panic!("{other:?}"),
        };
        let is_not_done = |error: &_| matches!(error, VulkanError::NotDone);
        assert!(matches!(refusal(&frame), VulkanError::NotRecorded));
        let record = |frame: &mut SceneFrame, commands| {
            // SAFETY: the commands are discarded, or submitted and waited for while everything that they use is alive.
            unsafe {
                prepared.record_upload(commands);
                frame.record(&camera(), commands, &target);
            }
        };
        discard(&device, |commands| record(&mut frame, commands));
        assert!(is_not_done(&refusal(&frame)));
        let again = renderer.prepare_again(&frame).err();
        assert!(matches!(&again, Some(RenderError::Engine(EngineError::Vulkan(error))) if is_not_done(error)));
        submit(&device, |commands| record(&mut frame, commands));
        assert_eq!(colors.read::<[f32; 4]>(pixels).unwrap(), expected.colors);
        let found = frame.statistics().unwrap();
        assert_eq!(found.superpixels, expected.statistics.superpixels);
    });
}

#[test]
fn geometry_that_contradicts_itself_is_refused() {
    on_gpu(|gpu| {
        let (scene, pose) = stage().build();
        let vertices = pose.geometry.positions.len();
        let triangles = pose.geometry.triangles.len();
        let mut refused = |spoil: &dyn Fn(&mut PosedGeometry)| {
            let mut pose = pose.clone();
            spoil(&mut pose.geometry);
            match gpu.upload(SceneRequest::new(&scene, &pose)) {
                Err(RenderError::Geometry(error)) => error,
                Err(other) => panic!("{other}"),
                Ok(_) => panic!("it was taken"),
            }
        };
        assert_eq!(
            refused(&|geometry| geometry.triangles[3][1] = vertices as u32),
            GeometryError::Index { triangle: 3, index: vertices as u32, vertices }
        );
        assert_eq!(
            refused(&|geometry| geometry.streams.normals.truncate(2)),
            GeometryError::Stream { stream: "normals", found: 2, vertices }
        );
        assert_eq!(
            refused(&|geometry| geometry.draws[0].material = 77),
            GeometryError::Material { draw: 0, material: 77, materials: scene.materials.len() }
        );
        assert_eq!(
            refused(&|geometry| geometry.draws[0].triangle_count = u32::MAX),
            GeometryError::Draw { draw: 0, first: 0, expected: 0, triangles }
        );
        let draws = pose.geometry.draws.len();
        let last = pose.geometry.draws.last().unwrap().first_triangle;
        assert_eq!(
            refused(&|geometry| geometry.draws.truncate(draws - 1)),
            GeometryError::Draw { draw: draws - 1, first: triangles as u32, expected: last as usize, triangles }
        );
        assert_eq!(
            refused(&|geometry| geometry.draws[0].class = DrawClass::BlendDoubleSided),
            GeometryError::Order { draw: 1, class: pose.geometry.draws[1].class }
        );
    });
}

#[test]
fn memory_is_counted_while_it_is_held() {
    on_gpu(|gpu| {
        // SAFETY: no commands use objects made from it.
        let memory = unsafe { memory(gpu.gpu(), Some(1 << 20)) };
        let usage = ash::vk::BufferUsageFlags::TRANSFER_DST;
        let make = || memory.buffer("half", 1 << 19, usage, MemoryUse::Readback);
        let first = make().unwrap();
        let second = make().unwrap();
        assert!(make().is_err());
        assert_eq!(memory.used(), 1 << 20);
        drop(first);
        assert_eq!(memory.used(), 1 << 19);
        assert!(make().is_ok());
        assert!(second.read::<[f32; 4]>(1 << 15).is_ok());
        assert!(second.read::<[f32; 4]>((1 << 15) + 1).is_err());
    });
}

#[test]
fn uploads_count_until_they_are_freed() {
    on_gpu(|gpu| {
        let side = 512;
        let mut stage = Stage::new(vec![textured(AlphaMode::Opaque)]);
        stage.add(0, [[-1.0, -1.0, -2.0], [1.0, -1.0, -2.0], [0.0, 1.0, -2.0]]);
        let image = Image { width: side, height: side, pixels: vec![200; 4 * (side * side) as usize] };
        stage.texture = Some((image, Sampler::default()));
        let image = u64::from(4 * side * side);
        let prepared = stage.upload(gpu);
        // This is the size of the image and its smaller levels, without the staging memory.
        assert!((image..2 * image).contains(&prepared.memory_bytes()));
    });
}

#[test]
fn the_bound_on_memory_covers_what_is_read_back() {
    on_gpu(|gpu| {
        let size = [400, 300];
        let prepared = Stage::new(vec![flat([1.0; 4], AlphaMode::Opaque)]).upload(gpu);
        let read_back = u64::from(size[0] * size[1]) * 16;
        let with = |limit| Settings::new(size[0], size[1]).max_memory(Some(limit));
        let refused = gpu.prepare(&prepared, &with(read_back)).err();
        assert!(matches!(refused, Some(RenderError::Engine(EngineError::Memory { .. }))));
        let limit = 2 * read_back + (12 << 20);
        let mut frame = gpu.prepare(&prepared, &with(limit)).unwrap();
        let rendered = gpu.render(&mut frame, &camera()).unwrap();
        let used = rendered.statistics.memory_bytes;
        assert!((read_back..=limit).contains(&used), "{used}");
    });
}
