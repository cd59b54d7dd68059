//! Plan of an image: its regions, each within the device's limits and the allowed memory.

use super::capacity::Capacity;
use super::{CellOptions, EngineError, ImageRequest, Method, RoundPolicy, Shading};
use crate::engine::data::tiles::tile_count;
use crate::engine::data::{Content, ResourceSizes};
use crate::engine::spirv::{ENCODE_THRESHOLD_WORDS, FILTER_TRIANGLES};
use crate::sampling::Pattern;
use crate::vulkan::Limits;

/// Part of an image, in output pixels. If only a part of the image is wanted, the region is still placed and drawn as
/// for the whole image, because devices round vertices to a fraction of a pixel after the viewport transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Region {
    /// Upper left pixel of the region in the whole image.
    low: [u32; 2],
    /// Lower right pixel of the region in the whole image, exclusive.
    high: [u32; 2],
    /// Upper left pixel that is wanted.
    pub wanted_low: [u32; 2],
    /// Lower right pixel that is wanted, exclusive.
    wanted_high: [u32; 2],
    /// Width of the border around the region with which detection compares: left, top, right, bottom, in pixels.
    /// Detection needs [`NEIGHBOURS`] pixels, each growth one more, and a pixel filter as many more as it reaches. On the
    /// left and at the top, the border is made of whole tiles, so that tiles and the rounding of edge functions are the same as in the
    /// undivided image.
    halo: [u32; 4],
    /// Distance in pixels within which pixels affect the wanted ones.
    depends: u32,
}

impl Region {
    /// Restricts the wanted pixels to those from `low` to before `high` in the image; returns false if none are left.
    fn keep(&mut self, low: [u32; 2], high: [u32; 2]) -> bool {
        self.wanted_low = [0, 1].map(|axis| self.low[axis].max(low[axis]));
        self.wanted_high = [0, 1].map(|axis| self.high[axis].min(high[axis]));
        (0..2).all(|axis| self.wanted_low[axis] < self.wanted_high[axis])
    }

    /// Width and height of the wanted pixels.
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.wanted_high[axis] - self.wanted_low[axis])
    }

    /// Width and height in memory: those of the region with its border.
    pub fn outer(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis] + self.halo[axis] + self.halo[axis + 2])
    }

    /// Pixel of the image at the upper left in memory.
    pub fn corner(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.low[axis] - self.halo[axis])
    }

    /// Position in memory of the upper left wanted pixel.
    pub fn first_wanted(&self) -> [u32; 2] {
        let corner = self.corner();
        [0, 1].map(|axis| self.wanted_low[axis] - corner[axis])
    }

    /// Range of positions in memory that have to be drawn, the end exclusive: the wanted pixels, and the neighbours
    /// with which detection compares them.
    pub fn drawn(&self) -> [[u32; 2]; 2] {
        let (first, size, outer) = (self.first_wanted(), self.size(), self.outer());
        [
            first.map(|place| place.saturating_sub(self.depends)),
            [0, 1].map(|axis| (first[axis] + size[axis] + self.depends).min(outer[axis])),
        ]
    }
}

/// Regions of an image, and the memory that the largest of them needs.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub regions: Vec<Region>,
    pub sizes: ResourceSizes,
    /// Whether the device's limits allow longer lists.
    pub lists_can_grow: bool,
}

/// Distance in pixels within which pixels decide whether one is a superpixel before the first growth. In each growth, a
/// pixel becomes one because of its neighbours, so that it depends on pixels one farther away.
const NEIGHBOURS: u32 = 2;
/// Largest number of rendered pixels in a region. A larger image has several regions, each of them a separate
/// submission if the renderer has its own device.
const REGION_PIXELS: u64 = 4 << 20;
/// Number of pixels below which a region is not divided to make it faster.
const SMALL_REGION_PIXELS: u64 = 1 << 12;
/// Number of point samples that take as long as the lines of a superpixel.
const LINES_AS_POINTS: u32 = 64;
/// Factor for the cost of a sample with shadows: the sample is projected once for each light, on up to six planes.
const SHADOWED: u64 = 8;
/// Largest number of visibility samples and of candidates in a round.
pub(crate) const MOST_FRAGMENTS: u64 = 6 << 20;
pub(crate) const MOST_CANDIDATES: u64 = 2 << 20;
/// Limit for the visibility samples of a round, for each 64 samples of a superpixel. Room above this limit is reduced
/// to a third, which makes more rounds; these cost little.
const LARGE_FRAGMENTS: u64 = 1 << 20;
/// Largest number of pairs of a triangle and a tile, over all rounds, for which a frame is first planned.
pub(crate) const MOST_PAIRS: u64 = 8 << 20;
/// Largest number of pairs for each tile if the scene has instances. Instanced scenes have many triangles, so this
/// limit makes memory depend on the image instead of the scene. Fewer candidates in a round make more rounds, which
/// cost little.
const TILE_PAIRS: u64 = 160;
const TILE_CANDIDATES: u64 = 10;
/// Smallest number of candidates. Their memory also holds the samples of a tile without a list.
const FEWEST_CANDIDATES: u32 = 32 * 1024 / ResourceSizes::CANDIDATE_TEXELS as u32;

