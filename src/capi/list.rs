//! Lists of sample locations.

use super::device::GpcAntialiaser;
use super::error::{Error, GpcResult, answer};
use super::frame::{Callback, GpcShade};
use super::geometry::{GpcDraw, GpcGeometry};
use super::input::{
    Element, GpcStructType, Struct, hand_over, init, object, place, read, sizes, take_back, write,
};
use super::options::GpcOptions;
use crate::host::{List, Location, LocationList};
use ash::vk;
use std::ffi::c_void;

/// Pipelines and memory to sample the locations of a list, of one frame in flight.
pub struct GpcList {
    inner: List,
}

/// A place on the image plane, as it lies in the buffer of a GpcLocationList: 32 bytes.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcLocation {
    /// The pixel that it lies in: column and row from the upper left corner of the image that GpcOptions names.
    pub pixel: [i32; 2],
    /// Where it lies in the pixel, x and y down, from 0 to 1.
    pub within: [f32; 2],
    /// How far apart it lies from its neighbours, in pixels: the change of x and y to the next column, and to the next row, of
    /// what the application makes of the list. Sub-samples and filters of textures spread over this parallelogram.
    pub jacobian: [[f32; 2]; 2],
}

const _: () = assert!(size_of::<GpcLocation>() == size_of::<Location>());

/// Where a list of locations lies, and where what they see goes.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcLocationList {
    /// sizeof(GpcLocationList).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LOCATION_LIST.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Most locations of a recording.
    pub capacity: u32,
    /// GpcLocations, made with VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT. They may change
    /// with every recording.
    pub locations: vk::Buffer,
    /// Where the first one is, in bytes: a multiple of 256, or of what the device's descriptors of buffers may begin at.
    pub offset: u64,
    /// What they see, made with VK_BUFFER_USAGE_TRANSFER_DST_BIT: four floats a location, in their order: linear light and
    /// opacity, by which the light is multiplied.
    pub colors: vk::Buffer,
    /// Where that of the first location goes, in bytes: a multiple of 4.
    pub colors_offset: u64,
}

// SAFETY: `repr(C)`; numbers, raw handles and pointers may have any bytes.
unsafe impl Element for GpcLocationList {
    const NAME: &'static str = "GpcLocationList";
    const SIZES: &'static [usize] = sizes!(GpcLocationList, colors_offset);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcLocationList {
    const TYPE: GpcStructType = GpcStructType::LocationList;
}

/// Fills a GpcLocationList of `size` bytes, which is sizeof(GpcLocationList): nothing is
/// lent.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_location_list(
    list: *mut GpcLocationList,
    size: usize,
) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(list, size) }
}

/// What a recording of a list samples, and where.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcListScenery {
    /// sizeof(GpcListScenery).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LIST_SCENERY.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// How many locations are sampled: the first ones of the buffer.
    pub location_count: u32,
    /// How many draws there are.
    pub draw_count: u32,
    /// The draws that locations see, read during the call alone. May be NULL where there are none.
    pub draws: *const GpcDraw,
    /// sizeof(GpcDraw), where there are some.
    pub draw_stride: u32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: `repr(C)`; numbers and raw pointers may have any bytes.
unsafe impl Element for GpcListScenery {
    const NAME: &'static str = "GpcListScenery";
    const SIZES: &'static [usize] = sizes!(GpcListScenery, reserved);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcListScenery {
    const TYPE: GpcStructType = GpcStructType::ListScenery;
}

/// Fills a GpcListScenery of `size` bytes, which is sizeof(GpcListScenery): no locations are
/// sampled.
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_list_scenery(
    scenery: *mut GpcListScenery,
    size: usize,
) -> GpcResult {
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

/// What a recording of a list did.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct GpcListOutcome {
    /// sizeof(GpcListOutcome).
    pub size: u32,
    /// GPC_STRUCT_TYPE_LIST_OUTCOME.
    pub r#type: u32,
    /// NULL, or a structure that extends this one.
    pub next: *const c_void,
    /// Locations off the image, or that are no numbers. They show the background.
    pub left_out: u32,
    /// Cells and tiles that found no room, and show the background. gpc_list_grow makes a list with more.
    pub left_over: u64,
    /// Visibility samples that were shaded.
    pub visibility_samples: u64,
    /// Bytes of device memory that the list takes, beside what the application lends.
    pub memory_bytes: u64,
    /// Time of the library's commands on the device in milliseconds; 0 where the queue has no timestamps.
    pub gpu_milliseconds: f64,
}

