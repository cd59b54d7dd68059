//! Uniform block of the sampling passes, which all of their clients make here.

use super::SamplerSettings;
use super::footprint::Footprints;
use crate::engine::data::tiles::tiles;
use crate::engine::data::{FrameUniform, ResourceSizes};

/// Part of the uniform block about the scene: triangles, materials and viewpoint. Clients whose passes don't read it
/// use the default.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SceneBlock {
    /// Position of the eye in the coordinates of the geometry; the last component is 1.
    pub eye: [f32; 4],
    /// Unit vector of the view direction; the last component is 1 if all rays are parallel to it, otherwise 0.
    pub view_direction: [f32; 4],
    /// Spherical harmonics of the environment's irradiance.
    pub irradiance: [[f32; 4]; 9],
    /// The axes of the environment map.
    pub environment: [[f32; 4]; 3],
    /// Number of triangles, or of triangle slots.
    pub triangle_count: u32,
    /// Index of the first alpha-tested triangle.
    pub first_mask: u32,
    /// Index of the first BLEND triangle.
    pub first_blend: u32,
    /// Number of vectors of a material.
    pub material_vectors: u32,
    /// Number of shading keys.
    pub bin_count: u32,
    /// Number of lights.
    pub light_count: u32,
}

/// Part of the uniform block about the image plane: the rectangle whose pixels or locations are sampled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneBlock {
    /// Matrix, by columns, from positions to pixels of the plane.
    pub transform: [f32; 16],
    /// Upper left corner of the rectangle in pixels, relative to the origin of clip-space positions.
    pub corner: [f64; 2],
    /// Width and height of the rectangle in pixels.
    pub size: [u32; 2],
    /// Range of the pixels that may become cells: the first one, and the one after the last.
    pub interior: [[u32; 2]; 2],
    /// Depth difference of two surfaces that are a pixel's width apart along the line of sight: a factor on the depth,
    /// and a constant.
    pub gap: [f32; 2],
    /// Contrast threshold of detection in code values; 0 for a plane without detection.
    pub contrast: u32,
    /// Largest difference, in code values, of colours around a pixel for which a triangle is still shaded once.
    pub alike: u32,
    /// Number of pixels of the plane along a side of an output pixel.
    pub side: u32,
    /// Upper left pixel of the rectangle in a host's images of IDs and depth.
    pub seen_corner: [u32; 2],
    /// Upper left pixel of the rectangle in a host's colour image.
    pub color_corner: [u32; 2],
}

impl Default for PlaneBlock {
    fn default() -> Self {
        Self {
            transform: [0.0; 16],
            corner: [0.0; 2],
            size: [1; 2],
            interior: [[0; 2]; 2],
            gap: [0.0; 2],
            contrast: 0,
            alike: 0,
            side: 1,
            seen_corner: [0; 2],
            color_corner: [0; 2],
        }
    }
}

/// Makes the uniform block for cells of `samples` samples, in memory of these sizes.
pub(crate) fn frame_uniform(
    scene: &SceneBlock,
    plane: &PlaneBlock,
    settings: &SamplerSettings,
    samples: u32,
    footprints: &Footprints,
    sizes: &ResourceSizes,
) -> FrameUniform {
    let [width, height] = plane.size;
    let to_device = plane.size.map(|side| 2.0 / f64::from(side));
    FrameUniform {
        transform: plane.transform,
        eye: scene.eye,
        view_direction: scene.view_direction,
        irradiance: scene.irradiance,
        environment: scene.environment,
        background: settings.background_rgba(),
        raster_scale: to_device.map(|scale| scale as f32),
        raster_offset: [0, 1].map(|axis| (-plane.corner[axis] * to_device[axis] - 1.0) as f32),
        origin: plane.corner.map(|side| (side + 0.5) as f32),
        size: plane.size,
        tiles: tiles([width, height]),
        interior_low: plane.interior[0],
        interior_high: plane.interior[1],
        gap: plane.gap,
        triangle_count: scene.triangle_count,
        first_mask: scene.first_mask,
        first_blend: scene.first_blend,
        sample_count: samples,
        survivor_capacity: sizes.survivor_capacity,
        pair_capacity: sizes.pair_capacity,
        list_capacity: sizes.list_capacity,
        fragment_capacity: sizes.fragment_capacity,
        bin_count: scene.bin_count,
        light_count: scene.light_count,
        material_vectors: scene.material_vectors,
        contrast: plane.contrast,
        alike: plane.alike,
        exposure: settings.exposure.exp2(),
        footprint: footprints.centre,
        place_footprint: footprints.place,
        sample_footprint: footprints.sample,
        side: plane.side,
        // `distribute` computes the reach of a list's samples.
        reach: 0.5,
        group_count: sizes.locations.map_or(0, |locations| locations.groups),
        seen_corner: plane.seen_corner,
        color_corner: plane.color_corner,
    }
}