/// Largest number of visibility samples in the buffers of a device.
pub(crate) fn most_fragments(limits: &Limits) -> u64 {
    (limits.max_storage_bytes / 16).min(limits.max_texel_elements)
}

/// Average number of visibility samples for which a superpixel has room.
pub(crate) fn fragments_of_superpixel(options: &CellOptions, scene: &dyn Content) -> u64 {
    let samples = u64::from(options.samples);
    let usual = if options.shading == Shading::Sample || scene.has_blend() {
        samples.min(64)
    } else {
        6 * samples.div_ceil(64)
    };
    usual.min(samples).max(2)
}

impl Plan {
    /// Plans an image. Its pixels take `encoded_bytes` bytes each in the buffer of encoded pixels (0 without one), and
    /// its places have `shadow_words` shadow words. Others use `taken` bytes of the
    /// memory that the request allows.
    ///
    /// # Errors
    /// [`EngineError::Memory`] if not even a region of 8 x 8 pixels fits.
    pub fn new(
        image: &ImageRequest<'_>,
        scene: &dyn Content,
        limits: &Limits,
        encoded_bytes: u64,
        shadow_words: u32,
        capacity: Capacity,
        taken: u64,
    ) -> Result<Self, EngineError> {
        let side = image.method.side();
        let [width, height] = image.size;
        let samples_a_pixel = match image.method {
            // A line of 64 samples takes as long as a few points.
            Method::Superpixel(options) if options.cells.pattern == Pattern::Lines => {
                u64::from(options.cells.samples.min(LINES_AS_POINTS))
            }
            Method::Superpixel(_) | Method::Msaa { .. } => u64::from(image.method.samples()),
            Method::None | Method::Ssaa { .. } | Method::Accumulate { .. } => 1,
        };
        let lights = if shadow_words > 0 { SHADOWED } else { 1 };
        let most =
            REGION_PIXELS.min(limits.max_submitted_samples / (samples_a_pixel * lights)).max(SMALL_REGION_PIXELS);
        let longest = limits.max_image_side.min(65_535) / side - 11;
        let mut region = [width.min(longest), height.min(longest)];
        let allowed = image.max_memory;
        loop {
            let mut plan = Self::with_region(image, scene, limits, encoded_bytes, capacity, region)?;
            plan.sizes.shadow_words = shadow_words;
            let pixels = u64::from(plan.sizes.pixels());
            let needed = plan.shrink(scene, image, allowed, taken);
            let fits = pixels <= most && plan.sizes.check(limits).is_ok();
            if fits && allowed.is_none_or(|allowed| needed <= allowed) {
                return Ok(plan);
            }
            let longer = usize::from(region[1] > region[0]);
            if region[longer] <= 8 {
                return Err(EngineError::Memory { needed, allowed: allowed.unwrap_or(0) });
            }
            // Sides are whole numbers of tiles, so that the regions have the same tiles as the undivided image.
            region[longer] = region[longer].div_ceil(2).next_multiple_of(8);
        }
    }

    /// Plans an image in one region, whatever its size. Without a limit for memory, the policy's usual one decides how large
    /// rounds are.
    ///
    /// # Errors
    /// [`EngineError::Memory`] if the plan exceeds the allowed memory or the device's buffer sizes.
    pub fn whole(
        image: &ImageRequest<'_>,
        scene: &dyn Content,
        limits: &Limits,
        capacity: Capacity,
        taken: u64,
    ) -> Result<Self, EngineError> {
        let mut plan = Self::with_region(image, scene, limits, 0, capacity, image.size)?;
        // No triangle is left out, because the image may be on the screen before anyone asks.
        plan.sizes.survivor_capacity = scene.triangle_slots();
        let usual = || Some(RoundPolicy::of(limits).usual_memory(capacity)? + taken);
        let wanted = image.max_memory.or_else(usual);
        let needed = plan.shrink(scene, image, wanted, taken);
        plan.sizes.check(limits)?;
        match image.max_memory {
            Some(allowed) if needed > allowed => Err(EngineError::Memory { needed, allowed }),
            _ => Ok(plan),
        }
    }

