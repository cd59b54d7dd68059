//! Frames in flight.

use super::device::GpcAntialiaser;
use super::error::{Error, GpcResult, answer};
use super::geometry::{GpcDraw, GpcGeometry};
use super::images::{GpcImageKinds, GpcImages};
use super::input::{Element, array, hand_over, init, object, place, read, shown, take_back, write};
use super::options::GpcOptions;
use crate::host::{Frame, Scenery, ShadeSamples, Viewport, VisibilitySamples};
use ash::vk;
use std::ffi::c_void;

/// Pipelines and memory to antialias one frame in flight.
pub struct GpcFrame {
    inner: Frame,
}

/// Draws and view of a recording.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcScenery {
    /// sizeof(GpcScenery).
    pub size: u32,
    /// GPC_STRUCT_TYPE_SCENERY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Number of draws.
    pub draw_count: u32,
    /// sizeof(GpcDraw), if there are draws.
    pub draw_stride: u32,
    /// Draws, read during the call only. Triangle IDs count from 1 in the order of the draws. May be NULL if there are
    /// none.
    pub draws: *const GpcDraw,
    /// Projection matrix by columns, from view space, whose unit of length is the world's, to clip space: the one with
    /// which positions in clip space were computed. The matrix tells how far apart two depths are.
    pub projection: [[f32; 4]; 4],
    /// Viewport of the application, as VkViewport: x, y, width and height in pixels of the images. The height is
    /// negative with GpcGeometry.y_up.
    ///
    /// The viewport contains the frame's part of the images, which is the application's scissor rectangle: the upper
    /// left pixel is GpcImages.corner, the size that in GpcOptions. Four zeros, as gpc_init_scenery sets them, stand
    /// for a viewport equal to the part.
    pub viewport: [f32; 4],
}

/// Fills a GpcScenery of `size` bytes, which is sizeof(GpcScenery), without draws.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_scenery(scenery: *mut GpcScenery, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(scenery, size) }
}

/// Visibility samples of a round, sorted by shading key, on the device.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcVisibilitySamples {
    /// The library's sizeof(GpcVisibilitySamples).
    pub size: u32,
    /// GPC_STRUCT_TYPE_VISIBILITY_SAMPLES.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Number of shading keys.
    pub keys: u32,
    /// Descriptor set with the layout of gpc_antialiaser_samples_layout, to be bound for compute at the set number that
    /// the shaders use.
    pub descriptor_set: vk::DescriptorSet,
    /// Buffer of the keys' indirect dispatches, in workgroups of 64 invocations.
    pub dispatches: vk::Buffer,
    /// Offset of the dispatch of key 0 in the buffer, in bytes.
    pub dispatch_offset: u64,
    /// Distance in bytes from the dispatch of one key to that of the next.
    pub dispatch_stride: u64,
    /// Buffer for conditional rendering; its first 32-bit word is zero if the round has no work. The dispatches of such
    /// a round have no workgroups. To skip them altogether, record them between vkCmdBeginConditionalRenderingEXT, with
    /// this buffer and offset 0, and its end, within the callback. VK_NULL_HANDLE without
    /// GpcDevice.conditional_rendering, and for shading outside of rounds.
    pub condition: vk::Buffer,
}

/// Function of the application that records the shading of a round's samples into a command buffer: for each key, a
/// pipeline, the samples' descriptor set, and the key's indirect dispatch. `samples` lives until the function returns.
///
/// gpc_frame_record and gpc_list_record call the function on their thread, a fixed number of times, also for rounds
/// without work, outside of a render pass and of conditional rendering. The library's writes are visible to the
/// dispatches, which need no barrier between them, and the library waits for their writes.
///
/// The function may bind and push anything. The function must not throw or jump out, and must not use the frame or
/// list.
pub type GpcShade =
    Option<unsafe extern "C" fn(user: *mut c_void, commands: vk::CommandBuffer, samples: *const GpcVisibilitySamples)>;

