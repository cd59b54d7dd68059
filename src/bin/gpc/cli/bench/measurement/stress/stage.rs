//! Stages: scenes of a few triangles in front of a camera whose transform a CPU can repeat to the bit.
//!
//! The camera stands at the origin, looks along -z with a vertical field of view of 90 degrees, and has its far plane
//! at infinity. Each row of its matrix then has a single entry, so that a clip-space coordinate is one product (or the
//! constant [`NEAR`]), with the same rounding however a device orders or contracts the sum.

use super::meshes::Mesh;
use glam::{DMat3, DVec2, DVec3, Vec3};
use gpc::camera::{Camera, Projection};
use gpc::render::{
    Detection, Headless, Method, Reference, RenderError, Rendered, SceneRequest, Settings, Shading, SuperpixelOptions,
};
use gpc::sampling::Pattern;
use gpc::scene::{
    AlphaMode, DrawClass, DrawRange, Image, Material, Pose, PosedGeometry, Sampler, Scene, Texture, VertexStreams,
};

/// Distance of the near plane, and the clip-space z of every vertex.
pub const NEAR: f64 = 0.01;

/// Camera of all stages.
pub fn camera() -> Camera {
    Camera {
        eye: DVec3::ZERO,
        axes: DMat3::IDENTITY,
        projection: Projection::Perspective { fov: std::f64::consts::FRAC_PI_2, near: NEAR, far: None },
        shift: DVec2::ZERO,
    }
}

/// Position that the camera sees at `distance` along the direction of view. `[x, y]` is the place in pixels from the
/// image's centre, y down; the image is `height` pixels high.
pub fn seen_at([x, y]: [f64; 2], distance: f64, height: u32) -> [f32; 3] {
    let scale = distance * 2.0 / f64::from(height);
    [x * scale, -y * scale, -distance].map(|v| v as f32)
}

/// Triangle with vertices of its own.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// Index of its material.
    pub material: usize,
    /// Positions of its vertices.
    pub corners: [[f32; 3]; 3],
    /// Linear colour of its vertices.
    pub color: [f32; 4],
    /// Texture coordinates of its vertices.
    pub uvs: [[f32; 2]; 3],
}

/// Stage that is being built. Triangle `i` has the ID `i + 1`.
#[derive(Clone, Debug, Default)]
pub struct Stage {
    /// Materials of the stage.
    pub materials: Vec<Material>,
    /// Triangles of the stage: those of opaque materials first, then MASK, then BLEND.
    pub triangles: Vec<Triangle>,
    /// Texture 0 of the scene.
    pub texture: Option<(Image, Sampler)>,
}

/// Unlit material that is visible from both sides.
pub fn flat(base_color: [f32; 4], alpha_mode: AlphaMode) -> Material {
    Material { base_color, alpha_mode, unlit: true, double_sided: true, ..Material::default() }
}

impl Stage {
    /// Makes a stage with these materials and without triangles.
    pub fn new(materials: Vec<Material>) -> Self {
        Self { materials, ..Self::default() }
    }

    /// Adds a white triangle.
    pub fn add(&mut self, material: usize, corners: [[f32; 3]; 3]) {
        self.triangles.push(Triangle { material, corners, color: [1.0; 4], uvs: [[0.0; 2]; 3] });
    }

    /// Adds the two triangles of a quadrilateral, whose corners are given in order around it.
    pub fn add_quad(&mut self, material: usize, [a, b, c, d]: [[f32; 3]; 4]) {
        self.add(material, [a, b, c]);
        self.add(material, [a, c, d]);
    }

    /// Adds a mesh as seen in an image `height` pixels high. `permutation` gives the order of each triangle's corners,
    /// as in [`Mesh::corners`].
    pub fn add_mesh(&mut self, material: usize, mesh: &Mesh, height: u32, permutation: impl Fn(usize) -> usize) {
        let half = height as f32 / 2.0;
        for triangle in 0..mesh.triangles.len() {
            let corners = mesh.corners(triangle, permutation(triangle));
            self.add(material, corners.map(|[x, y, _, w]| [x / half, -y / half, -w]));
        }
    }

