//! Frames in flight.

use super::device::GpcAntialiaser;
use super::error::{Error, GpcResult, answer};
use super::geometry::{GpcDraw, GpcGeometry};
use super::images::{GpcImageKinds, GpcImages};
use super::input::{
    Element, GpcStructType, Struct, hand_over, init, object, place, read, shown, sizes, take_back,
    write,
};
use super::options::GpcOptions;
use crate::host::{Frame, Scenery, ShadeSamples, Viewport, VisibilitySamples};
use ash::vk;
use std::ffi::c_void;

/// Pipelines and memory to antialias one frame in flight.
pub struct GpcFrame {
    inner: Frame,
}

/// What a recording shows.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcScenery {
    /// sizeof(GpcScenery).
    pub size: u32,
    /// GPC_STRUCT_TYPE_SCENERY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// How many draws there are.
    pub draw_count: u32,
    /// sizeof(GpcDraw), where there are some.
    pub draw_stride: u32,
    /// The draws, read during the call alone. IDs count from 1 in their order. May be NULL where there are none.
    pub draws: *const GpcDraw,
    /// The projection that positions in clip space were made with, in columns: from view space, in which distances are the world's, to
    /// clip space. It tells how far apart two depths are.
    pub projection: [[f32; 4]; 4],
    /// Where clip space lies on the images: x, y, width and height of the application's VkViewport, in pixels of the images. The height
    /// is negative with GpcGeometry.y_up. It holds the frame's part of the images, which is the application's scissor rectangle: the
    /// pixels of the size in GpcOptions from GpcImages.corner on. Four zeros, as gpc_init_scenery gives, for a viewport that is the part.
    pub viewport: [f32; 4],
}

// SAFETY: `repr(C)`; numbers and raw pointers may have any bytes.
unsafe impl Element for GpcScenery {
    const NAME: &'static str = "GpcScenery";
    const SIZES: &'static [usize] = sizes!(GpcScenery, projection, viewport);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcScenery {
    const TYPE: GpcStructType = GpcStructType::Scenery;
}

/// Fills a GpcScenery of `size` bytes, which is sizeof(GpcScenery): there are no draws.
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
    /// How many keys there are.
    pub keys: u32,
    /// The set of gpc_antialiaser_samples_layout, to be bound for compute where the shaders expect it.
    pub descriptor_set: vk::DescriptorSet,
    /// Buffer of the keys' indirect dispatches, in workgroups of 64 invocations.
    pub dispatches: vk::Buffer,
    /// Where in it, in bytes, the dispatch of key 0 is.
    pub dispatch_offset: u64,
    /// Bytes from the dispatch of a key to that of the next one.
    pub dispatch_stride: u64,
    /// A buffer whose first word is zero where the round has nothing to do, so that its dispatches are of no workgroups. Recorded
    /// after vkCmdBeginConditionalRenderingEXT with it, at offset 0, and ended before the callback returns, they take no time
    /// there, as the library's own. VK_NULL_HANDLE without GpcDevice.conditional_rendering, and where what is shaded is no round.
    pub condition: vk::Buffer,
}

// SAFETY: `repr(C)`; numbers, raw handles and pointers may have any bytes.
unsafe impl Element for GpcVisibilitySamples {
    const NAME: &'static str = "GpcVisibilitySamples";
    const SIZES: &'static [usize] = sizes!(GpcVisibilitySamples, condition);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcVisibilitySamples {
    const TYPE: GpcStructType = GpcStructType::VisibilitySamples;
}

/// Records the shading of a round's samples into a command buffer: for each key a pipeline, the samples' set, and the
/// key's indirect dispatch. It is called a fixed number of times during gpc_frame_record or gpc_list_record, in rounds that have
/// nothing to do as well, on its thread, outside of a render pass and of conditional rendering. Dispatches need no barrier between them: what the library wrote is visible to them, and it waits for what they
/// write. It may bind and push what it likes, must not throw or jump out, and must not use the frame or list. `samples` lives until
/// it returns.
pub type GpcShade = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        commands: vk::CommandBuffer,
        samples: *const GpcVisibilitySamples,
    ),
>;

/// What a recording did.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcOutcome {
    /// sizeof(GpcOutcome).
    pub size: u32,
    /// GPC_STRUCT_TYPE_OUTCOME.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Rounds that had work.
    pub rounds: u32,
    /// Superpixels and tiles that found no room. gpc_frame_grow makes a frame with more.
    pub left_over: u64,
    /// Superpixels.
    pub superpixels: u64,
    /// Triangles in all draws.
    pub triangles: u64,
    /// Visibility samples that were shaded.
    pub visibility_samples: u64,
    /// Bytes of device memory that the frame takes, beside what the application lends.
    pub memory_bytes: u64,
    /// Time of the library's commands on the device in milliseconds; 0 where the queue has no timestamps.
    pub gpu_milliseconds: f64,
}