/// Result of a recording.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcOutcome {
    /// sizeof(GpcOutcome).
    pub size: u32,
    /// GPC_STRUCT_TYPE_OUTCOME.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Number of rounds that had work.
    pub rounds: u32,
    /// Number of superpixels and tiles for which memory or GpcOptions.max_rounds did not suffice; these keep the colours that
    /// they had. The frame's next recording has more memory, unless GpcOptions.fixed_memory is set.
    pub left_over: u64,
    /// Number of superpixels.
    pub superpixels: u64,
    /// Number of triangles in all draws, with the indirect ones that were not left out.
    pub triangles: u64,
    /// Number of visibility samples that were shaded.
    pub visibility_samples: u64,
    /// Number of bytes of device memory that the frame uses, without the application's buffers and images.
    pub memory_bytes: u64,
    /// Time of the library's commands on the device in milliseconds; 0 if the queue has no timestamps.
    pub gpu_milliseconds: f64,
    /// Number of draws of all GpcIndirectDraws that the device wrote.
    pub indirect_draws: u64,
    /// Number of those that were left out because a capacity of a list was too small: all from the first one that did not
    /// fit.
    pub indirect_left_out: u64,
    /// Number of those that were left out because they are not possible, such as draws with vertices or indices beyond the
    /// ends of the mesh, a shading key or an alpha map that does not exist, or an instance beyond the capacity.
    pub indirect_impossible: u64,
}

/// Fills a GpcOutcome of `size` bytes, which is sizeof(GpcOutcome).
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_outcome(outcome: *mut GpcOutcome, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(outcome, size) }
}

/// Makes the pipelines and memory of a frame. An application has one for each frame in flight, whatever the number of
/// its swapchain's images, and makes new ones if a buffer changes. Frames share the memory that the library's passes
/// hand to each other if its size suffices for several, so the commands of all frames of an antialiaser must be
/// executed on one queue.
///
/// Threads: any; several frames may be created at once.
/// Lifetime: the lent buffers and alpha maps outlive the frame. The structs are read during the call only.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
/// GPC_RESULT_VULKAN. `*frame` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_create(
    antialiaser: *const GpcAntialiaser,
    geometry: *const GpcGeometry,
    kinds: *const GpcImageKinds,
    options: *const GpcOptions,
    frame: *mut *mut GpcFrame,
) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe {
            let antialiaser = object(antialiaser, "antialiaser")?;
            let geometry = read(geometry)?.geometry()?;
            let kinds = read(kinds)?.kinds()?;
            let options = read(options)?.options()?;
            antialiaser.inner.prepare(&geometry, &kinds, &options)
        }?;
        Ok(GpcFrame { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(frame, "frame", make) }
}

/// Makes a frame like `frame`, for the same buffers and kinds of images, with more of the memory that the last
/// recording lacked. If it lacked none, the new frame has as much memory as the old one. The old frame still has to be
/// destroyed. With GpcOptions.fixed_memory, this is the way to more memory; otherwise gpc_frame_record takes care of it.
///
/// Threads: no other call uses the frame at the same time. Lifetime: the lent buffers and alpha maps outlive the new
/// frame too.
/// Errors: as gpc_frame_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_grow(frame: *const GpcFrame, grown: *mut *mut GpcFrame) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe { object(frame, "frame")?.inner.grow() }?;
        Ok(GpcFrame { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(grown, "grown", make) }
}

/// Changes the size of the images, in pixels. Pipelines are kept, and so is shared memory that suffices. Memory of the frame
/// alone, which is small, is made anew. If shared memory does not suffice, the first frame that is resized allocates memory, which the other frames
/// of the antialiaser then share.
///
/// Threads: no other call uses the frame at the same time.
/// Lifetime: the commands of the frame's last recording are done, or will never be executed.
/// Errors: as gpc_frame_create; the frame is unchanged then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_resize(frame: *mut GpcFrame, width: u32, height: u32) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        unsafe { place(frame, "frame")?.inner.resize([width, height]) }?;
        Ok(())
    })
}

