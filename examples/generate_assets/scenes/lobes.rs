//! Rows of spheres, a scene for each material extension; its effect grows from left to right.

use super::glb::{Builder, Placement, linear};
use super::mesh::{Mesh, globe};
use glam::{DVec3, dvec3};
use serde_json::{Value, json};

const COUNT: usize = 5;

/// `KHR_materials_ior`: index of refraction from 1 to 3.
pub fn ior() -> Vec<u8> {
    row("Index of refraction", [36, 60, 110], 0.2, |share| json!({ "KHR_materials_ior": { "ior": 1.0 + 2.0 * share } }))
}

/// `KHR_materials_specular`: from no reflection to a strong, golden one.
pub fn specular() -> Vec<u8> {
    row("Specular", [40, 40, 44], 0.2, |share| {
        json!({ "KHR_materials_specular": {
            "specularFactor": share, "specularColorFactor": [6.0, 4.5, 1.5],
        } })
    })
}

/// `KHR_materials_clearcoat`: growing coat over a rough base.
pub fn clearcoat() -> Vec<u8> {
    row("Clearcoat", [170, 30, 36], 0.7, |share| {
        json!({ "KHR_materials_clearcoat": {
            "clearcoatFactor": share, "clearcoatRoughnessFactor": 0.05,
        } })
    })
}

/// `KHR_materials_sheen`: growing roughness.
pub fn sheen() -> Vec<u8> {
    row("Sheen", [30, 34, 60], 0.9, |share| {
        json!({ "KHR_materials_sheen": {
            "sheenColorFactor": [0.75, 0.5, 1.0], "sheenRoughnessFactor": 0.2 + 0.8 * share,
        } })
    })
}

/// `KHR_materials_anisotropy`: growing strength, along the parallels of the spheres.
pub fn anisotropy() -> Vec<u8> {
    metal(
        "Anisotropy",
        [214, 170, 108],
        0.3,
        |share| json!({ "KHR_materials_anisotropy": { "anisotropyStrength": share } }),
    )
}

/// `KHR_materials_iridescence`: growing thickness.
pub fn iridescence() -> Vec<u8> {
    row("Iridescence", [16, 16, 18], 0.15, |share| {
        json!({ "KHR_materials_iridescence": {
            "iridescenceFactor": 1.0, "iridescenceIor": 1.8,
            "iridescenceThicknessMaximum": 150.0 + 500.0 * share,
        } })
    })
}

/// `KHR_materials_diffuse_transmission`: growing share of transmitted light.
pub fn diffuse_transmission() -> Vec<u8> {
    row("Diffuse transmission", [70, 130, 60], 0.8, |share| {
        json!({ "KHR_materials_diffuse_transmission": {
            "diffuseTransmissionFactor": share, "diffuseTransmissionColorFactor": [0.9, 0.7, 0.2],
        } })
    })
}

/// `KHR_materials_transmission` and `KHR_materials_volume`: growing thickness.
pub fn transmission() -> Vec<u8> {
    row("Transmission", [255, 255, 255], 0.1, |share| {
        json!({
            "KHR_materials_transmission": { "transmissionFactor": 1.0 },
            "KHR_materials_volume": {
                "thicknessFactor": 2.0 * share, "attenuationDistance": 1.0,
                "attenuationColor": [0.3, 0.8, 0.6],
            },
        })
    })
}

/// `KHR_materials_pbrSpecularGlossiness`: growing glossiness.
pub fn specular_glossiness() -> Vec<u8> {
    row("Specular-glossiness", [0, 0, 0], 1.0, |share| {
        json!({ "KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.05, 0.1, 0.05, 1.0], "specularFactor": [0.2, 0.4, 0.3],
            "glossinessFactor": 0.2 + 0.7 * share,
        } })
    })
}

/// A row of dielectric spheres of the same colour and roughness; `extensions` gives their extensions for a share from
/// 0 to 1.
fn row(title: &str, color: [u8; 3], roughness: f64, extensions: impl Fn(f64) -> Value) -> Vec<u8> {
    spheres(title, color, 0.0, roughness, extensions)
}

/// A row of metal spheres, as [`row`] makes dielectric ones.
fn metal(title: &str, color: [u8; 3], roughness: f64, extensions: impl Fn(f64) -> Value) -> Vec<u8> {
    spheres(title, color, 1.0, roughness, extensions)
}

fn spheres(title: &str, color: [u8; 3], metallic: f64, roughness: f64, extensions: impl Fn(f64) -> Value) -> Vec<u8> {
    let mut file = Builder::default();
    let [r, g, b] = color.map(linear);
    let ball = file.surface(&globe(32, 18));
    for index in 0..COUNT {
        let share = index as f64 / (COUNT - 1) as f64;
        let material = file.material(json!({
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic,
                "roughnessFactor": roughness,
            },
            "extensions": extensions(share),
        }));
        let mesh = file.mesh(&[(ball, material)]);
        let x = 2.2 * (index as f64 - (COUNT - 1) as f64 / 2.0);
        file.place(mesh, Placement::at(dvec3(x, 1.0, 0.0)));
    }
    floor(&mut file);
    file.perspective("front", dvec3(0.0, 2.6, 13.5), dvec3(0.0, 0.9, 0.0), 27.0);
    file.finish(title)
}

/// Striped floor, against which the transparency of spheres is visible.
fn floor(file: &mut Builder) {
    for (name, color, first) in [("light", [222, 212, 196], 0), ("dark", [120, 110, 100], 1)] {
        let paint = file.paint(name, color, 0.9);
        let mut stripes = Mesh::default();
        for stripe in (first..28).step_by(2) {
            let x = -7.0 + 0.5 * f64::from(stripe);
            let corner = |x: f64, z: f64| DVec3::new(x, 0.0, z);
            stripes.polygon(&[corner(x, 2.5), corner(x + 0.5, 2.5), corner(x + 0.5, -4.0), corner(x, -4.0)]);
        }
        let surface = file.surface(&stripes);
        let mesh = file.mesh(&[(surface, paint)]);
        file.place(mesh, Placement::at(DVec3::ZERO));
    }
}
