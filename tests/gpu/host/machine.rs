//! Vulkan objects of the tests' host: what it makes, lends and reads back.

use super::layers::{Layers, with_secondary};
use super::world::{Drawn, Indirect, Lent, Map, SIZE, SKY, Way, World};
use crate::submit::{discard, submit, submit_and};
use ash::vk;
use gpc::host::HostError;
use gpc::host::{
    AlphaMap, Antialiaser, ClipSpace, Coordinates, Draw, Frame, Geometry, ImageKinds, ImageState, Images, Indices,
    IndirectDraws, LentImage, ListOptions, ListOutcome, Location, LocationList, Mesh, Options, Outcome, PositionSpace,
    Scenery, ShadeSamples, VertexFormat, VisibilitySamples,
};
use gpc::render::{EngineError, Headless};
use gpc::testing::{Buffer, Image, Memory, MemoryUse, Recorder, memory};
use gpc::vulkan::Gpu;
use gpc::vulkan::VulkanError;
use std::cell::{Cell, RefCell};
use std::sync::Arc;

/// Contents of images around the picture: larger than any colour, and no triangle's ID.
pub const AROUND: [f32; 4] = [9.0; 4];

/// Results of a frame.
pub struct Seen {
    /// Colours of the whole image.
    pub colors: Vec<[f32; 4]>,
    /// Corners of all triangles in clip space, as the library computes them.
    pub corners: Vec<[f32; 4]>,
    pub outcome: Outcome,
    /// Numbers of workgroups of the shading dispatches, call by call.
    pub dispatched: Vec<u32>,
    /// Number of rounds of the recording.
    pub rounds: u32,
}

/// Largest number of shading calls that are recorded.
const CALLS: u64 = 1024;

/// Host shading that also records the corners of triangles and the sizes of its dispatches.
struct Shading<'a> {
    dispatched: &'a Buffer,
    calls: Cell<u64>,
    /// Functions of conditional rendering, if the host uses them.
    skips: Option<&'a ash::ext::conditional_rendering::Device>,
    device: &'a ash::Device,
    layout: vk::PipelineLayout,
    set: vk::DescriptorSet,
    samples: vk::Pipeline,
    corners: vk::Pipeline,
    triangles: u32,
    /// Factor on the brightness of back faces.
    back: f32,
}

impl ShadeSamples for Shading<'_> {
    fn record(&self, commands: vk::CommandBuffer, found: &VisibilitySamples) {
        let sets = [found.descriptor_set(), self.set];
        let (compute, device) = (vk::PipelineBindPoint::COMPUTE, self.device);
        let (arguments, offset) = found.dispatch(0).unwrap();
        let call = self.calls.replace(self.calls.get() + 1);
        let kept = [vk::BufferCopy::default().src_offset(offset).dst_offset(4 * call.min(CALLS - 1)).size(4)];
        let skipping = self.skips.zip(found.condition());
        // SAFETY: the commands are being recorded; all handles outlive their execution. Conditional rendering that is
        // begun is ended.
        unsafe {
            device.cmd_copy_buffer(commands, arguments, self.dispatched.handle(), &kept);
            if let Some((functions, word)) = skipping {
                let info = vk::ConditionalRenderingBeginInfoEXT::default().buffer(word);
                (functions.fp().cmd_begin_conditional_rendering_ext)(commands, &info);
            }
            device.cmd_bind_descriptor_sets(commands, compute, self.layout, 0, &sets, &[]);
            device.cmd_bind_pipeline(commands, compute, self.corners);
            let [triangles, back] = [self.triangles, self.back.to_bits()].map(u32::to_ne_bytes);
            device.cmd_push_constants(
                commands,
                self.layout,
                vk::ShaderStageFlags::COMPUTE,
                0,
                &[triangles, back].concat(),
            );
            device.cmd_dispatch(commands, (3 * self.triangles).div_ceil(64), 1, 1);
            device.cmd_bind_pipeline(commands, compute, self.samples);
            device.cmd_dispatch_indirect(commands, arguments, offset);
            if let Some((functions, _)) = skipping {
                (functions.fp().cmd_end_conditional_rendering_ext)(commands);
            }
        }
    }
}

/// Shading that waits until the CPU sets an event.
struct Gated<'a> {
    inner: &'a Shading<'a>,
    gate: vk::Event,
}

impl ShadeSamples for Gated<'_> {
    fn record(&self, commands: vk::CommandBuffer, found: &VisibilitySamples) {
        let gates = [self.gate];
        let by_cpu = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let info = [vk::DependencyInfo::default().memory_barriers(&by_cpu)];
        // SAFETY: the commands are being recorded; the event outlives their execution.
        unsafe {
            self.inner.device.cmd_wait_events2(commands, &gates, &info);
        }
        self.inner.record(commands, found);
    }
}

/// Image of which the library makes every pixel.
struct Canvas {
    color: Image,
    read_back: Buffer,
    size: [u32; 2],
}

/// Result of a frame on a [`Canvas`].
pub struct Shown {
    pub colors: Vec<[f32; 4]>,
    pub memory_bytes: u64,
    pub shared_bytes: u64,
}

