//! Lists of sample locations.

use super::device::GpcAntialiaser;
use super::error::{Error, GpcResult, answer};
use super::frame::{Callback, GpcShade};
use super::geometry::{GpcDraw, GpcGeometry};
use super::input::{Element, array, hand_over, init, object, place, read, take_back, unused, write};
use super::options::GpcOptions;
use crate::host::{List, ListOptions, Location, LocationList};
use ash::vk;
use std::ffi::c_void;

/// Pipelines and memory to sample the locations of a list, for one frame in flight.
pub struct GpcList {
    inner: List,
}

/// Sample location on the image plane: 32 bytes, an element of a GpcLocationList's buffer.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcLocation {
    /// Column and row of the pixel that contains the location, from the upper left corner of the image of the size in
    /// GpcOptions.
    pub pixel: [i32; 2],
    /// Position in that pixel: x to the right and y down, from 0 to 1.
    pub within: [f32; 2],
    /// Jacobian of the location's mapping, in pixels: the changes of x and y to the next column, and those to the next
    /// row, of the application's output. Sub-samples and texture filters cover this parallelogram.
    pub jacobian: [[f32; 2]; 2],
}

const _: () = assert!(size_of::<GpcLocation>() == size_of::<Location>());

/// Buffers of the application for a list: sample locations, and the resulting colours.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcLocationList {
    /// sizeof(GpcLocationList).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LOCATION_LIST.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Largest number of locations of a recording.
    pub capacity: u32,
    /// Buffer of GpcLocations, created with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and
    /// VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT. Its contents may change with every recording.
    pub locations: vk::Buffer,
    /// Offset of the first location in bytes: a multiple of 256, or of the device's offset alignment for buffer
    /// descriptors.
    pub offset: u64,
    /// Buffer for the colours of the locations, created with VK_BUFFER_USAGE_TRANSFER_DST_BIT. Each location, in the
    /// order of the list, gets four floats: linear light, premultiplied by opacity, and opacity.
    pub colors: vk::Buffer,
    /// Offset of the first location's colour in bytes: a multiple of 4.
    pub colors_offset: u64,
}

/// Fills a GpcLocationList of `size` bytes, which is sizeof(GpcLocationList), without buffers.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_location_list(list: *mut GpcLocationList, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(list, size) }
}

/// Locations and draws of a recording of a list.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcListScenery {
    /// sizeof(GpcListScenery).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LIST_SCENERY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Number of locations to sample, from the first one of the buffer on.
    pub location_count: u32,
    /// Number of draws.
    pub draw_count: u32,
    /// Draws, read during the call only. May be NULL if there are none.
    pub draws: *const GpcDraw,
    /// sizeof(GpcDraw), if there are draws.
    pub draw_stride: u32,
    /// 0.
    pub reserved: u32,
}

/// Fills a GpcListScenery of `size` bytes, which is sizeof(GpcListScenery), without locations and draws.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_list_scenery(scenery: *mut GpcListScenery, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(scenery, size) }
}

impl GpcLocationList {
    fn list(&self) -> LocationList {
        LocationList {
            locations: self.locations,
            offset: self.offset,
            capacity: self.capacity,
            colors: self.colors,
            colors_offset: self.colors_offset,
        }
    }
}

/// Result of a recording of a list.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcListOutcome {
    /// sizeof(GpcListOutcome).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LIST_OUTCOME.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Number of locations that lie outside of the image or are not finite; these show the background.
    pub left_out: u32,
    /// Number of cells and tiles for which memory or GpcOptions.max_rounds did not suffice; these show the background.
    /// The list's next recording has more memory, unless GpcOptions.fixed_memory is set.
    pub left_over: u64,
    /// Number of visibility samples that were shaded.
    pub visibility_samples: u64,
    /// Number of bytes of device memory that the list uses, without the application's buffers.
    pub memory_bytes: u64,
    /// Time of the library's commands on the device in milliseconds; 0 if the queue has no timestamps.
    pub gpu_milliseconds: f64,
}

/// Fills a GpcListOutcome of `size` bytes, which is sizeof(GpcListOutcome).
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_list_outcome(outcome: *mut GpcListOutcome, size: usize) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(outcome, size) }
}

