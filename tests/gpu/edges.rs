//! Edges of meshes, compared with polygons of the visible edges.

use glam::{DQuat, DVec3, EulerRot};
use gpc::camera::{Camera, Projection};
use gpc::render::{Detection, Headless, SceneRequest, Settings};
use gpc::sampling::Pattern;
use gpc::scene::{Edges, PoseRequest};
use serde_json::json;
use std::collections::BTreeMap;
use twins::stroke::{Edge, Eye, edge};

use crate::scene_builder::Builder;
use crate::stage::{camera, centre, everywhere, on_gpu};

const SIZE: [u32; 2] = [64, 48];
/// Number of samples along each axis of a pixel.
const SAMPLES: usize = 12;

/// A mesh whose faces share vertices.
struct Mesh {
    vertices: Vec<DVec3>,
    faces: Vec<[usize; 3]>,
}

impl Mesh {
    fn cube() -> Self {
        let corner = |v: usize| [0, 1, 2].map(|axis| if v >> axis & 1 == 1 { 0.8 } else { -0.8 });
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Self {
            vertices: (0..8).map(|v| DVec3::from_array(corner(v))).collect(),
            faces: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
        }
    }

    /// A sphere of rings around the y axis, without creases.
    fn sphere() -> Self {
        let (rings, around) = (9, 16);
        let mut vertices = vec![DVec3::Y, DVec3::NEG_Y];
        for ring in 1..rings {
            let (sin, cos) = (ring as f64 / rings as f64 * std::f64::consts::PI).sin_cos();
            vertices.extend((0..around).map(|k| {
                let turn = (k as f64 + 0.5) / around as f64 * std::f64::consts::TAU;
                DVec3::new(sin * turn.sin(), cos, sin * turn.cos())
            }));
        }
        let at = |ring: usize, k: usize| 2 + (ring - 1) * around + k % around;
        let mut faces = Vec::new();
        for k in 0..around {
            faces.push([0, at(1, k), at(1, k + 1)]);
            faces.push([1, at(rings - 1, k + 1), at(rings - 1, k)]);
            for ring in 1..rings - 1 {
                let (a, b) = (at(ring, k), at(ring, k + 1));
                let (c, d) = (at(ring + 1, k), at(ring + 1, k + 1));
                faces.extend([[a, c, b], [b, c, d]]);
            }
        }
        Self { vertices, faces }
    }