impl Canvas {
    fn images(&self) -> Images {
        Images {
            ids: None,
            depth: None,
            color: LentImage {
                image: self.color.handle(),
                view: self.color.view(),
                aspects: vk::ImageAspectFlags::COLOR,
                before: UNDEFINED,
                after: COPIED,
            },
            corner: [0, 0],
            layer: 0,
        }
    }

    fn shown(&self, frame: &Frame) -> Shown {
        let pixels = self.size[0] as usize * self.size[1] as usize;
        Shown {
            colors: self.read_back.read(pixels).unwrap().to_vec(),
            memory_bytes: frame.memory_bytes(),
            shared_bytes: frame.shared_memory_bytes(),
        }
    }
}

/// Kinds of the images of a canvas.
const KINDS: ImageKinds = ImageKinds {
    ids: false,
    depth: false,
    color_format: vk::Format::R32G32B32A32_SFLOAT,
    color_encoded: false,
    color_copied: false,
};

/// Options for a canvas of a size.
fn of_size([width, height]: [u32; 2]) -> Options {
    Options::new(width, height).background(Some(SKY)).shade_all(true)
}

/// Whether an error says that nothing was recorded.
pub fn is_not_recorded(error: Option<HostError>) -> bool {
    matches!(error, Some(HostError::Engine(EngineError::Vulkan(VulkanError::NotRecorded))))
}

/// Whether an error says that the commands have not been executed.
pub fn is_not_done(error: Option<HostError>) -> bool {
    matches!(error, Some(HostError::Engine(EngineError::Vulkan(VulkanError::NotDone))))
}

/// Images that a host has drawn before it calls the library.
#[derive(Clone, Copy)]
pub enum Base<'a> {
    /// IDs, depth and colours.
    All(&'a Drawn),
    /// Colours only.
    Colors(&'a Drawn),
    /// IDs and depth only.
    Ids(&'a Drawn),
    Nothing,
}

impl Base<'_> {
    fn ids(&self) -> Option<&Drawn> {
        match self {
            Self::All(drawn) | Self::Ids(drawn) => Some(drawn),
            Self::Colors(_) | Self::Nothing => None,
        }
    }

    fn colors(&self) -> Option<&Drawn> {
        match self {
            Self::All(drawn) | Self::Colors(drawn) => Some(drawn),
            Self::Ids(_) | Self::Nothing => None,
        }
    }
}

/// A host that shows a world.
pub struct Machine<'a> {
    gpu: Arc<Gpu>,
    memory: Memory,
    antialiaser: Antialiaser,
    world: &'a World,
    descriptors: vk::DescriptorPool,
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipelines: [vk::Pipeline; 2],
    /// Whether the host first makes recordings that it never submits.
    pub discards: bool,
    /// Whether the host's shading is skipped in rounds that have nothing to do, if the device supports that.
    pub skips: bool,
}

/// Buffers and maps on the device, and the structures that lend them.
struct Lending<'a> {
    _meshes: Vec<[Buffer; 2]>,
    _coordinates: Buffer,
    paints: Buffer,
    of_draws: Buffer,
    _maps: Vec<(Image, &'a Map)>,
    /// Factor on the brightness of back faces.
    back: f32,
    _indirect: Vec<[Buffer; 3]>,
    geometry: Geometry,
}

/// Copy of `bytes`, which hold elements of `stride` bytes from `offset` on. Elements that `of` assigns to other meshes
/// than `mesh` are overwritten.
fn of_mesh(bytes: &[u8], offset: u64, stride: usize, of: &[usize], mesh: usize) -> Vec<u8> {
    let mut kept = bytes.to_vec();
    for (number, _) in of.iter().enumerate().filter(|(_, of)| **of != mesh) {
        let first = offset as usize + number * stride;
        kept[first..first + stride].fill(0xff);
    }
    kept
}

