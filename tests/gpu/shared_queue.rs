//! Several renderers on one queue, in several threads.

use std::sync::{Arc, Mutex};

use gpc::camera::Camera;
use gpc::render::{Headless, PreparedScene, RenderError, Renderer, Settings, SuperpixelOptions};
use gpc::vulkan::{Instance, InstanceOptions, SharedQueue};

use crate::locations::{pinhole, planar};
use crate::scenes::ball_over_checker;
use crate::stage::camera;

const SIZE: [u32; 2] = [96, 64];

fn settings() -> Settings {
    Settings::new(SIZE[0], SIZE[1]).method(SuperpixelOptions::new(16))
}

/// Colours of a frame, and of an image made of locations.
fn images(gpu: &mut Headless, scene: &PreparedScene, camera: &Camera) -> Result<[Vec<[f32; 4]>; 2], RenderError> {
    let mut frame = gpu.prepare(scene, &settings())?;
    let drawn = gpu.render(&mut frame, camera)?.colors;
    let rig = [(pinhole(SIZE), planar(SIZE))];
    Ok([drawn, gpu.render_locations(scene, &rig, &settings())?.colors])
}

/// Threads that share a queue and a scene make the images that one renderer makes alone.
#[test]
fn threads_share_a_queue_and_a_scene() {
    let mut options = InstanceOptions::default();
    options.validation = true;
    let instance = Instance::new(options).unwrap();
    let gpu = instance.create_gpu(None).unwrap();
    // SAFETY: the device was created with one queue of this family.
    let queue = unsafe { gpu.device().get_device_queue(gpu.queue_family(), 0) };
    let queue: SharedQueue = Arc::new(Mutex::new(queue));
    let renderer = Renderer::in_gpu(gpu).unwrap();
    let open = || {
        // SAFETY: the queue is that of the renderer's device, and all its users lock it.
        unsafe { Headless::with_queue(renderer.clone(), queue.clone()) }.unwrap()
    };
    let mut alone = open();
    let scene = ball_over_checker().upload(&mut alone);
    let expected = images(&mut alone, &scene, &camera()).unwrap();
    // The scene outlives the renderer that uploaded it.
    drop(alone);
    std::thread::scope(|threads| {
        for _ in 0..3 {
            threads.spawn(|| {
                let mut gpu = open();
                for _ in 0..3 {
                    let found = images(&mut gpu, &scene, &camera()).unwrap();
                    assert!(found == expected, "a thread's images differ");
                }
            });
        }
    });
    assert!(queue.try_lock().is_ok(), "the queue stays locked");
    assert_eq!(instance.validation_messages(), Vec::<String>::new());
}

/// While a submission is executed, the queue is free for others: the function of `stop_when` runs between submissions, and
/// the lock that it takes is given back before the next one.
#[test]
fn the_queue_is_free_between_submissions() {
    let instance = Instance::new(InstanceOptions::default()).unwrap();
    let gpu = instance.create_gpu(None).unwrap();
    // SAFETY: the device was created with one queue of this family.
    let queue = unsafe { gpu.device().get_device_queue(gpu.queue_family(), 0) };
    let queue: SharedQueue = Arc::new(Mutex::new(queue));
    // SAFETY: the queue is that of the renderer's device, and all its users lock it.
    let mut gpu = unsafe { Headless::with_queue(Renderer::in_gpu(gpu).unwrap(), queue.clone()) }.unwrap();
    let scene = ball_over_checker().upload(&mut gpu);
    let free = queue.clone();
    gpu.stop_when(move || free.try_lock().is_err());
    images(&mut gpu, &scene, &camera()).unwrap();
}