    /// Reduces the room for visibility samples, which makes more rounds, until the plan and all other users fit into
    /// `wanted` bytes, if possible. Returns the number of bytes.
    fn shrink(&mut self, scene: &dyn Content, image: &ImageRequest<'_>, wanted: Option<u64>, taken: u64) -> u64 {
        let all = |plan: &Self| plan.bytes(scene, image) + taken;
        let mut needed = all(self);
        // Smaller rounds cost less than more regions.
        while wanted.is_some_and(|wanted| needed > wanted) && self.sizes.fragment_capacity > 1 << 16 {
            self.sizes.fragment_capacity /= 2;
            self.sizes.list_capacity = (self.sizes.list_capacity / 2).max(FEWEST_CANDIDATES);
            needed = all(self);
        }
        needed
    }

    fn with_region(
        image: &ImageRequest<'_>,
        scene: &dyn Content,
        limits: &Limits,
        encoded_bytes: u64,
        capacity: Capacity,
        region: [u32; 2],
    ) -> Result<Self, EngineError> {
        let [width, height] = image.size;
        let side = image.method.side();
        let (detects, growths) = match &image.method {
            Method::Superpixel(options) => (true, options.growth_count()),
            _ => (false, 0),
        };
        // Frames that are accumulated are filtered together, later.
        let filtered_alone = !matches!(image.method, Method::Accumulate { .. });
        let filters_pixels = filtered_alone && !image.filter.is_box();
        let depends = NEIGHBOURS + growths + if filters_pixels { image.filter.reach() } else { 0 };
        let mut regions = Vec::new();
        for y in (0..height).step_by(region[1] as usize) {
            for x in (0..width).step_by(region[0] as usize) {
                let high = [(x + region[0]).min(width), (y + region[1]).min(height)];
                let halo = |inside: bool, pixels: u32| u32::from((detects || filters_pixels) && inside) * pixels;
                regions.push(Region {
                    low: [x, y],
                    high,
                    wanted_low: [x, y],
                    wanted_high: high,
                    halo: [
                        halo(x > 0, depends.next_multiple_of(8)),
                        halo(y > 0, depends.next_multiple_of(4)),
                        halo(high[0] < width, depends),
                        halo(high[1] < height, depends),
                    ],
                    depends,
                });
            }
        }
        let outer = regions.iter().fold([0, 0], |most, r| {
            let [w, h] = r.outer();
            [most[0].max(w * side), most[1].max(h * side)]
        });
        if let Some(wanted) = image.region {
            let end = wanted.end(image.size)?;
            regions.retain_mut(|region| region.keep(wanted.corner, end));
        }
        let pixels = u64::from(outer[0]) * u64::from(outer[1]);
        let tiles = tile_count(outer);
        let samples = u64::from(image.method.samples_a_frame());
        let policy = RoundPolicy::of(limits);
        let fragments = match image.method {
            Method::Superpixel(options) => {
                let most = policy.most_fragments(limits);
                (pixels * fragments_of_superpixel(&options.cells, scene)).clamp(1 << 16, most)
            }
            Method::Msaa { .. } => tiles * 32 * samples * if scene.has_blend() { 2 } else { 1 },
            _ if scene.has_blend() => pixels * 3,
            Method::None | Method::Ssaa { .. } | Method::Accumulate { .. } => 0,
        };
        let large = LARGE_FRAGMENTS * samples.div_ceil(64);
        let fragments = if detects && fragments > large && policy == RoundPolicy::Small {
            (fragments / 3).max(large)
        } else {
            fragments
        };
        // A tile has room for all layers of its samples.
        let of_tile = capacity.layered(pixels.min(32) * samples);
        let fragments = fragments.max(of_tile.min(most_fragments(limits)));
        let spreads = detects && filters_pixels;
        let fragments = if spreads { fragments.min(most_fragments(limits) / 2) } else { fragments };
        let samples_cells = detects || scene.has_blend();
        let at_most = |room: u64, most: u64| {
            let room = if samples_cells { room } else { 0 };
            (room * u64::from(capacity.lists)).min(most) as u32
        };
        let most_listed = ResourceSizes::most_pairs(limits);
        let triangles = u64::from(scene.triangle_slots());
        let (most_pairs, most_candidates) = if scene.is_instanced() && policy == RoundPolicy::Small {
            (tiles * TILE_PAIRS, tiles * TILE_CANDIDATES)
        } else {
            (MOST_PAIRS, MOST_CANDIDATES)
        };
        let room = |wanted: u64, most: u64| wanted.min(most).max(1 << 14);
        let pairs = room(triangles * 4 + tiles * 16, most_pairs);
        let candidates = room(triangles * 3 + tiles * 8, most_candidates);
        let filtered = if side > 1 || filters_pixels { pixels / u64::from(side * side) } else { 0 };
        let lists_triangles = limits.is_cpu()
            && !matches!(image.method, Method::Msaa { .. })
            && scene.triangle_slots() >= FILTER_TRIANGLES
            && triangles * 12 <= limits.max_storage_bytes;
        let sizes = ResourceSizes {
            // A surviving triangle has at least one pair.
            survivor_capacity: at_most(pairs, limits.max_storage_bytes / 4).min(scene.triangle_slots()),
            filtered_triangles: if lists_triangles { scene.triangle_slots() } else { 0 },
            pair_capacity: at_most(pairs, most_listed),
            list_capacity: at_most(candidates, ResourceSizes::most_candidates(limits)),
            fragment_capacity: fragments as u32,
            filtered: filtered as u32,
            spreads,
            filter_weights: if filters_pixels && side > 1 { image.filter.span() * side } else { 0 },
            attributes: image.attributes,
            encoded: match encoded_bytes {
                0 => 0,
                bytes => {
                    let pixels = (pixels / u64::from(side * side)).next_multiple_of(64);
                    u64::from(ENCODE_THRESHOLD_WORDS) * 4 + bytes * pixels
                }
            },
            ..ResourceSizes::new(outer, scene.bin_count(), limits)
        };
        Ok(Self { regions, sizes, lists_can_grow: u64::from(sizes.pair_capacity) < most_listed })
    }