impl<'a> Lending<'a> {
    fn new(machine: &Machine<'a>, way: &Way, lent: &Lent) -> Self {
        let buffers = |mesh| {
            let (stride, short) = (way.stride as usize, lent.index_type == vk::IndexType::UINT16);
            let [offset, first] = [way.positions_offset, way.indices_offset];
            let size = if short { 2 } else { 4 };
            [
                machine.filled(&of_mesh(&lent.positions, offset, stride, &lent.of_vertices, mesh)),
                machine.filled(&of_mesh(&lent.indices, first, size, &lent.of_indices, mesh)),
            ]
        };
        let together = || [machine.filled(&lent.positions), machine.filled(&lent.indices)];
        let meshes: Vec<_> =
            if way.apart { (0..machine.world.meshes.len()).map(buffers).collect() } else { vec![together()] };
        let paints = machine.filled(bytemuck::cast_slice(&lent.paints));
        let coordinates = machine.filled(bytemuck::cast_slice(&lent.coordinates));
        let with_image = |map| (machine.map_image(map), map);
        let maps: Vec<_> = machine.world.maps.iter().map(with_image).collect();
        let of_draws: Vec<_> = (machine.world.parts.iter())
            .map(|part| [part.color[0], part.color[1], part.color[2], part.opacity])
            .collect();
        let of_draws = machine.filled(bytemuck::cast_slice(&of_draws));
        let lent_mesh = |[positions, indices]: &[Buffer; 2]| Mesh {
            positions: positions.handle(),
            positions_offset: way.positions_offset,
            position_stride: way.stride,
            position_format: way.format,
            vertex_capacity: lent.vertex_count,
            coordinates: (!maps.is_empty()).then(|| Coordinates {
                buffer: coordinates.handle(),
                offset: 0,
                stride: 8,
                format: VertexFormat::FLOAT,
            }),
            indices: (!way.bare).then(|| Indices {
                buffer: indices.handle(),
                offset: way.indices_offset,
                index_type: lent.index_type,
                capacity: lent.index_count,
            }),
        };
        let in_buffers = |indirect: &Indirect| {
            let count = indirect.count.as_deref().unwrap_or_default();
            let instances = bytemuck::cast_slice(&indirect.instances);
            [&indirect.commands[..], count, instances].map(|bytes| machine.filled(bytes))
        };
        let indirect: Vec<_> = lent.indirect.iter().map(in_buffers).collect();
        let list = |(lent, buffers): (&Indirect, &[Buffer; 3])| {
            let [commands, count, instances] = buffers.each_ref().map(Buffer::handle);
            let count = lent.list.count.map(|(_, offset)| (count, offset));
            IndirectDraws { commands, count, instances, ..lent.list }
        };
        let lists = lent.indirect.iter().zip(&indirect).map(list).collect();
        let listed: u32 = lent.indirect.iter().map(|indirect| indirect.list.triangle_capacity).sum();
        let geometry = Geometry {
            meshes: meshes.iter().map(lent_mesh).collect(),
            position_space: if way.object_space {
                PositionSpace::Object { capacity: lent.drawn_vertices }
            } else {
                PositionSpace::Clip
            },
            indirect: lists,
            triangle_capacity: lent.triangle_count - listed,
            draw_capacity: lent.draws.len() as u32,
            keys: 1,
            alpha_maps: maps.iter().map(|(image, map)| map.lent(image)).collect(),
            blended: lent.draws.iter().any(|draw| draw.blended) || lent.indirect.iter().any(|i| i.list.blended),
            clip: ClipSpace { y_up: way.y_up, reversed_depth: way.reversed_depth, depth_range: way.depth_range },
        };
        Self {
            _meshes: meshes,
            _coordinates: coordinates,
            paints,
            of_draws,
            back: way.back,
            _maps: maps,
            _indirect: indirect,
            geometry,
        }
    }
}

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::from_raw(
    vk::BufferUsageFlags::STORAGE_BUFFER.as_raw() | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER.as_raw(),
);
const UNDEFINED: ImageState = ImageState {
    layout: vk::ImageLayout::UNDEFINED,
    stage: vk::PipelineStageFlags2::ALL_COMMANDS,
    access: vk::AccessFlags2::NONE,
};
const WRITTEN: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_WRITE,
};
const COPIED: ImageState = ImageState {
    layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
    stage: vk::PipelineStageFlags2::COPY,
    access: vk::AccessFlags2::TRANSFER_READ,
};

macro_rules! spirv {
    ($name:literal) => {
        include_bytes!(concat!("shaders/spirv/", $name, ".spv"))
    };
}

