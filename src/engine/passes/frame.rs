//! The uniform block `Frame` of `shaders/include/frame.glsl`.

/// The uniform block `Frame`; the shader's comments say what the fields are.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[allow(missing_docs)]
pub struct FrameUniform {
    pub transform: [f32; 16],
    pub eye: [f32; 4],
    pub view_direction: [f32; 4],
    pub irradiance: [[f32; 4]; 9],
    pub environment: [[f32; 4]; 3],
    pub background: [f32; 4],
    pub raster_scale: [f32; 2],
    pub raster_offset: [f32; 2],
    pub origin: [f32; 2],
    pub size: [u32; 2],
    pub tiles: [u32; 2],
    pub interior_low: [u32; 2],
    pub interior_high: [u32; 2],
    pub gap: [f32; 2],
    pub triangle_count: u32,
    pub first_mask: u32,
    pub first_blend: u32,
    pub sample_count: u32,
    pub survivor_capacity: u32,
    pub pair_capacity: u32,
    pub list_capacity: u32,
    pub record_capacity: u32,
    pub bin_count: u32,
    pub light_count: u32,
    pub material_vectors: u32,
    pub contrast: u32,
    pub alike: u32,
    pub exposure: f32,
    pub footprint: f32,
    pub place_footprint: f32,
    pub sample_footprint: f32,
    pub side: u32,
    pub reach: f32,
    pub group_count: u32,
    pub seen_corner: [u32; 2],
    pub color_corner: [u32; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Walks the block by std140's rules and compares each member's offset with the host struct's.
    #[test]
    fn the_uniform_block_is_the_shaders() {
        let text = include_str!("../../../shaders/include/frame.glsl");
        let block = text
            .split("uniform Frame {")
            .nth(1)
            .and_then(|rest| rest.split("} frame;").next())
            .unwrap();
        let mut offset = 0_usize;
        let mut offsets = Vec::new();
        for line in block.lines() {
            let code = line
                .split("//")
                .next()
                .unwrap()
                .trim()
                .trim_end_matches(';');
            let Some((kind, name)) = code.split_once(' ') else {
                continue;
            };
            let (size, align) = match kind {
                "mat4" => (64, 16),
                "vec4" => (16, 16),
                "vec2" | "uvec2" => (8, 8),
                "uint" | "float" => (4, 4),
                other => panic!("an unknown type {other}"),
            };
            let (name, count) = match name.split_once('[') {
                Some((name, count)) => (name, count.trim_end_matches(']').parse().unwrap()),
                None => (name, 1),
            };
            offset = offset.next_multiple_of(align);
            offsets.push((name.to_owned(), offset));
            offset += size * count;
        }
        macro_rules! host {
            ($($field:ident),*) => { [$((stringify!($field).to_owned(), std::mem::offset_of!(FrameUniform, $field))),*] };
        }
        let host = host!(
            transform,
            eye,
            view_direction,
            irradiance,
            environment,
            background,
            raster_scale,
            raster_offset,
            origin,
            size,
            tiles,
            interior_low,
            interior_high,
            gap,
            triangle_count,
            first_mask,
            first_blend,
            sample_count,
            survivor_capacity,
            pair_capacity,
            list_capacity,
            record_capacity,
            bin_count,
            light_count,
            material_vectors,
            contrast,
            alike,
            exposure,
            footprint,
            place_footprint,
            sample_footprint,
            side,
            reach,
            group_count,
            seen_corner,
            color_corner
        );
        assert_eq!(offsets, host);
        assert_eq!(offset, size_of::<FrameUniform>());
    }
}
