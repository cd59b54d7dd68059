//! Mapping of clip space to the images.

use super::{ClipSpace, HostError};

/// Viewport of the host, as `VkViewport`, in pixels from the upper left corner of its images.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Left side of the viewport.
    pub x: f32,
    /// Upper side of the viewport; with a negative height, its lower side.
    pub y: f32,
    /// Width of the viewport.
    pub width: f32,
    /// Height of the viewport: negative if [`ClipSpace::y_up`] is true, otherwise positive.
    pub height: f32,
}

/// Mapping of clip space to pixels of a frame's part of the images.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipPlane {
    /// Factors from normalised device coordinates to pixels with y down; the factor of y is negative if y points up.
    pub scale: [f32; 2],
    /// Centre of clip space in pixels from the upper left corner of the part.
    pub middle: [f64; 2],
}

impl ClipPlane {
    /// Mapping of a clip space that spans a part of the given size.
    pub fn of_size(clip: &ClipSpace, size: [u32; 2]) -> Self {
        let middle = size.map(|side| 0.5 * f64::from(side));
        Self::with_middle(clip, middle, middle)
    }

    /// Mapping of a viewport, for a part of the images that begins at `corner`.
    ///
    /// # Errors
    /// If the viewport is no rectangle, or does not contain the part.
    pub fn of_viewport(
        clip: &ClipSpace,
        viewport: &Viewport,
        corner: [u32; 2],
        size: [u32; 2],
    ) -> Result<Self, HostError> {
        let &Viewport { x, y, width, height } = viewport;
        let is_finite = [x, y, width, height].iter().all(|n| n.is_finite());
        let height_fits = if clip.y_up { height < 0.0 } else { height > 0.0 };
        if !(is_finite && width > 0.0 && height_fits) {
            return Err(HostError::Viewport { x, y, width, height, y_up: clip.y_up });
        }
        let half = [width, height].map(|side| 0.5 * f64::from(side));
        let middle = [f64::from(x) + half[0], f64::from(y) + half[1]];
        let half = half.map(f64::abs);
        let part = [0, 1, 2, 3].map(|side| {
            let axis = side % 2;
            let end = if side < 2 { 0 } else { size[axis] };
            u64::from(corner[axis]) + u64::from(end)
        });
        let sides = [middle[0] - half[0], middle[1] - half[1], middle[0] + half[0], middle[1] + half[1]];
        let beyond = |side: usize| {
            let at = part[side] as f64;
            if side < 2 { at < sides[side] } else { at > sides[side] }
        };
        if (0..4).any(beyond) {
            return Err(HostError::ViewportPart { viewport: sides, part });
        }
        let in_part = [0, 1].map(|axis| middle[axis] - f64::from(corner[axis]));
        Ok(Self::with_middle(clip, half, in_part))
    }

    fn with_middle(clip: &ClipSpace, half: [f64; 2], middle: [f64; 2]) -> Self {
        let [x, y] = half.map(|side| side as f32);
        Self { scale: [x, if clip.y_up { -y } else { y }], middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: ClipSpace = ClipSpace { y_up: true, reversed_depth: false, depth_range: [0.0, 1.0] };

    fn viewport(x: f32, y: f32, width: f32, height: f32) -> Viewport {
        Viewport { x, y, width, height }
    }

    #[test]
    fn a_viewport_of_the_part_is_none() {
        let size = [64, 48];
        for (clip, viewport) in
            [(ClipSpace::default(), viewport(10.0, 20.0, 64.0, 48.0)), (UP, viewport(10.0, 68.0, 64.0, -48.0))]
        {
            let plane = ClipPlane::of_viewport(&clip, &viewport, [10, 20], size).unwrap();
            assert_eq!(plane, ClipPlane::of_size(&clip, size));
        }
    }

    #[test]
    fn viewports_lie_anywhere_around_the_part() {
        let wide = viewport(-6.5, 0.0, 100.0, 30.5);
        let plane = ClipPlane::of_viewport(&ClipSpace::default(), &wide, [4, 1], [20, 20]);
        let plane = plane.unwrap();
        assert_eq!((plane.scale, plane.middle), ([50.0, 15.25], [39.5, 14.25]));
    }

    #[test]
    fn viewports_that_do_not_fit_are_named() {
        let refused = |clip, viewport| {
            let plane = ClipPlane::of_viewport(&clip, &viewport, [2, 0], [20, 20]);
            plane.unwrap_err().to_string()
        };
        assert_eq!(
            refused(ClipSpace::default(), viewport(2.5, 0.0, 40.0, 40.0)),
            "Scenery::viewport holds the pixels from (2.5, 0) to (42.5, 40), and the frame is of those from (2, 0) to (22, 20): a frame's part of the images has to lie in the viewport; make Options::size smaller, or begin it elsewhere by Images::corner"
        );
        assert_eq!(
            refused(UP, viewport(0.0, 0.0, 40.0, 40.0)),
            "Scenery::viewport is 40 x 40 pixels at (0, 0); it needs finite numbers, a positive width, and a height that is negative as ClipSpace::y_up is true"
        );
        let broken = viewport(f32::NAN, 0.0, 40.0, 40.0);
        assert!(refused(ClipSpace::default(), broken).starts_with("Scenery::viewport is 40 x 40 pixels"));
    }
}
