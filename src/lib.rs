//! A renderer on Vulkan that antialiases only where an image aliases.
//!
//! The first pass renders one sample a pixel and marks the pixels that alias, called *superpixels*. The second pass samples the
//! superpixels alone, at 512 to 4,096 places each: it finds which triangle each place sees, shades these visibility samples and
//! averages them.
//!
//! <!-- figures: passes-in-short -->
//!
//! ```text
//! every pixel:       filter ─▶ raster ─▶ spans ─▶ shade ─▶ thin ─▶ detect
//! superpixels alone: cull ─▶ bin ─▶ tally ─▶ schedule ─▶ enlist ─▶ setup ─▶ sample ─▶ sort ─▶ shade ─▶ resolve ─▶ grow
//! ```
//!
//! <!-- end -->
//!
//! # Three levels of use
//!
//! | level | scene | device, command buffer | module | feature |
//! |---|---|---|---|---|
//! | 1 | a glTF, OBJ, STL or PLY file | the library's | `render::Headless` | `gltf` |
//! | 2 | such a file | yours | `render::Renderer` | `gltf` |
//! | 3 | your geometry, materials and images | yours | [`host`] | none |
//!
//! ## 1. A file, on a device of the library's
//!
#![cfg_attr(feature = "gltf", doc = "```")]
#![cfg_attr(not(feature = "gltf"), doc = "```ignore")]
//! use gpc::camera::Orbit;
//! use gpc::render::{Headless, HeadlessOptions, SceneRequest, Settings};
//! use gpc::scene::{PoseRequest, Scene};
//!
//! let scene = Scene::load("assets/fence.glb".as_ref())?.scene;
//! let pose = scene.pose(&PoseRequest::default())?;
//! let (low, high) = pose.geometry.bounds().ok_or("the scene is empty")?;
//! let camera = Orbit::default().frame(low, high, 1280.0 / 720.0)?;
//!
//! let mut headless = Headless::new(&HeadlessOptions::default())?;
//! let prepared = headless.upload(SceneRequest::new(&scene, &pose))?;
//! let mut frame = headless.prepare(&prepared, &Settings::new(1280, 720))?;
//! let image = headless.render(&mut frame, &camera)?; // again and again, with other cameras
//! println!("{} superpixels, {:.1} ms", image.statistics.superpixels, image.statistics.gpu_ms());
//! # assert!(image.statistics.superpixels > 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `image.colors` has rows of linear, premultiplied RGBA. Any other set of locations is a `camera::Pinhole` and a list of
//! `camera::SampleLocation`s, which `Headless::sample_points`, `sample_superpixels` and `render_locations` take. `camera` makes
//! such lists: for zooms, panoramas, rigs and projectors. `SceneRequest::shadowed` readies a scene for shadows.
//!
//! ## 2. A file, in your command buffer
//!
#![cfg_attr(feature = "gltf", doc = "```")]
#![cfg_attr(not(feature = "gltf"), doc = "```ignore")]
//! use ash::vk;
//! use gpc::render::{Renderer, SceneRequest, Settings, Target};
//! use gpc::vulkan::{Host, Requirements};
//! # use gpc::{camera::Orbit, scene::{PoseRequest, Scene}};
//! # let scene = Scene::load("assets/spheres.glb".as_ref())?.scene;
//! # let pose = scene.pose(&PoseRequest::default())?;
//! # let (low, high) = pose.geometry.bounds().ok_or("the scene is empty")?;
//! # let camera = Orbit::default().frame(low, high, 320.0 / 180.0)?;
//! # unsafe {
//! # let entry = ash::Entry::load()?;
//! # let application = vk::ApplicationInfo::default().api_version(Requirements::API_VERSION);
//! # let instance = entry.create_instance(&vk::InstanceCreateInfo::default().application_info(&application), None)?;
//! # let devices = instance.enumerate_physical_devices()?;
//! # let is_suitable = |device: &&vk::PhysicalDevice| Requirements::missing(&instance, **device).is_empty();
//! # let physical_device = *devices.iter().find(is_suitable).ok_or("no suitable device")?;
//! # let queue_family = Requirements::queue_family(&instance, physical_device).ok_or("no suitable queue")?;
//! # let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
//!
//! // Your device, with the features that the renderer needs.
//! let mut features = Requirements::features13();
//! let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut features);
//! let device = instance.create_device(physical_device, &info, None)?;
//! # let pool = device.create_command_pool(&vk::CommandPoolCreateInfo::default().queue_family_index(queue_family), None)?;
//! # let allocate = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
//! # let commands = device.allocate_command_buffers(&allocate)?[0];
//! # let info = vk::BufferCreateInfo::default().size(16 * 320 * 180).usage(vk::BufferUsageFlags::TRANSFER_DST);
//! # let buffer = device.create_buffer(&info, None)?;
//! # let needs = device.get_buffer_memory_requirements(buffer);
//! # let kind = needs.memory_type_bits.trailing_zeros();
//! # let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind);
//! # device.bind_buffer_memory(buffer, device.allocate_memory(&info, None)?, 0)?;
//!
//! // All that can fail happens before anything is recorded.
//! let renderer = Renderer::new(Host::new(instance, physical_device, device.clone(), queue_family))?;
//! let prepared = renderer.prepare_scene(SceneRequest::new(&scene, &pose))?;
//! let mut frame = renderer.prepare(&prepared, &Settings::new(320, 180), None)?;
//! # device.begin_command_buffer(commands, &vk::CommandBufferBeginInfo::default())?;
//!
//! // Your command buffer, and a buffer or image of yours.
//! prepared.record_upload(commands); // once
//! frame.record(&camera, commands, &Target::Buffer { colors: buffer, attributes: None });
//! # device.end_command_buffer(commands)?;
//! # let submitted = [vk::SubmitInfo::default().command_buffers(std::slice::from_ref(&commands))];
//! # device.queue_submit(device.get_device_queue(queue_family, 0), &submitted, vk::Fence::null())?;
//! # device.device_wait_idle()?;
//! # assert!(frame.statistics()?.superpixels > 100);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`vulkan::Requirements`] says what a device needs before there is one. `render::Renderer` takes your handles and, if you like,
//! your allocator. `SceneFrame::record` never submits, waits or allocates. An image comes back in the layout, stage and access that you
//! name. Once the commands are done, `SceneFrame::statistics` fails with `EngineError::Unfinished` if a dense scene needed more memory;
//! `Renderer::prepare_again` makes a frame with more. `examples/embed.rs` is a complete host.
//!
//! ## 3. Your own scene
//!
//! You lend vertex and index buffers as they are, and what you have drawn: colours, triangle IDs and depth, or less. [`host`] samples
//! your triangles where your image aliases, your own pipelines shade what the samples see, and the resolved pixels are drawn over
//! the aliased ones. `examples/visibility` is a complete application, and `docs/embedding.md` the manual.
//!
//! ```no_run
//! # fn shown(host: gpc::vulkan::Host, geometry: gpc::host::Geometry, kinds: gpc::host::ImageKinds, images: gpc::host::Images, commands: ash::vk::CommandBuffer,
//! #     draws: &[gpc::host::Draw], projection: [[f32; 4]; 4], materials: &dyn gpc::host::ShadeSamples) -> Result<(), Box<dyn std::error::Error>> {
//! use gpc::host::{Antialiaser, Options, Scenery};
//!
//! let antialiaser = unsafe { Antialiaser::new(host) }?;
//! let mut frame = unsafe { antialiaser.prepare(&geometry, &kinds, &Options::new(1280, 720)) }?; // one for each frame in flight
//! unsafe { frame.record(commands, &images, &Scenery::new(draws, projection), materials) }?; // after the application has drawn
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! | feature | what it adds |
//! |---|---|
//! | none | the engine: [`host`], which knows no files |
//! | `gltf` | scenes, cameras, and rendering in your device or one of the library's |
//! | `draco`, `basisu` | Draco meshes and KTX2 textures; files with them are refused otherwise |
//! | `cli`, on by default | what the command needs: image files (`output`), comparisons (`compare`) and resampling (`resample`) |
//! | `view` | the command's window |
//! | `capi` | [`host`] in C: `include/gpc.h` |
//! | `compile-shaders` | compiles the shaders instead of taking the SPIR-V that comes with the package |
//!
//! An application that renders scenes takes `default-features = false` and `gltf`. The types of `ash` 0.38, `gpu-allocator` 0.28,
//! `glam` 0.30 and `gltf` 1.4 are part of the API.

#![warn(missing_docs)]

#[cfg(feature = "capi")]
mod capi;
#[cfg(feature = "cli")]
pub mod compare;
// Scenes of files use all of the engine, hosts a part.
#[cfg_attr(not(feature = "gltf"), allow(dead_code, unused_imports))]
#[macro_use]
mod engine;
#[cfg(feature = "cli")]
pub mod names;
#[cfg(feature = "cli")]
pub mod output;
#[cfg(feature = "gltf")]
pub mod render;
#[cfg(feature = "cli")]
pub mod resample;

pub use engine::{color, host, sampling, vulkan};
#[cfg(feature = "gltf")]
#[doc(hidden)]
pub use render::testing;
#[cfg(feature = "gltf")]
pub use render::{camera, scene};

/// Compiles the library's example in the README.
#[cfg(all(doctest, feature = "gltf"))]
#[doc = include_str!("../README.md")]
struct Readme;