/// Records the antialiasing of the images that the application has drawn, such as the current image of a swapchain. The
/// images have the kinds and the size for which the frame was created. The call neither submits nor waits. It updates
/// descriptor sets of the frame, so the commands of the frame's last recording must be done.
///
/// The call allocates no device memory, with one exception: if the last recording left work over for want of memory, the
/// frame first gets more of it, as by gpc_frame_resize. If the device has no more, the frame keeps what it has.
/// GpcOptions.fixed_memory forbids this.
///
/// `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the lent family.
/// The application must bind and push its state again afterwards. `user` is passed to `shade`, whose shaders write no
/// memory of the library except by gpc_store.
///
/// Threads: no other call uses the frame or the command buffer at the same time. Different frames may be recorded at
/// the same time.
/// Lifetime: the commands of the frame's last recording are done, or will never be executed. The frame, the buffers,
/// the images and the objects that `shade` records outlive the execution of the commands.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY; GPC_RESULT_DEVICE_LOST
/// and GPC_RESULT_VULKAN while the frame gets more memory. Nothing is recorded then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_record(
    frame: *mut GpcFrame,
    commands: vk::CommandBuffer,
    images: *const GpcImages,
    scenery: *const GpcScenery,
    shade: GpcShade,
    user: *mut c_void,
) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        let (frame, images, scenery) = unsafe {
            let frame = place(frame, "frame")?;
            (frame, read(images)?.images()?, read(scenery)?)
        };
        if commands == vk::CommandBuffer::null() {
            return Err(Error::Null("commands"));
        }
        let shade = shade.ok_or(Error::Null("shade"))?;
        // SAFETY: passed on to the caller.
        let draws = unsafe { array!(scenery, GpcScenery, draws, draw_count, draw_stride) }?;
        let draws: Vec<_> = draws.iter().map(GpcDraw::draw).collect::<Result<_, _>>()?;
        let [x, y, width, height] = scenery.viewport;
        let viewport = Viewport { x, y, width, height };
        let viewport = (scenery.viewport != [0.0; 4]).then_some(viewport);
        let scenery = Scenery::new(&draws, scenery.projection).viewport(viewport);
        // SAFETY: passed on to the caller.
        unsafe { frame.inner.record(commands, &images, &scenery, &Callback { shade, user }) }?;
        Ok(())
    })
}

/// Result of the last recording, available once its commands are done, until the next recording begins. The call does
/// not wait: if the commands were not submitted or still run, the result is GPC_RESULT_NOT_READY. If the commands are
/// submitted again, call this only when that submission is done: until the device begins it, it is taken for done.
///
/// Threads: no gpc_frame_record of the frame runs at the same time.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_outcome(frame: *const GpcFrame, outcome: *mut GpcOutcome) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        unsafe {
            let frame = object(frame, "frame")?;
            write(outcome, || {
                let found = frame.inner.outcome()?;
                let statistics = &found.statistics;
                Ok(GpcOutcome {
                    rounds: u32::try_from(statistics.rounds).unwrap_or(u32::MAX),
                    left_over: found.left_over,
                    superpixels: statistics.superpixels,
                    triangles: statistics.triangles.total,
                    visibility_samples: statistics.visibility_samples,
                    memory_bytes: statistics.memory_bytes,
                    gpu_milliseconds: statistics.gpu_ms(),
                    indirect_draws: found.indirect.draws,
                    indirect_left_out: found.indirect.left_out,
                    indirect_impossible: found.indirect.impossible,
                    ..GpcOutcome::defaults()
                })
            })
        }
    })
}

/// Number of bytes of device memory that a frame uses, without the application's buffers and images; 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_memory_bytes(frame: *const GpcFrame) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { frame.as_ref() }.map_or(0, |frame| frame.inner.memory_bytes())
}

/// Part of gpc_frame_memory_bytes that other frames of the same antialiaser may use too, in bytes; counts once for all
/// of them. 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_shared_memory_bytes(frame: *const GpcFrame) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { frame.as_ref() }.map_or(0, |frame| frame.inner.shared_memory_bytes())
}

/// Destroys a frame, whose commands are done. NULL is ignored.
///
/// Threads: no other call uses the frame at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_destroy(frame: *mut GpcFrame) {
    // SAFETY: passed on to the caller.
    unsafe { take_back(frame) };
}

/// Materials of an application, shaded by its C function.
pub(super) struct Callback {
    pub shade: unsafe extern "C" fn(*mut c_void, vk::CommandBuffer, *const GpcVisibilitySamples),
    pub user: *mut c_void,
}

impl ShadeSamples for Callback {
    fn record(&self, commands: vk::CommandBuffer, samples: &VisibilitySamples) {
        let (dispatches, dispatch_offset) = samples.dispatch(0).unwrap_or_default();
        let samples = shown(GpcVisibilitySamples {
            descriptor_set: samples.descriptor_set(),
            dispatches,
            dispatch_offset,
            dispatch_stride: VisibilitySamples::DISPATCH_STRIDE,
            condition: samples.condition().unwrap_or_default(),
            keys: samples.keys(),
            ..GpcVisibilitySamples::defaults()
        });
        // SAFETY: the application's function, called as documented.
        unsafe { (self.shade)(self.user, commands, &raw const samples) };
    }
}