// SAFETY: `repr(C)`; numbers and raw pointers may have any bytes.
unsafe impl Element for GpcListOutcome {
    const NAME: &'static str = "GpcListOutcome";
    const SIZES: &'static [usize] = sizes!(GpcListOutcome, gpu_milliseconds);
}

// SAFETY: it begins with size, type and next.
unsafe impl Struct for GpcListOutcome {
    const TYPE: GpcStructType = GpcStructType::ListOutcome;
}

/// Fills a GpcListOutcome of `size` bytes, which is sizeof(GpcListOutcome).
///
/// Threads: any. Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_init_list_outcome(
    outcome: *mut GpcListOutcome,
    size: usize,
) -> GpcResult {
    // SAFETY: passed on to the caller.
    unsafe { init(outcome, size) }
}

/// Makes the pipelines and memory to sample a list of locations. With one sample each location is sampled where it is, with
/// more as a superpixel around it. Of the options, detection, contrast, thin and shade_all do not matter; width and height are
/// those of the image whose pixels locations count in.
///
/// Threads: any; several lists may be created at once.
/// Lifetime: the buffers and views lent outlive the list. The structs are read during the call alone.
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
            let options = read(options)?.options()?;
            antialiaser
                .inner
                .prepare_list(&geometry, &locations, &options)
        }?;
        Ok(GpcList { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(list, "list", make) }
}

/// Makes a list like this one, for the same buffers, with more of what its last recording lacked. Where it lacked nothing, the
/// new one has as much. The old one is still to be destroyed.
///
/// Threads: no other call uses the list at the time. Lifetime: the buffers and views lent outlive the new list too.
/// Errors: as gpc_list_create; GPC_RESULT_NOT_READY before the commands of the last recording are done. `*grown` is then NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_grow(
    list: *const GpcList,
    grown: *mut *mut GpcList,
) -> GpcResult {
    let make = || {
        // SAFETY: passed on to the caller.
        let inner = unsafe { object(list, "list")?.inner.grow() }?;
        Ok(GpcList { inner })
    };
    // SAFETY: passed on to the caller.
    unsafe { hand_over(grown, "grown", make) }
}

/// Records the sampling of locations. It submits nothing, waits for nothing, allocates nothing on the device
/// and updates no descriptor. `commands` is being recorded, outside of a render pass and of conditional rendering, for a queue of the family lent; what was
/// bound and pushed before has to be bound and pushed again, and what is recorded is visible to all commands after it. `user`
/// is handed to `shade`, whose shaders write no memory of the library but by gpc_store.
///
/// Threads: no other call uses the list or the command buffer at the time. Different lists may be recorded at once.
/// Lifetime: the commands of the list's last recording are done, or will never be executed. The list, the buffers and what `shade` records outlive the
/// execution of the commands.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_VALUE, GPC_RESULT_CAPACITY. Nothing is recorded then.
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
        // SAFETY: passed on to the caller.
        let draws = unsafe {
            GpcDraw::all(
                scenery.draws,
                (scenery.draw_count, scenery.draw_stride),
                ("GpcListScenery.draws", "GpcListScenery.draw_stride"),
            )
        }?;
        let shading = Callback { shade, user };
        // SAFETY: passed on to the caller.
        unsafe {
            list.inner
                .record(commands, &draws, scenery.location_count, &shading)
        }?;
        Ok(())
    })
}

/// What the last recording did, once its commands are done, until the next one. It waits for nothing: where they were not
/// submitted or still run, it answers GPC_RESULT_NOT_READY.
///
/// Threads: no gpc_list_record of the list runs at the time.
/// Errors: GPC_RESULT_NULL, GPC_RESULT_STRUCT_SIZE, GPC_RESULT_STRUCT_TYPE, GPC_RESULT_NOT_READY, GPC_RESULT_DEVICE_LOST, GPC_RESULT_VULKAN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_outcome(
    list: *const GpcList,
    outcome: *mut GpcListOutcome,
) -> GpcResult {
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
                    visibility_samples: statistics.records,
                    memory_bytes: statistics.memory_bytes,
                    gpu_milliseconds: statistics.gpu_ms(),
                    ..GpcListOutcome::defaults()
                })
            })
        }
    })
}

/// Bytes of device memory that a list takes, beside what the application lends; 0 for NULL.
///
/// Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_memory_bytes(list: *const GpcList) -> u64 {
    // SAFETY: passed on to the caller.
    unsafe { list.as_ref() }.map_or(0, |list| list.inner.memory_bytes())
}

/// Destroys a list, whose commands are done. NULL does nothing.
///
/// Threads: no other call uses the list at the time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gpc_list_destroy(list: *mut GpcList) {
    // SAFETY: passed on to the caller.
    unsafe { take_back(list) };
}