    /// Makes the scene and the pose for the renderer.
    pub fn build(&self) -> (Scene, Pose) {
        let mut scene = Scene::from_materials(self.materials.clone());
        if let Some((image, sampler)) = &self.texture {
            scene.images = vec![image.clone()];
            scene.textures = vec![Texture { image: 0, sampler: *sampler }];
        }
        let mut draws: Vec<DrawRange> = Vec::new();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let (material, class) = (triangle.material as u32, DrawClass::of(&self.materials[triangle.material]));
            match draws.last_mut() {
                Some(draw) if draw.material == material && draw.class == class => {
                    draw.triangle_count += 1;
                }
                _ => draws.push(DrawRange { first_triangle: index as u32, triangle_count: 1, material, class }),
            }
        }
        debug_assert!(draws.is_sorted_by_key(|draw| draw.class), "order of classes");
        let each = |value: &dyn Fn(&Triangle, usize) -> [f32; 4]| -> Vec<[f32; 4]> {
            let corners = |t| (0..3).map(move |corner| (t, corner));
            let all = self.triangles.iter().flat_map(corners);
            all.map(|(t, corner)| value(t, corner)).collect()
        };
        let white = self.triangles.iter().all(|t| t.color == [1.0; 4]);
        let geometry = PosedGeometry {
            positions: self.triangles.iter().flat_map(|t| t.corners).collect(),
            streams: VertexStreams {
                normals: self.triangles.iter().flat_map(|t| [normal(t); 3]).collect(),
                uvs: match self.texture {
                    Some(_) => each(&|t, corner| [t.uvs[corner][0], t.uvs[corner][1], 0.0, 0.0]),
                    None => Vec::new(),
                },
                // Without colours the renderer uses white, which is exactly 1.
                colors: if white { Vec::new() } else { each(&|t, _| t.color) },
                ..VertexStreams::default()
            },
            triangles: (0..self.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
            draws,
            ..PosedGeometry::default()
        };
        let pose = Pose { geometry, ..Pose::default() };
        (scene, pose)
    }

    /// Renders the stage with [`camera`].
    ///
    /// # Errors
    /// As [`Headless::upload`], [`Headless::prepare`] and [`Headless::render`].
    pub fn render(&self, headless: &mut Headless, settings: &Settings) -> Result<Rendered, RenderError> {
        self.seen_by(headless, settings, &camera())
    }

    /// Renders the stage with another camera.
    ///
    /// # Errors
    /// As [`render`](Self::render).
    pub fn seen_by(
        &self,
        headless: &mut Headless,
        settings: &Settings,
        camera: &Camera,
    ) -> Result<Rendered, RenderError> {
        let (scene, pose) = self.build();
        let prepared = headless.upload(SceneRequest::new(&scene, &pose).within(settings.scene.max_memory))?;
        let mut frame = headless.prepare(&prepared, settings)?;
        headless.render(&mut frame, camera)
    }
}

/// Unit normal of a triangle's front face; a triangle without an area gets one towards the camera.
fn normal(triangle: &Triangle) -> [f32; 3] {
    let [a, b, c] = triangle.corners.map(Vec3::from_array);
    (b - a).cross(c - a).normalize_or(Vec3::Z).to_array()
}

/// Settings that sample every pixel `samples` times; its colour is the mean of the samples' radiance.
pub fn everywhere(size: [u32; 2], pattern: Pattern, samples: u32) -> Settings {
    Settings::new(size[0], size[1])
        .reference(Reference::Scene { tonemapped_detection: false })
        .method(SuperpixelOptions::new(samples).pattern(pattern).shading(Shading::Triangle).detection(Detection::Every))
}

/// Settings for one sample at each pixel's centre, with attributes and without tone mapping.
pub fn once(size: [u32; 2]) -> Settings {
    Settings::new(size[0], size[1])
        .reference(Reference::Scene { tonemapped_detection: false })
        .attributes(true)
        .method(Method::None)
}
