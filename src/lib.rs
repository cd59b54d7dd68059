//! A renderer on Vulkan that antialiases only where an image aliases.
//!
//! The first pass renders one sample a pixel and marks the pixels that alias, called *superpixels*. The second pass takes up to
//! 1,024 samples in the superpixels alone: it finds which triangle each sample sees, shades these visibility samples and averages
//! them.
//!
//! ```text
//!                 ┌────────── every pixel ──────────┐   ┌──────── superpixels alone ────────┐
//!   triangles ──▶ raster ──▶ shade ──▶ thin, detect ──▶ bin ──▶ sample ──▶ shade ──▶ resolve ──▶ image
//!                  IDs, depth  colours   superpixels     tiles   visibility   colours
//! ```
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
#![cfg_attr(feature = "gltf", doc = "```no_run")]
#![cfg_attr(not(feature = "gltf"), doc = "```ignore")]
//! use gpc::camera::Orbit;
//! use gpc::render::{Headless, HeadlessOptions, SceneRequest, Settings};
//! use gpc::scene::{PoseRequest, Scene};
//!
//! let scene = Scene::load("scene.glb".as_ref())?.scene;
//! let pose = scene.pose(&PoseRequest::default())?;
//! let (low, high) = pose.geometry.bounds().ok_or("the scene is empty")?;
//! let camera = Orbit::default().frame(low, high, 1280.0 / 720.0)?;
//!
//! let mut headless = Headless::new(&HeadlessOptions::default())?;
//! let prepared = headless.upload(SceneRequest::new(&scene, &pose))?;
//! let mut frame = headless.prepare(&prepared, &Settings::new(1280, 720))?;
//! let image = headless.render(&mut frame, &camera)?; // again and again, with other cameras
//! println!("{} superpixels, {:.1} ms", image.statistics.superpixels, image.statistics.gpu_ms());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `image.colors` has rows of linear, premultiplied RGBA. Any other set of locations is a `camera::Pinhole` and a list of
//! `camera::SampleLocation`s, which `Headless::sample_points`, `sample_superpixels` and `render_locations` take. `camera` makes
//! such lists: for zooms, panoramas, rigs and projectors. `SceneRequest::shadowed` readies a scene for shadows.
//!
//! ## 2. A file, in your command buffer
//!
//! [`vulkan::Requirements`] says what a device needs before there is one. `render::Renderer` takes your handles and, if you like,
//! your allocator. `Renderer::prepare` does all that can fail. `Frame::record` writes into your command buffer; it never submits,
//! waits or allocates. The image comes back in the layout, stage and access that you name. `examples/embed.rs` is a complete host.
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
// Scenes of files use all of the engine, hosts a part.
#[cfg_attr(not(feature = "gltf"), allow(dead_code, unused_imports))]
mod engine;
#[cfg(feature = "gltf")]
mod random;
pub mod reference;
#[cfg(feature = "gltf")]
pub mod render;
#[cfg(feature = "gltf")]
#[doc(hidden)]
pub mod testing;
#[cfg(feature = "cli")]
mod tools;

pub use engine::{color, host, sampling, vulkan};
#[cfg(feature = "gltf")]
pub use render::{camera, scene};
#[cfg(feature = "cli")]
pub use tools::{compare, names, output, resample};

/// What `gpc bench` and tests measure with: no part of the library's interface, and changes without notice.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub use tools::bench;

/// Compiles the library's example in the README.
#[cfg(all(doctest, feature = "gltf"))]
#[doc = include_str!("../README.md")]
struct Readme;