// SAFETY: `repr(C)`; numbers and raw pointers may have any bytes.
unsafe impl Element for GpcOutcome {
    const NAME: &'static str = "GpcOutcome";
    const SIZES: &'static [usize] = sizes!(GpcOutcome, gpu_milliseconds);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcOutcome {
    const TYPE: GpcStructType = GpcStructType::Outcome;
}

/// Fills a GpcOutcome of `size` bytes, which is sizeof(GpcOutcome).
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_outcome(outcome: *mut GpcOutcome, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(outcome, size) }
}

/// Makes the pipelines and memory of a frame. An application has one for each frame that it has in flight, whatever the number of
/// its swapchain's images, and makes new ones where a buffer changes. Frames share the memory that the library's passes hand to
/// each other, where its size suffices for several, so that the commands of all frames of an antialiaser are executed on one queue.
///
/// Threads: any; several frames may be created at once.
/// Lifetime: the buffers and alpha maps lent outlive the frame. The structs are read during the call alone.
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

/// Makes a frame like this one, for the same buffers and kinds of images, with more of what its last recording lacked. Where it
/// lacked nothing, the new one has as much. The old one is still to be destroyed.
///
/// Threads: no other call uses the frame at the time. Lifetime: the buffers and alpha maps lent outlive the new frame too.
/// Errors: as gpc_frame_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_grow(
    frame: *const GpcFrame,
    grown: *mut *mut GpcFrame,
) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe { object(frame, "frame")?.inner.grow() }?;
        Ok(GpcFrame { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(grown, "grown", make) }
}

/// Goes on with images of another size, in pixels. Pipelines stay, and so does memory where it suffices: a frame that becomes smaller
/// keeps what it has. Where that is too small, the first frame that is resized makes more, and the others share it.
///
/// Threads: no other call uses the frame at the time.
/// Lifetime: the commands of the frame's last recording are done, or will never be executed.
/// Errors: as gpc_frame_create; the frame is then as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_resize(
    frame: *mut GpcFrame,
    width: u32,
    height: u32,
) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        unsafe { place(frame, "frame")?.inner.resize([width, height]) }?;
        Ok(())
    })
}

/// Records the antialiasing of what the application has drawn, in any images of the kinds and the size that the frame was created
/// for, such as the swapchain's image at hand. It submits nothing, waits for nothing and allocates nothing on the device. It updates
/// descriptor sets of the frame's own, for which the last recording has to be done. `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the family
/// lent; what was bound and pushed before has to be bound and pushed again. `user` is handed to `shade`, whose shaders write
/// no memory of the library but by gpc_store.
///
/// Threads: no other call uses the frame or the command buffer at the time. Different frames may be recorded at once.
/// Lifetime: the commands of the frame's last recording are done, or will never be executed. The frame, the buffers, the images and what `shade` records
/// outlive the execution of the commands.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY. Nothing is recorded then.
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
            (frame, read(images)?.images(), read(scenery)?)
        };
        if commands == vk::CommandBuffer::null() {
            return Err(Error::Null("commands"));
        }
        let shade = shade.ok_or(Error::Null("shade"))?;
        // SAFETY: passed on to the caller.
        let draws = unsafe {
            GpcDraw::all(
                scenery.draws,
                (scenery.draw_count, scenery.draw_stride),
                ("GpcScenery.draws", "GpcScenery.draw_stride"),
            )
        }?;
        let [x, y, width, height] = scenery.viewport;
        let viewport = Viewport {
            x,
            y,
            width,
            height,
        };
        let viewport = (scenery.viewport != [0.0; 4]).then_some(viewport);
        let scenery = Scenery::new(&draws, scenery.projection).viewport(viewport);
        // SAFETY: passed on to the caller.
        unsafe {
            frame
                .inner
                .record(commands, &images, &scenery, &Callback { shade, user })
        }?;
        Ok(())
    })
}

/// What the last recording did, once its commands are done, until the next one. It waits for nothing: where they were not
/// submitted or still run, it answers GPC_RESULT_NOT_READY.
///
/// Threads: no gpc_frame_record of the frame runs at the time.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_outcome(
    frame: *const GpcFrame,
    outcome: *mut GpcOutcome,
) -> GpcResult {
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
                    visibility_samples: statistics.records,
                    memory_bytes: statistics.memory_bytes,
                    gpu_milliseconds: statistics.gpu_ms(),
                    ..GpcOutcome::defaults()
                })
            })
        }
    })
}

/// Bytes of device memory that a frame takes, beside what the application lends; 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_memory_bytes(frame: *const GpcFrame) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { frame.as_ref() }.map_or(0, |frame| frame.inner.memory_bytes())
}

/// Bytes of these that other frames of the same antialiaser may use as well, and that count once for all of them; 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_shared_memory_bytes(frame: *const GpcFrame) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { frame.as_ref() }.map_or(0, |frame| frame.inner.shared_memory_bytes())
}

/// Destroys a frame, whose commands are done. NULL does nothing.
///
/// Threads: no other call uses the frame at the time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_frame_destroy(frame: *mut GpcFrame) {
    // SAFETY: passed on to the caller.
    unsafe { take_back(frame) };
}

/// An application's materials behind a function of C.
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
