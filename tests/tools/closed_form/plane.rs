//! A textured plane to the horizon: rendered, and integrated over each pixel.

use super::texture::Texture;
use crate::measurement::brute_force;
use crate::measurement::stress::stage::{Stage, camera};
use crate::textured::textured;
use gpc::render::{Footprint, Headless, MethodKind, PreparedScene, Reference, SceneRequest, Settings};
use gpc::scene::{AlphaMode, Filter, TextureTransform, TextureUse};
use rayon::prelude::*;

/// Width and height of the image in pixels. The upper half is sky; the horizon lies between two rows.
pub const SIZE: [u32; 2] = [64, 48];
/// Linear colour of the sky.
const SKY: f64 = 0.3;
/// Distance of the plane's far edge / height of the eye above the plane: a twentieth of a pixel below the horizon.
const FAR: f64 = 480.0;
/// Number of pixels below the horizon within which the plane is integrated point by point, because lines are too long
/// there.
const NEAR_HORIZON: f64 = 0.5;
/// Number of points of a pixel for that.
const POINTS: u32 = 1 << 18;

/// The plane, one unit below the eye, and the mapping of its texture.
pub struct Plane {
    pub texture: Texture,
    /// Texture coordinates per unit of the plane, before `transform`; u is to the right, v is ahead.
    pub scale: f64,
    pub transform: TextureTransform,
}

impl Plane {
    /// A plane on which the texture covers four units, without a transform.
    pub fn new(texture: Texture) -> Self {
        Self { texture, scale: 0.25, transform: TextureTransform::default() }
    }

    /// Uploads the plane to a device.
    pub fn upload(&self, headless: &mut Headless) -> PreparedScene {
        let mut material = textured(AlphaMode::Opaque);
        material.base_color_texture = Some(TextureUse { texture: 0, uv_set: 0, transform: self.transform });
        let mut stage = Stage::new(vec![material]);
        stage.texture = Some((self.texture.image.clone(), self.texture.sampler));
        // The plane starts in front of the near plane's lower edge, and is wide enough for the image's corners.
        let (near, far, side) = (0.5_f32, FAR as f32, 2.0 * FAR as f32);
        stage.add_quad(0, [[-side, -1.0, -near], [side, -1.0, -near], [side, -1.0, -far], [-side, -1.0, -far]]);
        for triangle in &mut stage.triangles {
            let scale = self.scale as f32;
            triangle.uvs = triangle.corners.map(|[x, _, z]| [scale * x, -scale * z]);
        }
        let (scene, pose) = stage.build();
        headless.upload(SceneRequest::new(&scene, &pose)).unwrap()
    }

    /// Texture coordinates of a place on the plane.
    fn coordinates(&self, right: f64, ahead: f64) -> [f64; 2] {
        self.transform
            .0
            .map(|[a, b, c]| f64::from(a) * self.scale * right + f64::from(b) * self.scale * ahead + f64::from(c))
    }

    /// Mean over a row of a pixel: `x` is the pixel's left edge from the image's middle, `y` the distance of the row
    /// below the horizon, in pixels.
    fn row(&self, x: f64, y: f64) -> f64 {
        let focal = f64::from(SIZE[1]) / 2.0;
        let place = |x: f64| self.coordinates(x / y, focal / y);
        self.texture.mean_along(place(x), place(x + 1.0))
    }