impl<'a> Machine<'a> {
    pub fn new(headless: &Headless, world: &'a World) -> Self {
        let gpu = headless.gpu().clone();
        let antialiaser = Antialiaser::in_gpu(gpu.clone()).unwrap();
        let device = gpu.device();
        let compute = vk::ShaderStageFlags::COMPUTE;
        // SAFETY: plain creations on a live device.
        unsafe {
            let sizes = [vk::DescriptorPoolSize { ty: vk::DescriptorType::STORAGE_BUFFER, descriptor_count: 3 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            let descriptors = device.create_descriptor_pool(&info, None).unwrap();
            let bindings = [0, 1, 2].map(|binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .descriptor_count(1)
                    .stage_flags(compute)
            });
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layout = device.create_descriptor_set_layout(&info, None).unwrap();
            let sets = [antialiaser.samples_layout(), set_layout];
            let push = [vk::PushConstantRange { stage_flags: compute, offset: 0, size: 8 }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&push);
            let layout = device.create_pipeline_layout(&info, None).unwrap();
            let pipeline = |code: &[u8]| {
                let words = ash::util::read_spv(&mut std::io::Cursor::new(code)).unwrap();
                let info = vk::ShaderModuleCreateInfo::default().code(&words);
                let module = device.create_shader_module(&info, None).unwrap();
                let stage = vk::PipelineShaderStageCreateInfo::default().stage(compute).module(module).name(c"main");
                let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
                let cache = vk::PipelineCache::null();
                let made = device.create_compute_pipelines(cache, &[info], None);
                device.destroy_shader_module(module, None);
                made.unwrap()[0]
            };
            let pipelines = [pipeline(spirv!("samples")), pipeline(spirv!("corners"))];
            Self {
                // Tests wait for the commands that use objects made from this.
                memory: memory(&gpu, None),
                antialiaser,
                world,
                descriptors,
                set_layout,
                layout,
                pipelines,
                gpu,
                discards: false,
                skips: true,
            }
        }
    }

    /// Result of a frame over the images that the host has drawn, with buffers lent as `way` says.
    pub fn see(&self, way: &Way, base: Base<'_>) -> Seen {
        let options = Options::new(SIZE[0], SIZE[1]).flat_background(true);
        self.see_lent(way, &self.world.lent(way), base, options)
    }

    /// Result of a frame as [`Self::see`] gives it, with the caller's buffers.
    pub fn see_lent(&self, way: &Way, lent: &Lent, base: Base<'_>, options: Options) -> Seen {
        self.see_again(way, lent, base, options, 1).pop().unwrap()
    }

    /// Results of `times` recordings of one frame, each over the same images of the host.
    pub fn see_again(&self, way: &Way, lent: &Lent, base: Base<'_>, options: Options, times: usize) -> Vec<Seen> {
        let size = way.around(options.size);
        let lending = Lending::new(self, way, lent);
        let corner_bytes = 48 * u64::from(lent.triangle_count);
        let corners = self.read_back(corner_bytes);
        let pixels = size[0] as usize * size[1] as usize;
        let read_back = self.read_back(16 * pixels as u64);
        let (plain, deep) = (vk::ImageAspectFlags::COLOR, vk::ImageAspectFlags::DEPTH);
        let ids = self.image(size, vk::Format::R32_UINT, plain);
        let depth = self.image(size, vk::Format::D32_SFLOAT, deep);
        let color = self.color(size, !way.copied);
        let mut pictures = Vec::new();
        if let Some(drawn) = base.ids() {
            let numbers = way.framed(&drawn.ids, options.size, u32::MAX);
            let [least, most] = way.depth_range;
            let in_range = |depth: &f32| least + (most - least) * depth;
            let depths: Vec<_> = drawn.depths.iter().map(in_range).collect();
            let depths = way.framed(&depths, options.size, 0.5);
            pictures.push((&ids, plain, self.filled(bytemuck::cast_slice(&numbers))));
            pictures.push((&depth, deep, self.filled(bytemuck::cast_slice(&depths))));
        }
        if let Some(drawn) = base.colors() {
            let colors = way.framed(&drawn.colors, options.size, AROUND);
            let colors = self.filled(bytemuck::cast_slice(&colors));
            pictures.push((&color, plain, colors));
        }
        let lend = |image: &Image, aspects, before, after| LentImage {
            image: image.handle(),
            view: image.view(),
            aspects,
            before,
            after,
        };
        let before = base.colors().map_or(UNDEFINED, |_| WRITTEN);
        let images = Images {
            ids: (base.ids()).map(|_| lend(&ids, plain, WRITTEN, WRITTEN)),
            depth: (base.ids()).map(|_| lend(&depth, deep, WRITTEN, WRITTEN)),
            color: lend(&color, plain, before, COPIED),
            corner: way.corner,
            layer: 0,
        };
        let kinds = ImageKinds {
            ids: images.ids.is_some(),
            depth: images.depth.is_some(),
            color_format: vk::Format::R32G32B32A32_SFLOAT,
            color_encoded: false,
            color_copied: way.copied,
        };
        let background = options.background.or(Some(SKY));
        let options = options.background(background).shade_all(base.colors().is_none());
        // SAFETY: lent objects have the stated contents, and outlive the frame.
        let mut frame = unsafe { self.antialiaser.prepare(&lending.geometry, &kinds, &options) }.unwrap();
        let dispatched = self.read_back(4 * CALLS);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let scenery = Scenery::new(&lent.draws, self.world.projection).viewport(way.viewport);
        if self.discards {
            assert!(is_not_recorded(frame.outcome().err()));
            discard(&self.gpu, |commands| {
                // SAFETY: the commands are never submitted.
                unsafe { frame.record(commands, &images, &scenery, &shading) }.unwrap();
            });
            assert!(is_not_done(frame.outcome().err()));
            // SAFETY: lent objects outlive all frames.
            assert!(is_not_done(unsafe { frame.grow() }.err()));
        }
        let mut see = || {
            shading.calls.set(0);
            self.run(size, &mut frame, (&images, &scenery), &shading, &pictures, (&color, &read_back));
            let (calls, triangles) = (shading.calls.get(), lent.triangle_count as usize);
            Seen {
                colors: read_back.read(pixels).unwrap().to_vec(),
                corners: corners.read(3 * triangles).unwrap().to_vec(),
                outcome: frame.outcome().unwrap(),
                dispatched: (dispatched.read(calls.min(CALLS) as usize).unwrap()).to_vec(),
                rounds: frame.rounds(),
            }
        };
        (0..times).map(|_| see()).collect()
    }

    /// Memory of a frame that is prepared for a number of triangles, in bytes, and the number of rounds of its recordings.
    pub fn prepared(&self, way: &Way, triangles: u32, options: &Options) -> (u64, u32) {
        let lending = Lending::new(self, way, &self.world.lent(way));
        let geometry = Geometry { triangle_capacity: triangles, ..lending.geometry };
        let kinds = ImageKinds { color_format: vk::Format::B8G8R8A8_SRGB, ..KINDS };
        // SAFETY: lent objects outlive the frame, of which no command is recorded.
        let frame = unsafe { self.antialiaser.prepare(&geometry, &kinds, options) }.unwrap();
        (frame.memory_bytes(), frame.rounds())
    }

    /// Message with which the library refuses a geometry that `spoil` has changed.
    pub fn refused(&self, way: &Way, lent: &Lent, spoil: impl FnOnce(&mut Geometry)) -> String {
        let mut geometry = Lending::new(self, way, lent).geometry;
        spoil(&mut geometry);
        // SAFETY: nothing is recorded.
        let made = unsafe { self.antialiaser.prepare(&geometry, &KINDS, &of_size(SIZE)) };
        made.err().unwrap().to_string()
    }

    /// Layers of an image with two layers, which are filled with [`AROUND`] before the library makes the picture of one of
    /// them. With `is_secondary`, the library's commands are in a secondary command buffer.
    pub fn see_layer(&self, way: &Way, layer: u32, is_secondary: bool) -> [Vec<[f32; 4]>; 2] {
        let lent = self.world.lent(way);
        let lending = Lending::new(self, way, &lent);
        let (corners, dispatched) = self.kept(&lent);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let options = of_size(SIZE).flat_background(true);
        // SAFETY: lent objects have the stated contents, and outlive the frame.
        let mut frame = unsafe { self.antialiaser.prepare(&lending.geometry, &KINDS, &options) }.unwrap();
        let image = Layers::new(&self.gpu);
        let read_back = [0, 1].map(|_| self.read_back(16 * u64::from(SIZE[0] * SIZE[1])));
        let images = Images {
            ids: None,
            depth: None,
            color: LentImage {
                image: image.raw,
                view: image.views[layer as usize],
                aspects: vk::ImageAspectFlags::COLOR,
                before: WRITTEN,
                after: WRITTEN,
            },
            corner: [0, 0],
            layer,
        };
        let scenery = Scenery::new(&lent.draws, self.world.projection);
        let mut record = |commands| {
            // SAFETY: the commands are waited for; all handles outlive them.
            unsafe { frame.record(commands, &images, &scenery, &shading) }.unwrap();
        };
        let mut secondary = None;
        submit(&self.gpu, |commands| {
            image.fill(commands, AROUND);
            if is_secondary {
                secondary = Some(with_secondary(&self.gpu, commands, &mut record));
            } else {
                record(commands);
            }
            for (layer, buffer) in (0..).zip(&read_back) {
                image.read(commands, layer, buffer);
            }
        });
        drop(secondary);
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        read_back.map(|buffer| buffer.read(pixels).unwrap().to_vec())
    }

    /// Pictures that the library makes of several lists of draws, each in a frame of its own. The commands of the
    /// frames follow each other without a barrier of the host's.
    pub fn see_at_once(&self, way: &Way, lent: &Lent, shown: &[&[Draw]]) -> Vec<Shown> {
        let size = SIZE;
        let lending = Lending::new(self, way, lent);
        let (corners, dispatched) = self.kept(lent);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let canvases: Vec<_> = shown.iter().map(|_| self.canvas(size)).collect();
        // SAFETY: lent objects have the stated contents, and outlive the frames.
        let prepared = || unsafe {
            let options = of_size(size);
            self.antialiaser.prepare(&lending.geometry, &KINDS, &options)
        };
        let mut frames: Vec<_> = shown.iter().map(|_| prepared().unwrap()).collect();
        submit(&self.gpu, |commands| {
            for ((frame, draws), canvas) in frames.iter_mut().zip(shown).zip(&canvases) {
                let scenery = Scenery::new(draws, self.world.projection);
                // SAFETY: the commands are waited for; all handles outlive them.
                unsafe { frame.record(commands, &canvas.images(), &scenery, &shading) }.unwrap();
            }
            for canvas in &canvases {
                self.read(commands, canvas);
            }
        });
        let frames = frames.iter().zip(&canvases);
        frames.map(|(frame, canvas)| canvas.shown(frame)).collect()
    }

    /// Pictures of the world, made by one frame that is resized to each of the `sizes` in turn.
    pub fn see_resized(&self, way: &Way, lent: &Lent, sizes: &[[u32; 2]]) -> Vec<Shown> {
        let lending = Lending::new(self, way, lent);
        let (corners, dispatched) = self.kept(lent);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let options = of_size(sizes[0]);
        let prepare = |geometry| {
            // SAFETY: lent objects have the stated contents, and outlive the frame.
            unsafe { self.antialiaser.prepare(geometry, &KINDS, &options) }
        };
        let mut frame = prepare(&lending.geometry).unwrap();
        let scenery = Scenery::new(&lent.draws, self.world.projection);
        let shown = sizes.iter().map(|&size| {
            let canvas = self.canvas(size);
            // SAFETY: the previous commands have run.
            unsafe { frame.resize(size) }.unwrap();
            assert!(is_not_recorded(frame.outcome().err()));
            submit(&self.gpu, |commands| {
                // SAFETY: the commands are waited for; all handles outlive them.
                unsafe { frame.record(commands, &canvas.images(), &scenery, &shading) }.unwrap();
                self.read(commands, &canvas);
            });
            assert_eq!(frame.outcome().unwrap().left_over, 0);
            canvas.shown(&frame)
        });
        shown.collect()
    }

    /// Pictures of the world, made by two submissions of one recording. In between the picture is overwritten.
    pub fn see_twice(&self, way: &Way, lent: &Lent) -> [Shown; 2] {
        let lending = Lending::new(self, way, lent);
        let (corners, dispatched) = self.kept(lent);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        // SAFETY: lent objects have the stated contents, and outlive the frame.
        let frame = unsafe {
            let options = of_size(SIZE);
            self.antialiaser.prepare(&lending.geometry, &KINDS, &options)
        };
        let frame = RefCell::new(frame.unwrap());
        let scenery = Scenery::new(&lent.draws, self.world.projection);
        let canvas = self.canvas(SIZE);
        let recorded = Cell::default();
        let mut first = None;
        submit_and(
            &self.gpu,
            |commands| {
                let (mut frame, images) = (frame.borrow_mut(), canvas.images());
                // SAFETY: the commands are waited for; all handles outlive them.
                unsafe { frame.record(commands, &images, &scenery, &shading) }.unwrap();
                self.read(commands, &canvas);
                recorded.set(commands);
            },
            || {
                let device = self.gpu.device();
                let all = [recorded.get()];
                let submits = [vk::SubmitInfo::default().command_buffers(&all)];
                // SAFETY: the commands are submitted again when they are done, and are waited for by `submit_and`.
                unsafe {
                    let queue = device.get_device_queue(self.gpu.queue_family(), 0);
                    device.queue_wait_idle(queue).unwrap();
                    first = Some(canvas.shown(&frame.borrow()));
                    submit(&self.gpu, |commands| self.overwrite(commands, &canvas));
                    let colors = canvas.shown(&frame.borrow()).colors;
                    assert!(colors.iter().all(|color| *color == AROUND));
                    device.queue_submit(queue, &submits, vk::Fence::null()).unwrap();
                }
            },
        );
        let frame = frame.into_inner();
        assert_eq!(frame.outcome().unwrap().left_over, 0);
        [first.unwrap(), canvas.shown(&frame)]
    }

    /// Buffers for the corners of triangles and for numbers of workgroups.
    fn kept(&self, lent: &Lent) -> (Buffer, Buffer) {
        let corners = self.read_back(48 * u64::from(lent.triangle_count));
        (corners, self.read_back(4 * CALLS))
    }

    fn canvas(&self, size: [u32; 2]) -> Canvas {
        let plain = vk::ImageAspectFlags::COLOR;
        Canvas {
            color: self.image(size, vk::Format::R32G32B32A32_SFLOAT, plain),
            read_back: self.read_back(16 * u64::from(size[0] * size[1])),
            size,
        }
    }

    /// Fills a canvas that was read with [`AROUND`], and reads it.
    fn overwrite(&self, commands: vk::CommandBuffer, canvas: &Canvas) {
        let image = canvas.color.handle();
        let color = vk::ClearColorValue { float32: AROUND };
        let range =
            vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1);
        let barrier = |before, after| {
            vk::ImageMemoryBarrier2::default()
                .image(image)
                .old_layout(before)
                .new_layout(after)
                .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
                .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
                .dst_access_mask(vk::AccessFlags2::MEMORY_WRITE | vk::AccessFlags2::MEMORY_READ)
                .subresource_range(range)
        };
        let cleared = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let before = [barrier(COPIED.layout, cleared)];
        let after = [barrier(cleared, COPIED.layout)];
        let device = self.gpu.device();
        // SAFETY: the commands are waited for; the image is in the layout named.
        unsafe {
            let info = vk::DependencyInfo::default().image_memory_barriers(&before);
            device.cmd_pipeline_barrier2(commands, &info);
            device.cmd_clear_color_image(commands, image, cleared, &color, &[range]);
            let info = vk::DependencyInfo::default().image_memory_barriers(&after);
            device.cmd_pipeline_barrier2(commands, &info);
        }
        self.read(commands, canvas);
    }