/// Makes the pipelines and memory to sample a list of locations. With one sample, each location is sampled at its own
/// position; with more, as a superpixel around it. `width` and `height` are the size of the image in whose pixels
/// locations are given. A list has no neighbouring pixels, so that the options `detection`, `contrast`, `growths`,
/// `thin`, `flat_background`, `high_dynamic_range` and `shade_all` have no effect, and `filter` has to be GPC_FILTER_BOX.
///
/// Threads: any; several lists may be created at once.
/// Lifetime: the lent buffers and views outlive the list. The structs are read during the call only.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_OUT_OF_MEMORY, GPC_RESULT_DEVICE_LOST,
/// GPC_RESULT_VULKAN. `*list` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_create(
    antialiaser: *const GpcAntialiaser,
    geometry: *const GpcGeometry,
    locations: *const GpcLocationList,
    options: *const GpcOptions,
    list: *mut *mut GpcList,
) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe {
            let antialiaser = object(antialiaser, "antialiaser")?;
            let geometry = read(geometry)?.geometry()?;
            let locations = read(locations)?.list();
            let options = read(options)?;
            options.check_filter_of_list()?;
            let options = options.options()?;
            antialiaser.inner.prepare_list(&geometry, &locations, &ListOptions::from(&options))
        }?;
        Ok(GpcList { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(list, "list", make) }
}

/// Makes a list like `list`, for the same buffers, with more of the memory that the last recording lacked. If it lacked
/// none, the new list has as much memory as the old one. The old list still has to be destroyed. With
/// GpcOptions.fixed_memory, this is the way to more memory; otherwise gpc_list_record takes care of it.
///
/// Threads: no other call uses the list at the same time. Lifetime: the lent buffers and views outlive the new list
/// too.
/// Errors: as gpc_list_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_grow(list: *const GpcList, grown: *mut *mut GpcList) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe { object(list, "list")?.inner.grow() }?;
        Ok(GpcList { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(grown, "grown", make) }
}

/// Records the sampling of locations. The call neither submits nor waits.
///
/// The call allocates no device memory and updates no descriptor, with one exception: if the last recording left work over
/// for want of memory, the list first gets more of it. If the device has no more, the list keeps what it has.
/// GpcOptions.fixed_memory forbids this.
///
/// `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the lent family.
/// The application must bind and push its state again afterwards; the results are visible to all later commands. `user`
/// is passed to `shade`, whose shaders write no memory of the library except by gpc_store.
///
/// Threads: no other call uses the list or the command buffer at the same time. Different lists may be recorded at the
/// same time.
/// Lifetime: the commands of the list's last recording are done, or will never be executed. The list, the buffers and
/// the objects that `shade` records outlive the execution of the commands.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY; GPC_RESULT_DEVICE_LOST
/// and GPC_RESULT_VULKAN while the list gets more memory. Nothing is recorded then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_record(
    list: *mut GpcList,
    commands: vk::CommandBuffer,
    scenery: *const GpcListScenery,
    shade: GpcShade,
    user: *mut c_void,
) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        let (list, scenery) = unsafe { (place(list, "list")?, read(scenery)?) };
        if commands == vk::CommandBuffer::null() {
            return Err(Error::Null("commands"));
        }
        let shade = shade.ok_or(Error::Null("shade"))?;
        unused("GpcListScenery.reserved", scenery.reserved)?;
        // SAFETY: passed on to the caller.
        let draws = unsafe { array!(scenery, GpcListScenery, draws, draw_count, draw_stride) }?;
        let draws: Vec<_> = draws.iter().map(GpcDraw::draw).collect::<Result<_, _>>()?;
        let shading = Callback { shade, user };
        // SAFETY: passed on to the caller.
        unsafe { list.inner.record(commands, &draws, scenery.location_count, &shading) }?;
        Ok(())
    })
}

/// Result of the last recording, available once its commands are done, until the next recording begins. The call does
/// not wait: if the commands were not submitted or still run, the result is GPC_RESULT_NOT_READY. If the commands are
/// submitted again, call this only when that submission is done: until the device begins it, it is taken for done.
///
/// Threads: no gpc_list_record of the list runs at the same time.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_outcome(list: *const GpcList, outcome: *mut GpcListOutcome) -> GpcResult {
    answer(|| {
        // SAFETY: passed on to the caller.
        unsafe {
            let list = object(list, "list")?;
            write(outcome, || {
                let found = list.inner.outcome()?;
                let statistics = &found.statistics;
                Ok(GpcListOutcome {
                    left_out: found.left_out,
                    left_over: found.left_over,
                    visibility_samples: statistics.visibility_samples,
                    memory_bytes: statistics.memory_bytes,
                    gpu_milliseconds: statistics.gpu_ms(),
                    ..GpcListOutcome::defaults()
                })
            })
        }
    })
}

/// Number of bytes of device memory that a list uses, without the application's buffers; 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_memory_bytes(list: *const GpcList) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { list.as_ref() }.map_or(0, |list| list.inner.memory_bytes())
}

/// Destroys a list, whose commands are done. NULL is ignored.
///
/// Threads: no other call uses the list at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_destroy(list: *mut GpcList) {
    // SAFETY: passed on to the caller.
    unsafe { take_back(list) };
}
