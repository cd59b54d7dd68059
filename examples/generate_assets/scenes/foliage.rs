//! A tree and grass made of cards with alpha masks, whose edges lie within triangles.

use super::glb::{Builder, Placement};
use super::mesh::Mesh;
use super::picture::{coverage, paint};
use glam::{DVec3, dvec2, dvec3};
use gpc::testing::Random;
use serde_json::json;
use std::f64::consts::{PI, TAU};

const TEXELS: u32 = 256;

/// Builds the scene.
pub fn build() -> Vec<u8> {
    let mut file = Builder::default();
    let mut random = Random::new(29);
    ground(&mut file);
    let bark = file.paint("bark", [122, 94, 72], 0.95);
    let mut wood = Mesh::default();
    let mut tips = Vec::new();
    let trunk = Branch { from: DVec3::ZERO, along: DVec3::Y * 1.25, radius: 0.17, level: 0 };
    grow(&mut wood, &mut tips, &mut random, &trunk);
    place(&mut file, &wood, bark);

    let leaves = masked(&mut file, "leaves", &paint(TEXELS, leaf_cluster));
    let mut crown = Mesh::default();
    let centre = dvec3(0.0, 2.9, 0.0);
    for &tip in &tips {
        for _ in 0..3 {
            let spread = |random: &mut Random| random.range(-0.18, 0.18);
            let at = tip + dvec3(spread(&mut random), spread(&mut random), spread(&mut random));
            let outward = ((at - centre).normalize() + DVec3::Y * 0.35).normalize();
            let lean = dvec3(random.range(-0.8, 0.8), random.range(-0.4, 0.8), random.range(-0.8, 0.8));
            // The back of a card is shaded as if its normal were reversed; both cameras are at +z.
            let mut facing = (outward + lean).normalize();
            facing.z = facing.z.abs();
            let size = random.range(0.17, 0.27);
            crown.card(card(at, facing, size, random.range(0.0, TAU)), outward);
        }
    }
    place(&mut file, &crown, leaves);

    let blades = masked(&mut file, "grass", &paint(TEXELS, grass_tuft));
    let mut grass = Mesh::default();
    for _ in 0..260 {
        let distance = 0.4 + 5.2 * random.range(0.0, 1.0).sqrt();
        let (sin, cos) = random.range(0.0, TAU).sin_cos();
        let foot = dvec3(distance * cos, -0.015, distance * sin);
        let (turn_sin, turn_cos) = random.range(-0.5 * PI, 0.5 * PI).sin_cos();
        let across = dvec3(turn_cos, 0.0, turn_sin) * random.range(0.2, 0.34);
        let up = DVec3::Y * random.range(0.22, 0.46);
        let corners = [foot - across, foot + across, foot + across + up, foot - across + up];
        grass.card(corners, DVec3::Y);
    }
    place(&mut file, &grass, blades);
    file.daylight();
    file.perspective("tree", dvec3(1.3, 1.6, 6.5), dvec3(0.0, 2.0, 0.0), 38.0);
    file.perspective("below", dvec3(1.9, 0.7, 2.9), dvec3(-0.1, 2.7, -0.2), 46.0);
    file.finish("Foliage")
}

fn place(file: &mut Builder, mesh: &Mesh, material: usize) {
    let surface = file.surface(mesh);
    let mesh = file.mesh(&[(surface, material)]);
    file.place(mesh, Placement::at(DVec3::ZERO));
}

fn masked(file: &mut Builder, name: &str, png: &[u8]) -> usize {
    let texture = file.texture(png, false);
    file.material(json!({
        "name": name, "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": texture }, "metallicFactor": 0.0, "roughnessFactor": 0.85,
        },
    }))
}

fn ground(file: &mut Builder) {
    let soil = file.paint("meadow", [134, 160, 86], 0.95);
    let mut disc = Mesh::default();
    let rim = |step: i32| {
        let (sin, cos) = (TAU * f64::from(step) / 64.0).sin_cos();
        dvec3(6.2 * cos, 0.0, 6.2 * sin)
    };
    for step in 0..64 {
        disc.polygon(&[DVec3::ZERO, rim(step + 1), rim(step)]);
    }
    place(file, &disc, soil);
}

struct Branch {
    from: DVec3,
    along: DVec3,
    radius: f64,
    level: u32,
}