    /// Integral over a pixel's width, between two distances below the horizon. It uses Gauss's four-point rule over
    /// steps of fractions of a texel along the reciprocal of the distance, in which the texture is uniform.
    fn integral(&self, x: f64, from: f64, to: f64) -> f64 {
        const NODES: [[f64; 2]; 4] = [
            [-0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
            [-0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
            [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
            [0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
        ];
        let (low, high) = (1.0 / to, 1.0 / from);
        let [near, far] = [low, high].map(|t| self.coordinates(x * t, f64::from(SIZE[1]) / 2.0 * t));
        let texels = f64::from(super::texture::SIDE);
        let length = (far[0] - near[0]).abs().max((far[1] - near[1]).abs()) * texels;
        let texel = match self.texture.sampler.mag {
            Filter::Linear => 2.0,
            // The texture is constant within texels, and jumps between them.
            Filter::Nearest => 8.0,
        };
        let steps = (texel * length).ceil().max(1.0);
        let half = 0.5 * (high - low) / steps;
        let step = |index: u32| {
            let middle = low + (2.0 * f64::from(index) + 1.0) * half;
            let node = |[offset, weight]: [f64; 2]| {
                let t = middle + offset * half;
                half * weight * self.row(x, 1.0 / t) / (t * t)
            };
            NODES.map(node).iter().sum::<f64>()
        };
        (0..steps as u32).map(step).sum()
    }

    /// Integral just below the horizon, where lines are thousands of texels long: the mean of quasi-random points (M.
    /// Roberts' generalised golden ratio).
    fn integral_of_points(&self, x: f64, from: f64, to: f64) -> f64 {
        let point = |index: u32| {
            let fraction = |step: f64| (0.5 + f64::from(index) * step).fract();
            let y = from + (to - from) * fraction(0.754_877_666_246_692_8);
            let place = x + fraction(0.569_840_290_998_053_3);
            self.texture.at(self.coordinates(place / y, f64::from(SIZE[1]) / 2.0 / y))
        };
        (to - from) * (0..POINTS).map(point).sum::<f64>() / f64::from(POINTS)
    }

    /// Mean of each pixel in linear light, rows from the top.
    pub fn expected(&self) -> Vec<f64> {
        let [width, height] = SIZE.map(f64::from);
        let edge = height / 2.0 / FAR;
        let pixel = |index: u32| {
            let x = f64::from(index % SIZE[0]) - width / 2.0;
            let y = f64::from(index / SIZE[0]) - height / 2.0;
            if y < 0.0 {
                return SKY;
            }
            if y > 0.0 {
                return self.integral(x, y, y + 1.0);
            }
            edge * SKY + self.integral_of_points(x, edge, NEAR_HORIZON) + self.integral(x, NEAR_HORIZON, 1.0)
        };
        (0..SIZE[0] * SIZE[1]).into_par_iter().map(pixel).collect()
    }
}

/// Settings with which pixels are means of linear light.
pub fn settings(method: MethodKind, samples: u32) -> Settings {
    Settings::new(SIZE[0], SIZE[1])
        .background(Some([SKY as f32; 3]))
        .reference(Reference::Scene { tonemapped_detection: false })
        .method(method.with_samples(samples))
}

/// Image of a method.
pub fn render(headless: &mut Headless, scene: &PreparedScene, settings: &Settings) -> Vec<f64> {
    let mut frame = headless.prepare(scene, settings).unwrap();
    let rendered = headless.render(&mut frame, &camera()).unwrap();
    rendered.colors.iter().map(|color| f64::from(color[0])).collect()
}

/// Reference with 4,096 samples a pixel; `footprint` says over which area it reads textures.
pub fn reference(headless: &mut Headless, scene: &PreparedScene, footprint: Footprint) -> Vec<f64> {
    let settings = settings(MethodKind::None, 1).footprint(footprint);
    let colors = brute_force(headless, scene, &camera(), &settings, 4096, || {}).unwrap();
    colors.iter().map(|color| f64::from(color[0])).collect()
}

/// Root mean squared difference over the lower half of the image without the first `without` rows below the horizon.
pub fn rmse(image: &[f64], expected: &[f64], without: u32) -> f64 {
    assert_eq!(image.len(), expected.len());
    let first = ((SIZE[1] / 2 + without) * SIZE[0]) as usize;
    let pairs = image.iter().zip(expected).skip(first);
    let sum: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    (sum / (image.len() - first) as f64).sqrt()
}
