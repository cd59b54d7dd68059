//! stroke: computes points and lines for a camera. It is no [`Pass`](crate::engine::pipelines::Pass), because its push constants
//! depend on the camera.

use crate::engine::pipelines::{FrameLayout, Kernel};
use crate::engine::spirv;
use crate::render::SceneSettings;
use crate::render::data::{FrameGeometry, GpuScene};
use crate::scene::Edge;
use crate::vulkan::{Recorder, VulkanError};
use glam::{DMat4, DVec3, Vec4Swizzles};

/// Distance, in output pixels, by which edges are moved from their surfaces towards the camera: enough for the search
/// for triangles thinner than a pixel.
const EDGE_OFFSET: f32 = 2.0;

/// Gives points and lines their size on the screen.
pub struct StrokePass {
    kernel: Kernel<spirv::Stroke>,
}

/// Sizes of points and lines in output pixels.
#[derive(Clone, Copy, Debug)]
pub struct StrokeSizes {
    /// Width of lines.
    pub line_width: f32,
    /// Diameter of points.
    pub point_size: f32,
    /// Width of the edges of meshes.
    pub edge_width: f32,
    /// Number of rendered pixels along the side of an output pixel.
    pub side: u32,
}

impl StrokeSizes {
    /// Sizes of a scene's points and lines, in an image with `side` x `side` rendered pixels for each output pixel.
    pub(in crate::render) fn new(scene: &SceneSettings, side: u32) -> Self {
        Self { line_width: scene.line_width, point_size: scene.point_size, edge_width: scene.edge_width, side }
    }
}

impl StrokePass {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// If the driver refuses it.
    pub fn new(layout: &FrameLayout) -> Result<Self, VulkanError> {
        Ok(Self { kernel: layout.kernel(&spirv::Stroke)? })
    }

    /// Records the pass for a camera; `to_clip` is the matrix from the scene's coordinates to pixel-scaled clip space.
    pub fn record(
        &self,
        recorder: &Recorder<'_>,
        scene: &GpuScene,
        geometry: &FrameGeometry,
        to_clip: &DMat4,
        sizes: StrokeSizes,
    ) {
        let (Some(strokes), Some(_)) = (&scene.geometry.strokes, &geometry.moving) else {
            return;
        };
        let [right, down] = pixel_steps(to_clip);
        let side = sizes.side as f32;
        let half = |size: f32| 0.5 * side * size;
        let vector = |step: DVec3, size: f32| {
            let [x, y, z] = step.as_vec3().to_array();
            [x, y, z, half(size)]
        };
        let push = spirv::StrokePush {
            right: vector(right, sizes.line_width),
            down: vector(down, sizes.point_size),
            corners: strokes.corner_count,
            half_edge: half(sizes.edge_width),
            apart: EDGE_OFFSET * side,
            edges: strokes.edge_count,
        };
        let corners = u64::from(strokes.corner_count) + u64::from(Edge::CORNERS) * u64::from(strokes.edge_count);
        self.kernel.record(recorder, &push, corners);
    }
}

/// Vectors that lead one pixel to the right and one pixel down in the image, in the plane parallel to the image where
/// w is 1.
fn pixel_steps(to_clip: &DMat4) -> [DVec3; 2] {
    let rows = to_clip.transpose();
    let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis].map(|row| row.xyz());
    // Planes parallel to the image have a constant w, or for parallel rays a constant depth.
    let across = if w == DVec3::ZERO { z } else { w };
    let (right, down) = (y.cross(across), across.cross(x));
    [right / right.dot(x), down / down.dot(y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, Projection};
    use glam::DVec2;

    #[test]
    fn steps_are_pixels_at_any_distance() {
        let mut camera = Camera::look_at(DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO, DVec3::Y, 50.0, 0.1).unwrap();
        let origin = DVec3::new(1.0, -2.0, 0.5);
        for orthographic in [false, true] {
            if orthographic {
                camera.projection = Projection::Orthographic { half_height: 2.0, near: 0.5, far: 10.0 };
            }
            camera.shift = DVec2::new(0.1, -0.2);
            let to_clip = camera.pixel_matrix(origin, 300.0, 200.0);
            let steps = pixel_steps(&to_clip);
            for p in [DVec3::new(0.3, 0.2, 0.1), DVec3::new(-2.0, 1.0, -3.0)] {
                let project = |p: DVec3| to_clip * p.extend(1.0);
                let clip = project(p);
                for (step, expected) in steps.into_iter().zip([DVec2::X, DVec2::Y]) {
                    let moved = project(p + step * clip.w);
                    let apart = moved.xy() / moved.w - clip.xy() / clip.w;
                    assert!((apart - expected).length() < 1e-9, "{apart}");
                    assert!((moved.zw() - clip.zw()).length() < 1e-9);
                }
            }
        }
    }
}