/// Adds a branch's wood, then the branches at its end; twigs of the last level carry leaves.
fn grow(wood: &mut Mesh, tips: &mut Vec<DVec3>, random: &mut Random, branch: &Branch) {
    let middle = branch.from + branch.along * 0.5 + wander(random, 0.05 * branch.along.length());
    let end = branch.from + branch.along;
    let thin = branch.radius * 0.68;
    let sides = 10 - 2 * branch.level.min(3);
    wood.tube(&[branch.from, middle, end], [branch.radius, thin], sides);
    if branch.level >= 3 {
        tips.extend([middle, end]);
    }
    if branch.level == 5 {
        return;
    }
    let count = if branch.level == 0 { 4 } else { 2 + u32::from(branch.level == 2) };
    let phase = random.range(0.0, TAU);
    let across = branch.along.normalize().any_orthonormal_vector();
    let other = branch.along.normalize().cross(across);
    for i in 0..count {
        let (sin, cos) = (phase + TAU * f64::from(i) / f64::from(count)).sin_cos();
        let bend = random.range(0.5, 0.95);
        let direction = branch.along.normalize() + (across * cos + other * sin) * bend + DVec3::Y * 0.12;
        let length = branch.along.length() * random.range(0.62, 0.8);
        let child =
            Branch { from: end, along: direction.normalize() * length, radius: thin * 0.8, level: branch.level + 1 };
        grow(wood, tips, random, &child);
    }
}

fn wander(random: &mut Random, size: f64) -> DVec3 {
    dvec3(random.range(-size, size), random.range(-size, size), random.range(-size, size))
}

fn card(centre: DVec3, facing: DVec3, size: f64, turn: f64) -> [DVec3; 4] {
    let (sin, cos) = turn.sin_cos();
    let u = facing.any_orthonormal_vector();
    let v = facing.cross(u);
    let [across, up] = [(u * cos + v * sin) * size, (v * cos - u * sin) * size];
    [centre - across - up, centre + across - up, centre + across + up, centre - across + up]
}

/// Mixes two sRGB colours.
fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [u8; 3] {
    std::array::from_fn(|i| (a[i] + (b[i] - a[i]) * t.clamp(0.0, 1.0)).round() as u8)
}

/// Nine pointed leaves around a twig. Transparent texels are leaf green too, so that filtering adds no fringe.
fn leaf_cluster(u: f64, v: f64) -> [u8; 4] {
    let point = dvec2(u - 0.5, 0.5 - v);
    let mut alpha = coverage((point.x.abs() - 0.008).max(point.y.abs() - 0.44), TEXELS);
    let mut color = mix([112.0, 92.0, 58.0], [0.0; 3], 0.0);
    for i in 0..9 {
        let i = f64::from(i);
        let angle = PI / 2.0 + (i - 4.0) * 0.56;
        let (sin, cos) = angle.sin_cos();
        let axis = dvec2(cos, sin);
        let from = dvec2(0.0, -0.3 + 0.06 * (4.0 - (i - 4.0).abs()));
        let local = point - from;
        let (t, side) = (local.dot(axis) / 0.42, local.perp_dot(axis));
        if !(0.0..=1.0).contains(&t) {
            continue;
        }
        // A leaf is widest at a third of its length and pointed at the tip.
        let width = 0.1 * (PI * t.powf(0.7)).sin().max(0.0);
        let cover = coverage(side.abs() - width, TEXELS);
        if cover > 0.0 {
            let vein = (1.0 - side.abs() * 160.0).max(0.0) * 0.6;
            let shade = 0.25 * i / 9.0 + 0.5 * t + 0.25 * (side * 8.0 + 0.5);
            let green = mix([62.0, 112.0, 48.0], [150.0, 184.0, 78.0], shade);
            color = mix(green.map(f64::from), [196.0, 214.0, 132.0], vein);
            alpha = alpha.max(cover);
        }
    }
    if alpha == 0.0 {
        color = [96, 142, 60];
    }
    let [r, g, b] = color;
    [r, g, b, (alpha * 255.0).round() as u8]
}

/// Fourteen bent blades that grow from the lower edge.
fn grass_tuft(u: f64, v: f64) -> [u8; 4] {
    let height = 1.0 - v;
    let mut alpha: f64 = 0.0;
    let mut color = [112, 150, 64];
    for i in 0..14 {
        let i = f64::from(i);
        let tall = 0.62 + 0.34 * (i * 2.399).sin().abs();
        let t = height / tall;
        if t > 1.0 {
            continue;
        }
        let foot = 0.22 + 0.56 * i / 13.0;
        let centre = foot + (foot - 0.5) * 0.5 * t * t + 0.08 * (i * 1.7).sin() * t * t;
        let cover = coverage((u - centre).abs() - 0.02 * (1.0 - t), TEXELS);
        if cover > 0.0 {
            color = mix([84.0, 122.0, 52.0], [182.0, 202.0, 104.0], t * 0.8 + 0.2 * (i * 3.1).sin());
            alpha = alpha.max(cover);
        }
    }
    let [r, g, b] = color;
    [r, g, b, (alpha * 255.0).round() as u8]
}