    fn read(&self, commands: vk::CommandBuffer, canvas: &Canvas) {
        let (color, read_back) = (canvas.color.handle(), canvas.read_back.handle());
        let region = [copy(canvas.size, vk::ImageAspectFlags::COLOR, 0)];
        let device = self.gpu.device();
        // SAFETY: the commands are waited for; the image is in the layout named.
        unsafe {
            device.cmd_copy_image_to_buffer(commands, color, COPIED.layout, read_back, &region);
            self.show_to_host(commands);
        }
    }

    /// Result of sampling a list of locations of the world.
    pub fn see_list(&self, way: &Way, locations: &[Location], options: Options) -> (Vec<[f32; 4]>, ListOutcome) {
        self.see_list_again(way, locations, options, 1).pop().unwrap()
    }

    /// Results of `times` recordings of one list.
    pub fn see_list_again(
        &self,
        way: &Way,
        locations: &[Location],
        options: Options,
        times: usize,
    ) -> Vec<(Vec<[f32; 4]>, ListOutcome)> {
        let lent = self.world.lent(way);
        let lending = Lending::new(self, way, &lent);
        let corners = self.read_back(48 * u64::from(lent.triangle_count));
        let colors = self.read_back(16 * locations.len() as u64);
        let listed = self.filled(bytemuck::cast_slice(locations));
        let list = LocationList {
            locations: listed.handle(),
            offset: 0,
            capacity: locations.len() as u32,
            colors: colors.handle(),
            colors_offset: 0,
        };
        let options = ListOptions::from(&options.background(Some(SKY)));
        let prepared = |geometry: &Geometry| {
            // SAFETY: lent objects have the stated contents, and outlive the list.
            unsafe { self.antialiaser.prepare_list(geometry, &list, &options) }.unwrap()
        };
        let mut list = prepared(&lending.geometry);
        let dispatched = self.read_back(4 * CALLS);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let count = locations.len() as u32;
        if self.discards {
            assert!(is_not_recorded(list.outcome().err()));
            discard(&self.gpu, |commands| {
                // SAFETY: the commands are never submitted.
                unsafe { list.record(commands, &lent.draws, count, &shading) }.unwrap();
            });
            assert!(is_not_done(list.outcome().err()));
            // SAFETY: lent objects outlive all lists.
            assert!(is_not_done(unsafe { list.grow() }.err()));
        }
        let mut see = || {
            submit(&self.gpu, |commands| {
                // SAFETY: the commands are waited for; all handles outlive them.
                unsafe {
                    list.record(commands, &lent.draws, count, &shading).unwrap();
                    self.show_to_host(commands);
                }
            });
            let seen = colors.read(locations.len()).unwrap().to_vec();
            (seen, list.outcome().unwrap())
        };
        (0..times).map(|_| see()).collect()
    }