    fn bytes(&self, scene: &dyn Content, image: &ImageRequest<'_>) -> u64 {
        let samples = match image.method {
            Method::Msaa { samples } => u64::from(*samples),
            _ => 1,
        };
        let images = u64::from(self.sizes.pixels()) * samples * if scene.has_blend() { 12 } else { 8 };
        self.sizes.planned_bytes() + images
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::sampler::SuperpixelOptions;
    use crate::sampling::PixelFilter;
    use crate::vulkan::Teams;
    use ash::vk;

    /// A million triangles.
    struct Triangles;

    impl Content for Triangles {
        fn triangle_slots(&self) -> u32 {
            1_000_000
        }

        fn is_instanced(&self) -> bool {
            false
        }

        fn has_mask(&self) -> bool {
            false
        }

        fn has_blend(&self) -> bool {
            false
        }

        fn has_high_frequency(&self) -> bool {
            true
        }

        fn is_tinted(&self) -> bool {
            false
        }

        fn bin_count(&self) -> u32 {
            2
        }
    }

    /// Limits of a GPU with `local_bytes` bytes of its own.
    fn gpu(local_bytes: u64) -> Limits {
        Limits {
            device_name: String::new(),
            driver: String::new(),
            device_type: vk::PhysicalDeviceType::DISCRETE_GPU,
            local_bytes,
            teams: Teams::new(32, [32; 2], true),
            max_image_side: 1 << 15,
            snap: 0.0,
            max_texel_elements: 1 << 27,
            buffer_alignment: 16,
            max_storage_bytes: u64::from(u32::MAX),
            timestamp_period: 1.0,
            max_submitted_samples: 1 << 27,
            sample_counts: vk::SampleCountFlags::TYPE_1,
            conditional_rendering: true,
            max_unused_pipelines: 64,
        }
    }

    /// A host's frame takes at most 960 MiB on a GPU of any size if the host names no bound, and as much as one that it names.
    #[test]
    fn a_hosts_frame_has_a_usual_bound_on_gpus() {
        for size in [[640, 360], [1920, 1080], [3840, 2160]] {
            for samples in [64, 256, 1024] {
                let method = Method::from(SuperpixelOptions::new(samples));
                let taken = |local: u64, max_memory| {
                    let filter = PixelFilter::BOX;
                    let image =
                        ImageRequest { size, region: None, method: &method, filter, attributes: false, max_memory };
                    let limits = gpu(local << 30);
                    let plan = Plan::whole(&image, &Triangles, &limits, Capacity::default(), 0);
                    let plan = plan.unwrap();
                    (plan.bytes(&Triangles, &image), plan.sizes.fragment_capacity)
                };
                for local in [2, 8, 24, 141] {
                    let (bytes, fragments) = taken(local, None);
                    assert!(bytes <= 960 << 20, "{size:?}, {samples}, {local}: {bytes}");
                    assert!(fragments >= 1 << 20, "{size:?}, {samples}, {local}: {fragments}");
                }
                let (bytes, fragments) = taken(141, Some(4 << 30));
                assert!(bytes <= 4 << 30, "{bytes}");
                assert!(fragments >= taken(141, None).1, "{fragments}");
                if size[0] > 1920 {
                    assert!(bytes > 1 << 30, "{bytes}");
                }
            }
        }
    }
}