    /// A square of two faces.
    fn sheet() -> Self {
        let corners = [[-1.0, -0.8], [1.0, -0.9], [0.9, 1.0], [-0.7, 0.8]];
        Self {
            vertices: corners.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect(),
            faces: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    fn placed(mut self, turn: [f64; 3], distance: f64) -> Self {
        let turn = DQuat::from_euler(EulerRot::XYZ, turn[0], turn[1], turn[2]);
        for vertex in &mut self.vertices {
            *vertex = (turn * *vertex + DVec3::new(0.1, -0.05, -distance)).as_vec3().as_dvec3();
        }
        self
    }

    /// Edges of the mesh; those between faces that turn by more than 30 degrees are creases.
    fn edges(&self, is_double_sided: bool) -> Vec<Edge> {
        let mut known: BTreeMap<[usize; 2], [Option<usize>; 2]> = BTreeMap::new();
        for face in &self.faces {
            for k in 0..3 {
                let [from, to, third] = [0, 1, 2].map(|i| face[(k + i) % 3]);
                let faces = known.entry([from.min(to), from.max(to)]).or_default();
                faces[usize::from(from > to)] = Some(third);
            }
        }
        let edges = known.into_iter().map(|(ends, faces)| {
            let [a, b] = ends.map(|v| self.vertices[v]);
            let [front, back] = faces.map(|third| third.map(|v| self.vertices[v]));
            let normals = front.zip(back).map(|(front, back)| {
                let (front, back) = ((b - a).cross(front - a), (a - b).cross(back - b));
                front.angle_between(back).to_degrees()
            });
            Edge {
                ends: [a, b].map(|p| p.to_array()),
                faces: [front, back].map(|third| third.map(|p| p.to_array())),
                is_smooth: normals.is_some_and(|angle| angle < 30.0),
                is_double_sided,
            }
        });
        edges.collect()
    }

    /// Number of visible edges, and the share of each pixel that they cover.
    fn covered(&self, is_double_sided: bool, camera: &Camera, width: f64) -> (usize, Vec<f64>) {
        let [w, h] = SIZE.map(f64::from);
        let matrix = camera.pixel_matrix(DVec3::ZERO, w, h);
        let eye = if camera.is_orthographic() {
            Eye::Along(camera.direction().to_array())
        } else {
            Eye::At(camera.eye.to_array())
        };
        let edges = self.edges(is_double_sided);
        let shown = edges.iter().filter(|edge| edge.shows(eye));
        let polygons: Vec<_> = shown
            .map(|shown| {
                let clip = |p: [f64; 3]| (matrix * DVec3::from_array(p).extend(1.0)).to_array();
                edge(shown.ends.map(clip), shown.is_smooth, width)
            })
            .collect();
        let within = |at: [f64; 2]| {
            polygons.iter().any(|polygon| {
                let next = polygon.iter().cycle().skip(1);
                polygon
                    .iter()
                    .zip(next)
                    .all(|(p, q)| (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]) <= 0.0)
            })
        };
        let share = |pixel: usize| {
            let [x, y] = centre(pixel, SIZE);
            let offset = |i: usize| (i as f64 + 0.5) / SAMPLES as f64 - 0.5;
            let samples = (0..SAMPLES * SAMPLES).map(|i| [x + offset(i % SAMPLES), y + offset(i / SAMPLES)]);
            samples.filter(|at| within(*at)).count() as f64 / (SAMPLES * SAMPLES) as f64
        };
        let count = (SIZE[0] * SIZE[1]) as usize;
        (polygons.len(), (0..count).map(share).collect())
    }

    /// Share of each pixel that the edges cover in a rendered image.
    fn drawn(&self, gpu: &mut Headless, settings: &Settings, look: &Look) -> Vec<f32> {
        let mut builder = Builder::new();
        let sign = if look.is_mirrored { -1.0 } else { 1.0 };
        let at = |v: &usize| {
            let [x, y, z] = self.vertices[*v].as_vec3().to_array();
            [sign * x, y, z]
        };
        // Faces have their own vertices, as in meshes with flat shading.
        let wound = |[a, b, c]: &[usize; 3]| {
            if look.is_mirrored { [*a, *c, *b] } else { [*a, *b, *c] }
        };
        let corners: Vec<_> = self.faces.iter().flat_map(wound).map(|v| at(&v)).collect();
        let positions = builder.floats(&corners);
        let material = builder.push(
            "materials",
            json!({
                "doubleSided": look.is_double_sided, "extensions": {"KHR_materials_unlit": {}},
                "pbrMetallicRoughness": {"baseColorFactor": [1.0, 0.0, 0.0, 1.0]},
            }),
        );
        builder.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
        builder.node_with(
            json!({"attributes": {"POSITION": positions}, "material": material}),
            json!({"scale": [sign, 1.0, 1.0]}),
        );
        let mut scene = builder.load().unwrap().scene;
        scene.add_edges(&Edges { color: [0.0, 1.0, 0.0], ..Edges::default() });
        let pose = scene.pose(&PoseRequest::default()).unwrap();
        let prepared = gpu.upload(SceneRequest::new(&scene, &pose)).unwrap();
        let mut frame = gpu.prepare(&prepared, settings).unwrap();
        let image = gpu.render(&mut frame, &look.camera).unwrap();
        image.colors.iter().map(|color| color[1]).collect()
    }

    #[track_caller]
    fn check(&self, gpu: &mut Headless, settings: &Settings, look: &Look) -> usize {
        let found = self.drawn(gpu, settings, look);
        let width = f64::from(settings.scene.edge_width);
        let (shown, expected) = self.covered(look.is_double_sided, &look.camera, width);
        for (pixel, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let error = (f64::from(*found) - expected).abs();
            assert!(error < 0.13, "pixel {pixel}: {found}, expected {expected}");
        }
        let error = found.iter().zip(&expected).map(|(a, b)| f64::from(*a) - b);
        let mean = (error.map(|e| e * e).sum::<f64>() / found.len() as f64).sqrt();
        assert!(mean < 0.012, "{mean}");
        shown
    }
}

struct Look {
    camera: Camera,
    is_double_sided: bool,
    is_mirrored: bool,
}

impl Look {
    fn new() -> Self {
        Self { camera: camera(), is_double_sided: false, is_mirrored: false }
    }
}

fn settings(edge_width: f32) -> Settings {
    everywhere(SIZE, Pattern::Sobol, 256).edge_width(edge_width)
}

/// All visible edges of a convex mesh are in front of its faces, and all others behind them.
#[test]
fn edges_are_not_hidden_by_their_faces() {
    on_gpu(|gpu| {
        for width in [1.0, 4.0] {
            for turn in [[0.5, 0.7, 0.1], [2.4, -0.3, 1.2], [0.05, 0.02, 0.3]] {
                let shown = Mesh::cube().placed(turn, 2.2).check(gpu, &settings(width), &Look::new());
                // A cube has twelve edges; those of a face that is almost edge-on may be visible or not.
                assert!((4..=9).contains(&shown), "{shown} of a cube's");
                Mesh::sphere().placed(turn, 2.0).check(gpu, &settings(width), &Look::new());
            }
        }
    });
}

#[test]
fn a_parallel_projection_has_silhouettes_of_its_own() {
    on_gpu(|gpu| {
        let mut look = Look::new();
        look.camera.projection = Projection::Orthographic { half_height: 1.5, near: 0.1, far: 10.0 };
        for mesh in [Mesh::cube(), Mesh::sphere()] {
            mesh.placed([0.5, 0.7, 0.1], 3.0).check(gpu, &settings(2.0), &look);
        }
    });
}

#[test]
fn a_mirrored_mesh_has_the_same_edges() {
    on_gpu(|gpu| {
        let mesh = Mesh::sphere().placed([0.5, 0.7, 0.1], 2.0);
        let plain = mesh.drawn(gpu, &settings(2.0), &Look::new());
        let look = Look { is_mirrored: true, ..Look::new() };
        let mirrored = mesh.drawn(gpu, &settings(2.0), &look);
        let pairs = plain.iter().zip(&mirrored);
        let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(apart < 0.02, "{apart}");
        mesh.check(gpu, &settings(2.0), &look);
    });
}

#[test]
fn boundaries_show_with_their_surface() {
    on_gpu(|gpu| {
        // The sheet is seen from the front and from behind.
        for (turn, is_double_sided, expected) in
            [([0.2, 0.3, 0.1], false, 4), ([0.2, 3.4, 0.1], false, 0), ([0.2, 3.4, 0.1], true, 4)]
        {
            let look = Look { is_double_sided, ..Look::new() };
            let sheet = Mesh::sheet().placed(turn, 2.0);
            let shown = sheet.check(gpu, &settings(2.0), &look);
            assert_eq!(shown, expected);
        }
    });
}

/// Thin edges are found where the image aliases.
#[test]
fn thin_edges_are_found() {
    on_gpu(|gpu| {
        let mesh = Mesh::cube().placed([0.5, 0.7, 0.1], 2.2);
        for width in [0.5, 1.0] {
            let all = mesh.drawn(gpu, &settings(width), &Look::new());
            let found = settings(width).map_superpixels(|options| options.detection(Detection::Contrast));
            let found = mesh.drawn(gpu, &found, &Look::new());
            let unlike = all.iter().zip(&found).filter(|(a, b)| (**a - **b).abs() > 0.05);
            assert_eq!(unlike.count(), 0, "width {width}");
        }
    });
}