    fn shading<'s>(
        &'s self,
        lending: &Lending<'_>,
        (corners, dispatched): (&Buffer, &'s Buffer),
        triangles: u32,
    ) -> Shading<'s> {
        Shading {
            dispatched,
            calls: Cell::new(0),
            skips: self.gpu.conditional_rendering().filter(|_| self.skips),
            device: self.gpu.device(),
            layout: self.layout,
            set: self.set([&lending.of_draws, &lending.paints, corners]),
            samples: self.pipelines[0],
            corners: self.pipelines[1],
            triangles,
            back: lending.back,
        }
    }

    /// Records a barrier that makes earlier writes visible to the host.
    unsafe fn show_to_host(&self, commands: vk::CommandBuffer) {
        let barriers = [vk::MemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::HOST)
            .dst_access_mask(vk::AccessFlags2::HOST_READ)];
        let info = vk::DependencyInfo::default().memory_barriers(&barriers);
        // SAFETY: the commands are being recorded.
        unsafe { self.gpu.device().cmd_pipeline_barrier2(commands, &info) };
    }

    /// An image with a map's levels, ready to be read.
    fn map_image(&self, map: &Map) -> Image {
        let format = vk::Format::R8G8B8A8_UNORM;
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: map.side, height: map.side, depth: 1 })
            .mip_levels(map.levels.len() as u32)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage);
        let aspect = vk::ImageAspectFlags::COLOR;
        let image = self.memory.image("alpha map", &info, aspect).unwrap();
        let bytes = self.filled(&map.levels.concat());
        submit(&self.gpu, |commands| {
            // SAFETY: the commands are waited for; image and buffer outlive them.
            let recorder = unsafe { Recorder::new(&self.gpu, commands, None) };
            recorder.transition(&image, vk::ImageLayout::UNDEFINED, WRITTEN.layout);
            let mut offset = 0;
            for (level, texels) in (0..).zip(&map.levels) {
                let side = (map.side >> level).max(1);
                let region = [vk::BufferImageCopy { buffer_offset: offset, ..copy([side; 2], aspect, level) }];
                offset += texels.len() as u64;
                // SAFETY: the buffer holds all levels.
                unsafe {
                    self.gpu.device().cmd_copy_buffer_to_image(
                        commands,
                        bytes.handle(),
                        image.handle(),
                        WRITTEN.layout,
                        &region,
                    );
                }
            }
            let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
            recorder.transition(&image, WRITTEN.layout, read);
        });
        image
    }

    /// Answers of a list about its outcome: while the device waits in the middle of its commands, and after they have
    /// run.
    pub fn asked_early(
        &self,
        way: &Way,
        locations: &[Location],
        options: &Options,
    ) -> [Result<ListOutcome, HostError>; 2] {
        let lent = self.world.lent(way);
        let lending = Lending::new(self, way, &lent);
        let corners = self.read_back(48 * u64::from(lent.triangle_count));
        let colors = self.read_back(16 * locations.len() as u64);
        let listed = self.filled(bytemuck::cast_slice(locations));
        let list = LocationList {
            locations: listed.handle(),
            offset: 0,
            capacity: locations.len() as u32,
            colors: colors.handle(),
            colors_offset: 0,
        };
        let device = self.gpu.device();
        // SAFETY: lent objects have the stated contents, and outlive the list.
        let (list, gate) = unsafe {
            (
                self.antialiaser.prepare_list(&lending.geometry, &list, &ListOptions::from(options)).unwrap(),
                device.create_event(&vk::EventCreateInfo::default(), None),
            )
        };
        let gate = gate.unwrap();
        let dispatched = self.read_back(4 * CALLS);
        let shading = self.shading(&lending, (&corners, &dispatched), lent.triangle_count);
        let gated = Gated { inner: &shading, gate };
        let list = RefCell::new(list);
        let mut early = None;
        submit_and(
            &self.gpu,
            |commands| {
                let count = locations.len() as u32;
                let mut list = list.borrow_mut();
                // SAFETY: the commands are waited for; all handles outlive them.
                unsafe { list.record(commands, &lent.draws, count, &gated) }.unwrap();
            },
            || {
                early = Some(list.borrow().outcome());
                // SAFETY: the event belongs to the device.
                unsafe { device.set_event(gate) }.unwrap();
            },
        );
        // SAFETY: the commands have run.
        unsafe { device.destroy_event(gate, None) };
        [early.unwrap(), list.borrow().outcome()]
    }

    /// Fills images, has them antialiased, and copies one of them to the host.
    fn run(
        &self,
        size: [u32; 2],
        frame: &mut Frame,
        (images, scenery): (&Images, &Scenery<'_>),
        shading: &Shading<'_>,
        pictures: &[(&Image, vk::ImageAspectFlags, Buffer)],
        (shown, read_back): (&Image, &Buffer),
    ) {
        let device = self.gpu.device();
        submit(&self.gpu, |commands| {
            // SAFETY: the commands are waited for; all handles outlive them.
            unsafe {
                for (image, aspect, bytes) in pictures {
                    let recorder = Recorder::new(&self.gpu, commands, None);
                    recorder.transition(image, vk::ImageLayout::UNDEFINED, WRITTEN.layout);
                    device.cmd_copy_buffer_to_image(
                        commands,
                        bytes.handle(),
                        image.handle(),
                        WRITTEN.layout,
                        &[copy(size, *aspect, 0)],
                    );
                }
                frame.record(commands, images, scenery, shading).unwrap();
                device.cmd_copy_image_to_buffer(
                    commands,
                    shown.handle(),
                    COPIED.layout,
                    read_back.handle(),
                    &[copy(size, vk::ImageAspectFlags::COLOR, 0)],
                );
                self.show_to_host(commands);
            }
        });
    }

    /// A descriptor set of the host with these buffers; the previous one is freed.
    fn set(&self, buffers: [&Buffer; 3]) -> vk::DescriptorSet {
        let device = self.gpu.device();
        let layouts = [self.set_layout];
        // SAFETY: the pool's sets are not in use; the buffers outlive the new set.
        unsafe {
            let flags = vk::DescriptorPoolResetFlags::empty();
            device.reset_descriptor_pool(self.descriptors, flags).unwrap();
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.descriptors).set_layouts(&layouts);
            let set = device.allocate_descriptor_sets(&info).unwrap()[0];
            let infos =
                buffers.map(|buffer| vk::DescriptorBufferInfo::default().buffer(buffer.handle()).range(vk::WHOLE_SIZE));
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .buffer_info(&infos);
            device.update_descriptor_sets(&[write], &[]);
            set
        }
    }

    fn filled(&self, bytes: &[u8]) -> Buffer {
        let usage = STORAGE | vk::BufferUsageFlags::TRANSFER_SRC;
        let size = bytes.len() as u64;
        let buffer = self.memory.buffer("lent", size, usage, MemoryUse::Upload);
        let mut buffer = buffer.unwrap();
        buffer.bytes_mut()[..bytes.len()].copy_from_slice(bytes);
        buffer
    }

    fn read_back(&self, bytes: u64) -> Buffer {
        let usage = STORAGE | vk::BufferUsageFlags::TRANSFER_DST;
        let buffer = self.memory.buffer("read back", bytes, usage, MemoryUse::Readback);
        buffer.unwrap()
    }

    fn image(&self, size: [u32; 2], format: vk::Format, aspect: vk::ImageAspectFlags) -> Image {
        let drawn = if aspect == vk::ImageAspectFlags::COLOR {
            vk::ImageUsageFlags::COLOR_ATTACHMENT
        } else {
            vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
        };
        self.image_for(size, format, aspect, drawn | vk::ImageUsageFlags::SAMPLED)
    }

    /// An image of colours, which shaders can read if it is `sampled`.
    fn color(&self, size: [u32; 2], sampled: bool) -> Image {
        let sampled = if sampled { vk::ImageUsageFlags::SAMPLED } else { vk::ImageUsageFlags::empty() };
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | sampled;
        self.image_for(size, vk::Format::R32G32B32A32_SFLOAT, vk::ImageAspectFlags::COLOR, usage)
    }

    /// An image that can be copied, for a usage besides.
    fn image_for(
        &self,
        size: [u32; 2],
        format: vk::Format,
        aspect: vk::ImageAspectFlags,
        usage: vk::ImageUsageFlags,
    ) -> Image {
        let copied = vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage | copied);
        self.memory.image("lent", &info, aspect).unwrap()
    }
}

impl Map {
    fn lent(&self, image: &Image) -> AlphaMap {
        AlphaMap {
            view: image.view(),
            size: [self.side; 2],
            levels: self.levels.len() as u32,
            mag_filter: self.mag_filter,
            min_filter: self.min_filter,
            mipmap_mode: self.mipmap_mode,
            address: self.address,
            cutoff: self.cutoff,
        }
    }
}

/// Copy of a whole level of an image, tightly packed.
fn copy(size: [u32; 2], aspect_mask: vk::ImageAspectFlags, mip_level: u32) -> vk::BufferImageCopy {
    vk::BufferImageCopy::default()
        .image_subresource(vk::ImageSubresourceLayers { aspect_mask, mip_level, base_array_layer: 0, layer_count: 1 })
        .image_extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
}

impl Drop for Machine<'_> {
    fn drop(&mut self) {
        let device = self.gpu.device();
        // SAFETY: all commands have run.
        unsafe {
            for pipeline in self.pipelines {
                device.destroy_pipeline(pipeline, None);
            }
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
            device.destroy_descriptor_pool(self.descriptors, None);
        }
    }
}
